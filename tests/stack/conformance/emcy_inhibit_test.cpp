// SPDX-License-Identifier: Apache-2.0
// EMCY messages that are delayed by the inhibit time (1015h) or by the controller. [301:7.5.2.18]
#include "support/emcy_fixture.hpp"

#if USE_EMCY && CO_EMCY_QUEUE_N > 0

namespace {

using namespace test;

TEST_CASE("1015h: messages keep the inhibit time and carry 1001h of the time of their event [E6]") {
  for (const std::uint32_t rate : clock_rates) {
    for (const std::uint32_t start : clock_starts) {
      CAPTURE(rate);
      CAPTURE(start);
      EmcyNode node(Setup().only_small().emergencies(errors_of_device()).rate(rate).clock(start), 1000);
      node.set(current);
      node.tx("081#0020030000000000");
      node.set(hot);
      node.clr(current);
      node.silent();
      node.after(250ms);
      node.tx_at(100ms, "081#00400B0000000000");
      node.tx_at(2 * (Time{node.ticks(100ms) * 1000000 / rate}), "081#0000090000000000");
      node.silent();
    }
  }
}

TEST_CASE("1015h: after a pause the next message is sent at once [E6]") {
  EmcyNode node(Setup().emergencies(errors_of_device()), 1000);
  node.set(current);
  node.tx("081#0020030000000000");
  node.after(100ms);
  node.silent();
  node.clr(current);
  node.tx("081#0000000000000000");
  node.set(hot);
  node.silent();
  node.after(99ms);
  node.silent();
  node.after(1ms);
  node.tx("081#0040090000000000");
}

TEST_CASE("1015h: a fraction of a tick is rounded up; the longest time is kept [E6]") {
  EmcyNode shortest(Setup().emergencies(errors_of_device()), 1);
  shortest.set(current);
  shortest.clr(current);
  shortest.tx("081#0020030000000000");
  shortest.after(1ms);
  shortest.tx("081#0000000000000000");
  EmcyNode longest(Setup().emergencies(errors_of_device()), 0xFFFF);
  longest.set(current);
  longest.clr(current);
  longest.tx("081#0020030000000000");
  longest.after(7s);
  longest.tx_at(6554ms, "081#0000000000000000");
}

TEST_CASE("1015h: a new value applies from the next message [E6]") {
  EmcyNode node;
  node.ask("601#2B15100064000000", "581#6015100000000000");
  node.set(current);
  node.tx("081#0020030000000000");
  node.clr(current);
  node.set(hot);
  node.silent();
  node.ask("601#2B15100000000000", "581#6015100000000000");
  node.after(100ms);
  node.tx_at(10ms, "081#0000000000000000");
  node.tx_at(10ms, "081#0040090000000000");
  node.clr(hot);
  node.tx("081#0000000000000000");
}

TEST_CASE("1015h: a full queue keeps the first messages and the latest state, and counts lost messages [E6]") {
  EmcyNode node(Setup().emergencies(errors_of_device()), 1000);
  node.set(general);
  node.tx("081#0010010000000000");
  for (int n = 0; n < 20; ++n) {
    node.set(current);
    node.set(hot);
    node.clr(current);
    node.clr(hot);
  }
  node.set(no_disk);
  node.silent();
  CHECK(node.counters().Dropped == 81 - CO_EMCY_QUEUE_N);
  node.after(60s);
  const std::vector<std::string> sent = node.frames();
  CHECK(sent.size() == CO_EMCY_QUEUE_N);
  if (CO_EMCY_QUEUE_N == 4 && sent.size() == 4) {
    CHECK(sent[0] == "081#0020030000000000");
    CHECK(sent[1] == "081#00400B0000000000");
    CHECK(sent[2] == "081#0000090000000000");
  }
  CHECK(sent.back() == "081#00FF810000000000");
  CHECK(node.error_register() == 0x81);
}

TEST_CASE("1015h: queued messages are neither sent in Stopped nor after it [E9] [N3]") {
  EmcyNode node(Setup().emergencies(errors_of_device()), 10000);
  node.set(current);
  node.tx("081#0020030000000000");
  node.set(hot);
  node.set(general);
  node.rx("000#0201");
  CHECK(node.counters().Dropped == 2);
  node.after(500ms);
  node.rx("000#8001");
  node.after(10s);
  node.silent();
  CHECK(node.error_register() == 0x0B);
}

TEST_CASE(
    "1015h: messages that are queued in the inhibit time remain if 1014h is written with the same value [E5] [E6]") {
  EmcyNode node(Setup().emergencies(errors_of_device()), 1000);
  node.set(current);
  node.tx("081#0020030000000000");
  node.clr(current);
  node.ask("601#2314100081000000", "581#6014100000000000");
  node.after(100ms);
  node.tx("081#0000000000000000");
}

TEST_CASE("1015h: an error without an identifier in the inhibit time is not sent when there is one again [E5] [E6]") {
  EmcyNode node(Setup().emergencies(errors_of_device()), 1000);
  node.set(current);
  node.tx("081#0020030000000000");
  node.ask("601#2314100081000080", "581#6014100000000000");
  node.clr(current);
  node.ask("601#2314100081000000", "581#6014100000000000");
  node.after(100ms);
  node.silent();
  CHECK(node.counters().Dropped == 0);
}

TEST_CASE("1015h: the inhibit time runs in Stopped [E6]") {
  EmcyNode node(Setup().emergencies(errors_of_device()), 10000);
  node.set(current);
  node.tx("081#0020030000000000");
  node.rx("000#0201");
  node.after(400ms);
  node.rx("000#0101");
  node.clr(current);
  node.silent();
  node.after(600ms);
  node.tx_at(600ms, "081#0000000000000000");
}

TEST_CASE("1015h: a time beyond the range of the timer is limited to the longest one") {
  EmcyNode node(Setup().emergencies(errors_of_device()).rate(1000000000), 0xFFFF);
  node.set(current);
  node.clr(current);
  node.tx("081#0020030000000000");
  node.after(4s);
  node.silent();
  node.after(295ms);
  node.tx("081#0000000000000000");
}

TEST_CASE("1015h: a late main loop sends one message, and the next one an inhibit time later [Q8]") {
  EmcyNode node(Setup().emergencies(errors_of_device()), 1000);
  node.set(current);
  node.set(hot);
  node.set(no_disk);
  node.tx("081#0020030000000000");
  node.jump(1030ms);
  node.tx("081#00400B0000000000");
  node.after(100ms);
  node.tx_at(100ms, "081#00FF8B0000000000");
}

TEST_CASE("1015h: a missing entry, or one of another length, means an inhibit time of 0") {
  for (const bool missing : {false, true}) {
    CAPTURE(missing);
    Setup setup = Setup().emergencies(errors_of_device());
    missing ? setup.without(0x1015, 0) : setup;
    EmcyNode node(setup);
    if (!missing) {
      node.find(0x1015, 0)->Type = CO_TUNSIGNED8;
      node.find(0x1015, 0)->Data = 200;
    }
    node.set(current);
    node.clr(current);
    node.tx({"081#0020030000000000", "081#0000000000000000"});
  }
}

// CAN controller ------------------------------------------------------------------------------------------------------

TEST_CASE("EMCY: no message is lost, whichever frame the driver refuses [T12]") {
  const std::vector<std::string> expected = {"081#0020030000000000", "081#00400B0000000000", "081#0000090000000000",
                                             "081#0000000000000000"};
  for (const std::int16_t refusal : {std::int16_t{0}, std::int16_t{-1}}) {
    for (const std::uint64_t times : {1U, 2U, 3U}) {
      for (std::uint64_t nth = 1; nth <= 5; ++nth) {
        CAPTURE(refusal);
        CAPTURE(times);
        CAPTURE(nth);
        EmcyNode node(Setup().only_small().emergencies(errors_of_device()));
        node.can.refuse_nth(nth, refusal);
        node.can.refuse_to += times - 1;
        node.set(current);
        node.set(hot);
        node.clr(current);
        node.clr(hot);
        for (int n = 0; n < 5; ++n) node.loop();
        CHECK(node.frames() == expected);
        CHECK(node.counters().Dropped == 0);
      }
    }
  }
}

TEST_CASE("EMCY: a message that is raised while the transmit queue is full is sent later [T12]") {
  EmcyNode node(Setup().emergencies(errors_of_device()).tx_queue(2));
  node.can.refuse_all();
  node.set(current);
  node.set(hot);
  node.set(no_disk);
  node.clr(hot);
  node.silent();
  CHECK(node.node.TxQueue.Num == 2);
  node.after(100ms);
  node.silent();
  CHECK(node.counters().Dropped == 0);
  node.can.accept_all();
  node.after(2ms);
  node.tx({"081#0020030000000000", "081#00400B0000000000", "081#00FF8B0000000000", "081#0000830000000000"});
  CHECK(node.counters().Dropped == 0);
  node.after(1s);
  node.silent();
}

TEST_CASE("EMCY: in a transmit queue full of other frames it gets the first free slot [T12] [Q4]") {
  EmcyNode node(Setup().emergencies(errors_of_device()).tx_queue(1));
  node.can.refuse_all();
  node.rx("601#4000100000000000");
  node.set(current);
  node.after(10ms);
  CHECK(node.counters().Dropped == 0);
  node.can.accept_all();
  node.after(1ms);
  node.tx({"581#4300100091010F00", "081#0020030000000000"});
}

TEST_CASE("EMCY: while the controller refuses frames the latest state survives any number of errors [T12]") {
  EmcyNode node(Setup().emergencies(errors_of_device()).tx_queue(1));
  node.can.refuse_all();
  for (int n = 0; n < 100; ++n) {
    node.set(hot);
    node.clr(hot);
  }
  node.set(no_disk);
  CHECK(node.counters().Dropped == 201 - 1 - CO_EMCY_QUEUE_N);
  node.can.accept_all();
  node.after(10ms);
  const std::vector<std::string> sent = node.frames();
  CHECK(sent.size() == 1 + CO_EMCY_QUEUE_N);
  CHECK(sent.front() == "081#0040090000000000");
  CHECK(sent.back() == "081#00FF810000000000");
}

TEST_CASE("EMCY: a message queued for the controller is not sent in Stopped [N3] [E9]") {
  EmcyNode node(Setup().emergencies(errors_of_device()));
  node.can.refuse_all();
  node.set(current);
  CHECK(node.node.TxQueue.Num == 1);
  node.rx("000#0201");
  CHECK(node.node.TxQueue.Num == 0);
  CHECK(node.counters().Dropped == 1);
  node.can.accept_all();
  node.after(1s);
  node.silent();
}

TEST_CASE("EMCY: a node with an invalid 1014h does not remove frames of the application from the transmit queue") {
  Fixture node(Setup().with({CO_KEY(0x1014, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 0x80000081}));
  node.can.refuse_all();
  CO_IF_FRM command = frame("000#0102");
  node.call([&] { COIfCanSend(&node->If, &command); });
  node.rx("000#0201");
  CHECK(node.node.TxQueue.Num == 1);
}

TEST_CASE("EMCY: a message is sent before queued frames of lower priority [Q4]") {
  EmcyNode node(Setup().emergencies(errors_of_device()));
  node.can.refuse_all();
  node.rx("601#4000100000000000");
  node.set(current);
  node.can.accept_all();
  node.loop();
  node.tx({"081#0020030000000000", "581#4300100091010F00"});
}

TEST_CASE("EMCY: errors for a minute at an inhibit time of 10 ms: every message is on time and no memory grows") {
  EmcyNode node(Setup().only_small().emergencies(errors_of_device()), 100);
  std::size_t sent = 0;
  constexpr unsigned total = 60000 / stride(30);
  for (unsigned ms = 0; ms < total; ++ms) {
    const auto err = static_cast<std::uint8_t>(ms % 5);
    COEmcyGet(&node->Emcy, err) == 1 ? node.clr(err) : node.set(err);
    node.after(1ms);
    sent += node.trace().size();
  }
  CHECK(sent == total / 10 + 1);
  CHECK(node.counters().Dropped == total - (total / 10 + 1) - (CO_EMCY_QUEUE_N - 1));
  CHECK(node.errors().size() == 4);
  node.after(1s);
  CHECK(node.trace().size() == CO_EMCY_QUEUE_N - 1);
}

}  // namespace

#endif
