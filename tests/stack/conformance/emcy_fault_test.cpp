// SPDX-License-Identifier: Apache-2.0
// EMCY messages of the stack: events of the CAN controller, and faults that services raise. [301:7.2.7.1]
#include "support/emcy_fixture.hpp"

#if USE_EMCY

namespace {

using namespace test;
using co::event::Fault;

TEST_CASE(
    "EMCY: each fault has its error code; byte 3 of the manufacturer data is the node-ID or PDO number [E7] [E11]") {
  const struct {
    Fault fault;
    const char* sent;
  } cases[] = {{Fault::heartbeat, "081#3081110000070000"},   {Fault::life_guard, "081#3081110000070000"},
               {Fault::collision, "081#5081110000070000"},   {Fault::pdo_short, "081#1082110000070000"},
               {Fault::pdo_long, "081#2082110000070000"},    {Fault::sync_length, "081#4082110000070000"},
               {Fault::pdo_timeout, "081#5082110000070000"}, {Fault::overrun, "081#1081110000070000"},
               {Fault::passive, "081#2081110000070000"}};
  for (const auto& one : cases) {
    CAPTURE(one.sent);
    EmcyNode node(Setup().only_small());
    node.raise_fault(one.fault, 7);
    node.tx(one.sent);
    CHECK(node.error_register() == 0x11);
    node.resolve_fault(one.fault, 7);
    node.tx("081#0000000000070000");
    CHECK(node.error_register() == 0);
  }
}

TEST_CASE("EMCY: each occurrence of a fault is sent; the register bit is cleared with the last one [E1] [E2]") {
  EmcyNode node{Setup()};
  node.raise_fault(Fault::heartbeat, 3);
  node.raise_fault(Fault::heartbeat, 4);
  node.tx({"081#3081110000030000", "081#3081110000040000"});
  node.resolve_fault(Fault::heartbeat, 4);
  node.tx("081#0000110000040000");
  node.resolve_fault(Fault::heartbeat, 3);
  node.tx("081#0000000000030000");
  CHECK(node.errors() == std::vector<std::uint32_t>{0x8130, 0x8130});
}

TEST_CASE("EMCY: faults of all PDOs at once are all sent") {
  constexpr unsigned number = CO_RPDO_N > 255 ? 512 : 255;
  EmcyNode node(Setup().only_small());
  for (unsigned n = 0; n < number; ++n) node.raise_fault(Fault::pdo_timeout, static_cast<std::uint8_t>(n));
  for (unsigned n = 0; n < number; ++n) {
    CHECK(node.error_register() == 0x11);
    node.resolve_fault(Fault::pdo_timeout, static_cast<std::uint8_t>(n));
  }
  CHECK(node.error_register() == 0);
  CHECK(node.trace().size() == 2 * number);
}

TEST_CASE("EMCY: a fault that was not raised is not resolved, and a discarded fault is not sent") {
  EmcyNode node{Setup()};
  node.resolve_fault(Fault::pdo_short, 1);
  node.forget_fault(Fault::pdo_short);
  node.silent();
  CHECK(node.error_register() == 0);
  node.raise_fault(Fault::pdo_short, 1);
  node.tx("081#1082110000010000");
  node.forget_fault(Fault::pdo_short);
  node.silent();
  CHECK(node.error_register() == 0);
}

TEST_CASE("EMCY: errors of the application and of the stack share the register [E3]") {
  EmcyNode node(Setup().emergencies({{CO_EMCY_REG_COM, CO_EMCY_CODE_MON_COM_ERR}}));
  node.set(0);
  node.raise_fault(Fault::sync_length);
  node.tx({"081#0081110000000000", "081#4082110000000000"});
  node.clr(0);
  node.tx("081#0000110000000000");
  node.set(0);
  node.resolve_fault(Fault::sync_length);
  node.tx({"081#0081110000000000", "081#0000110000000000"});
  node.clr(0);
  node.tx("081#0000000000000000");
}

#if CO_RPDO_N > 0

TEST_CASE("EMCY: an RPDO without data in Operational sends 8210h and is entered in 1001h and 1003h [EMCY 04-06]") {
  EmcyNode node(Setup()
                    .with({CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TPDO_ID, 0x200})
                    .with({CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, 254})
                    .with({CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, 1})
                    .with({CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, CO_LINK(0x2001, 0, 8)}));
  node.rx("000#0101");
  node.rx("201#");
  node.tx("081#1082110000010000");
  node.ask("601#4001100000000000", "581#4F01100011000000");
  node.ask("601#4003100100000000", "581#4303100110820000");
}

#endif

// CAN controller ------------------------------------------------------------------------------------------------------

TEST_CASE("EMCY: a lost frame is 8110h, resolved after a second without another lost frame [E7]") {
  for (const std::uint32_t rate : clock_rates) {
    for (const std::uint32_t start : clock_starts) {
      CAPTURE(rate);
      CAPTURE(start);
      EmcyNode node(Setup().only_small().rate(rate).clock(start));
      node.can_event(CO_CAN_OVERRUN);
      node.tx("081#1081110000000000");
      node.after(1500ms);
      node.tx_at(1s, "081#0000000000000000");
      CHECK(node.error_register() == 0);
    }
  }
}

TEST_CASE("EMCY: many lost frames or frames with the node's own CAN-ID send one message [E7]") {
  for (const Fault fault : {Fault::overrun, Fault::collision}) {
    EmcyNode node(Setup().only_small());
    for (int n = 0; n < 3000; ++n) {
      node.raise_fault(fault);
      node.after(1ms);
    }
    node.tx(fault == Fault::overrun ? "081#1081110000000000" : "081#5081110000000000");
    CHECK(node.error_register() == 0x11);
    CHECK(node.errors().size() == 1);
    node.after(998ms);
    node.silent();
    node.after(1ms);
    node.tx("081#0000000000000000");
    node.raise_fault(fault);
    CHECK(node.trace().size() == 1);
  }
}

TEST_CASE("EMCY: lost frames and CAN-ID collisions are resolved independently") {
  EmcyNode node{Setup()};
  node.raise_fault(Fault::overrun);
  node.after(400ms);
  node.raise_fault(Fault::collision);
  node.tx({"081#1081110000000000", "081#5081110000000000"});
  node.after(2s);
  node.tx_at(600ms, "081#0000110000000000");
  node.tx_at(1s, "081#0000000000000000");
}

TEST_CASE("EMCY: error passive sends 8120h once, until the controller has recovered [E7]") {
  EmcyNode node{Setup()};
  node.rx("20000004#0010000000000000");
  node.tx("081#2081110000000000");
  node.rx("20000004#0030000000000000");
  node.after(10s);
  node.silent();
  node.rx("20000004#0040000000000000");
  node.tx("081#0000000000000000");
  node.rx("20000004#0040000000000000");
  node.silent();
}

TEST_CASE("EMCY: a recovery of the controller without a previous error sends nothing") {
  EmcyNode node{Setup()};
  node.can_event(CO_CAN_RECOVERED);
  node.silent();
  CHECK(node.errors().empty());
}

TEST_CASE("EMCY: bus-off changes 1001h at once; after recovery the node sends 8140h and then 0000h [E7] [Q5]") {
  EmcyNode node{Setup()};
  node.rx("20000040#0000000000000000");
  node.silent();
  CHECK(node.error_register() == 0x11);
  CHECK(node.errors().empty());
  node.rx("20000040#0000000000000000");
  node.after(5s);
  node.silent();
  node.rx("20000100#0000000000000000");
  node.tx({"081#4081110000000000", "081#0000000000000000"});
  CHECK(node.error_register() == 0);
  CHECK(node.errors() == std::vector<std::uint32_t>{0x8140});
}

TEST_CASE("EMCY: error passive before a bus-off is resolved with it; other errors stay [E2]") {
  EmcyNode node;
  node.can_event(CO_CAN_PASSIVE);
  node.set(hot);
  node.tx({"081#2081110000000000", "081#0040190000000000"});
  node.can_event(CO_CAN_BUS_OFF);
  node.can_event(CO_CAN_RECOVERED);
  node.tx({"081#4081190000000000", "081#0000090000000000"});
  node.can_event(CO_CAN_PASSIVE);
  node.can_event(CO_CAN_RECOVERED);
  node.tx({"081#2081190000000000", "081#0000090000000000"});
}

TEST_CASE("EMCY: bus-off and recovery in one error frame are both reported") {
  EmcyNode node{Setup()};
  node.rx("20000140#0000000000000000");
  node.tx({"081#4081110000000000", "081#0000000000000000"});
}

TEST_CASE("EMCY: errors detected during bus-off are sent after it in their order [T12]") {
  EmcyNode node;
  node.can.refuse_all();
  node.can_event(CO_CAN_BUS_OFF);
  node.set(hot);
  node.after(1s);
  node.can_event(CO_CAN_RECOVERED);
  node.can.accept_all();
  node.loop();
  node.tx({"081#0040190000000000", "081#4081190000000000", "081#0000090000000000"});
}

#if CO_EMCY_QUEUE_N > 0

TEST_CASE("EMCY: 8140h and 0000h keep the inhibit time [E6]") {
  EmcyNode node(Setup(), 500);
  node.can_event(CO_CAN_BUS_OFF);
  node.can_event(CO_CAN_RECOVERED);
  node.tx("081#4081110000000000");
  node.after(1s);
  node.tx_at(50ms, "081#0000000000000000");
}

#endif

TEST_CASE("EMCY: controller states before the start and after the stop of the node have no effect") {
  EmcyNode node(Setup().stay_in_init());
  node.can_event(CO_CAN_OVERRUN);
  node.can_event(CO_CAN_PASSIVE);
  node.silent();
  CHECK(node.error_register() == 0x11);
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  node.after(1s);
  node.tx("081#0000110000000000");
  node.can_event(CO_CAN_OVERRUN);
  node.tx("081#1081110000000000");
  node.call([&] { CONodeStop(&node.node); });
  CHECK(node.armed_timers() == 0);
  for (const CO_CAN_EVENT event : {CO_CAN_OVERRUN, CO_CAN_PASSIVE, CO_CAN_BUS_OFF, CO_CAN_RECOVERED}) {
    node.can_event(event);
  }
  CHECK(node.armed_timers() == 0);
  node.after(2s);
  node.silent();
}

TEST_CASE(
    "EMCY: faults in Stopped are in 1003h and not sent; a frame lost in Stopped resolves without a message [E9]") {
  EmcyNode node{Setup()};
  node.rx("000#0201");
  node.can_event(CO_CAN_OVERRUN);
  CHECK(node.error_register() == 0x11);
  node.after(1s);
  CHECK(node.error_register() == 0);
  node.can_event(CO_CAN_BUS_OFF);
  node.can_event(CO_CAN_RECOVERED);
  node.silent();
  CHECK(node.errors() == std::vector<std::uint32_t>{0x8140, 0x8110});
}

}  // namespace

#endif
