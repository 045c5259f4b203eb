// SPDX-License-Identifier: Apache-2.0
// CONodeGetErrKey(): index and sub-index of the object that has caused the node's error.
#include <cstdio>

#include "support/emcy_fixture.hpp"
#include "support/logged_stream.hpp"
#include "support/parameter_groups.hpp"
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

/// Returns the name of the node's error and its object: "CO_ERR_TPDO_MAP_OBJ 1A00:2"; "-": no object. \a key_first:
/// reads the key before the error.
std::string told(CO_NODE& node, bool key_first = false) {
  std::uint32_t key = key_first ? CONodeGetErrKey(&node) : 0;
  const CO_ERR err = CONodeGetErr(&node);
  key = key_first ? key : CONodeGetErrKey(&node);
  char object[12] = "-";
  if (key != 0) {
    std::snprintf(object, sizeof object, "%04X:%u", unsigned{CO_GET_IDX(key)}, unsigned{CO_GET_SUB(key)});
  }
  CHECK((key & 0xFFU) == 0);
  return std::string(COErrName(err)) + " " + object;
}

std::string told(Fixture& node) { return told(node.node); }

const std::string no_error = "CO_ERR_NONE -";

// Reading ------------------------------------------------------------------------------------------------------------

TEST_CASE("error key: can be read before or after the error, until CONodeGetErr() has returned CO_ERR_NONE") {
  for (const bool key_first : {false, true}) {
    CAPTURE(key_first);
    Fixture node(Setup().without(0x1018, 1));
    CHECK(CONodeGetErrKey(&node.node) == (USE_DICT_CHECK != 0 ? CO_DEV(0x1018, 1) : 0));
    CHECK(told(node.node, key_first) == (USE_DICT_CHECK != 0 ? "CO_ERR_CFG_1018 1018:1" : no_error));
    CHECK(CONodeGetErr(&node.node) == CO_ERR_NONE);
    CHECK(CONodeGetErrKey(&node.node) == 0);
  }
  CHECK(CONodeGetErrKey(nullptr) == 0);
}

TEST_CASE("error key: an error without an object replaces the key of the error before it") {
  Fixture node(Setup().without(0x1018, 1));
  node.call([&] { CONmtSetMode(&node->Nmt, CO_INVALID); });
  CHECK(told(node) == "CO_ERR_NMT_MODE -");
  node.call([&] { CHECK(COTmrCreate(&node->Tmr, 1, 0, nullptr, nullptr) == -1); });
  CHECK(told(node) == "CO_ERR_BAD_ARG -");
}

// The dictionary -----------------------------------------------------------------------------------------------------

#if USE_DICT_CHECK
TEST_CASE("error key: a missing mandatory object is the key [X1]") {
  Fixture without_register(Setup().without(0x1001, 0));
  CHECK(told(without_register) == "CO_ERR_CFG_1001_0 1001:0");
  Fixture without_both(Setup().without(0x1001, 0).without(0x1018, 1));
  CHECK(told(without_both) == "CO_ERR_CFG_1018 1018:1");
}

/// A node with a wrong entry, whose initialisation fails; therefore without the fixture.
struct Refused {
  explicit Refused(CO_OBJ wrong)
      : table{{CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 0}, wrong, CO_OBJ_DICT_ENDMARK} {
    ext.Size = sizeof ext;
    ext.Can = &can;
    ext.Timer = &timer;
    CONodeInitEx(&node, &spec, &ext);
  }

  CO_OBJ table[3];
  CO_IF_CAN_DRV_EX can = {[](void*) {},
                          [](void*, std::uint32_t) {},
                          [](void*, CO_IF_FRM*) { return std::int16_t{-1}; },
                          [](void*, const CO_IF_FRM*) { return std::int16_t{0}; },
                          [](void*) {},
                          [](void*) {},
                          nullptr,
                          nullptr};
  CO_IF_TIMER_DRV_EX timer = {[](void*, std::uint32_t) {}, [](void*) { return std::uint32_t{0}; }, nullptr};
  CO_NODE_SPEC spec = {1, 125000, table, 3, nullptr, nullptr, 0, 1000, nullptr, nullptr};
  CO_NODE_EXT ext = {};
  CO_NODE node;
};

