// SPDX-License-Identifier: Apache-2.0
// COPdoTransmit(), which may call API functions. [Q9]
#include "support/pdo_commands.hpp"

#if CO_TPDO_N > 1 && CO_RPDO_N > 1

namespace {

using namespace test;

TEST_CASE("PDO callback: COPdoTransmit is called for each TPDO and may change it") {
  SyncNode node(asynchronous());
  node.start();
  std::vector<std::string> seen;
  callbacks().pdo_transmit = [&](CO_IF_FRM* frm) {
    seen.push_back(notation(*frm));
    CO_SET_BYTE(frm, 0xEE, 0);
    CO_SET_BYTE(frm, 0xFF, 1);
    CO_SET_DLC(frm, 2);
  };
  node.trigger(0);
  node.trigger(1);
  node.tx({"181#EEFF", "281#EEFF"});
  CHECK(seen == std::vector<std::string>{"181#31", "281#41"});
}

TEST_CASE("PDO callback: COPdoTransmit may trigger other TPDOs [Q9]") {
  SyncNode node(asynchronous());
  node.start();
  callbacks().pdo_transmit = [&](CO_IF_FRM* frm) {
    if (CO_GET_ID(frm) == 0x181) COTPdoTrigPdo(node->TPdo, 1);
  };
  node.trigger(0);
  std::vector<std::string> sent = node.frames();
  std::sort(sent.begin(), sent.end());
  CHECK(sent == std::vector<std::string>{"181#31", "281#41"});
}

TEST_CASE("PDO callback: COPdoTransmit may trigger the PDO that is being sent without an endless loop [Q9]") {
  SyncTable table = asynchronous();
  table.tpdo[0].inhibit = 100;
  SyncNode node(table);
  node.start();
  unsigned depth = 0;
  unsigned deepest = 0;
  unsigned calls = 0;
  callbacks().pdo_transmit = [&](CO_IF_FRM*) {
    deepest = std::max(deepest, ++depth);
    if (++calls < 100) COTPdoTrigPdo(node->TPdo, 0);
    --depth;
  };
  node.trigger(0);
  CHECK(deepest <= 2);
  node.after(100ms);
  CHECK(node.frames().size() <= 12);
}

TEST_CASE("PDO callback: COPdoTransmit may change an object of the PDO (flag A) without endless recursion [Q9]") {
  SyncTable table;
  table.tpdo[0].on(0x40000181, 255, {0x22010108, 0x22110108}).inhibit = 100;
  SyncNode node(table);
  node.start();
  unsigned calls = 0;
  callbacks().pdo_transmit = [&](CO_IF_FRM*) {
    if (++calls < 100) CODictWrByte(&node->Dict, CO_DEV(0x2211, 1), static_cast<std::uint8_t>(calls));
  };
  node.trigger(0);
  CHECK(calls <= 2);
  node.frames();
  node.after(100ms);
  CHECK(node.frames().size() <= 12);
}

TEST_CASE("PDO callback: a TPDO that COPdoTransmit marks may change the NMT state [Q9]") {
  enum class By : std::uint8_t { set_mode, error_behaviour, stop };
  for (const By by : {By::set_mode, By::error_behaviour, By::stop}) {
    SyncTable table;
    table.tpdo[0].on(0x40000181, 255, {0x22110108});
    table.tpdo[1].on(0x40000281, 255, {0x22110208});
    SyncNode node(table);
    node.start();
    callbacks().pdo_transmit = [&](CO_IF_FRM* frm) {
      CO_NODE* const own = &node.node;
      if (CO_GET_ID(frm) == 0x181) {
        CODictWrByte(&own->Dict, CO_DEV(0x2211, 2), 0x55);
      } else if (by == By::set_mode) {
        CONmtSetMode(&own->Nmt, CO_PREOP);
      } else if (by == By::error_behaviour) {
        COErrorBehaviour(own, 1);
      } else {
        CONodeStop(own);
      }
    };
    node.call([&] { CODictWrByte(&node.node.Dict, CO_DEV(0x2211, 1), 0x44); });
    CHECK(node.mode() == (by == By::stop ? CO_INVALID : CO_PREOP));
    by == By::stop ? node.tx("181#44") : node.tx({"181#44", "281#55"});
    callbacks().pdo_transmit = nullptr;
    node.rx("000#0101");
    node.after(1s);  // what was marked before is not sent any more
    node.silent();
  }
}

TEST_CASE("PDO callback: if COPdoTransmit leaves Operational this PDO is the last one [Q9] [N3]") {
  for (const std::string& what : commands) {
    CAPTURE(what);
    SyncTable table = asynchronous();
    table.tpdo[0].event = 100;
    table.tpdo[0].inhibit = 50;
    SyncNode node(table);
    node.start();
    callbacks().pdo_transmit = [&](CO_IF_FRM*) { command(node, what); };
    node.trigger(0);
    CHECK(pdos(node.frames()) == (what == "stop of the node" ? 0 : 1));
    check_left(node);
  }
}

TEST_CASE("PDO callback: if COPdoTransmit leaves Operational at an event timer this PDO is the last one [Q9] [N3]") {
  for (const std::string& what : commands) {
    CAPTURE(what);
    SyncTable table = asynchronous();
    table.tpdo[0].event = 100;
    SyncNode node(table);
    node.start();
    callbacks().pdo_transmit = [&](CO_IF_FRM*) { command(node, what); };
    node.after(100ms);
    CHECK(pdos(node.frames()) == (what == "stop of the node" ? 0 : 1));
    check_left(node);
  }
}

TEST_CASE("PDO callback: if COPdoTransmit leaves Operational at a SYNC its PDOs are the last ones [Q9] [N3]") {
  for (const std::string& what : commands) {
    if (what.compare(0, 5, "reset") == 0) {
      continue;  // a reset is deferred until the SYNC is processed
    }
    CAPTURE(what);
    SyncNode node(table_of(1));
    node.start();
    unsigned calls = 0;
    callbacks().pdo_transmit = [&](CO_IF_FRM*) {
      ++calls;
      command(node, what);
    };
    node.rx("080#");
    CHECK(pdos(node.frames()) == (what == "stop of the node" ? 0 : 2));
    CHECK(calls == 2);
    check_left(node);
  }
}

TEST_CASE("PDO callback: a reset requested by COPdoTransmit at a SYNC is carried out after all PDOs [Q9]") {
  SyncNode node(table_of(1));
  node.start();
  node.rx("201#55");
  callbacks().pdo_transmit = [&](CO_IF_FRM*) { command(node, "reset communication"); };
  node.rx("080#");
  node.tx({"181#31", "281#41", "701#00"});
  CHECK(node.u8[0] == 0x55);
  check_left(node);
}

TEST_CASE(
    "PDO callback: a reset requested by COPdoTransmit at a produced SYNC is carried out after all PDOs [Q9] [Y9]") {
  SyncTable table = table_of(1);
  table.sync_id = 0x40000080;
  table.cycle = 10000;
  SyncNode node(table);
  node.start();
  node.rx("201#55");
  callbacks().pdo_transmit = [&](CO_IF_FRM*) { command(node, "reset communication"); };
  node.after(10ms);
  node.tx({"080#", "181#31", "281#41", "701#00"});
  CHECK(node.u8[0] == 0x55);
}

TEST_CASE("PDO callback: COPdoTransmit may switch the PDO off [Q9]") {
  SyncTable table = asynchronous();
  table.tpdo[0].event = 100;
  SyncNode node(table);
  node.start();
  callbacks().pdo_transmit = [&](CO_IF_FRM*) { CODictWrLong(&node->Dict, CO_DEV(0x1800, 1), 0xC0000181); };
  node.may_change(0x1800, 1);
  node.trigger(0);
  CHECK(pdos(node.frames()) == 1);
  CHECK(node.armed_timers() == 0);
  check_left(node);
}

TEST_CASE("PDO callback: COPdoTransmit may change the CAN-ID of the PDO, from the next frame on [Q9]") {
  SyncNode node(asynchronous());
  node.may_change(0x1800, 1);
  node.start();
  callbacks().pdo_transmit = [&](CO_IF_FRM*) {
    CODictWrLong(&node->Dict, CO_DEV(0x1800, 1), 0xC0000191);
    CODictWrLong(&node->Dict, CO_DEV(0x1800, 1), 0x40000191);
  };
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx("181#31");
  callbacks().pdo_transmit = nullptr;
  node.trigger(0);
  node.tx("191#31");
}

TEST_CASE("PDO callback: COPdoTransmit may switch the PDO off and on at its event timer: one timer runs [Q9] [D38]") {
  for (const std::uint16_t inhibit : std::initializer_list<std::uint16_t>{0, 20, 200}) {
    SyncTable table = asynchronous();
    table.tpdo[0].event = 10;
    table.tpdo[0].inhibit = inhibit;
    SyncNode node(table);
    node.may_change(0x1800, 1);
    node.start();
    unsigned calls = 0;
    callbacks().pdo_transmit = [&](CO_IF_FRM*) {
      ++calls;
      CODictWrLong(&node->Dict, CO_DEV(0x1800, 1), 0xC0000181);
      CODictWrLong(&node->Dict, CO_DEV(0x1800, 1), 0x40000181);
    };
    node.after(100ms);
    CHECK(calls >= 5);
    CHECK(calls <= 10);
    CHECK(node.armed_timers() == 1);
    callbacks().pdo_transmit = [&](CO_IF_FRM*) {
      CONmtSetMode(&node->Nmt, CO_PREOP);
      CONmtSetMode(&node->Nmt, CO_OPERATIONAL);
    };
    node.after(100ms);
    CHECK(node.armed_timers() == 1);
    node.frames();
  }
}

TEST_CASE("PDO callback: COPdoTransmit may switch PDOs off and on at a SYNC: the others are sent once [Q9]") {
  SyncNode node(table_of(1));
  node.may_change(0x1800, 1);
  node.may_change(0x1801, 1);
  node.start();
  unsigned calls = 0;
  callbacks().pdo_transmit = [&](CO_IF_FRM*) {
    REQUIRE(++calls < 100);
    CODictWrLong(&node->Dict, CO_DEV(0x1800, 1), 0xC0000181);
    CODictWrLong(&node->Dict, CO_DEV(0x1801, 1), 0xC0000281);
    CODictWrLong(&node->Dict, CO_DEV(0x1801, 1), 0x40000281);
    CODictWrLong(&node->Dict, CO_DEV(0x1800, 1), 0x40000181);
  };
  node.rx("080#");
  node.frames();
  callbacks().pdo_transmit = nullptr;
  node.rx("080#");
  node.tx({"181#31", "281#41"});
}

}  // namespace

#endif
