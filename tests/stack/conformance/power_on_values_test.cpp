// SPDX-License-Identifier: Apache-2.0
// Power-on values of a hand-written dictionary, whose end mark refers to the variables and their default values.
// [301:7.3.2.2.1]
#include <cstring>

#include "support/failing_nvm.hpp"
#include "support/fixture.hpp"

namespace {

using namespace test;

CO_DATA data(const void* address) { return reinterpret_cast<std::uintptr_t>(address); }

// Variables of a device, which differ from their defaults until the node is initialised.
struct Device {
  struct Communication {
    std::uint16_t heartbeat = 77;
    std::uint8_t number = 0;
    std::uint32_t cob_id = 0x80000000;
    std::uint32_t mapping[2] = {};
    std::uint8_t type = 0;
  };

  struct Application {
    std::uint32_t value = 77;
    CO_OBJ_STR_RW name = {};
    std::uint8_t text[8] = {};
  };

  Device() {
    com_default.heartbeat = 100;
    com_default.number = 1;
    com_default.cob_id = 0x201;
    com_default.mapping[0] = 0x24000108;
    com_default.type = 255;
    app_default.value = 0x11223344;
    app_default.name = {0, 2, sizeof app.text, app.text};
    std::memcpy(app_default.text, "ab", 2);
    zero = mapped[0] = mapped[1] = 0x55;
  }

  Setup setup() {
    Setup all = Setup().only_small().ends_with(CO_OBJ_DICT_DEFAULTS(list));
    all.with({CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, data(&com.heartbeat)});
    all.with({CO_KEY(0x1400, 1, CO_OBJ_____RW), CO_TPDO_ID, data(&com.cob_id)});
    all.with({CO_KEY(0x1400, 2, CO_OBJ_____RW), CO_TPDO_TYPE, data(&com.type)});
    all.with({CO_KEY(0x1600, 0, CO_OBJ_____RW), CO_TPDO_NUM, data(&com.number)});
    all.with({CO_KEY(0x1600, 1, CO_OBJ_____RW), CO_TPDO_MAP, data(&com.mapping[0])});
    all.with({CO_KEY(0x1600, 2, CO_OBJ_____RW), CO_TPDO_MAP, data(&com.mapping[1])});
    all.with({CO_KEY(0x2300, 1, CO_OBJ_____RW), CO_TUNSIGNED32, data(&app.value)});
    all.with({CO_KEY(0x2300, 2, CO_OBJ_____RW), CO_TVISIBLE_STRING, data(&app.name)});
    all.with({CO_KEY(0x2300, 3, CO_OBJ_____RW), CO_TUNSIGNED8, data(&zero)});
    all.with({CO_KEY(0x2400, 1, CO_OBJ____PRW), CO_TUNSIGNED8, data(&mapped[0])});
    all.with({CO_KEY(0x2400, 2, CO_OBJ____PRW), CO_TUNSIGNED8, data(&mapped[1])});
    for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}}) all.may_change(0x2300, sub);
    for (const std::uint8_t sub : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{2}}) all.may_change(0x1600, sub);
    return all.may_change(0x1017, 0).may_change(0x1400, 1).may_change(0x1400, 2).may_change(0x2400, 1).may_change(
        0x2400, 2);
  }

  Communication com;
  Application app;
  Communication com_default;
  Application app_default;
  std::uint8_t zero;
  std::uint8_t mapped[2];
  CO_DEFAULTS list[4] = {CO_DEFAULTS_OF(com, com_default, CO_RESET_COM),
                         CO_DEFAULTS_OF(app, app_default, CO_RESET_NODE), CO_DEFAULTS_ZERO(zero, CO_RESET_NODE),
                         CO_DEFAULTS_END};
};

TEST_CASE("power-on values: CONodeInit() sets them before a service reads them [301:7.3.2.2.1]") {
  Device device;
  Fixture node(device.setup());
  node.after(100ms);
  node.tx({"701#7F"});
  node.ask("601#4017100000000000", "581#4B17100064000000");
  node.ask("601#4000230100000000", "581#4300230144332211");
  node.ask("601#4000230300000000", "581#4F00230300000000");
}

