// SPDX-License-Identifier: Apache-2.0
// Tests several nodes in one process, on several virtual buses, with drivers that have a context argument.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <vector>

#include "co_core.h"
#include "support/callbacks.hpp"
#include "support/notation.hpp"
#include "virtual_bus.hpp"
#include "virtual_clock.hpp"

namespace {

using namespace std::chrono_literals;
using co::VirtualBus;
using co::VirtualClock;
using co::VirtualTimer;
using Fault = VirtualBus::Fault;
using Texts = std::vector<std::string>;

constexpr std::uint32_t ticks_per_second = 1000;

// A node with its variables, dictionary, timer and port.
class Device {
 public:
  Device(VirtualBus& bus, VirtualClock& clock, std::uint8_t node_id, std::uint16_t heartbeat_ms = 0)
      : port(bus.attach({"node " + std::to_string(node_id)})),
        timer_(clock, [this] { COTmrService(&node.Tmr); }),
        heartbeat_(heartbeat_ms) {
    od_ = {{
        {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(0)},
        {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, CO_DATA(&error_register_)},
        {CO_KEY(0x1008, 0, CO_OBJ_____R_), CO_TSTRING, CO_DATA(&name_)},
        {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, CO_DATA(&heartbeat_)},
        {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(1)},
        {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(0)},
        {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(2)},
        {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TSDO_ID, CO_DATA(CO_COBID_SDO_REQUEST())},
        {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TSDO_ID, CO_DATA(CO_COBID_SDO_RESPONSE())},
        {CO_KEY(0x2000, 0, CO_OBJ_____RW), CO_TUNSIGNED16, CO_DATA(&value)},
        CO_OBJ_DICT_ENDMARK,
    }};
    ext_.Size = sizeof ext_;
    ext_.Can = &co::VirtualBusDriver;
    ext_.CanCtx = &port;
    ext_.Timer = &co::VirtualTimerDriver;
    ext_.TimerCtx = &timer_;
    CO_NODE_SPEC spec{};
    spec.NodeId = node_id;
    spec.Baudrate = 250000;
    spec.Dict = od_.data();
    spec.DictLen = static_cast<std::uint16_t>(od_.size());
    spec.TmrFreq = ticks_per_second;
    spec.SdoBuf = sdo_memory_.data();
    CONodeInitCtx(&node, &spec, &ext_);
    CHECK(CONodeGetErr(&node) == CO_ERR_NONE);
    CONodeStart(&node);
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  void process() {
    do {
      CONodeProcess(&node);
      COTmrProcess(&node.Tmr);
    } while (port.waiting() != 0);
  }

  VirtualBus::Port& port;
  CO_NODE node{};
  std::uint16_t value = 0;

 private:
  VirtualTimer timer_;
  CO_NODE_EXT ext_{};
  std::array<CO_OBJ, 11> od_{};
  std::array<std::uint8_t, CO_SSDO_N * CO_SDO_BUF_BYTE> sdo_memory_{};
  std::uint8_t error_register_ = 0;
  std::uint16_t heartbeat_;
  CO_OBJ_STR name_{0, reinterpret_cast<const std::uint8_t*>("integration")};
};

// A bus with a master that receives every frame.
struct Line {
  explicit Line(VirtualClock& clock) {
    bus.set_time([&clock] { return clock.time(); });
    master.enable(250000);
  }
  Texts heard() {
    Texts texts;
    while (const auto frame = master.read()) {
      texts.push_back(test::notation(*frame));
    }
    return texts;
  }
  void say(const char* text) { CHECK(master.send(test::frame(text)) > 0); }