TEST_CASE("error key: for a refused dictionary it is the entry that CODictGetFault() returns") {
  Refused unsorted({CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 0});
  CHECK(told(unsorted.node) == "CO_ERR_DICT_INIT 1000:0");
  CHECK(CODictGetFault(&unsorted.node.Dict, nullptr) == CO_DICT_NOT_ASCENDING);
  Refused misplaced({CO_KEY(0x2000, 3, CO_OBJ_D___R_), CO_TSYNC_ID, 0x80});
  CHECK(told(misplaced.node) == (USE_SYNC != 0 ? "CO_ERR_DICT_INIT 2000:3" : no_error));
}

TEST_CASE("error key: CONodeInit() clears the key of the previous run") {
  Refused unsorted({CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 0});
  const CO_NODE_SPEC spec = {};
  CONodeInit(&unsorted.node, &spec);
  CHECK(told(unsorted.node) == "CO_ERR_NODE_CAN -");
}

TEST_CASE("error key: the key of a node that does not run is kept when its controller fails") {
  Refused unsorted({CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 0});
  CONodeProcess(&unsorted.node);
  CHECK(told(unsorted.node) == "CO_ERR_DICT_INIT 1000:0");
}

TEST_CASE("error key: the first entry whose Init function fails is the key") {
  const CO_OBJ no_variable = {CO_KEY(0x2001, 0, CO_OBJ_____RW), CO_TUNSIGNED8, 0};
  Fixture node(Setup().with(no_variable).with({CO_KEY(0x2002, 0, CO_OBJ_____RW), CO_TUNSIGNED16, 0}));
  CHECK(told(node) == "CO_ERR_OBJ_INIT 2001:0");
  node.rx("000#8101");
  node.tx("701#00");
  CHECK(told(node) == "CO_ERR_OBJ_INIT 2001:0");
}
#endif

TEST_CASE("error key: an entry whose application-defined type cannot be initialised is the key") {
  static const CO_OBJ_TYPE failing = {[](CO_OBJ*, CO_NODE_T*, std::uint32_t) { return std::uint32_t{1}; },
                                      [](CO_OBJ*, CO_NODE_T*) { return CO_ERR_TYPE_INIT; }, nullptr, nullptr, nullptr};
  Fixture node(Setup().with({CO_KEY(0x3000, 7, CO_OBJ_____RW), &failing, 0}));
  CHECK(told(node) == "CO_ERR_OBJ_INIT 3000:7");
}

#if CO_HBCONS_N > 1
TEST_CASE("error key: a heartbeat consumer entry for a node that another entry monitors is the key [H7]") {
  CO_HBCONS consumers[2] = {};
  consumers[0].Time = consumers[1].Time = 100;
  consumers[0].NodeId = consumers[1].NodeId = 9;
  Setup setup;
  setup.with({CO_KEY(0x1016, 0, CO_OBJ_D___R_), CO_THB_CONS, 2});
  setup.with({CO_KEY(0x1016, 1, CO_OBJ_____RW), CO_THB_CONS, &consumers[0]});
  setup.with({CO_KEY(0x1016, 2, CO_OBJ_____RW), CO_THB_CONS, &consumers[1]});
  Fixture node(setup);
  CHECK(told(node) == "CO_ERR_OBJ_INIT 1016:2");
}
#endif

// PDOs ---------------------------------------------------------------------------------------------------------------

/// Returns the error of a node with these parameters of one RPDO or TPDO.
std::string error_of_pdo(bool is_tpdo, unsigned number, const PdoEntries& entries,
                         const std::function<void(Setup&)>& change = {}) {
  PdoTable table;
  (is_tpdo ? table.tpdo : table.rpdo)[number] = entries;
  PdoNode node(table, change);
  const std::string error = told(node);
  node.rx("000#8101");  // a reset reports the error again
  node.tx("701#00");
  CHECK(told(node) == error);
  return error;
}

PdoEntries pdo(std::uint32_t cob_id, std::uint8_t type, std::initializer_list<std::uint32_t> words) {
  return PdoEntries().on(cob_id, type, words);
}

constexpr std::uint32_t byte = 0x22010108;