TEST_CASE("power-on values: reset communication sets 1017h to its default period") {
  Device device;
  Fixture node(device.setup());
  node.rx("601#2B171000FA000000");
  node.frames();
  node.after(250ms);
  node.tx("701#7F");
  node.rx("000#8201");
  node.tx("701#00");
  node.ask("601#4017100000000000", "581#4B17100064000000");
  node.after(100ms);
  node.tx("701#7F");
}

TEST_CASE("power-on values: objects of the application keep their values at reset communication") {
  Device device;
  Fixture node(device.setup());
  node.frames();
  node.ask("601#2300230101000000", "581#6000230100000000");
  node.ask("601#2F00230309000000", "581#6000230300000000");
  node.rx("000#8201");
  node.frames();
  node.ask("601#4000230100000000", "581#4300230101000000");
  node.ask("601#4000230300000000", "581#4F00230309000000");
  node.rx("000#8101");
  node.frames();
  node.ask("601#4000230100000000", "581#4300230144332211");
  node.ask("601#4000230300000000", "581#4F00230300000000");
}

TEST_CASE("power-on values: reset node also sets those of reset communication, and a string with its length") {
  Device device;
  Fixture node(device.setup());
  node.frames();
  CHECK(node.download(0x2300, 2, {'l', 'o', 'n', 'g', 'e', 'r'}) == 0);
  CHECK(node.upload(0x2300, 2) == Bytes{'l', 'o', 'n', 'g', 'e', 'r'});
  node.ask("601#2B171000FA000000", "581#6017100000000000");
  node.rx("000#8101");
  node.tx("701#00");
  CHECK(node.upload(0x2300, 2) == Bytes{'a', 'b'});
  node.ask("601#4017100000000000", "581#4B17100064000000");
}

TEST_CASE("power-on values: resets by the application set them like those of the NMT master") {
  Device device;
  Fixture node(device.setup());
  node.frames();
  node.call([&] {
    CHECK(CODictWrWord(&node->Dict, CO_DEV(0x1017, 0), 0) == CO_ERR_NONE);
    CHECK(CODictWrLong(&node->Dict, CO_DEV(0x2300, 1), 5) == CO_ERR_NONE);
  });
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_COM); });
  CHECK(device.com.heartbeat == 100);
  CHECK(device.app.value == 5);
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_NODE); });
  CHECK(device.app.value == 0x11223344);
  node.frames();
}

#if CO_RPDO_N > 0
TEST_CASE("power-on values: a PDO that was mapped anew by SDO has its default mapping after reset communication") {
  Device device;
  Fixture node(device.setup());
  node.rx("000#0101");
  node.frames();
  node.rx("201#01");
  CHECK(device.mapped[0] == 0x01);
  node.ask("601#2300140101020080", "581#6000140100000000");
  node.ask("601#2F00160000000000", "581#6000160000000000");
  node.ask("601#2300160108020024", "581#6000160100000000");
  node.ask("601#2F00160001000000", "581#6000160000000000");
  node.ask("601#2300140101030000", "581#6000140100000000");
  node.rx("301#02");
  CHECK(device.mapped[1] == 0x02);
  node.rx("000#8201");
  node.tx("701#00");
  node.rx("000#0101");
  node.rx("301#03");
  CHECK(device.mapped[1] == 0x02);
  node.rx("201#04");
  CHECK(device.mapped[0] == 0x04);
  node.ask("601#4000140100000000", "581#4300140101020000");
  node.ask("601#4000160100000000", "581#4300160108010024");
}
#endif

#if USE_PARA
TEST_CASE("power-on values: a parameter group is loaded after the default values are set") {
  Device device;
  FailingNvm nvm{{1024, 1, 0}};
  CO_PARA group = {0, sizeof device.app.value, &device.app.value, nullptr, CO_RESET_NODE, nullptr, CO_PARA___E};
  Fixture node(device.setup()
                   .nvm(FailingNvm::driver, &nvm)
                   .with({CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, data(&group)}));
  node.frames();
  node.ask("601#2300230107000000", "581#6000230100000000");
  node.ask("601#2310100173617665", "581#6010100100000000");
  node.ask("601#2300230108000000", "581#6000230100000000");
  node.rx("000#8101");
  node.frames();
  node.ask("601#4000230100000000", "581#4300230107000000");
}
#endif

