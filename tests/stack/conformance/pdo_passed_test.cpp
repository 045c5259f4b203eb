// SPDX-License-Identifier: Apache-2.0
// CORPdoWasReceived() and COTPdoWasSent() for PDOs, CORPdoObjWasReceived() and COTPdoObjWasSent() for objects.
#include "support/sync_fixture.hpp"

#if CO_TPDO_N > 0 && CO_RPDO_N > 0

namespace {

using namespace test;

PdoTable both() {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108, 0x22020110});
  table.tpdo[0].on(0x40000181, 255, {0x22010308, 0x22020310});
  return table;
}

bool received(PdoNode& node, std::uint16_t num) {
  bool was = false;
  node.call([&] { was = CORPdoWasReceived(&node.node, num); });
  return was;
}
bool sent(PdoNode& node, std::uint16_t num) {
  bool was = false;
  node.call([&] { was = COTPdoWasSent(&node.node, num); });
  return was;
}
bool received(PdoNode& node, std::uint16_t index, std::uint8_t sub) {
  bool was = false;
  node.call([&] { was = CORPdoObjWasReceived(&node.node, node.find(index, sub)); });
  return was;
}
bool sent(PdoNode& node, std::uint16_t index, std::uint8_t sub) {
  bool was = false;
  node.call([&] { was = COTPdoObjWasSent(&node.node, node.find(index, sub)); });
  return was;
}

TEST_CASE("PDO flags: an RPDO and each of its objects are marked as received once, independently") {
  PdoNode node(both());
  node.start();
  CHECK_FALSE(received(node, 0));
  CHECK_FALSE(received(node, 0x2201, 1));
  node.rx("201#010203");
  CHECK(received(node, 0x2202, 1));
  CHECK_FALSE(received(node, 0x2202, 1));
  CHECK(received(node, 0));
  CHECK_FALSE(received(node, 0));
  CHECK(received(node, 0x2201, 1));
  CHECK_FALSE(received(node, 0x2201, 1));
  CHECK_FALSE(sent(node, 0));
  CHECK_FALSE(sent(node, 0x2201, 1));
  node.rx("201#010203");
  node.rx("201#010203");
  CHECK(received(node, 0));
  CHECK_FALSE(received(node, 0));
}

TEST_CASE("PDO flags: a TPDO and each of its objects are marked as sent once, independently") {
  PdoNode node(both());
  node.start();
  CHECK_FALSE(sent(node, 0));
  CHECK_FALSE(sent(node, 0x2201, 3));
  node.trigger(0);
  node.tx("181#313132");
  CHECK(sent(node, 0x2202, 3));
  CHECK_FALSE(sent(node, 0x2202, 3));
  CHECK(sent(node, 0));
  CHECK_FALSE(sent(node, 0));
  CHECK(sent(node, 0x2201, 3));
  CHECK_FALSE(sent(node, 0x2201, 3));
  CHECK_FALSE(received(node, 0));
  CHECK_FALSE(received(node, 0x2201, 3));
}

TEST_CASE("PDO flags: missing PDOs and objects are not marked") {
  PdoNode node(both());
  node.start();
  CHECK_FALSE(CORPdoWasReceived(nullptr, 0));
  CHECK_FALSE(COTPdoWasSent(nullptr, 0));
  CHECK_FALSE(CORPdoObjWasReceived(nullptr, node.find(0x2201, 1)));
  CHECK_FALSE(COTPdoObjWasSent(nullptr, node.find(0x2201, 1)));
  CHECK_FALSE(CORPdoObjWasReceived(&node.node, nullptr));
  CHECK_FALSE(COTPdoObjWasSent(&node.node, nullptr));
  CHECK_FALSE(received(node, CO_RPDO_N));
  CHECK_FALSE(received(node, 0xFFFF));
  CHECK_FALSE(sent(node, CO_TPDO_N));
  CHECK_FALSE(sent(node, 0xFFFF));
  CHECK_FALSE(received(node, 0x2208, 8));
  CHECK_FALSE(sent(node, 0x1000, 0));
}

TEST_CASE("PDO flags: short frames, full queues, Pre-operational and consumed frames are not marked") {
  PdoNode node(both(), [](Setup& setup) { setup.tx_queue(1); });
  node.rx("201#010203");
  CHECK_FALSE(received(node, 0));
  node.start();
  node.rx("201#0102");
  node.frames();
  CHECK_FALSE(received(node, 0));
  CHECK_FALSE(received(node, 0x2201, 1));
  callbacks().pdo_receive = [](CO_IF_FRM*) { return std::int16_t{1}; };
  node.rx("201#010203");
  node.frames();
  CHECK_FALSE(received(node, 0));
  node.can.refuse_all();
  CO_IF_FRM other = frame("123#01");
  node.call([&] { COIfCanSend(&node->If, &other); });
  node.trigger(0);
  CHECK_FALSE(sent(node, 0));
  CHECK_FALSE(sent(node, 0x2201, 3));
  node.can.accept_all();
  node.loop();
  node.tx("123#01");
}