TEST_CASE("error key: a wrong COB-ID or transmission type of a PDO is the key [M9]") {
  if (fixture_rpdos > 1) {
    CHECK(error_of_pdo(false, 1, pdo(0x0, 255, {byte})) == "CO_ERR_RPDO_COM_OBJ 1401:1");
    CHECK(error_of_pdo(false, 1, pdo(0x301, 241, {byte})) == "CO_ERR_RPDO_COM_OBJ 1401:2");
    CHECK(error_of_pdo(false, 1, pdo(0x0, 241, {byte})) == "CO_ERR_RPDO_COM_OBJ 1401:1");
    CHECK(error_of_pdo(false, 1, pdo(0x301, 255, {byte})) == no_error);
  }
  if (fixture_tpdos > 1) {
    CHECK(error_of_pdo(true, 1, pdo(0x40000000, 255, {byte})) == "CO_ERR_TPDO_COM_OBJ 1801:1");
    CHECK(error_of_pdo(true, 1, pdo(0x40000281, 251, {byte})) == "CO_ERR_TPDO_COM_OBJ 1801:2");
    CHECK(error_of_pdo(true, 1, pdo(0x40000281, 255, {byte})) == no_error);
  }
}

TEST_CASE("error key: a wrong mapping entry of a PDO is the key [M9]") {
  const struct {
    PdoEntries entries;
    const char* sub;
  } rows[] = {
      {pdo(0x301, 255, {}), "0"},                                          // no entry
      {pdo(0x301, 255, {0x21FF0008}), "1"},                                // no such object
      {pdo(0x301, 255, {byte, 0x22020810, 0x22010110}), "3"},              // wrong length
      {pdo(0x301, 255, {byte, 0}), "2"},                                   // empty entry
      {pdo(0x301, 255, {0x22080140, byte}), "2"},                          // ninth byte
      {pdo(0x301, 255, {0x22040120, 0x22020110, 0x22040220, byte}), "3"},  // first of two that do not fit
      {pdo(0x301, 255, {0x22080140, 0x22080240, 0x22010109}), "3"},        // objects are checked before the length
  };
  for (const auto& row : rows) {
    CAPTURE(row.sub);
    if (fixture_rpdos > 1) {
      CHECK(error_of_pdo(false, 1, row.entries) == std::string("CO_ERR_RPDO_MAP_OBJ 1601:") + row.sub);
    }
    if (fixture_tpdos > 1) {
      PdoEntries tpdo = row.entries;
      tpdo.cob_id = 0x40000281;
      CHECK(error_of_pdo(true, 1, tpdo) == std::string("CO_ERR_TPDO_MAP_OBJ 1A01:") + row.sub);
    }
  }
}

TEST_CASE("error key: sub-index 0 of a mapping is the key if the number is too large or missing [M9]") {
  if (fixture_tpdos == 0) {
    return;
  }
  PdoEntries tpdo = pdo(0x40000181, 255, {byte});
  tpdo.number = 65;
  CHECK(error_of_pdo(true, 0, tpdo) == "CO_ERR_TPDO_MAP_OBJ 1A00:0");
  const auto without_number = [](Setup& setup) { setup.without(0x1A00, 0); };
  CHECK(error_of_pdo(true, 0, pdo(0x40000181, 255, {byte}), without_number) == "CO_ERR_TPDO_MAP_OBJ 1A00:0");
}

/// A variable of one byte whose accesses fail.
struct Failing {
  Failing() { log.data = {7}; }
  CO_OBJ entry() {
    CO_OBJ obj = log.value(0x3000);
    obj.Key |= CO_OBJ____P__;
    return obj;
  }
  void fail() {
    log.on_piece = [](CO_OBJ*, CO_NODE*) { return CO_ERR_OBJ_STATE; };
  }
  LoggedStream log;
};

TEST_CASE("error key: an object of a PDO that could not be read or written is the key") {
  Failing failing;
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {byte, 0x30000008});
  table.tpdo[0].on(0x40000181, 255, {byte, 0x30000008});
  PdoNode node(table, [&](Setup& setup) { setup.with(failing.entry()); });
  REQUIRE(told(node) == no_error);
  node.start();
  failing.fail();
  if (fixture_rpdos > 0) {
    node.rx("201#0102");
    CHECK(told(node) == "CO_ERR_OBJ_STATE 3000:0");
  }
  if (fixture_tpdos > 0) {
    CHECK(node.request(0) == CO_ERR_OBJ_STATE);
    CHECK(told(node) == "CO_ERR_OBJ_STATE 3000:0");
    node.trigger(0);
    CHECK(told(node) == "CO_ERR_OBJ_STATE 1800:0");
  }
}

