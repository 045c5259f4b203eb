// SPDX-License-Identifier: Apache-2.0
// COPdoReceive(), COPdoUpdate() and COPdoSyncUpdate(), which may call API functions. [Q9]
#include "support/pdo_commands.hpp"

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

}  // namespace

#endif
