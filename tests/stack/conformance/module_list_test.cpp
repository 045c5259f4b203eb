// SPDX-License-Identifier: Apache-2.0
// 1027h, module list, whose content a function of the application provides. [301:7.5.2.30]
#include "support/fixture.hpp"

namespace {

using namespace test;

/// Three places for modules, the second of which is empty.
struct Modular {
  explicit Modular(CO_MODULE_LIST list = {read}, std::uint32_t flags = CO_OBJ_____R_)
      : modules(list), node(setup(flags)) {}

  static CO_ERR read(CO_NODE*, void*, std::uint8_t sub, std::uint16_t* value) {
    constexpr std::uint16_t types[] = {0x0102, 0, 0xFFFE};
    CHECK(*value == 0);
    if (sub == 0) {
      *value = 2;
    } else if (sub == 2) {
      return CO_ERR_OBJ_NO_DATA;
    } else {
      *value = types[sub - 1];
    }
    return CO_ERR_NONE;
  }

  Setup setup(std::uint32_t flags) {
    Setup setup;
    for (std::uint8_t sub = 0; sub <= 3; ++sub) {
      setup.with({CO_KEY(0x1027, sub, flags), CO_TMODULE_LIST, &modules});
    }
    return setup;
  }

  CO_MODULE_LIST modules;
  Fixture node;
};

TEST_CASE("1027h: sub 0 is the number of modules and the other sub-indices are their types [O7]") {
  Modular device;
  device.node.ask("601#4027100000000000", "581#4F27100002000000");
  device.node.ask("601#4027100100000000", "581#4B27100102010000");
  device.node.ask("601#4027100300000000", "581#4B271003FEFF0000");
}

TEST_CASE("1027h: a number of modules above 254 is refused, not shortened [O7]") {
  static std::uint16_t number = 0;
  const CO_MODULE_LIST list = {[](CO_NODE*, void*, std::uint8_t, std::uint16_t* value) {
    *value = number;
    return CO_ERR_NONE;
  }};
  Modular device(list);
  number = 254;
  device.node.ask("601#4027100000000000", "581#4F271000FE000000");
  for (const std::uint16_t refused : {std::uint16_t{255}, std::uint16_t{256}, std::uint16_t{0x1002}}) {
    number = refused;
    device.node.ask("601#4027100000000000", "581#8027100020000008");
    device.node.ask("601#4027100100000000", std::string("581#4B271001") + (refused == 255   ? "FF000000"
                                                                           : refused == 256 ? "00010000"
                                                                                            : "02100000"));
  }
}

TEST_CASE("1027h: a place without a module has no data and one beyond the table does not exist [O7]") {
  Modular device;
  device.node.ask("601#4027100200000000", "581#8027100224000008");
  device.node.ask("601#4027100400000000", "581#8027100411000906");
}

TEST_CASE("1027h: it cannot be written with or without flag W [O7]") {
  for (const std::uint32_t flags : {std::uint32_t{CO_OBJ_____R_}, std::uint32_t{CO_OBJ_____RW}}) {
    Modular device({Modular::read}, flags);
    device.node.ask("601#2F27100003000000", "581#8027100002000106");
    device.node.ask("601#2B27100103000000", "581#8027100102000106");
  }
}

TEST_CASE("1027h: the application reads it through the dictionary with the width of the entry [O7]") {
  Modular device;
  std::uint8_t number = 0;
  std::uint16_t type = 0;
  std::uint32_t wide = 0;
  CO_DICT* const dict = &device.node->Dict;
  CHECK(CODictRdByte(dict, CO_DEV(0x1027, 0), &number) == CO_ERR_NONE);
  CHECK(number == 2);
  CHECK(CODictRdWord(dict, CO_DEV(0x1027, 3), &type) == CO_ERR_NONE);
  CHECK(type == 0xFFFE);
  CHECK(CODictRdWord(dict, CO_DEV(0x1027, 0), &type) == CO_ERR_OBJ_SIZE);
  CHECK(CODictRdLong(dict, CO_DEV(0x1027, 1), &wide) == CO_ERR_OBJ_SIZE);
  CHECK(CODictWrByte(dict, CO_DEV(0x1027, 0), 1) != CO_ERR_NONE);
}

TEST_CASE("1027h: the function may choose the abort code [O7]") {
  Modular device({[](CO_NODE* node, void*, std::uint8_t sub, std::uint16_t*) {
    COObjTypeUserSDOAbort(CODictFind(&node->Dict, CO_DEV(0x1027, sub)), node, CO_SDO_ERR_HW_ACCESS);
    return CO_ERR_TYPE_RD;
  }});
  device.node.ask("601#4027100100000000", "581#8027100100000606");
}

TEST_CASE("1027h: without a function there is no data and without a list the access is refused [O7]") {
  Modular empty({nullptr});
  empty.node.ask("601#4027100000000000", "581#8027100024000008");
  empty.node.ask("601#4027100100000000", "581#8027100124000008");
  Fixture null(Setup().with({CO_KEY(0x1027, 0, CO_OBJ_____R_), CO_TMODULE_LIST, 0}));
  null.ask("601#4027100000000000", "581#8027100020000008");
}

#if USE_DICT_CHECK
TEST_CASE("1027h: its type is accepted at 1027h only [O7]") {
  CO_MODULE_LIST modules{Modular::read};
  Fixture wrong(Setup().with({CO_KEY(0x1026, 0, CO_OBJ_____R_), CO_TMODULE_LIST, &modules}).stay_in_init());
  CHECK(wrong.error() == CO_ERR_DICT_INIT);
  CHECK(CODictGetFault(&wrong->Dict, nullptr) == CO_DICT_WRONG_PLACE);
}
#endif

}  // namespace
