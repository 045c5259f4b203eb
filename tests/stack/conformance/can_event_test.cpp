// SPDX-License-Identifier: Apache-2.0
// Events of the CAN controller: error frames with several events, and a reset of the node at bus-off.
#include <algorithm>

#include "support/fixture.hpp"

namespace {

using namespace test;

using Events = std::vector<CO_CAN_EVENT>;

// Returns the events that the application receives for an error frame.
Events events_of(const char* text) {
  Fixture node(Setup().without(0x1014, 0));  // no EMCY
  Events events;
  callbacks().can_change = [&](CO_NODE*, CO_CAN_EVENT event) { events.push_back(event); };
  node.rx(text);
  node.silent();
  const CO_NODE_COUNTERS counters = node.counters();
  for (int event = 0; event < CO_CAN_EVENT_NUM; ++event) {
    const auto told = std::count(events.begin(), events.end(), static_cast<CO_CAN_EVENT>(event));
    CHECK(counters.CanEvents[event] == static_cast<std::uint32_t>(told));
  }
  return events;
}

TEST_CASE("CAN events: an error frame with several events reports each of them once") {
  CHECK(events_of("20000004#0011000000000000") == Events{CO_CAN_OVERRUN, CO_CAN_PASSIVE});
  CHECK(events_of("20000004#0021000000000000") == Events{CO_CAN_OVERRUN, CO_CAN_PASSIVE});
  CHECK(events_of("20000004#0030000000000000") == Events{CO_CAN_PASSIVE});
  CHECK(events_of("20000004#0041000000000000") == Events{CO_CAN_OVERRUN, CO_CAN_RECOVERED});
  CHECK(events_of("20000044#0001000000000000") == Events{CO_CAN_OVERRUN, CO_CAN_BUS_OFF});
  CHECK(events_of("20000044#0030000000000000") == Events{CO_CAN_PASSIVE, CO_CAN_BUS_OFF});
  CHECK(events_of("20000140#0000000000000000") == Events{CO_CAN_BUS_OFF, CO_CAN_RECOVERED});
}

TEST_CASE("CAN events: bus-off and its recovery, by restart or by error active, are each reported once") {
  CHECK(events_of("20000040#0000000000000000") == Events{CO_CAN_BUS_OFF});
  CHECK(events_of("20000100#0000000000000000") == Events{CO_CAN_RECOVERED});
  CHECK(events_of("20000004#0040000000000000") == Events{CO_CAN_RECOVERED});
  CHECK(events_of("20000104#0040000000000000") == Events{CO_CAN_RECOVERED});
}

TEST_CASE("CAN events: details of other error classes and warnings raise no event") {
  CHECK(events_of("20000008#0011000000000000") == Events{});  // protocol
  CHECK(events_of("20000080#0071000000000000") == Events{});  // bus error
  CHECK(events_of("20000020#0040000000000000") == Events{});  // no acknowledgement
  CHECK(events_of("20000004#0000000000000000") == Events{});
  CHECK(events_of("20000004#000C000000000000") == Events{});  // warning levels
  CHECK(events_of("20000004#0002000000000000") == Events{});  // send buffer overflow
  CHECK(events_of("20000040#0071000000000000") == Events{CO_CAN_BUS_OFF});
}

TEST_CASE("CAN events: the counters of all events saturate [Q10]") {
  constexpr std::uint32_t most = std::numeric_limits<std::uint32_t>::max();
  Fixture node(Setup().without(0x1014, 0));  // no EMCY
  for (std::uint32_t& number : node->Count.CanEvents) number = most - 1;
  unsigned told = 0;
  callbacks().can_change = [&](CO_NODE*, CO_CAN_EVENT) { ++told; };
  for (int i = 0; i < 3; ++i) {
    node.rx("20000004#0011000000000000");
    node.rx("20000140#0000000000000000");
  }
  CHECK(told == 12);
  for (const std::uint32_t number : node.counters().CanEvents) {
    CHECK(number == most);
  }
}

// A reset at bus-off --------------------------------------------------------------------------------------------------

// A node with a queued frame, whose application resets it when the callback reports bus-off.
class BusOff : public Fixture {
 public:
  explicit BusOff(CO_NMT_RESET reset) : Fixture(Setup().tx_queue(20)) {
    frames_per_call(2);
    can.refuse_all();
    CO_IF_FRM frm = frame("201#0102030405060708");
    call([&] { COIfCanSend(&node.If, &frm); });
    callbacks().can_change = [=](CO_NODE* n, CO_CAN_EVENT event) {
      if (event == CO_CAN_BUS_OFF) CONmtReset(&n->Nmt, reset);
    };
  }

  void check_reset() {
    CHECK(can.resets == 1);
    silent();
    can.accept_all();
    loop();
    tx("701#00");  // the frame of the application is dropped
    CHECK(mode() == CO_PREOP);
    ask("601#4000100000000000", "581#4300100091010F00");
    CHECK(can.resets == 1);
  }
};

TEST_CASE("CAN events: CONmtReset at bus-off with queued frames resets the controller at once") {
  for (const CO_NMT_RESET reset : {CO_RESET_NODE, CO_RESET_COM}) {
    BusOff by_frame(reset);
    by_frame.can.to_node.push_back(frame("20000040#0000000000000000"));
    by_frame.call([&] { CONodeProcess(&by_frame.node); });
    by_frame.check_reset();

    BusOff by_driver(reset);
    by_driver.call([&] { CONodeCanEvent(&by_driver.node, CO_CAN_BUS_OFF); });
    by_driver.check_reset();
  }
}

}  // namespace
