// SPDX-License-Identifier: Apache-2.0
// COPdoReceive(), COPdoUpdate() and COPdoSyncUpdate(), which may call API functions. [Q9]
#include "support/pdo_commands.hpp"
#include "support/sync_fixture.hpp"

#if CO_TPDO_N > 1 && CO_RPDO_N > 1

namespace {

using namespace test;

TEST_CASE("PDO callback: COPdoReceive is called for each RPDO and may change its data") {
  SyncNode node(asynchronous());
  node.start();
  std::vector<std::string> seen;
  callbacks().pdo_receive = [&](CO_IF_FRM* frm) {
    seen.push_back(notation(*frm));
    CO_SET_BYTE(frm, 0xEE, 0);
    return std::int16_t{0};
  };
  node.rx("201#42");
  node.rx("301#43");
  CHECK(seen == std::vector<std::string>{"201#42", "301#43"});
  CHECK(node.u8[0] == 0xEE);
  CHECK(node.u8[1] == 0xEE);
}

TEST_CASE("PDO callback: a frame that COPdoReceive consumes is not written, then or at the SYNC") {
  for (const std::uint8_t type : std::initializer_list<std::uint8_t>{1, 255}) {
    for (const std::int16_t answer : std::initializer_list<std::int16_t>{1, -1}) {
      SyncNode node(table_of(type));
      node.start();
      unsigned updates = 0;
      callbacks().pdo_receive = [&](CO_IF_FRM*) { return answer; };
      callbacks().pdo_update = [&](CO_RPDO*) { ++updates; };
      node.rx("201#42");
      node.rx("080#");
      CHECK(node.u8[0] == 0x11);
      CHECK(updates == 0);
      CHECK(node.counters().Malformed == 0);
      CHECK(node.counters().Unclaimed == 0);
      node.frames();
    }
  }
}

TEST_CASE("PDO callback: COPdoReceive is not called for frames that are too short or in another state [X5] [X9]") {
  SyncNode node(asynchronous());
  unsigned calls = 0;
  callbacks().pdo_receive = [&](CO_IF_FRM*) { return ++calls, std::int16_t{0}; };
  node.rx("201#42");
  node.start();
  node.rx("201#");
  node.frames();
  CHECK(calls == 0);
}

TEST_CASE(
    "PDO callback: if COPdoReceive leaves Operational its frame is the last one, a synchronous one is lost [Q9] [X9]") {
  for (const std::string& what : commands) {
    if (what.compare(0, 5, "reset") == 0) {
      continue;  // a reset is deferred until the frame is processed
    }
    for (const std::uint8_t type : std::initializer_list<std::uint8_t>{1, 255}) {
      CAPTURE(what);
      SyncTable table = table_of(type);
      table.rpdo[0].event = 100;
      SyncNode node(table);
      node.start();
      callbacks().pdo_receive = [&](CO_IF_FRM*) { return command(node, what), std::int16_t{0}; };
      node.rx("201#77");
      const std::uint8_t written = type == 1 ? 0x11 : 0x77;
      CHECK(node.u8[0] == written);
      callbacks() = Callbacks{};
      if (node.mode() != CO_INVALID) {
        node.rx("000#0101");
        node.rx("080#");
        node.frames();
        CHECK(node.u8[0] == written);
        node.rx(what == "stopped" ? "000#0201" : "000#8001");
      }
      check_left(node);
    }
  }
}

TEST_CASE("PDO callback: COPdoReceive may switch the PDO off or map it anew [Q9]") {
  for (const std::uint8_t type : std::initializer_list<std::uint8_t>{1, 255}) {
    SyncNode node(table_of(type));
    node.may_change(0x1400, 1);
    node.may_change(0x1600, 0);
    node.may_change(0x1600, 1);
    node.start();
    callbacks().pdo_receive = [&](CO_IF_FRM*) {
      CODictWrLong(&node->Dict, CO_DEV(0x1400, 1), 0x80000201);
      return std::int16_t{0};
    };
    node.rx("201#42");
    node.rx("080#");
    node.frames();
    CHECK(node.u8[0] == (type == 1 ? 0x11 : 0x42));
  }
}

TEST_CASE("PDO callback: COPdoUpdate is called for written RPDOs, COPdoSyncUpdate for synchronous ones only") {
  for (const std::uint8_t type : std::initializer_list<std::uint8_t>{1, 255}) {
    SyncNode node(table_of(type));
    node.start();
    std::vector<CO_RPDO*> any;
    std::vector<CO_RPDO*> synchronous;
    callbacks().pdo_update = [&](CO_RPDO* pdo) {
      any.push_back(pdo);
      CHECK(pdo->Node == &node.node);
      CHECK(node.u8[1] == 0x42);
    };
    callbacks().pdo_sync_update = [&](CO_RPDO* pdo) { synchronous.push_back(pdo); };
    node.rx("301#42");
    node.rx("080#");
    node.frames();
    CHECK(any == std::vector<CO_RPDO*>{&node->RPdo[1]});
    CHECK(synchronous == (type == 1 ? any : std::vector<CO_RPDO*>{}));
  }
}

TEST_CASE("PDO callback: COPdoUpdate may trigger TPDOs, write objects and request any state [Q9]") {
  for (const std::uint8_t type : std::initializer_list<std::uint8_t>{1, 255}) {
    for (const std::string& what : commands) {
      CAPTURE(what);
      SyncNode node(table_of(type));
      node.start();
      callbacks().pdo_update = [&](CO_RPDO*) {
        CODictWrByte(&node->Dict, CO_DEV(0x2201, 3), 0x66);
        COTPdoTrigPdo(node->TPdo, 0);
        command(node, what);
      };
      node.rx("201#40");
      CHECK(pdos(node.frames()) == (type == 255 ? 1 : 0));
      node.rx("080#");
      CHECK(pdos(node.frames()) == (type == 1 ? 2 : 0));  // TPDOs are sent before RPDOs are updated
      CHECK(node.u8[0] == 0x40);
      CHECK(node.u8[2] == 0x66);
      check_left(node);
    }
  }
}

TEST_CASE("PDO callback: COPdoSyncUpdate that switches RPDOs off and on loses and repeats none [Q9]") {
  SyncNode node(table_of(1));
  node.may_change(0x1400, 1);
  node.may_change(0x1401, 1);
  node.start();
  unsigned updates = 0;
  callbacks().pdo_sync_update = [&](CO_RPDO*) {
    ++updates;
    for (const std::uint16_t index : std::initializer_list<std::uint16_t>{0x1400, 0x1401}) {
      const std::uint32_t id = index == 0x1400 ? 0x201 : 0x301;
      CODictWrLong(&node->Dict, CO_DEV(index, 1), 0x80000000 | id);
      CODictWrLong(&node->Dict, CO_DEV(index, 1), id);
    }
  };
  for (int i = 1; i <= 3; ++i) {
    node.rx(CO_IF_FRM{0x201, {static_cast<std::uint8_t>(i)}, 1});
    node.rx(CO_IF_FRM{0x301, {static_cast<std::uint8_t>(i)}, 1});
    node.rx("080#");
    node.frames();
    CHECK(node.u8[0] == i);
    CHECK(node.u8[1] == i);
  }
  CHECK(updates >= 3);
  CHECK(updates <= 6);
}

TEST_CASE("PDO callback: COPdoUpdate may start an SDO client request or send a frame [Q9]") {
  SyncNode node(asynchronous());
  node.start();
  callbacks().pdo_update = [&](CO_RPDO*) {
    CO_IF_FRM own = frame("7E0#0102");
    CHECK(COIfCanSend(&node->If, &own) == sizeof(CO_IF_FRM));
  };
  node.rx("201#42");
  node.tx("7E0#0102");
}

// Type functions that change the PDO during which they are called.

// Returns the action of the type of 22FFh when it is read or written.
std::function<void(CO_NODE*)>& action() {
  static std::function<void(CO_NODE*)> what;
  return what;
}

void act(CO_NODE* node) {
  const OutsideStack outside;
  action()(node);
}

const CO_OBJ_TYPE* acting_type() {
  static const CO_OBJ_TYPE type = {[](CO_OBJ*, CO_NODE*, std::uint32_t) -> std::uint32_t { return 1; }, nullptr,
                                   [](CO_OBJ*, CO_NODE* node, void* buffer, std::uint32_t) {
                                     *static_cast<std::uint8_t*>(buffer) = 0x5A;
                                     act(node);
                                     return CO_ERR_NONE;
                                   },
                                   [](CO_OBJ*, CO_NODE* node, void*, std::uint32_t) {
                                     act(node);
                                     return CO_ERR_NONE;
                                   },
                                   nullptr};
  return &type;
}

void add_acting(Setup& setup) { setup.with({CO_KEY(0x22FF, 0, CO_OBJ____PRW), acting_type(), 0}); }

constexpr std::uint32_t acting = 0x22FF0008;

// Runs the remapping procedure as the application. [301:7.5.2.36]
void map_anew(CO_NODE* node, std::uint16_t index, const std::vector<std::uint32_t>& words, std::uint32_t cob_id) {
  const auto mapping = static_cast<std::uint16_t>(index + 0x200);
  CHECK(CODictWrLong(&node->Dict, CO_DEV(index, 1), 0x80000000 | cob_id) == CO_ERR_NONE);
  CHECK(CODictWrByte(&node->Dict, CO_DEV(mapping, 0), 0) == CO_ERR_NONE);
  for (std::size_t n = 0; n < words.size(); ++n) {
    CHECK(CODictWrLong(&node->Dict, CO_DEV(mapping, n + 1), words[n]) == CO_ERR_NONE);
  }
  CHECK(CODictWrByte(&node->Dict, CO_DEV(mapping, 0), static_cast<std::uint8_t>(words.size())) == CO_ERR_NONE);
  CHECK(CODictWrLong(&node->Dict, CO_DEV(index, 1), cob_id) == CO_ERR_NONE);
}

void may_be_mapped_anew(PdoNode& node, std::uint16_t index) {
  node.may_change(index, 1);
  for (std::uint8_t sub = 0; sub <= 8; ++sub) node.may_change(static_cast<std::uint16_t>(index + 0x200), sub);
}

TEST_CASE("PDO change: a Write function may switch the RPDO off, after the frame; it is not marked as received") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108, acting, 0x22010208, 0x22020110});
  PdoNode node(table, add_acting);
  may_be_mapped_anew(node, 0x1400);
  node.start();
  action() = [](CO_NODE* it) { CODictWrLong(&it->Dict, CO_DEV(0x1400, 1), 0x80000201); };
  node.rx("201#4100434445");
  CHECK(node.u8[0] == 0x41);
  CHECK(node.u8[1] == 0x43);
  CHECK(node.u16[0] == 0x4544);
  CHECK(!CORPdoWasReceived(&node.node, 0));
  CHECK(!CORPdoObjWasReceived(&node.node, CODictFind(&node->Dict, CO_DEV(0x2201, 1))));
}