// Logged calls of an end mark with an application type: reset types, and the heartbeat time at each call.
struct Calls {
  std::uint16_t heartbeat = 5;
  unsigned number = 0;
  std::uint32_t type[4] = {};
  std::uint16_t found[4] = {};
};

CO_ERR note_reset(CO_OBJ* end, CO_NODE* node, std::uint32_t type) {
  auto& calls = *reinterpret_cast<Calls*>(static_cast<std::uintptr_t>(end->Data));
  CHECK(end->Key == CO_DEFAULTS_KEY);
  CHECK(CONodeGetUser(node) != nullptr);
  REQUIRE(calls.number < 4);
  calls.found[calls.number] = calls.heartbeat;
  calls.type[calls.number++] = type;
  return CO_ERR_NONE;
}

TEST_CASE("power-on values: an application-defined type in the end mark is called at power-on and by each NMT reset") {
  const CO_OBJ_TYPE type = {nullptr, nullptr, nullptr, nullptr, note_reset};
  Calls calls;
  Fixture node(Setup()
                   .only_small()
                   .ends_with({CO_DEFAULTS_KEY, &type, data(&calls)})
                   .with({CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, data(&calls.heartbeat)}));
  CHECK(calls.number == 1);
  node.ask("601#2B171000FA000000", "581#6017100000000000");
  node.rx("000#8201");
  node.tx("701#00");
  node.rx("000#8101");
  node.tx("701#00");
  CHECK(calls.number == 3);
  CHECK(calls.type[0] == CO_RESET_NODE);
  CHECK(calls.type[1] == CO_RESET_COM);
  CHECK(calls.type[2] == CO_RESET_NODE);
  CHECK(calls.found[0] == 5);
  CHECK(calls.found[1] == 250);
}

TEST_CASE("power-on values: an end mark with members of an entry or without a list sets nothing") {
  Device device;
  const CO_OBJ_TYPE without_reset = {nullptr, nullptr, nullptr, nullptr, nullptr};
  std::uint8_t byte = 0;
  CO_OBJ_DOM domain = {0, 1, &byte};
  for (const CO_OBJ end : {CO_OBJ{0, CO_TDOMAIN, data(&domain)}, CO_OBJ{0, CO_TUNSIGNED8, data(&byte)},
                           CO_OBJ{0, reinterpret_cast<const CO_OBJ_TYPE*>(&byte), data(&byte)},
                           CO_OBJ{CO_DEFAULTS_KEY, &without_reset, data(&byte)},
                           CO_OBJ{CO_DEFAULTS_KEY, CO_TDEFAULTS, 0}, CO_OBJ{CO_DEFAULTS_KEY, nullptr, data(&byte)}}) {
    device.com.heartbeat = 0;
    device.app.value = 3;
    Fixture node(device.setup().ends_with(end));
    node.rx("000#8101");
    node.frames();
    CHECK(device.com.heartbeat == 0);
    CHECK(device.app.value == 3);
  }
}

TEST_CASE("power-on values: an end mark beyond DictLen is not read") {
  Device device;
  device.com.heartbeat = 0;
  device.com.number = 0;
  Fixture node(device.setup());
  node.frames();
  CO_OBJ* const root = node->Dict.Root;
  const std::uint16_t entries = node->Dict.Num;
  node.ask("601#2B17100007000000", "581#6017100000000000");
  node.call([&] { (void)CODictInit(&node->Dict, &node.node, root, entries); });
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_NODE); });
  CHECK(device.com.heartbeat == 7);
  node.call([&] { (void)CODictInit(&node->Dict, &node.node, root, entries + 1); });
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_NODE); });
  CHECK(device.com.heartbeat == 100);
  node.frames();
}

}  // namespace