TEST_CASE("PDO flags: a TPDO that is queued for the controller is marked as sent") {
  PdoNode node(both());
  node.start();
  node.can.refuse_all();
  node.trigger(0);
  CHECK(sent(node, 0));
  node.can.accept_all();
  node.loop();
  node.tx("181#313132");
  CHECK_FALSE(sent(node, 0));
}

TEST_CASE("PDO flags: an event within the inhibit time is not marked as sent") {
  PdoTable table = both();
  table.tpdo[0].inhibit = 1000;
  PdoNode node(table);
  node.start();
  node.trigger(0);
  node.trigger(0);
  node.tx("181#313132");
  CHECK(sent(node, 0));
  CHECK_FALSE(sent(node, 0));
  node.after(100ms);
  node.tx("181#313132");
  CHECK(sent(node, 0));
}

TEST_CASE("PDO flags: an object in several PDOs or twice in one is marked") {
  if (fixture_rpdos < 2 || fixture_tpdos < 2) {
    return;
  }
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108, 0x22010108});
  table.rpdo[1].on(0x301, 255, {0x22010208, 0x22010108});
  table.tpdo[0].on(0x40000181, 255, {0x22010108, 0x22010108});
  table.tpdo[1].on(0x40000281, 255, {0x22010208, 0x22010108});
  PdoNode node(table);
  node.start();
  for (const char* text : {"201#0102", "301#0102"}) {
    node.rx(text);
    CHECK(received(node, 0x2201, 1));
    CHECK_FALSE(received(node, 0x2201, 1));
  }
  node.rx("201#0102");
  node.rx("301#0102");
  CHECK(received(node, 0x2201, 1));
  CHECK_FALSE(received(node, 0x2201, 1));
  node.trigger(0);
  node.trigger(1);
  node.frames();
  CHECK(sent(node, 0x2201, 1));
  CHECK_FALSE(sent(node, 0x2201, 1));
}

TEST_CASE("PDO flags: switching a PDO off and on or mapping it anew clears them") {
  PdoNode node(both());
  node.start();
  node.rx("201#010203");
  node.trigger(0);
  node.tx("181#313132");
  CHECK(node.remap_rpdo(0, {0x22010108}, 0x201) == 0);
  CHECK(node.remap_tpdo(0, {0x22010308}, 0x40000181) == 0);
  CHECK_FALSE(received(node, 0));
  CHECK_FALSE(received(node, 0x2201, 1));
  CHECK_FALSE(sent(node, 0));
  CHECK_FALSE(sent(node, 0x2201, 3));
}

TEST_CASE("PDO flags: a reset clears them") {
  PdoNode node(both());
  node.start();
  node.rx("201#010203");
  node.trigger(0);
  node.tx("181#313132");
  node.rx("000#8201");
  node.tx("701#00");
  CHECK_FALSE(received(node, 0));
  CHECK_FALSE(sent(node, 0));
  CHECK_FALSE(received(node, 0x2201, 1));
  CHECK_FALSE(sent(node, 0x2201, 3));
}

#if USE_SYNC
TEST_CASE("PDO flags: synchronous PDOs are marked at the SYNC") {
  SyncTable table;
  table.rpdo[0].on(0x201, 1, {0x22010108});
  table.tpdo[0].on(0x40000181, 1, {0x22010308});
  SyncNode node(table);
  node.start();
  node.rx("201#01");
  CHECK_FALSE(received(node, 0));
  CHECK_FALSE(received(node, 0x2201, 1));
  CHECK_FALSE(sent(node, 0));
  node.rx("080#");
  node.tx("181#31");
  CHECK(received(node, 0));
  CHECK(received(node, 0x2201, 1));
  CHECK(sent(node, 0));
  CHECK(sent(node, 0x2201, 3));
  node.rx("080#");
  node.tx("181#31");
  CHECK_FALSE(received(node, 0));
  CHECK(sent(node, 0));
}
#endif

TEST_CASE("PDO flags: every object of a PDO of eight is marked") {
  PdoTable table;
  const std::initializer_list<std::uint32_t> eight = {0x22010108, 0x22010208, 0x22010308, 0x22010408,
                                                      0x22010508, 0x22010608, 0x22010708, 0x22010808};
  table.rpdo[0].on(0x201, 255, eight);
  PdoNode node(table);
  node.start();
  for (std::uint8_t first = 1; first <= 8; ++first) {
    node.rx("201#0102030405060708");
    CHECK(received(node, 0x2201, first));
    CHECK_FALSE(received(node, 0x2201, first));
    for (std::uint8_t sub = 1; sub <= 8; ++sub) {
      CHECK(received(node, 0x2201, sub) == (sub != first));
    }
  }
}

}  // namespace

#endif