TEST_CASE("PDO change: a Write function may map the RPDO anew; the frame is not written to the new mapping") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22040120, acting, 0x22010108, 0x22010208, 0x22010308});
  PdoNode node(table, add_acting);
  may_be_mapped_anew(node, 0x1400);
  node.start();
  action() = [](CO_NODE* it) { map_anew(it, 0x1400, {0x22010408, 0x22010508, 0x22060130}, 0x201); };
  node.rx("201#4142434400666768");
  CHECK(node.u32[0] == 0x44434241);
  CHECK(node.u48[0] == PdoVariables().u48[0]);
  CHECK(node.u8[0] == 0x66);
  CHECK(!CORPdoWasReceived(&node.node, 0));
  node.rx("201#0102030405060708");
  CHECK(node.u8[3] == 1);
  CHECK(node.u8[4] == 2);
  CHECK(node.u48[0] == 0x080706050403);
  CHECK(CORPdoWasReceived(&node.node, 0));
}

TEST_CASE("PDO change: a Read function may switch the TPDO off or map it anew, after its transmission") {
  for (const bool anew : {false, true}) {
    CAPTURE(anew);
    PdoTable table;
    table.tpdo[0].on(0x40000181, 255, {0x22040120, acting, 0x22010108, 0x22010208, 0x22010308});
    PdoNode node(table, add_acting);
    may_be_mapped_anew(node, 0x1800);
    node.start();
    action() = [&](CO_NODE* it) {
      anew ? map_anew(it, 0x1800, {0x22010408, 0x22010508, 0x22060130}, 0x40000181)
           : (void)CODictWrLong(&it->Dict, CO_DEV(0x1800, 1), 0xC0000181);
    };
    CHECK(node.request(0) == CO_ERR_NONE);
    node.tx("181#111213145A112131");
    CHECK(!COTPdoWasSent(&node.node, 0));
    CHECK(node.request(0) == (anew ? CO_ERR_NONE : CO_ERR_TPDO_COM_OBJ));
    CHECK(node.frames().size() == (anew ? 1 : 0));
  }
}