TEST_CASE("error key: failed TPDO triggers set the TPDO or the object as key") {
  PdoTable table;
  table.tpdo[0].on(0x40000181, 255, {byte});
  PdoNode node(table);
  node.start();
  if (CO_TPDO_N < 512) {
    node.trigger(511);
    CHECK(told(node) == "CO_ERR_TPDO_NUM_TRIGGER 19FF:0");
  }
  node.trigger(512);
  CHECK(told(node) == "CO_ERR_TPDO_NUM_TRIGGER -");
#if CO_TPDO_N > 0
  CO_OBJ* const unmapped = CODictFind(&node->Dict, CO_DEV(0x2202, 3));
  node.call([&] { COTPdoTrigObj(node->TPdo, unmapped); });
  CHECK(told(node) == "CO_ERR_TPDO_OBJ_TRIGGER 2202:3");
  CO_OBJ other = *unmapped;
  node.call([&] { COTPdoTrigObj(node->TPdo, &other); });
  CHECK(told(node) == "CO_ERR_TPDO_OBJ_TRIGGER -");
#endif
}

// Other services -----------------------------------------------------------------------------------------------------

TEST_CASE("error key: an object whose SDO transfer failed with 0606 0000h is the key") {
  LoggedStream value;
  value.data = {1, 2, 3, 4};
  value.on_piece = [](CO_OBJ*, CO_NODE*) { return CO_ERR_IF_NVM_READ; };
  Fixture node(Setup().only_small().with(value.value(0x3000)));
  node.ask("601#4000300000000000", "581#8000300000000606");
  CHECK(told(node) == "CO_ERR_SDO_READ 3000:0");
  node.ask("601#2300300001020304", "581#8000300000000606");
  CHECK(told(node) == "CO_ERR_SDO_WRITE 3000:0");
}

#if USE_SYNC
TEST_CASE("error key: 1006h is the key if the period of a SYNC producer is too short") {
  Setup setup;
  setup.with({CO_KEY(0x1005, 0, CO_OBJ_D___R_), CO_TSYNC_ID, 0x40000080});
  setup.with({CO_KEY(0x1006, 0, CO_OBJ_D___R_), CO_TSYNC_CYCLE, CO_SYNC_PERIOD_MIN - 1});
  Fixture node(setup);
  CHECK(told(node) == "CO_ERR_OBJ_RANGE_LOW 1006:0");
}
#endif

#if USE_EMCY && USE_DICT_CHECK
TEST_CASE("error key: an error of the application without 1014h sets 1014h as key") {
  Fixture node(Setup().emergencies({{CO_EMCY_REG_TEMP, CO_EMCY_CODE_TEMP_ERR}}).without(0x1014, 0));
  CHECK(told(node) == "CO_ERR_CFG_1014_0 1014:0");
}
#endif

#if USE_EMCY
TEST_CASE("error key: an error identifier beyond the error table sets no key") {
  EmcyNode node;
  node.call([&] { COEmcySet(&node->Emcy, 255, nullptr); });
  CHECK(told(node) == "CO_ERR_BAD_ARG -");
}
#endif

#if USE_PARA
TEST_CASE("error key: a parameter group that overlaps another one or has a damaged record is the key") {
  {
    GroupDevice device;
    device.second.Offset = 0;
    device.first.Offset = 0;
    Fixture node(device.setup());
    CHECK(told(node) == "CO_ERR_PARA_OVERLAP 1010:3");
  }
  GroupDevice device;
  {
    Fixture node(device.setup());
    node.ask("601#2310100273617665", "581#6010100200000000");
  }
  for (std::uint8_t& b : device.nvm.bytes) {
    b = static_cast<std::uint8_t>(b ^ 0x5AU);
  }
  device.second.Value = CO_PARA____;
  Fixture node(device.setup());
  CHECK(told(node) == "CO_ERR_PARA_LOAD 1010:2");
}
#endif

}  // namespace
