// SPDX-License-Identifier: Apache-2.0
// co_od.h: requests to transmit an object, and flags of transmitted objects, in both forms of the interface: for each
// sub-index, and as a word with a bit for each TPDO.
#include "support/mpdo_fixture.hpp"
#include "support/sync_fixture.hpp"

#if USE_OD && CO_TPDO_N > 0 && CO_RPDO_N > 0

namespace {

using namespace test;

// RPDO 1: 2201h:1 and :2; TPDO 1 and 2: 2201h:3, TPDO 2 also :4; all event-driven.
SyncTable both() {
  SyncTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108, 0x22010208});
  table.tpdo[0].on(0x40000181, 255, {0x22010308});
  table.tpdo[1].on(0x40000281, 254, {0x22010308, 0x22010408});
  return table;
}

class FlagNode : public SyncNode {
 public:
  explicit FlagNode(const SyncTable& table = both(), const std::function<void(Setup&)>& change = {})
      : SyncNode(table, change) {}

  OD_entry_t* entry(std::uint16_t index = 0x2201) { return OD_find(&od, index); }
  void request(std::uint8_t sub, std::uint16_t index = 0x2201) {
    call([&] { OD_requestTPDO(entry(index), sub); });
  }
  bool transmitted(std::uint8_t sub, std::uint16_t index = 0x2201) {
    bool was = false;
    call([&] { was = OD_TPDOtransmitted(entry(index), sub); });
    return was;
  }
  OD_flagsPDO_t flags(std::uint8_t sub, std::uint16_t index = 0x2201) {
    OD_flagsPDO_t all = 0;
    call([&] { all = OD_getFlagsPDO(entry(index), sub); });
    return all;
  }
  void clear(std::uint8_t sub, OD_flagsPDO_t which, std::uint16_t index = 0x2201) {
    call([&] { OD_clearFlagsPDO(entry(index), sub, which); });
  }
};

TEST_CASE("OD flags: bit 0 is set by every reception and stays set until the application clears it") {
  FlagNode node;
  node.start();
  CHECK(node.flags(1) == 0);
  node.rx("201#0102");
  CHECK(node.flags(1) == 1);
  CHECK(node.flags(2) == 1);
  CHECK(node.flags(1) == 1);
  node.clear(1, 1);
  CHECK(node.flags(1) == 0);
  CHECK(node.flags(2) == 1);
  node.rx("201#0102");
  node.rx("201#0102");
  CHECK(node.flags(1) == 1);
  CHECK(node.flags(3) == 0);
}

TEST_CASE("OD flags: TPDO n sets bit n when it is sent, beginning with 1") {
  FlagNode node;
  node.start();
  CHECK(node.flags(3) == 0);
  node.trigger(1);
  node.tx("281#3141");
  CHECK(node.flags(3) == 4);
  CHECK(node.flags(4) == 4);
  node.trigger(0);
  node.tx("181#31");
  CHECK(node.flags(3) == 6);
  CHECK(node.flags(4) == 4);
  CHECK(node.flags(1) == 0);
}

