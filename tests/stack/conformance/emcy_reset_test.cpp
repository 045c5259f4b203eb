// SPDX-License-Identifier: Apache-2.0
// Effects of resets on emergencies. [301:7.3.2.2.1]
#include "support/emcy_fixture.hpp"

#if USE_EMCY

namespace {

using namespace test;
using co::event::Fault;

// Sets errors of the application and faults of the stack; some EMCY messages are queued.
void disturb(EmcyNode& node) {
  node.set(current);
  node.set(hot);
  node.raise_fault(Fault::heartbeat, 3);
  node.raise_fault(Fault::overrun);
  node.can_event(CO_CAN_PASSIVE);
  node.trace();
  CHECK(node.error_register() == 0x1B);
}

TEST_CASE("EMCY: reset node resolves all errors without a message and empties 1003h [N6] [EMCY 02] [EMCY 03] [T14]") {
  for (const std::uint16_t inhibit : {std::uint16_t{0}, std::uint16_t{100}}) {
    CAPTURE(inhibit);
    const EmcyNode fresh(Setup().emergencies(errors_of_device()), inhibit);
    EmcyNode node(Setup().emergencies(errors_of_device()), inhibit);
    disturb(node);
    node.rx("000#8101");
    node.tx("701#00");
    CHECK(node.error_register() == 0);
    CHECK(node.errors().empty());
    CHECK(COEmcyCnt(&node->Emcy) == 0);
    CHECK(node.difference(fresh) == "");
    node.after(10s);
    node.silent();
    node.set(current);
    node.tx("081#0020030000000000");
    CHECK(node.errors() == std::vector<std::uint32_t>{0x2000});
  }
}

TEST_CASE("EMCY: reset communication resolves the errors of the stack; those of the application stay [D46] [N6]") {
  EmcyNode node;
  disturb(node);
  const std::vector<std::uint32_t> errors = node.errors();
  CHECK(errors == std::vector<std::uint32_t>{0x8120, 0x8110, 0x8130, 0x4000});
  node.rx("000#8201");
  node.tx("701#00");
  CHECK(node.error_register() == 0x0B);
  CHECK(COEmcyCnt(&node->Emcy) == 2);
  CHECK(node.errors() == errors);
  node.after(10s);
  node.silent();
  CHECK(node.armed_timers() == 0);
  node.ask("601#4001100000000000", "581#4F0110000B000000");
  node.set(current);
  node.silent();
  node.clr(current);
  node.tx("081#0000090000000000");
  node.clr(hot);
  node.tx("081#0000000000000000");
  node.resolve_fault(Fault::heartbeat, 3);
  node.can_event(CO_CAN_RECOVERED);
  node.silent();
}

#if CO_EMCY_QUEUE_N > 0

TEST_CASE("EMCY: a reset drops messages queued for the inhibit time, which starts anew [T14] [N4]") {
  for (const std::string reset : {"000#8101", "000#8201"}) {
    CAPTURE(reset);
    EmcyNode node(Setup().emergencies(errors_of_device()), 10000);
    node.set(current);
    node.tx("081#0020030000000000");
    node.set(hot);
    node.set(no_disk);
    node.rx(reset);
    node.tx("701#00");
    CHECK(node.counters().Dropped == 2);
    CHECK(node.armed_timers() == 0);
    node.set(general);
    node.tx(reset == "000#8101" ? "081#0010010000000000" : "081#00108B0000000000");
    node.after(10s);
    node.silent();
  }
}

#endif

TEST_CASE("EMCY: of the frames that wait at a reset only SDO responses survive, no EMCY comes before the boot-up") {
  for (const CO_NMT_RESET type : {CO_RESET_NODE, CO_RESET_COM}) {
    for (const bool is_raised_last : {false, true}) {
      Fixture node(Setup().heartbeat(10).emergencies({{CO_EMCY_REG_TEMP, 0x4200}, {CO_EMCY_REG_VOLTAGE, 0x3100}}));
      node.can.refuse_all();
      node.call([&] { COEmcySet(&node.node.Emcy, 0, nullptr); });
      node.after(10ms);
      node.rx("601#4018100100000000");
      node.call([&] {
        CO_IF_FRM own = frame("123#01");
        COIfCanSend(&node.node.If, &own);
      });
      callbacks().mode_change = [&](CO_NMT*, CO_MODE to) {
        if (to == CO_INIT && is_raised_last) COEmcySet(&node.node.Emcy, 1, nullptr);
      };
      node.call([&] { CONmtReset(&node.node.Nmt, type); });
      node.can.accept_all();
      node.loop();
      const std::vector<std::string> frames = node.frames();
      REQUIRE(frames.size() >= 2);
      CHECK(frames[0] == "581#4318100111111111");
      CHECK(frames[1] == "701#00");
      for (std::size_t n = 2; n < frames.size(); ++n) CHECK(frames[n].substr(0, 4) == "081#");
    }
  }
}

TEST_CASE("EMCY: a reset by the application has the effect of one by the NMT master") {
  EmcyNode node;
  disturb(node);
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_COM); });
  node.tx("701#00");
  CHECK(node.error_register() == 0x0B);
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_NODE); });
  node.tx("701#00");
  CHECK(node.error_register() == 0);
  CHECK(node.errors().empty());
}

TEST_CASE("EMCY: CONodeInit clears all errors") {
  EmcyNode node;
  disturb(node);
  node.call([&] { CONodeStop(&node.node); });
  node.set(no_disk);
  node.silent();
  node.init_again();
  CHECK(node.error_register() == 0);
  CHECK(COEmcyCnt(&node->Emcy) == 0);
  CHECK(node.errors().empty());
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  node.after(10s);
  node.silent();
}

TEST_CASE("EMCY: an error that the application sets in CONmtResetRequest is sent after the boot-up [N4]") {
  EmcyNode node;
  callbacks().reset_request = [&](CO_NMT*, CO_NMT_RESET) { COEmcySet(&node->Emcy, hot, nullptr); };
  node.rx("000#8101");
  node.tx({"701#00", "081#0040090000000000"});
}

TEST_CASE("EMCY: a history whose length has changed is empty after the next reset") {
  EmcyNode node;
  disturb(node);
  node.find(0x1003, 4)->Type = CO_TUNSIGNED32;
  node.rx("000#8201");
  node.tx("701#00");
  std::uint8_t number = 0xFF;
  CHECK(CODictRdByte(&node->Dict, CO_DEV(0x1003, 0), &number) == CO_ERR_NONE);
  CHECK(number == 0);
  node.set(no_disk);
  node.tx("081#00FF8B0000000000");
  node.ask("601#4003100100000000", "581#4303100100FF0000");
}

#if USE_DICT_CHECK

TEST_CASE("EMCY: calls after a failed initialisation have no effect") {
  EmcyNode node(
      Setup().emergencies(errors_of_device()).with({CO_KEY(0x1FFF, 0, CO_OBJ_____R_), nullptr, 0}).stay_in_init());
  CHECK(node.error() == CO_ERR_DICT_INIT);
  node.set(current);
  CHECK(COEmcyGet(&node->Emcy, current) == 1);
  node.clr(current);
  node.call([&] { COEmcyReset(&node->Emcy, 0); });
  node.call([&] { COEmcyHistReset(&node->Emcy); });
  node.can_event(CO_CAN_OVERRUN);
  node.silent();
  CHECK(callbacks().fatal_errors == 0);
}

#endif

}  // namespace

#endif