  VirtualBus bus;
  VirtualBus::Port& master = bus.attach({"master"});
};

template <typename... Devices>
void process(Devices&... devices) {
  for (int rounds = 0; rounds < 3; ++rounds) {  // repeated, as an answer may be for a device that was processed before
    (devices.process(), ...);
  }
}

template <typename... Devices>
void pass(VirtualClock& clock, std::uint32_t ms, Devices&... devices) {
  const std::uint64_t end = clock.elapsed() + ms;
  while (clock.elapsed() < end) {
    const std::uint32_t left = static_cast<std::uint32_t>(end - clock.elapsed());
    clock.advance(std::min(left, clock.next_alarm()));
    process(devices...);
  }
}

}  // namespace

TEST_CASE("nodes on a virtual bus: each boots, answers with its own CAN-IDs and ignores the other's SDO") {
  VirtualClock clock(0xFFFFFF00);
  Line line(clock);
  Device five(line.bus, clock, 5);
  Device six(line.bus, clock, 6);
  CHECK(line.heard() == Texts{"705#00", "706#00"});
  line.say("605#2B00200034120000");
  process(five, six);
  CHECK(line.heard() == Texts{"585#6000200000000000"});
  CHECK(five.value == 0x1234);
  CHECK(six.value == 0);
  line.say("606#4000200000000000");
  process(five, six);
  CHECK(line.heard() == Texts{"586#4B00200000000000"});
}

TEST_CASE("nodes on a virtual bus: an NMT command to all nodes reaches all and one to a node reaches only that node") {
  VirtualClock clock;
  Line line(clock);
  Device five(line.bus, clock, 5);
  Device six(line.bus, clock, 6);
  line.say("000#0100");
  process(five, six);
  CHECK(CONmtGetMode(&five.node.Nmt) == CO_OPERATIONAL);
  CHECK(CONmtGetMode(&six.node.Nmt) == CO_OPERATIONAL);
  line.say("000#0206");
  process(five, six);
  CHECK(CONmtGetMode(&five.node.Nmt) == CO_OPERATIONAL);
  CHECK(CONmtGetMode(&six.node.Nmt) == CO_STOP);
}

TEST_CASE("nodes on two virtual buses: nodes with one node-ID are independent") {
  VirtualClock clock;
  Line left(clock);
  Line right(clock);
  Device at_left(left.bus, clock, 5);
  Device at_right(right.bus, clock, 5);
  left.heard();
  right.heard();
  left.say("605#2B00200001000000");
  right.say("605#4000200000000000");
  process(at_left, at_right);
  CHECK(left.heard() == Texts{"585#6000200000000000"});
  CHECK(right.heard() == Texts{"585#4B00200000000000"});
  left.say("000#8105");
  process(at_left, at_right);
  CHECK(left.heard() == Texts{"705#00"});
  CHECK(right.heard().empty());
}

TEST_CASE("nodes on a virtual bus: heartbeats of several nodes keep their periods on one clock that wraps") {
  VirtualClock clock(0xFFFFFFFF - 499);
  Line line(clock);
  Device five(line.bus, clock, 5, 100);
  Device six(line.bus, clock, 6, 250);
  line.heard();
  pass(clock, 1000, five, six);
  int of_five = 0;
  int of_six = 0;
  for (const std::string& text : line.heard()) {
    of_five += (text == "705#7F") ? 1 : 0;
    of_six += (text == "706#7F") ? 1 : 0;
  }
  CHECK(of_five == 10);
  CHECK(of_six == 4);
}

TEST_CASE("nodes on a virtual bus: unrelated frames are rejected by the receive filter of the node") {
  VirtualClock clock;
  Line line(clock);
  Device five(line.bus, clock, 5);
  CHECK(five.port.filtered());
  CHECK(five.port.accepted() == std::vector<std::uint32_t>{0x000, 0x605, 0x705});
  for (const char* foreign : {"606#4000200000000000", "706#7F", "585#6000200000000000", "00000605#4000200000000000"}) {
    line.say(foreign);
  }
  CHECK(five.port.waiting() == 0);
  process(five);
  CHECK(CONodeGetCounters(&five.node).Received == 0);
}

TEST_CASE("nodes on a virtual bus: no frame is lost when the controller refuses to send") {
  for (std::uint32_t refusals = 1; refusals <= 20; ++refusals) {
    CAPTURE(refusals);
    VirtualClock clock;
    Line line(clock);
    line.bus.add_rule(
        {Fault::refuse, [&](const auto& traffic) { return traffic.sender != &line.master; }, 1, refusals});
    Device five(line.bus, clock, 5);
    line.say("605#4000200000000000");
    for (int i = 0; i < 25; ++i) {
      pass(clock, 1, five);
    }
    CHECK(line.heard() == Texts{"705#00", "585#4B00200000000000"});
    CHECK(CONodeGetCounters(&five.node).Dropped == 0);
  }
}

TEST_CASE("nodes on a virtual bus: a driver error is reported, and the frame is sent afterwards") {
  VirtualClock clock;
  Line line(clock);
  Device five(line.bus, clock, 5);
  line.heard();
  line.bus.add_rule({Fault::error, [&](const auto& traffic) { return traffic.sender == &five.port; }});
  line.say("605#4000200000000000");
  five.process();
  CHECK(CONodeGetErr(&five.node) == CO_ERR_IF_CAN_SEND);
  five.process();
  CHECK(line.heard() == Texts{"585#4B00200000000000"});
}

TEST_CASE("nodes on a virtual bus: after any lost, doubled or swapped frame of a transfer the next one works") {
  for (const Fault fault : {Fault::drop, Fault::duplicate, Fault::reorder}) {
    for (std::uint32_t position = 1; position <= 6; ++position) {
      CAPTURE(static_cast<int>(fault));
      CAPTURE(position);
      VirtualClock clock;
      Line line(clock);
      Device five(line.bus, clock, 5);
      line.heard();
      const auto rule = line.bus.add_rule({fault, {}, position});
      for (const char* request : {"605#4008100000000000", "605#6000000000000000", "605#7000000000000000"}) {
        line.say(request);
        process(five);
      }
      CHECK(line.bus.struck(rule) == 1);
      line.bus.clear_rules();
      line.heard();
      line.say("605#4000200000000000");
      process(five);
      const Texts answers = line.heard();  // includes a frame that was held to be swapped
      CHECK(std::count(answers.begin(), answers.end(), "585#4B00200000000000") == 1);
    }
  }
}

TEST_CASE("nodes on a virtual bus: bus-off, recovery and overrun reach the node as events") {
  std::vector<CO_CAN_EVENT> events;
  test::callbacks().can_change = [&](CO_NODE*, CO_CAN_EVENT event) { events.push_back(event); };
  VirtualClock clock;
  Line line(clock);
  Device five(line.bus, clock, 5);
  five.port.bus_off();
  five.process();
  five.port.recover();
  five.process();
  for (int i = 0; i < 600; ++i) {  // more than the receive queue holds
    line.say("000#0205");
  }
  five.process();
  test::callbacks().can_change = nullptr;
  CHECK(events == std::vector<CO_CAN_EVENT>{CO_CAN_BUS_OFF, CO_CAN_RECOVERED, CO_CAN_OVERRUN});
  CHECK(five.port.lost() == 600 - 512);
  CHECK(CONodeGetCounters(&five.node).CanEvents[CO_CAN_OVERRUN] == 1);
}

TEST_CASE("nodes on a virtual bus: a stopped node is off the bus and sends nothing") {
  VirtualClock clock;
  Line line(clock);
  Device five(line.bus, clock, 5, 100);
  CONodeStop(&five.node);
  CHECK_FALSE(five.port.enabled());
  line.heard();
  clock.advance(1000);
  five.process();
  CHECK(line.heard().empty());
  CHECK(clock.next_alarm() == VirtualClock::never);
}