TEST_CASE("OD flags: clearing bit n requests TPDO n and no other") {
  FlagNode node;
  node.start();
  node.clear(3, 2);
  node.tx("181#31");
  CHECK(node.flags(3) == 2);
  node.clear(3, 4);
  node.tx("281#3141");
  CHECK(node.flags(3) == 6);
  node.clear(3, 6);
  node.tx({"181#31", "281#3141"});
  CHECK(node.flags(3) == 6);
  node.clear(4, 2);
  node.silent();
  node.clear(3, 1);
  node.silent();
  CHECK(node.flags(3) == 6);
  node.clear(3, ~OD_flagsPDO_t{0});
  node.tx({"181#31", "281#3141"});
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("OD flags: a cleared bit stays cleared until the TPDO is sent after its inhibit time [301:7.2.2.6]") {
  SyncTable table = both();
  table.tpdo[0].inhibit = 1000;
  FlagNode node(table);
  node.start();
  node.clear(3, 2);
  node.tx("181#31");
  node.clear(3, 2);
  node.silent();
  CHECK(node.flags(3) == 0);
  node.after(100ms);
  node.tx("181#31");
  CHECK(node.flags(3) == 2);
}

TEST_CASE("OD request: every TPDO of type 254 or 255 that maps the variable is sent and reported as transmitted") {
  FlagNode node;
  node.start();
  CHECK_FALSE(node.transmitted(3));
  node.request(3);
  node.tx({"181#31", "281#3141"});
  CHECK(node.transmitted(3));
  CHECK(node.transmitted(3));
  CHECK(node.transmitted(4));
  node.request(4);
  node.tx("281#3141");
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("OD request: it is reported as transmitted only if it was sent after the request") {
  SyncTable table = both();
  table.tpdo[0].inhibit = 1000;
  table.tpdo[1] = {};
  FlagNode node(table);
  node.start();
  node.request(3);
  node.tx("181#31");
  CHECK(node.transmitted(3));
  node.request(3);
  CHECK_FALSE(node.transmitted(3));
  node.after(100ms);
  node.tx("181#31");
  CHECK(node.transmitted(3));
}

#if USE_SYNC

TEST_CASE("OD request: a TPDO of type 0 is sent at the next SYNC, one of type 1 at each [301:7.5.2.37]") {
  SyncTable table = both();
  table.tpdo[0].type = 0;
  table.tpdo[1].type = 1;
  FlagNode node(table);
  node.start();
  node.rx("080#");
  node.tx({"181#31", "281#3141"});  // type 0 is sent at the first SYNC
  node.rx("080#");
  node.tx("281#3141");
  node.request(3);
  node.silent();
  CHECK_FALSE(node.transmitted(3));
  CHECK(node.flags(3) == 0);
  CHECK(node.error() == CO_ERR_TPDO_EVENT);
  node.rx("080#");
  node.tx({"181#31", "281#3141"});
  CHECK(node.transmitted(3));
  CHECK(node.flags(3) == 6);
  node.clear(3, 2);
  CHECK(node.error() == CO_ERR_NONE);
  node.rx("080#");
  node.tx({"181#31", "281#3141"});
}

TEST_CASE("OD flags: a synchronous RPDO is marked as received at the SYNC") {
  SyncTable table = both();
  table.rpdo[0].type = 1;
  FlagNode node(table);
  node.start();
  node.rx("201#0102");
  CHECK(node.flags(1) == 0);
  node.rx("080#");
  CHECK(node.flags(1) == 1);
}

#endif

TEST_CASE("OD request: the reason why a TPDO is not sent is the node error") {
  FlagNode node;
  node.request(3);
  CHECK(node.error() == CO_ERR_NMT_MODE);
  node.clear(3, 2);
  CHECK(node.error() == CO_ERR_NMT_MODE);
  node.start();
  node.request(1);
  CHECK(node.error() == CO_ERR_TPDO_OBJ_TRIGGER);
  node.request(5);
  CHECK(node.error() == CO_ERR_TPDO_OBJ_TRIGGER);
  node.silent();
}

TEST_CASE("OD request: it needs neither an extension nor a sub-index within the size of its flags") {
  SyncTable table = both();
  static std::uint8_t high = 0x5A;
  table.tpdo[0].on(0x40000181, 255, {0x2400C808});
  FlagNode node(table, [](Setup& setup) {
    setup.with({CO_KEY(0x2400, 200, CO_OBJ____PRW), CO_TUNSIGNED8, CO_DATA(&high)});
  });
  node.start();
  CHECK(node.entry(0x2400)->extension == nullptr);
  node.request(200, 0x2400);
  node.tx("181#5A");
  CHECK(node.transmitted(200, 0x2400));
  CHECK(node.flags(200, 0x2400) == 2);
}

#if OD_FLAGS_PDO_SIZE >= 1

TEST_CASE("OD request: the flag in an extension is 0 from the request until the TPDO has been sent") {
  SyncTable table = both();
  table.tpdo[1].on(0x40000281, 255, {0x2400C808});
  static std::uint8_t high = 0x5A;
  FlagNode node(table, [](Setup& setup) {
    setup.with({CO_KEY(0x2400, 200, CO_OBJ____PRW), CO_TUNSIGNED8, CO_DATA(&high)});
  });
  OD_extension_t extension{};
  extension.read = OD_readOriginal;
  extension.write = OD_writeOriginal;
  std::fill(std::begin(extension.flagsPDO), std::end(extension.flagsPDO), std::uint8_t{0xFF});
  CHECK(OD_extension_init(node.entry(), &extension) == ODR_OK);
  CHECK(OD_extension_init(node.entry(0x2400), &extension) == ODR_OK);
  node.start();
  node.request(3);
  node.tx("181#31");
  CHECK(extension.flagsPDO[0] == 0xF7);
  CHECK(node.transmitted(3));
  CHECK(extension.flagsPDO[0] == 0xFF);
  node.clear(3, 2);
  node.tx("181#31");
  CHECK(extension.flagsPDO[0] == 0xF7);
  CHECK(node.transmitted(3));
  node.request(200, 0x2400);
  node.tx("281#5A");
  CHECK(node.transmitted(200, 0x2400));
  const auto is_set = [](std::uint8_t flags) { return flags == 0xFF; };
  CHECK(std::all_of(std::begin(extension.flagsPDO), std::end(extension.flagsPDO), is_set));
}

#endif

TEST_CASE("OD flags: missing objects have no flags") {
  FlagNode node;
  node.start();
  OD_entry_t memory{};
  OD_obj_var_t variable{};
  memory.odObjectType = ODT_VAR;
  memory.odObject = &variable;
  for (OD_entry_t* const entry : {static_cast<OD_entry_t*>(nullptr), &memory}) {
    OD_requestTPDO(entry, 0);
    OD_clearFlagsPDO(entry, 0, 3);
    CHECK_FALSE(OD_TPDOtransmitted(entry, 0));
    CHECK(OD_getFlagsPDO(entry, 0) == 0);
  }
  node.request(99);
  node.clear(99, 3);
  CHECK_FALSE(node.transmitted(99));
  CHECK(node.flags(99) == 0);
  CHECK(node.flags(0, 0x1000) == 0);
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("OD flags: objects of a dictionary that the node does not use have no flags") {
  FlagNode node;
  node.start();
  static OD_entry_t list[4];
  OD_t other{};
  std::uint8_t value = 0;
  CO_OBJ table[] = {{CO_KEY(0x2201, 3, CO_OBJ____PRW), CO_TUNSIGNED8, CO_DATA(&value)}, CO_OBJ_DICT_ENDMARK};
  CHECK(OD_init(&other, list, 4, &node.node, table, 1) == ODR_OK);
  OD_requestTPDO(OD_find(&other, 0x2201), 3);
  node.silent();
  CHECK(OD_getFlagsPDO(OD_find(&other, 0x2201), 3) == 0);
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("OD flags: they are those of CORPdoObjWasReceived and COTPdoObjWasSent, which clear them") {
  FlagNode node;
  node.start();
  node.rx("201#0102");
  node.request(4);
  node.tx("281#3141");
  CHECK(node.flags(1) == 1);
  CHECK(node.flags(4) == 4);
  node.call([&] {
    CHECK(CORPdoObjWasReceived(&node.node, node.find(0x2201, 1)));
    CHECK(COTPdoObjWasSent(&node.node, node.find(0x2201, 4)));
  });
  CHECK(node.flags(1) == 0);
  CHECK(node.flags(4) == 0);
  CHECK_FALSE(node.transmitted(4));
}

TEST_CASE("OD request: a request while objects are locked is carried out after the unlock") {
  FlagNode node;
  node.start();
  node.call([&] {
    CO_LOCK_OD(&node.node);
    OD_requestTPDO(node.entry(), 4);
    CHECK_FALSE(OD_TPDOtransmitted(node.entry(), 4));
    CO_UNLOCK_OD(&node.node);
  });
  node.tx("281#3141");
  CHECK(node.transmitted(4));
}

TEST_CASE("OD lock: nested locks call OdLock and OdUnlock once; unlocking unlocked objects does nothing") {
  FlagNode node;
  node.start();
  unsigned locks = 0;
  unsigned unlocks = 0;
  callbacks().od_lock = [&] { ++locks; };
  callbacks().od_unlock = [&] { ++unlocks; };
  node.call([&] {
    CO_LOCK_OD(&node.node);
    CO_LOCK_EMCY(&node.node);
    CO_LOCK_CAN_SEND(&node.node);
    CO_UNLOCK_CAN_SEND(&node.node);
    CO_UNLOCK_EMCY(&node.node);
    CHECK(unlocks == 0);
    CO_UNLOCK_OD(&node.node);
    CO_UNLOCK_OD(&node.node);
  });
  CHECK(locks == 1);
  CHECK(unlocks == 1);
}

TEST_CASE("OD request: after CONodeStop() in a callback nothing is sent") {
  FlagNode node;
  node.start();
  callbacks().pdo_transmit = [&](CO_IF_FRM*) { CONodeStop(&node.node); };
  node.request(3);
  node.silent();
  CHECK(node.mode() == CO_INVALID);
}

#if CO_MPDO_N > 0

TEST_CASE("OD flags: objects of a scanner list have the flags of the TPDO that sends them [301:7.2.3]") {
  MpdoTable table;
  table.tpdo[1].on(0x40000281, 255, {}).number = sam;
  table.scan[0] = 0x03220101;
  MpdoNode node(table);
  node.start();
  OD_entry_t* const entry = OD_find(&node.od, 0x2201);
  node.call([&] { OD_requestTPDO(entry, 2); });
  node.tx("281#0101220221000000");
  CHECK(OD_TPDOtransmitted(entry, 2));
  CHECK_FALSE(OD_TPDOtransmitted(entry, 1));
  CHECK(OD_getFlagsPDO(entry, 2) == 4);
  CHECK(OD_getFlagsPDO(entry, 1) == 0);
  node.call([&] { OD_clearFlagsPDO(entry, 2, 4); });
  node.tx("281#0101220221000000");
  CHECK(OD_getFlagsPDO(entry, 2) == 4);
  node.call([&] { OD_clearFlagsPDO(entry, 4, 4); });
  node.silent();
}

#endif

}  // namespace

#endif
