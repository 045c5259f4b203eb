// SPDX-License-Identifier: Apache-2.0
// SDO server: block transfers while the controller refuses frames. [D20] [T12]
#include <algorithm>

#include "support/block_frames.hpp"

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

namespace {

using namespace test;

void finish_upload(Fixture& node, std::uint8_t ackseq) {
  node.rx(CO_IF_FRM{0x601, {0xA2, ackseq, 0x7F}, 8});
  if (ackseq == 127) {
    expect_segments(node, counting(890), 127, 1);
    node.rx("601#A2017F0000000000");
  }
  node.tx(notation(block_end(0x581, counting(890))));
  node.rx("601#A100000000000000");
  node.silent();
}

// Runs a block upload and a block download. Returns the frames of the server.
std::vector<std::string> session(Fixture& node) {
  std::vector<std::string> all;
  const auto say = [&](const CO_IF_FRM& frm) {
    node.rx(frm);
    for (int i = 0; i < 4; ++i) node.loop();
    for (const std::string& sent : node.frames()) all.push_back(sent);
  };
  for (const char* request : {"601#A400210F02000000", "601#A300000000000000", "601#A202020000000000",
                              "601#A201020000000000", "601#A100000000000000", "601#C600210F0F000000",
                              "601#0111121314151617", "601#0218191A1B1C1D1E", "601#831F000000000000"}) {
    say(frame(request));
  }
  say(block_end(0x601, counting(15, 0x11)));
  CHECK(node.objects.memory[15] == counting(15, 0x11));
  return all;
}

TEST_CASE("SDO block: no frame is lost or repeated, whichever ones the controller refuses [D20] [T12]") {
  Fixture undisturbed;
  const std::vector<std::string> expected = session(undisturbed);
  REQUIRE(expected.size() == 8);
  for (const std::int16_t refusal : {std::int16_t{0}, std::int16_t{-1}}) {
    for (const std::uint64_t times : {1U, 2U, 3U}) {
      for (std::uint64_t n = 1; n <= expected.size(); ++n) {
        CAPTURE(refusal);
        CAPTURE(times);
        CAPTURE(n);
        Fixture node;
        node.can.refuse_nth(n, refusal);
        node.can.refuse_to += times - 1;
        CHECK(session(node) == expected);
        CHECK(node.error() == (refusal == 0 ? CO_ERR_NONE : CO_ERR_IF_CAN_SEND));
        CHECK(node.counters().Dropped == 0);
      }
    }
  }
}

TEST_CASE("SDO block upload: it pauses at any segment and resumes with the next one [D20]") {
  for (std::uint64_t taken = 0; taken < 127; ++taken) {
    CAPTURE(taken);
    Fixture node;
    node.ask("601#A40421007F000000", "581#C60421007A030000");
    node.can.accept_next(taken);
    node.rx("601#A300000000000000");
    node.loop();
    const std::vector<std::string> first = node.frames();
    CHECK(first.size() == taken);
    node.can.accept_all();
    node.loop();
    std::vector<std::string> rest = node.frames();
    CHECK(rest.size() == 127 - taken);
    rest.insert(rest.begin(), first.begin(), first.end());
    for (std::size_t n = 0; n < rest.size(); ++n) {
      CO_IF_FRM segment = block_segment(counting(890), n, static_cast<unsigned>(n + 1));
      segment.Identifier = 0x581;
      CHECK(rest[n] == notation(segment));
    }
    finish_upload(node, 127);
  }
}

TEST_CASE("SDO block upload: it works with a controller that accepts a few frames at a time [D20]") {
  for (const std::uint64_t places : {1U, 2U, 3U, 16U}) {
    CAPTURE(places);
    Fixture node;
    node.ask("601#A40421007F000000", "581#C60421007A030000");
    node.can.accept_next(places);
    node.rx("601#A300000000000000");
    std::vector<std::string> all = node.frames();
    for (unsigned calls = 0; calls < 127 && all.size() < 127; ++calls) {
      node.can.accept_next(places);
      node.loop();
      const std::vector<std::string> some = node.frames();
      CHECK(some.size() <= places);
      all.insert(all.end(), some.begin(), some.end());
    }
    CHECK(all.size() == 127);
    CHECK(all.back() ==
          "581#7F737475767778"
          "79");
    node.can.accept_all();
    finish_upload(node, 127);
  }
}

TEST_CASE("SDO block upload: other frames are sent between its segments, and first [D20] [Q4]") {
  Fixture node(Setup().heartbeat(100));
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.accept_next(50);
  node.rx("601#A300000000000000");
  expect_segments(node, counting(890), 0, 50);
  CO_IF_FRM urgent = frame("081#0102030405060708");
  node.after(100ms);
  node.call([&] { COIfCanSend(&node->If, &urgent); });
  node.silent();
  node.can.accept_next(2);
  node.loop();
  node.tx({"081#0102030405060708", "701#7F"});
  node.can.accept_all();
  node.loop();
  const std::vector<std::string> rest = node.frames();
  REQUIRE(rest.size() == 77);
  CHECK(rest.front().substr(0, 6) == "581#33");
  CHECK(rest.back().substr(0, 6) == "581#7F");
}

TEST_CASE("SDO block upload: heartbeats keep their period during a paused upload [D20]") {
  Fixture node(Setup().heartbeat(50));
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.accept_next(0);
  node.rx("601#A300000000000000");
  unsigned heartbeats = 0;
  std::vector<std::string> segments;
  for (unsigned n = 0; n < 40; ++n) {
    node.after(25ms);
    node.can.accept_next(4);
    node.loop();
    for (const std::string& sent : node.frames()) {
      sent == "701#7F" ? void(++heartbeats) : segments.push_back(sent);
    }
  }
  CHECK(heartbeats == 20);
  CHECK(segments.size() == 127);
  node.can.accept_all();
}

TEST_CASE("SDO block upload: segments do not fill the transmit queue [D20]") {
  Fixture node(Setup().tx_queue(4));
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.refuse_all();
  node.rx("601#A300000000000000");
  node.loop();
  CHECK(node->TxQueue.Num == 0);
  CO_IF_FRM frm = frame("181#01");
  node.call([&] { CHECK(COIfCanSend(&node->If, &frm) == sizeof(CO_IF_FRM)); });
  node.can.accept_all();
  node.loop();
  std::vector<std::string> sent = node.frames();
  REQUIRE(sent.size() == 128);
  CHECK(sent.front() == "181#01");
  CHECK(sent.back().substr(0, 6) == "581#7F");
}

TEST_CASE("SDO block upload: a paused one resumes in a loop that sleeps until CONodeNextDeadline() [D20]") {
  Fixture node(Setup().wake(Wake::deadline));
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.accept_next(5);
  node.rx("601#A300000000000000");
  expect_segments(node, counting(890), 0, 5);
  CHECK(CONodeNextDeadline(&node.node) == 1);
  node.can.accept_all();
  node.after(1ms);
  CHECK(node.frames().size() == 122);
  CHECK(CONodeNextDeadline(&node.node) > 1);
}

TEST_CASE("SDO block upload: a slow controller does not cause a time-out of the client [D18] [D20]") {
  Fixture node;
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.accept_next(1);
  node.rx("601#A300000000000000");
  std::vector<std::string> all = node.frames();
  while (all.size() < 127) {
    node.can.accept_next(1);
    node.after(1000ms);
    node.loop();
    const std::vector<std::string> some = node.frames();
    REQUIRE(some.size() == 1);
    all.push_back(some[0]);
    REQUIRE(some[0].substr(0, 6) != "581#80");
  }
  node.can.accept_all();
  finish_upload(node, 127);
}

TEST_CASE("SDO block upload: a controller that refuses frames for long ends the transfer [D18] [D20]") {
  Fixture node;
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.refuse_all();
  node.rx("601#A300000000000000");
  node.after(3 * node.sdo_time_out());
  node.silent();
  node.can.accept_all();
  node.loop();
  node.frames();
  node.after(node.sdo_time_out());
  node.frames();
  node.ask("601#A3DEADBE00000000", "581#80DEADBE01000405");
  CHECK(node.block_upload(0x2104, 0).data == counting(890));
}

TEST_CASE(
    "SDO block upload: an acknowledge before all segments are sent begins the next block after them [D12] [D20]") {
  Fixture node;
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.accept_next(10);
  node.rx("601#A300000000000000");
  expect_segments(node, counting(890), 0, 10);
  node.rx("601#A204140000000000");
  node.silent();
  node.can.accept_all();
  node.loop();
  expect_segments(node, counting(890), 4, 20);
  node.rx("601#A214700000000000");
  expect_segments(node, counting(890), 24, 104);
  finish_upload(node, 104);
}

TEST_CASE("SDO block upload: an acknowledge of more segments than sent is aborted [D12] [D20]") {
  Fixture node;
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.accept_next(10);
  node.rx("601#A300000000000000");
  expect_segments(node, counting(890), 0, 10);
  node.rx("601#A20B140000000000");
  node.can.accept_all();
  node.loop();
  node.tx("581#8004210003000405");
}

TEST_CASE("SDO block upload: its end is queued like other answers [T12]") {
  Fixture node;
  node.ask("601#A40010007F000000", "581#C600100004000000");
  node.ask("601#A300000000000000", "581#8191010F00000000");
  node.can.refuse_all();
  node.rx("601#A2017F0000000000");
  node.silent();
  node.can.accept_all();
  node.loop();
  node.tx("581#CD25970000000000");
  node.rx("601#A100000000000000");
  node.silent();
}

TEST_CASE("SDO block download: refused answers are sent later and no segment counts twice [T12]") {
  for (const bool sized : {true, false}) {
    Fixture node;
    const Bytes data = counting(890, 31);
    node.can.refuse_all();
    node.rx(sized ? "601#C60421007A030000" : "601#C404210000000000");
    node.can.accept_all();
    node.loop();
    node.tx("581#A40421007F000000");
    node.can.refuse_all();
    send_segments(node, data, 0, 127);
    node.can.accept_all();
    node.loop();
    node.tx("581#A27F7F0000000000");
    node.can.refuse_all();
    send_segments(node, data, 127, 1);
    node.can.accept_all();
    node.loop();
    expect_last_ack(node, 1);
    node.can.refuse_all();
    node.rx(block_end(0x601, data));
    node.silent();
    CHECK(node.objects.memory[890] == data);
    node.can.accept_all();
    node.loop();
    node.tx("581#A100000000000000");
  }
}

// Returns the frames sent by one call, with or without a received frame.
std::vector<std::string> call_once(Fixture& node, std::string_view received = {}) {
  node.calls(1);
  received.empty() ? node.loop() : node.rx(received);
  node.calls(Fixture::enough_calls);
  return node.frames();
}

constexpr std::size_t pace = CO_SDO_BLOCK_PACE;

TEST_CASE("SDO block upload: each call sends a limited number of segments; the rest is due at once [T17] [Q2]") {
  Fixture node(Setup().only_small().with_mebibyte());
  node.ask("601#A40521007F000000", "581#C605210000001000");
  std::vector<std::string> sent = call_once(node, "601#A300000000000000");
  for (std::size_t number = sent.size(); number < 127; number += sent.size()) {
    CAPTURE(number);
    CHECK(sent.size() <= pace);
    CHECK(CONodeNextDeadline(&node.node) == 0);
    sent = call_once(node);
    REQUIRE(sent.size() == std::min(pace, 127 - number));
  }
  CHECK(CONodeNextDeadline(&node.node) != 0);
  CHECK(call_once(node).empty());
  node.rx("601#A27F010000000000");
  CHECK(node.frames().size() == 1);
  node.rx("601#8005210000000008");
}

TEST_CASE("SDO block upload: frames sent between two of its calls are not delayed until its end [T17] [Q4]") {
  Fixture node(Setup().only_small().with_mebibyte());
  node.ask("601#A40521007F000000", "581#C605210000001000");
  CHECK(call_once(node, "601#A300000000000000").size() == pace);
  CO_IF_FRM urgent = frame("181#01");
  node.call([&] { COIfCanSend(&node->If, &urgent); });
  node.tx("181#01");
  node.loop();
  CHECK(node.frames().size() == 127 - std::min<std::size_t>(pace, 127));
  node.rx("601#8005210000000008");
}

#if CO_SSDO_N > 1
TEST_CASE("SDO block upload: servers share the segments of a call in rotation [T17] [D20]") {
  Fixture node(Setup().before_init([](Objects& objects) {
    objects.sdo2_rx = 0x640;
    objects.sdo2_tx = 0x5C0;
  }));
  node.ask("601#A00421007F000000", "581#C60421007A030000");
  node.ask("640#A00321007F000000", "5C0#C603210078030000");
  std::vector<std::string> first = call_once(node, "601#A300000000000000");
  std::vector<std::string> all = call_once(node, "640#A300000000000000");
  CHECK(first.size() == pace);
  CHECK(all.size() <= pace);
  for (unsigned calls = 0; calls < 300 && first.size() + all.size() < 254; ++calls) {
    const std::vector<std::string> sent = call_once(node);
    CHECK(sent.size() <= pace);
    CHECK(!sent.empty());
    if (first.size() + all.size() < 127) {
      CHECK(sent.front().substr(0, 3) == sent.back().substr(0, 3));
      CHECK(sent.front().substr(0, 3) != all.back().substr(0, 3));
    }
    all.insert(all.end(), sent.begin(), sent.end());
  }
  CHECK(first.size() + all.size() == 254);
  node.rx("601#8000000000000008");
  node.rx("640#8000000000000008");
}
#endif

}  // namespace

#endif