TEST_CASE("PDO change: a Read function that ends Operational, after the transmission, stops the timers [301:7.3.2]") {
  PdoTable table;
  table.tpdo[0].on(0x40000181, 255, {acting, 0x22010108}).event = 100;
  PdoNode node(table, add_acting);
  node.start();
  action() = [](CO_NODE* it) { CONmtSetMode(&it->Nmt, CO_PREOP); };
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx("181#5A11");
  node.after(1000ms);
  node.silent();
}

TEST_CASE("PDO change: COTPdoTrigObj() in a Write function sends the TPDO after all objects are written [X10]") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {acting, 0x22010108});
  table.tpdo[0].on(0x40000181, 255, {0x22010108});
  PdoNode node(table, add_acting);
  node.start();
  action() = [](CO_NODE* it) { COTPdoTrigObj(it->TPdo, CODictFind(&it->Dict, CO_DEV(0x2201, 1))); };
  node.rx("201#0042");
  node.tx("181#42");
}

#if USE_SYNC && USE_PDO_RTR

TEST_CASE("PDO change: type 252 changed to 254 with an event timer: sampled data do not affect the timer") {
  SyncTable table;
  table.tpdo[0].on(0x181, 252, {0x22040120, 0x22040220}).event = 100;
  SyncNode node(table);
  node.start();
  node.rx("080#");
  node.rx("181#R8");
  CHECK(node.frames().size() == 1);
  REQUIRE(node.set(0x1800, 2, 1, 254) == 0);
  node.silent();
  for (int n = 0; n < 3; ++n) {
    node.after(100ms);
    CHECK(node.frames().size() == 1);
  }
  REQUIRE(node.set(0x1800, 2, 1, 252) == 0);
  node.rx("181#R8");
  node.silent();  // no SYNC has sampled the objects
}

#endif

}  // namespace

#endif
