// SPDX-License-Identifier: Apache-2.0
// Event-driven TPDOs, types 254 and 255, and events of type 0: flag A, COTPdoTrigPdo(), COTPdoTrigObj() and
// COTPdoRequest(). [301:7.2.2.5]
#include <cstring>

#include "support/sync_fixture.hpp"

#if CO_TPDO_N > 0

namespace {

using namespace test;

// Returns a table with TPDO 0 on 181h. By default it maps 2211h:1, with flag A, and 2202h:1, without.
PdoTable with(std::uint8_t type, std::initializer_list<std::uint32_t> words = {0x22110108, 0x22020110}) {
  PdoTable table;
  table.tpdo[0].on(0x40000181, type, words);
  return table;
}

void trigger_object(PdoNode& node, CO_OBJ* obj) {
  node.call([&] { COTPdoTrigObj(node->TPdo, obj); });
}

void write_byte(PdoNode& node, std::uint16_t index, std::uint8_t sub, std::uint8_t value) {
  node.call([&] { CHECK(CODictWrByte(&node->Dict, CO_DEV(index, sub), value) == CO_ERR_NONE); });
}

TEST_CASE("TPDO event: COTPdoTrigPdo sends types 254 and 255 at once with the present values [X1]") {
  for (const std::uint8_t type : std::initializer_list<std::uint8_t>{254, 255}) {
    CAPTURE(unsigned{type});
    PdoNode node(with(type));
    node.start();
    node.trigger(0);
    node.tx("181#111112");
    node.a8[0] = 0xAB;
    node.trigger(0);
    node.trigger(0);
    node.tx({"181#AB1112", "181#AB1112"});
    CHECK(node.error() == CO_ERR_NONE);
  }
}

TEST_CASE("TPDO event: entering Operational sends nothing [N11]") {
  if (CO_TPDO_ON_START != 0) {
    return;
  }
  PdoNode node(with(255));
  node.start();
  node.after(10000ms);
  node.silent();
}

TEST_CASE("TPDO event: COTPdoTrigPdo sends the PDO of the number and no other one") {
  PdoTable table;
  for (unsigned n = 0; n < fixture_tpdos; ++n) {
    table.tpdo[n].on(0x40000181 + n * 0x100, 255, {0x22010008U | (n + 1) << 8});
  }
  PdoNode node(table);
  node.start();
  for (unsigned n = fixture_tpdos; n-- > 0;) {
    node.trigger(static_cast<std::uint16_t>(n));
    node.tx(notation(CO_IF_FRM{0x181 + n * 0x100, {static_cast<std::uint8_t>(16 * (n + 1) + 1)}, 1}));
  }
}

TEST_CASE("TPDO event: COTPdoRequest returns why a PDO is not sent [X15]") {
  PdoNode node(with(255));
  CHECK(node.request(0) == CO_ERR_NMT_MODE);
  node.rx("000#0201");
  CHECK(node.request(0) == CO_ERR_NMT_MODE);
  node.start();
  node.silent();
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx("181#111112");
  CHECK(node.request(CO_TPDO_N) == CO_ERR_TPDO_NUM_TRIGGER);
  CHECK(node.request(0xFFFF) == CO_ERR_TPDO_NUM_TRIGGER);
  CHECK(node.request(CO_TPDO_N - 1) == (CO_TPDO_N > 1 ? CO_ERR_TPDO_COM_OBJ : CO_ERR_NONE));
  node.frames();
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  CHECK(node.request(0) == CO_ERR_TPDO_COM_OBJ);
  CHECK(COTPdoRequest(nullptr, 0) == CO_ERR_BAD_ARG);
  CHECK(node.error() == CO_ERR_NONE);
  node.silent();
}

TEST_CASE("TPDO event: COTPdoRequest of a type without events sends nothing then or later [X15] [D42]") {
  for (unsigned type = 0; type < 254; type += type < 240 ? stride(16) : 1) {
    const bool allowed = (type <= 240 && USE_SYNC != 0) || (type >= 252 && USE_PDO_RTR != 0);
    if (!allowed || type == 0) {
      continue;
    }
    CAPTURE(type);
    PdoNode node(with(static_cast<std::uint8_t>(type)));
    node.start();
    CHECK(node.request(0) == CO_ERR_TPDO_EVENT);
    node.trigger(0);
    CHECK(node.error() == CO_ERR_TPDO_EVENT);
    write_byte(node, 0x2211, 1, 0x77);
    node.after(1000ms);
    node.silent();
  }
}

TEST_CASE("TPDO event: COTPdoRequest of a PDO whose object cannot be read returns its error [X15] [D37]") {
  static CO_ERR answer;
  static const CO_OBJ_TYPE type = {[](CO_OBJ*, CO_NODE*, std::uint32_t) -> std::uint32_t { return 2; }, nullptr,
                                   [](CO_OBJ*, CO_NODE*, void* buffer, std::uint32_t) {
                                     const std::uint16_t value = 0x005A;
                                     std::memcpy(buffer, &value, sizeof value);
                                     return answer;
                                   },
                                   nullptr, nullptr};
  PdoNode node(with(255, {0x22010108, 0x22FF0010}), [](Setup& setup) {
    setup.with({CO_KEY(0x22FF, 0, CO_OBJ____PR_), &type, 0});
  });
  node.start();
  answer = CO_ERR_OBJ_READ;
  CHECK(node.request(0) == CO_ERR_OBJ_READ);
  node.silent();
  answer = CO_ERR_NONE;
  node.silent();
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx("181#115A00");
}

TEST_CASE(
    "TPDO event: COTPdoRequest with a full transmit queue returns CO_ERR_IF_CAN_SEND, nothing is sent later [X15]") {
  PdoNode node(with(255), [](Setup& setup) { setup.tx_queue(1); });
  node.start();
  node.can.refuse_all();
  CO_IF_FRM other = frame("123#01");
  node.call([&] { CHECK(COIfCanSend(&node->If, &other) == sizeof(CO_IF_FRM)); });
  CHECK(node.request(0) == CO_ERR_IF_CAN_SEND);
  node.can.accept_all();
  node.loop();
  node.tx("123#01");
  node.after(1000ms);
  node.silent();
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx("181#111112");
}

TEST_CASE("TPDO event: COTPdoTrigPdo sets its reason as the node error [D36] [X15]") {
  PdoNode node(with(255));
  node.trigger(0);
  CHECK(node.error() == CO_ERR_NMT_MODE);
  node.trigger(CO_TPDO_N);
  CHECK(node.error() == CO_ERR_TPDO_NUM_TRIGGER);
  node.start();
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  node.trigger(0);
  CHECK(node.error() == CO_ERR_TPDO_COM_OBJ);
  node.silent();
}

TEST_CASE("TPDO event: COTPdoTrigPdo and COTPdoTrigObj without a node call CONodeFatalError()") {
  PdoNode node;
  CO_TPDO without_node = {};
  for (CO_TPDO* const tpdo : {static_cast<CO_TPDO*>(nullptr), &without_node}) {
    COTPdoTrigPdo(tpdo, 0);
    COTPdoTrigObj(tpdo, nullptr);
  }
  CHECK(callbacks().fatal_errors == 4);
}

TEST_CASE("TPDO event: COTPdoTrigObj sends all PDOs that map the object once") {
  PdoTable table;
  table.tpdo[0].on(0x40000181, 255, {0x22010108, 0x22010108});
  if (fixture_tpdos > 3) {
    table.tpdo[1].on(0x40000281, 255, {0x22010208});
    table.tpdo[2].on(0x40000381, 254, {0x22020110, 0x22010108});
    table.tpdo[3].on(0xC0000481, 254, {0x22010108});
  }
  PdoNode node(table);
  node.start();
  trigger_object(node, node.find(0x2201, 1));
  CHECK(node.frames() == (fixture_tpdos > 3 ? std::vector<std::string>{"181#1111", "381#111211"}
                                            : std::vector<std::string>{"181#1111"}));
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("TPDO event: COTPdoTrigObj of an object that is not or cannot be mapped is CO_ERR_TPDO_OBJ_TRIGGER [X15]") {
  PdoNode node(with(255));
  node.start();
  trigger_object(node, nullptr);
  CHECK(node.error() == CO_ERR_TPDO_OBJ_TRIGGER);
  trigger_object(node, node.find(0x2241, 1));
  CHECK(node.error() == CO_ERR_TPDO_OBJ_TRIGGER);
  trigger_object(node, node.find(0x2201, 8));
  CHECK(node.error() == CO_ERR_TPDO_OBJ_TRIGGER);
  node.silent();
}

TEST_CASE("TPDO event: COTPdoTrigObj of an entry of another dictionary is CO_ERR_TPDO_OBJ_TRIGGER [X15]") {
  PdoNode node(with(255));
  node.start();
  CO_OBJ* const mapped = node.find(0x2211, 1);
  trigger_object(node, mapped);
  CHECK(node.frames().size() == 1);
  // Entries are numbered with 16 bits: an entry 65536 entries away must not be confused with the mapped one.
  const auto far = reinterpret_cast<std::uintptr_t>(mapped) + 65536 * sizeof(CO_OBJ);
  CO_OBJ copy = *mapped;
  for (CO_OBJ* const other : {reinterpret_cast<CO_OBJ*>(far), &copy, node->Dict.Root + node->Dict.Num}) {
    trigger_object(node, other);
    CHECK(node.error() == CO_ERR_TPDO_OBJ_TRIGGER);
    node.call([&] { CHECK_FALSE(COTPdoObjWasSent(&node.node, other)); });
    node.call([&] { CHECK_FALSE(CORPdoObjWasReceived(&node.node, other)); });
  }
  node.silent();
  node.call([&] { CHECK(COTPdoObjWasSent(&node.node, mapped)); });
}

TEST_CASE("TPDO event: COTPdoTrigObj ignores a mapping that has been replaced [D41]") {
  PdoNode node(with(255));
  node.start();
  CHECK(node.remap_tpdo(0, {0x22010108}, 0x40000181) == 0);
  trigger_object(node, node.find(0x2211, 1));
  CHECK(node.error() == CO_ERR_TPDO_OBJ_TRIGGER);
  trigger_object(node, node.find(0x2201, 1));
  node.tx("181#11");
}

TEST_CASE("TPDO event: a change of an object with flag A by SDO or by the application sends its PDOs") {
  PdoNode node(with(255, {0x22110108, 0x22120110, 0x22140120}));
  node.start();
  CHECK(node.set(0x2211, 1, 1, 0xAB) == 0);
  node.tx("181#AB111211121314");
  write_byte(node, 0x2211, 1, 0xAC);
  node.tx("181#AC111211121314");
  node.call([&] { CHECK(CODictWrWord(&node->Dict, CO_DEV(0x2212, 1), 0x5678) == CO_ERR_NONE); });
  node.tx("181#AC785611121314");
  node.call([&] { CHECK(CODictWrLong(&node->Dict, CO_DEV(0x2214, 1), 0x01020304) == CO_ERR_NONE); });
  node.tx("181#AC785604030201");
}

TEST_CASE("TPDO event: a PDO caused by a download (flag A) is sent besides the answer, in either order") {
  PdoNode node(with(255, {0x22110108}));
  node.start();
  node.rx("601#2F112201AB000000");
  std::vector<std::string> sent = node.frames();
  std::sort(sent.begin(), sent.end());
  CHECK(sent == std::vector<std::string>{"181#AB", "581#6011220100000000"});
}

TEST_CASE("TPDO event: writing the present value of an object with flag A sends nothing") {
  PdoNode node(with(255));
  node.start();
  CHECK(node.set(0x2211, 1, 1, 0x11) == 0);
  write_byte(node, 0x2211, 1, 0x11);
  node.silent();
}

TEST_CASE("TPDO event: a change of an object without flag A or without mapping sends nothing") {
  PdoNode node(with(255, {0x22110108, 0x22010108}));
  node.start();
  CHECK(node.set(0x2201, 1, 1, 0x77) == 0);
  CHECK(node.set(0x2211, 2, 1, 0x77) == 0);
  node.silent();
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("TPDO event: changes in Pre-operational and Stopped send nothing, also later [N11]") {
  PdoNode node(with(255));
  write_byte(node, 0x2211, 1, 0x55);
  node.rx("000#0201");
  write_byte(node, 0x2211, 1, 0x66);
  node.start();
  node.after(1000ms);
  node.silent();
  write_byte(node, 0x2211, 1, 0x77);
  node.tx("181#771112");
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("TPDO event: events of a TPDO that is switched off are dropped [X8]") {
  PdoNode node(with(255));
  node.start();
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  write_byte(node, 0x2211, 1, 0x55);
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  node.after(1000ms);
  node.silent();
}

#if USE_SYNC

TEST_CASE("TPDO event: type 0 is sent once with the next SYNC after an event [X1] [D42] [PDO 07]") {
  SyncTable table;
  table.tpdo[0].on(0x40000181, 0, {0x22110108});
  SyncNode node(table);
  node.start();
  node.rx("080#");
  node.tx("181#11");  // entering Operational is an event
  for (int i = 0; i < 3; ++i) {
    node.rx("080#");
    node.silent();
  }
  CHECK(node.request(0) == CO_ERR_NONE);
  node.after(100ms);
  node.silent();
  node.rx("080#");
  node.tx("181#11");
  node.rx("080#");
  node.silent();
  write_byte(node, 0x2211, 1, 0x12);
  write_byte(node, 0x2211, 1, 0x13);
  node.trigger(0);
  node.silent();
  node.a8[0] = 0x14;
  node.rx("080#");
  node.tx("181#14");  // the value at the SYNC
  node.rx("080#");
  node.silent();
}

TEST_CASE("TPDO event: entering Operational again and switching on are events of type 0 [PDO 07]") {
  SyncTable table;
  table.tpdo[0].on(0x40000181, 0, {0x22110108});
  SyncNode node(table);
  node.start();
  node.rx("080#");
  node.tx("181#11");
  node.rx("000#8001");
  node.rx("000#0101");
  node.rx("080#");
  node.tx("181#11");
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  node.rx("080#");
  node.silent();
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  node.rx("080#");
  node.tx("181#11");
}

#endif

TEST_CASE("TPDO event: a TPDO with a 29-bit CAN-ID is sent [P1]") {
  PdoTable table;
  table.tpdo[0].on(0x40000000U | 0x20000000U | 0x1ABCDEF0U, 255, {0x22010108});
  PdoNode node(table);
  node.start();
  node.trigger(0);
  node.tx("1ABCDEF0#11");
}

}  // namespace

#endif
