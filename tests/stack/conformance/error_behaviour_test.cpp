// SPDX-License-Identifier: Apache-2.0
// 1029h, error behaviour: the NMT state that the node enters when the network is lost. [301:7.5.2.32]
#include "support/monitor.hpp"

namespace {

using namespace test;

constexpr CO_CAN_EVENT bus_off = CO_CAN_BUS_OFF;

struct Behaviour {
  explicit Behaviour(std::uint8_t communication, Setup setup = {})
      : value(communication),
        node(setup.with({CO_KEY(0x1029, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 2})
                 .with({CO_KEY(0x1029, 1, CO_OBJ_____RW), CO_TERROR_BEHAVIOUR, &value})
                 .with({CO_KEY(0x1029, 2, CO_OBJ_D___RW), CO_TERROR_BEHAVIOUR, 0})) {}
  std::uint8_t value;
  Fixture node;
};

void lose(Fixture& node) {
  node.call([&] { CONodeCanEvent(&node.node, bus_off); });
  node.trace();
}

// Returns the NMT state after bus-off.
CO_MODE after_bus_off(std::uint8_t behaviour, const char* state) {
  Behaviour device(behaviour);
  device.node.rx(state);
  lose(device.node);
  return device.node.mode();
}

TEST_CASE("1029h: the reaction from every state with every value [B1] [B2] [State 03]") {
  constexpr const char* preop = "000#8001";
  constexpr const char* operational = "000#0101";
  constexpr const char* stop = "000#0201";
  CHECK(after_bus_off(0, preop) == CO_PREOP);
  CHECK(after_bus_off(0, operational) == CO_PREOP);
  CHECK(after_bus_off(0, stop) == CO_STOP);
  CHECK(after_bus_off(1, preop) == CO_PREOP);
  CHECK(after_bus_off(1, operational) == CO_OPERATIONAL);
  CHECK(after_bus_off(1, stop) == CO_STOP);
  CHECK(after_bus_off(2, preop) == CO_STOP);
  CHECK(after_bus_off(2, operational) == CO_STOP);
  CHECK(after_bus_off(2, stop) == CO_STOP);
}

TEST_CASE("1029h: a missing object or an undefined value of the table means 0 [B1]") {
  Fixture node;
  node.rx("000#0101");
  lose(node);
  CHECK(node.mode() == CO_PREOP);
  CHECK(after_bus_off(3, "000#0101") == CO_PREOP);
  CHECK(after_bus_off(255, "000#0101") == CO_PREOP);
}

TEST_CASE("1029h: a node that initialises or is stopped keeps its state [B1]") {
  for (std::uint8_t behaviour = 0; behaviour < 3; ++behaviour) {
    Behaviour device(behaviour, Setup().stay_in_init());
    lose(device.node);
    CHECK(device.node.mode() == CO_INIT);
    device.node.call([&] { CONodeStop(&device.node.node); });
    lose(device.node);
    CHECK(device.node.mode() == CO_INVALID);
  }
}

TEST_CASE("1029h: every value of every sub-index: 0, 1 and 2 are accepted [B1] [B2]") {
  Behaviour device(0, Setup().only_small());
  Fixture& node = device.node;
  for (const char sub : {'1', '2'}) {
    for (unsigned value = 0; value < 256; ++value) {
      CAPTURE(value);
      CO_IF_FRM request = frame(std::string("601#2F29100") + sub + "00000000");
      request.Data[4] = static_cast<std::uint8_t>(value);
      node.rx(request);
      node.tx(std::string(value < 3 ? "581#6029100" : "581#8029100") + sub + (value < 3 ? "00000000" : "30000906"));
      node.ask(std::string("601#4029100") + sub + "00000000", std::string("581#4F29100") + sub +
                                                                  (value == 0   ? "00"
                                                                   : value == 1 ? "01"
                                                                                : "02") +
                                                                  "000000");
    }
  }
}

TEST_CASE("1029h: a written value applies to the next loss") {
  Behaviour device(0);
  Fixture& node = device.node;
  node.rx("000#0101");
  node.ask("601#2F29100101000000", "581#6029100100000000");
  lose(node);
  CHECK(node.mode() == CO_OPERATIONAL);
  node.ask("601#2F29100102000000", "581#6029100100000000");
  lose(node);
  CHECK(node.mode() == CO_STOP);
}

TEST_CASE("1029h: the other error classes have no effect in the stack [B2]") {
  Behaviour device(1);
  device.node.ask("601#2F29100202000000", "581#6029100200000000");
  device.node.rx("000#0101");
  lose(device.node);
  CHECK(device.node.mode() == CO_OPERATIONAL);
}

TEST_CASE("1029h: the application may set another state in CONmtModeChange [Q9]") {
  Behaviour device(0);
  Fixture& node = device.node;
  node.rx("000#0101");
  callbacks().mode_change = [](CO_NMT* nmt, CO_MODE mode) {
    if (mode == CO_PREOP) CONmtSetMode(nmt, CO_OPERATIONAL);
  };
  lose(node);
  CHECK(node.mode() == CO_OPERATIONAL);
}

TEST_CASE("1029h: its type is accepted at 1029h only, and with one byte") {
  Behaviour device(0);
  device.node.ask("601#2B29100100000000", "581#8029100112000706");
  std::uint16_t two = 0x0505;
  CHECK(COObjWrValue(device.node.find(0x1029, 1), &device.node.node, &two, sizeof two) == CO_ERR_BAD_ARG);
#if USE_DICT_CHECK
  Fixture wrong(Setup().with({CO_KEY(0x102A, 1, CO_OBJ_D___RW), CO_TERROR_BEHAVIOUR, 0}).stay_in_init());
  CHECK(wrong.error() == CO_ERR_DICT_INIT);
  CHECK(CODictGetFault(&wrong->Dict, nullptr) == CO_DICT_WRONG_PLACE);
#endif
}

CO_ERR apply(Fixture& node, std::uint8_t sub) {
  CO_ERR err = CO_ERR_NONE;
  node.call([&] { err = COErrorBehaviour(&node.node, sub); });
  return err;
}

TEST_CASE("1029h: COErrorBehaviour executes the reaction of each sub-index from every state [B3]") {
  for (unsigned sub = 1; sub <= 254; ++sub) {
    CAPTURE(sub);
    std::uint8_t value = 0;
    Fixture node(Setup().only_small().with(
        {CO_KEY(0x1029, static_cast<std::uint8_t>(sub), CO_OBJ_____RW), CO_TERROR_BEHAVIOUR, &value}));
    const CO_MODE expected[3][3] = {
        {CO_PREOP, CO_PREOP, CO_STOP}, {CO_PREOP, CO_OPERATIONAL, CO_STOP}, {CO_STOP, CO_STOP, CO_STOP}};
    const char* const commands[3] = {"000#8001", "000#0101", "000#0201"};
    for (value = 0; value < 3; ++value) {
      for (unsigned state = 0; state < 3; ++state) {
        node.rx(commands[state]);
        CHECK(apply(node, static_cast<std::uint8_t>(sub)) == CO_ERR_NONE);
        CHECK(node.mode() == expected[value][state]);
      }
    }
  }
}

TEST_CASE("1029h: COErrorBehaviour uses only the entry of its sub-index [B3]") {
  Behaviour device(1);  // sub 1: no change, sub 2: Pre-operational
  device.node.rx("000#0101");
  CHECK(apply(device.node, 1) == CO_ERR_NONE);
  CHECK(device.node.mode() == CO_OPERATIONAL);
  CHECK(apply(device.node, 2) == CO_ERR_NONE);
  CHECK(device.node.mode() == CO_PREOP);
}

TEST_CASE("1029h: COErrorBehaviour without the entry enters Pre-operational from Operational [B3]") {
  Behaviour device(2);
  device.node.rx("000#0101");
  CHECK(apply(device.node, 3) == CO_ERR_NONE);
  CHECK(device.node.mode() == CO_PREOP);
  CHECK(apply(device.node, 3) == CO_ERR_NONE);
  CHECK(device.node.mode() == CO_PREOP);
}

TEST_CASE("1029h: COErrorBehaviour refuses wrong arguments and nodes that do not run [B3]") {
  CHECK(COErrorBehaviour(nullptr, 2) == CO_ERR_BAD_ARG);
  Behaviour device(2, Setup().stay_in_init());
  CHECK(apply(device.node, 0) == CO_ERR_BAD_ARG);
  CHECK(apply(device.node, 255) == CO_ERR_BAD_ARG);
  CHECK(apply(device.node, 1) == CO_ERR_NMT_MODE);
  CHECK(device.node.mode() == CO_INIT);
  device.node.call([&] { CONodeStop(&device.node.node); });
  CHECK(apply(device.node, 1) == CO_ERR_NMT_MODE);
  CHECK(device.node.mode() == CO_INVALID);
}

TEST_CASE("1029h: COErrorBehaviour may be called while a frame is processed [B3] [Q9]") {
  std::uint8_t value = 2;
  Fixture node(Setup().with({CO_KEY(0x1029, 9, CO_OBJ_____R_), CO_TERROR_BEHAVIOUR, &value}));
  callbacks().mode_change = [&](CO_NMT* nmt, CO_MODE mode) {
    if (mode == CO_OPERATIONAL) CHECK(COErrorBehaviour(nmt->Node, 9) == CO_ERR_NONE);
  };
  node.rx("000#0101");
  CHECK(node.mode() == CO_STOP);
}

#if CO_HBCONS_N > 0

TEST_CASE("1029h: two nodes with missing heartbeats cause one reaction each, none while they stay missing [B2]") {
  Monitor node({{5, 100}, {6, 150}});
  node.rx("000#0101");
  node.rx("705#05");
  node.rx("706#05");
  node.record.clear();
  node.after(100ms);
  node.told("5 missing, mode PREOP");
  node.emergency("081#3081110000050000");
  node.rx("000#0101");
  node.after(50ms);
  node.told("mode OPERATIONAL, 6 missing, mode PREOP");
  node.emergency("081#3081110000060000");
  node.rx("000#0101");
  node.record.clear();
  node.after(1000ms);
  CHECK(node.mode() == CO_OPERATIONAL);
  CHECK(node.record.size() == 10 + 6);
  node.record.clear();
  node.silent();
}

TEST_CASE("1029h: a missing heartbeat is reported before the node is stopped [B1] [N9]") {
  Monitor node({{5, 100}}, Setup().with({CO_KEY(0x1029, 1, CO_OBJ_D___R_), CO_TERROR_BEHAVIOUR, 2}));
  node.rx("705#05");
  node.after(100ms);
  node.emergency("081#3081110000050000");
  node.told("5 OPERATIONAL, 5 missing, mode STOP");
}

#endif

}  // namespace
