// SPDX-License-Identifier: Apache-2.0
// TIME consumer and producer. [301:7.2.6]
#include "support/time_fixture.hpp"

#if USE_TIME

namespace {

using namespace test;

// --- Consumer

TEST_CASE("TIME: a consumer sets its clock and calls COTimeUpdate() [301:7.2.6]") {
  for (const bool operational : {false, true}) {
    TimeNode node(time_consumer);
    unsigned calls = 0;
    CO_TIME_OF_DAY told{};
    callbacks().time_update = [&](CO_NODE* of, const CO_TIME_OF_DAY* time) {
      CHECK(of == &node.node);
      told = *time;
      ++calls;
    };
    if (operational) node.rx("000#0101");
    node.rx("100#952CB302313D");  // 12:34:56.789 on 2026-11-21
    check_time(node, 45296789, 15665);
    CHECK(calls == 1);
    CHECK(told.Ms == 45296789);
    CHECK(told.Days == 15665);
    node.after(1500ms);
    check_time(node, 45298289, 15665);
    node.silent();
  }
}

TEST_CASE("TIME: the last millisecond of a day is accepted; the next one is ignored and counted [Z1]") {
  TimeNode node(time_consumer);
  unsigned calls = 0;
  callbacks().time_update = [&](CO_NODE*, const CO_TIME_OF_DAY*) { ++calls; };
  node.rx("100#FF5B26050000");
  check_time(node, 86399999, 0);
  for (const char* wrong : {"100#005C26050000", "100#FFFFFF0F0000", "100#005C26F50100", "100#00000008FFFF"}) {
    node.rx(wrong);
    check_time(node, 86399999, 0);
  }
  CHECK(calls == 1);
  CHECK(node.counters().Malformed == 4);
}

TEST_CASE("TIME: the four reserved bits are ignored [301:7.1.6.5]") {
  TimeNode node(time_consumer);
  node.rx("100#952CB3F2313D");
  check_time(node, 45296789, 15665);
  CHECK(node.counters().Malformed == 0);
}

TEST_CASE("TIME: other lengths and remote frames are ignored and counted [Z1]") {
  TimeNode node(time_consumer);
  unsigned wrong = 0;
  for (const char* frame : {"100#", "100#95", "100#952C", "100#952CB3", "100#952CB302", "100#952CB30231",
                            "100#952CB302313D00", "100#952CB302313D0000", "100#R"}) {
    node.rx(frame);
    CHECK(node.counters().Malformed == ++wrong);
    check_time(node, 0, 0);
  }
}

TEST_CASE("TIME: in Stopped a message is neither processed nor counted as malformed [N3]") {
  TimeNode node(time_consumer);
  node.rx("000#0201");
  node.rx("100#952CB302313D");
  check_time(node, 0, 0);
  CHECK(node.counters().Unclaimed == 1);
  CHECK(node.counters().Malformed == 0);
}

TEST_CASE("TIME: without 1012h, with bit 31 = 0 or an invalid CAN-ID no message is processed") {
  for (const std::uint32_t id : {0x00000100U, 0x40000100U, 0x80000000U, 0xA0000000U, 0x80000800U}) {
    CAPTURE(id);
    TimeNode node(id);
    for (const char* frame :
         {"100#952CB302313D", "000#952CB302313D", "00000000#952CB302313D", "00000800#952CB302313D"}) {
      node.rx(frame);
    }
    check_time(node, 0, 0);
    CHECK(node.mode() == CO_PREOP);
  }
  Fixture none(Setup().only_small());
  none.rx("100#952CB302313D");
  CHECK(none.counters().Unclaimed == 1);
}

TEST_CASE("TIME: a 29-bit CAN-ID does not match the 11-bit one [Z1]") {
  TimeNode node(0xA0012345);
  node.rx("345#952CB302313D");
  check_time(node, 0, 0);
  node.rx("00012345#952CB302313D");
  check_time(node, 45296789, 15665);
}

TEST_CASE("TIME: the callback may read and set the clock and stop the node") {
  TimeNode node(time_consumer);
  callbacks().time_update = [&](CO_NODE* of, const CO_TIME_OF_DAY* time) {
    const CO_TIME_OF_DAY next{time->Ms + 1, time->Days};
    CHECK(COTimeSet(of, &next) == CO_ERR_NONE);
  };
  node.rx("100#000000000100");
  check_time(node, 1, 1);
  callbacks().time_update = [&](CO_NODE* of, const CO_TIME_OF_DAY*) { CONodeStop(of); };
  node.rx("100#000000000200");
  CHECK(node.mode() == CO_INVALID);
  check_time(node, 0, 0);
  CHECK(node.armed_timers() == 0);
}

// --- Producer

TEST_CASE("TIME: the producer sends the present time [301:7.2.6]") {
  TimeNode node(time_producer);
  node.set(45296789, 15665);
  CHECK(node.send() == CO_ERR_NONE);
  node.tx("100#952CB302313D");
  node.after(1000ms);
  CHECK(node.send() == CO_ERR_NONE);
  node.tx("100#7D30B302313D");
  node.rx("000#0101");
  CHECK(node.send() == CO_ERR_NONE);
  node.tx("100#7D30B302313D");
}

TEST_CASE("TIME: midnight increments the day, and 2163 is followed by 1984") {
  TimeNode node(time_producer);
  node.set(86399999, 15665);
  node.send();
  node.tx("100#FF5B2605313D");
  node.after(1ms);
  node.send();
  node.tx("100#00000000323D");
  node.set(86399000, 0xFFFF);
  node.after(1001ms);
  node.send();
  node.tx("100#010000000000");
}

TEST_CASE("TIME: COTimeSend returns the reason why it does not send") {
  CHECK(COTimeSend(nullptr) == CO_ERR_BAD_ARG);
  CHECK(COTimeProduce(nullptr, 10) == CO_ERR_BAD_ARG);
  TimeNode node(time_producer);
  CHECK(node.send() == CO_ERR_OBJ_NO_DATA);
  node.set(0, 0);
  node.rx("000#0201");
  CHECK(node.send() == CO_ERR_NMT_MODE);
  node.rx("000#0101");
  node.ask("601#2312100000010000", "581#6012100000000000");
  CHECK(node.send() == CO_ERR_OBJ_STATE);
  node.silent();
  TimeNode only_consumer(time_consumer);
  only_consumer.set(0, 0);
  CHECK(only_consumer.send() == CO_ERR_OBJ_STATE);
  TimeNode stopped(time_producer);
  stopped.set(0, 0);
  stopped.call([&] { CONodeStop(&stopped.node); });
  CHECK(stopped.send() == CO_ERR_NMT_MODE);
}

TEST_CASE("TIME: a queued message is replaced by a newer one, and a full queue is reported") {
  TimeNode node(time_producer, Setup().tx_queue(2));
  node.set(0, 0);
  node.can.refuse_all();
  CHECK(node.send() == CO_ERR_NONE);
  node.after(5ms);
  CHECK(node.send() == CO_ERR_NONE);
  CO_IF_FRM other = frame("7F0#01");
  node.call([&] { COIfCanSend(&node->If, &other); });
  node.can.accept_all();
  node.loop();
  CHECK(node.frames().front() == "100#050000000000");
  node.can.refuse_all();
  for (unsigned i = 0; i < 2; ++i) {
    other.Identifier = 0x7F0 + i;
    node.call([&] { COIfCanSend(&node->If, &other); });
  }
  CHECK(node.send() == CO_ERR_IF_CAN_SEND);
  node.can.accept_all();
  node.loop();
  for (const std::string& sent : node.frames()) CHECK(sent.substr(0, 3) != "100");
}

TEST_CASE("TIME: a queued message is not sent when state or bus no longer allow it") {
  for (const char* how : {"stop", "reset", "bus-off", "off"}) {
    CAPTURE(how);
    TimeNode node(time_producer);
    node.set(0, 0);
    node.can.refuse_all();
    CHECK(node.send() == CO_ERR_NONE);
    if (how == std::string("stop")) node.rx("000#0201");
    if (how == std::string("reset")) node.rx("000#8201");
    if (how == std::string("bus-off")) node.call([&] { CONodeCanEvent(&node.node, CO_CAN_BUS_OFF); });
    if (how == std::string("off")) {
      node.rx("601#2312100000010000");
    }
    node.can.accept_all();
    node.loop();
    for (const std::string& sent : node.frames()) CHECK(sent.substr(0, 3) != "100");
  }
}

TEST_CASE("TIME: cyclic production sends a message each period") {
  TimeNode node(time_producer);
  node.set(0, 0);
  CHECK(node.produce(100) == CO_ERR_NONE);
  node.after(310ms);
  node.tx_at(100ms, "100#640000000000");
  node.tx_at(200ms, "100#C80000000000");
  node.tx_at(300ms, "100#2C0100000000");
  node.silent();
  CHECK(node.produce(50) == CO_ERR_NONE);
  node.after(50ms);
  node.tx_at(50ms, "100#680100000000");
  CHECK(node.produce(0) == CO_ERR_NONE);
  node.after(1000ms);
  node.silent();
}

TEST_CASE("TIME: cyclic production starts when its conditions are met and pauses in other states") {
  TimeNode node(0x00000100);
  CHECK(node.produce(100) == CO_ERR_NONE);
  node.after(300ms);
  node.ask("601#2312100000010040", "581#6012100000000000");
  node.after(300ms);
  node.silent();
  node.set(0, 0);
  node.after(100ms);
  CHECK(node.frames().size() == 1);
  node.after(50ms);
  node.rx("000#0201");
  node.after(1000ms);
  node.silent();
  node.rx("000#0101");
  node.after(99ms);
  node.silent();
  node.after(1ms);
  CHECK(node.frames().size() == 1);
  node.rx("000#8001");
  node.after(100ms);
  CHECK(node.frames().size() == 1);
  node.rx("000#8201");
  node.tx("701#00");
  node.after(100ms);
  CHECK(node.frames().size() == 1);
  node.ask("601#2312100000010000", "581#6012100000000000");
  node.after(1000ms);
  node.silent();
}

TEST_CASE("TIME: the period continues when the node changes between states with TIME") {
  TimeNode node(time_producer);
  node.set(0, 0);
  node.produce(100);
  node.after(60ms);
  node.rx("000#0101");
  node.after(40ms);
  node.tx("100#640000000000");
  node.after(60ms);
  node.rx("000#8001");
  node.after(40ms);
  node.tx("100#C80000000000");
}

TEST_CASE("TIME: no timer runs for a disabled producer") {
  TimeNode node(time_consumer);
  node.produce(100);
  CHECK(node.armed_timers() == 0);
  node.ask("601#23121000000100C0", "581#6012100000000000");
  CHECK(node.armed_timers() == 1);
  node.rx("000#0201");
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("TIME: a late main loop sends one message and keeps the phase of the period [Q8]") {
  TimeNode node(time_producer);
  node.set(0, 0);
  node.produce(100);
  node.jump(950ms);
  node.tx("100#B60300000000");
  node.after(50ms);
  node.tx_at(50ms, "100#E80300000000");
}

TEST_CASE("TIME: a period beyond the range of the timer is refused, and the previous one continues") {
  TimeNode node(time_producer, Setup().rate(1000000));
  node.set(0, 0);
  CHECK(node.produce(500) == CO_ERR_NONE);
  CHECK(node.produce(4294968) == CO_ERR_BAD_ARG);
  node.after(500ms);
  node.tx("100#F40100000000");
}

TEST_CASE("TIME: a node may be consumer and producer") {
  TimeNode node(0xC0000100);
  node.rx("100#E80300000100");
  node.produce(1000);
  node.after(1000ms);
  node.tx("100#D00700000100");
}

}  // namespace

#endif
