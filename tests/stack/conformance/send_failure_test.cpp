// SPDX-License-Identifier: Apache-2.0
// Behaviour of the node when the controller does not accept a frame. [T12] [Q4]
#include "support/fixture.hpp"

namespace {

using namespace test;

// Runs a session of boot-up, uploads, downloads, an abort, NMT and heartbeats. Returns the sent frames.
std::vector<std::string> session(Fixture& node) {
  std::vector<std::string> all;
  const auto collect = [&] {
    for (int i = 0; i < 4; ++i) node.loop();
    for (const std::string& sent : node.frames()) all.push_back(sent);
  };
  node.call([&] { CONodeStart(&node.node); });
  collect();
  for (const char* request :
       {"601#4008100000000000", "601#6000000000000000", "601#7000000000000000", "601#6000000000000000",
        "601#2108200008000000", "601#0001020304050607", "601#1D08000000000000", "601#4004100000000000", "000#0101",
        "601#4000100000000000", "601#2B17100064000000"}) {
    node.rx(request);
    collect();
  }
  for (int i = 0; i < 3; ++i) {
    node.after(100ms);
    collect();
  }
  node.rx("000#8201");
  collect();
  return all;
}

TEST_CASE("send failure: no answer, boot-up or heartbeat is lost, whichever frames the driver refuses [T12]") {
  Fixture undisturbed(Setup().stay_in_init());
  const std::vector<std::string> expected = session(undisturbed);
  CHECK(expected.size() == 15);
  for (const std::int16_t refusal : {std::int16_t{0}, std::int16_t{-1}}) {
    for (const std::uint64_t times : {1U, 2U, 3U}) {
      for (std::uint64_t n = 1; n <= expected.size(); ++n) {
        CAPTURE(refusal);
        CAPTURE(times);
        CAPTURE(n);
        Fixture node(Setup().stay_in_init());
        node.can.refuse_nth(n, refusal);
        node.can.refuse_to += times - 1;
        CHECK(session(node) == expected);
        CHECK(node.error() == (refusal == 0 ? CO_ERR_NONE : CO_ERR_IF_CAN_SEND));
        CHECK(node.counters().Dropped == 0);
        CHECK(node.counters().Sent == expected.size());
      }
    }
  }
}

TEST_CASE("send failure: queued frames are sent by priority, those of equal CAN-ID in order [Q4]") {
  Fixture node(Setup().heartbeat(10).tx_queue(20));
  node.can.refuse_all();
  node.after(10ms);
  node.rx("000#0101");
  node.after(10ms);
  node.rx("601#4000100000000000");
  CO_IF_FRM urgent = frame("091#0102030405060708");
  CO_IF_FRM late = frame("091#1112131415161718");
  CO_IF_FRM last = frame("7FF#");
  node.call([&] {
    COIfCanSend(&node->If, &last);
    COIfCanSend(&node->If, &urgent);
    COIfCanSend(&node->If, &late);
  });
  node.silent();
  node.can.accept_all();
  node.loop();
  node.tx({"091#0102030405060708", "091#1112131415161718", "581#4300100091010F00", "701#05", "7FF#"});
}

// Arbitration compares the base identifiers first; of equal ones, an 11-bit identifier wins. [ISO 11898-1]
TEST_CASE("send failure: queued 29-bit and 11-bit identifiers are sent in the order of arbitration [Q4]") {
  Fixture node(Setup().tx_queue(22));  // half of it may be reserved for the node's own frames
  node.can.refuse_all();
  node.call([&] {
    for (const char* text : {"0607FFFF#01", "06040001#02", "182#03", "06040000#04", "181#05", "00000001#06",
                             "0603FFFF#07", "1FFFFFFF#08", "180#09", "7FF#0A", "06080000#0B"}) {
      CO_IF_FRM frm = frame(text);
      CHECK(COIfCanSend(&node->If, &frm) == sizeof(CO_IF_FRM));
    }
  });
  node.can.accept_all();
  node.loop();
  node.tx({"00000001#06", "180#09", "0603FFFF#07", "181#05", "06040000#04", "06040001#02", "0607FFFF#01", "182#03",
           "06080000#0B", "7FF#0A", "1FFFFFFF#08"});
}

TEST_CASE("send failure: a new frame does not overtake queued ones of its CAN-ID [Q4]") {
  Fixture node;
  CO_IF_FRM first = frame("181#01");
  CO_IF_FRM second = frame("181#02");
  node.can.refuse_next(1);
  node.call([&] {
    CHECK(COIfCanSend(&node->If, &first) == sizeof(CO_IF_FRM));
    CHECK(COIfCanSend(&node->If, &second) == sizeof(CO_IF_FRM));
  });
  node.loop();
  node.tx({"181#01", "181#02"});
}

TEST_CASE("send failure: a full queue refuses frames of the application and counts them") {
  Fixture node(Setup().tx_queue(6));
  node.can.refuse_all();
  CO_IF_FRM frm = frame("181#01");
  std::size_t taken = 0;
  node.call([&] {
    while (COIfCanSend(&node->If, &frm) == sizeof(CO_IF_FRM)) ++taken;
    CHECK(COIfCanSend(&node->If, nullptr) == -1);
  });
  CHECK(taken >= 3);
  CHECK(node.counters().Dropped == 1);
  node.can.accept_all();
  node.loop();
  CHECK(node.frames() == std::vector<std::string>(taken, "181#01"));
}

TEST_CASE("send failure: a full queue delays an SDO answer and does not drop it [Q4] [T12]") {
  for (const std::string waiting : {"091#01", "7FF#01"}) {
    CAPTURE(waiting);
    Fixture node(Setup().tx_queue(2));
    node.can.refuse_all();
    CO_IF_FRM frm = frame(waiting);
    node.call([&] {
      for (int i = 0; i < 3; ++i) COIfCanSend(&node->If, &frm);
    });
    node.rx("601#4000100000000000");
    node.can.accept_all();
    node.loop();
    node.loop();
    const std::vector<std::string> sent = node.frames();
    CHECK(std::count(sent.begin(), sent.end(), "581#4300100091010F00") == 1);
  }
}

TEST_CASE("send failure: the boot-up gets the last slot of a full queue and is sent first [N4] [T12]") {
  for (const unsigned length : {1U, 2U, 5U}) {
    CAPTURE(length);
    Fixture node(Setup().tx_queue(static_cast<std::uint16_t>(length)).stay_in_init());
    node.can.refuse_all();
    CO_IF_FRM frm = frame("091#01");
    std::size_t taken = 0;
    node.call([&] {
      while (COIfCanSend(&node->If, &frm) == sizeof(CO_IF_FRM)) ++taken;
    });
    node.call([&] { CONodeStart(&node.node); });
    node.can.accept_all();
    node.loop();
    std::vector<std::string> expected(std::min<std::size_t>(taken, length - 1U) + 1U, "091#01");
    expected[0] = "701#00";
    CHECK(node.frames() == expected);
    CHECK(node.counters().Dropped == 1 + (taken == length ? 1U : 0U));
  }
}

TEST_CASE("send failure: CONodeNextDeadline is 1 ms while frames are queued") {
  Fixture node(Setup().rate(10000));
  CHECK(CONodeNextDeadline(&node.node) == 0xFFFFFFFF);
  node.can.refuse_all();
  node.rx("601#4000100000000000");
  CHECK(CONodeNextDeadline(&node.node) == 10);
  node.call([&] {
    COTmrCreate(
        &node->Tmr, 3, 0, [](void*) {}, nullptr);
  });
  CHECK(CONodeNextDeadline(&node.node) == 3);
  node.after(1ms);
  node.can.accept_all();
  node.loop();
  node.tx("581#4300100091010F00");
  CHECK(CONodeNextDeadline(&node.node) == 0xFFFFFFFF);
}

TEST_CASE("send failure: leaving states with SDO withdraws queued answers and no frame of the application [N8]") {
  Fixture node(Setup().tx_queue(20));
  node.can.refuse_all();
  node.rx("601#4000100000000000");
  for (const char* text : {"00000000#01", "00000581#02", "57F#03", "600#04", "1FFFFFFF#05"}) {
    CO_IF_FRM frm = frame(text);
    node.call([&] { CHECK(COIfCanSend(&node->If, &frm) == sizeof(CO_IF_FRM)); });
  }
  CHECK(node->TxQueue.Num == 6);
  node.rx("000#0201");
  CHECK(node->TxQueue.Num == 5);
  node.can.accept_all();
  node.loop();
  node.tx({"00000000#01", "00000581#02", "57F#03", "600#04", "1FFFFFFF#05"});
}

TEST_CASE("send failure: disabled channels withdraw no frame [N8]") {
  Fixture node(Setup().tx_queue(20));
  node.can.refuse_all();
  CO_IF_FRM frm = frame("1FFFFFFF#01");
  node.call([&] { CHECK(COIfCanSend(&node->If, &frm) == sizeof(CO_IF_FRM)); });
  frm = frame("00000000#02");
  node.call([&] { CHECK(COIfCanSend(&node->If, &frm) == sizeof(CO_IF_FRM)); });
  node.rx("000#0201");
  node.can.accept_all();
  node.loop();
  node.tx({"00000000#02", "1FFFFFFF#01"});
}

}  // namespace
