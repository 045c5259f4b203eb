// SPDX-License-Identifier: Apache-2.0
// CO_NODE_EXT.OdLock and OdUnlock: protection of mapped objects from the application. [X10] (The fixture checks that
// the calls are not nested, and that no frame is sent in between.)
#include "support/sync_fixture.hpp"

#if CO_TPDO_N > 0 && CO_RPDO_N > 0

namespace {

using namespace test;

// Log of events at a node: "lock", "unlock", callbacks and accesses of a user type.
class Diary {
 public:
  explicit Diary(PdoNode& node) {
    log().clear();
    callbacks().od_lock = [] { log().push_back("lock"); };
    callbacks().od_unlock = [] { log().push_back("unlock"); };
    callbacks().pdo_transmit = [](CO_IF_FRM*) { log().push_back("transmit"); };
    callbacks().pdo_receive = [](CO_IF_FRM*) { return log().push_back("receive"), std::int16_t{0}; };
    callbacks().pdo_update = [](CO_RPDO*) { log().push_back("update"); };
    callbacks().pdo_sync_update = [](CO_RPDO*) { log().push_back("sync update"); };
    callbacks().can_receive = [](CO_IF_FRM*) { log().push_back("can"); };
    node.silent();
  }
  ~Diary() { callbacks() = Callbacks{}; }
  Diary(const Diary&) = delete;
  Diary& operator=(const Diary&) = delete;

  static std::vector<std::string> take() { return std::exchange(log(), {}); }
  static std::vector<std::string>& log() {
    static std::vector<std::string> all;
    return all;
  }
};

using Entries = std::vector<std::string>;

const CO_OBJ_TYPE* noted_type() {
  static const CO_OBJ_TYPE type = {[](CO_OBJ*, CO_NODE*, std::uint32_t) -> std::uint32_t { return 1; }, nullptr,
                                   [](CO_OBJ*, CO_NODE*, void* buffer, std::uint32_t) {
                                     const OutsideStack outside;
                                     *static_cast<std::uint8_t*>(buffer) = 0x5A;
                                     Diary::log().push_back("read");
                                     return CO_ERR_NONE;
                                   },
                                   [](CO_OBJ*, CO_NODE*, void*, std::uint32_t) {
                                     const OutsideStack outside;
                                     Diary::log().push_back("write");
                                     return CO_ERR_NONE;
                                   },
                                   nullptr};
  return &type;
}

void add_noted(Setup& setup) { setup.with({CO_KEY(0x22FF, 0, CO_OBJ____PRW), noted_type(), 0}); }

constexpr std::uint32_t noted = 0x22FF0008;

TEST_CASE(
    "PDO lock: the objects of an RPDO are copied with one lock; callbacks are called without it, types with it [X10]") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108, noted, 0x22020110, noted});
  PdoNode node(table, add_noted);
  node.start();
  Diary diary(node);
  node.rx("201#1122334455");
  CHECK(Diary::take() == Entries{"receive", "lock", "write", "write", "unlock", "update"});
}

TEST_CASE("PDO lock: the objects of a TPDO are copied with one lock; it is sent without the lock [X10]") {
  PdoTable table;
  table.tpdo[0].on(0x40000181, 255, {0x22010108, noted, 0x22020110, noted});
  PdoNode node(table, add_noted);
  node.start();
  Diary diary(node);
  node.trigger(0);
  CHECK(Diary::take() == Entries{"lock", "read", "read", "unlock", "transmit"});
  node.tx("181#115A11125A");
}

TEST_CASE("PDO lock: frames that write nothing and events that send nothing do not lock") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108});
  table.tpdo[0].on(0x40000181, 255, {0x22010108}).inhibit = 1000;
  PdoNode node(table);
  node.start();
  node.trigger(0);
  node.tx("181#11");
  Diary diary(node);
  node.rx("201#");
  CHECK(Diary::take().empty());
  node.frames();
  node.trigger(0);
  CHECK(Diary::take().empty());
  node.rx("000#8001");
  node.frames();
  node.rx("201#42");
  CHECK(Diary::take() == Entries{"can"});
}

TEST_CASE("PDO lock: a frame that COPdoReceive consumes does not lock") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108});
  PdoNode node(table);
  node.start();
  Diary diary(node);
  callbacks().pdo_receive = [](CO_IF_FRM*) { return std::int16_t{1}; };
  node.rx("201#42");
  CHECK(Diary::take().empty());
}

#if USE_SYNC

TEST_CASE("PDO lock: all RPDOs of a SYNC have one lock, each TPDO has its own, callbacks have none [X3] [X10]") {
  if (fixture_rpdos < 3 || fixture_tpdos < 2) {
    return;
  }
  SyncTable table;
  for (unsigned n = 0; n < 3; ++n) {
    table.rpdo[n].on(0x201 + n * 0x100, 1, {noted});
  }
  table.tpdo[0].on(0x40000181, 1, {noted});
  table.tpdo[1].on(0x40000281, 1, {0x22010108});
  SyncNode node(table, add_noted);
  node.start();
  for (const char* text : {"201#01", "301#02", "401#03"}) node.rx(text);
  Diary diary(node);
  node.rx("080#");
  CHECK(Diary::take() == Entries{"lock", "read", "unlock", "transmit", "lock", "unlock", "transmit", "lock", "write",
                                 "write", "write", "unlock", "sync update", "update", "sync update", "update",
                                 "sync update", "update"});
  node.tx({"181#5A", "281#11"});
  node.rx("080#");
  CHECK(Diary::take() == Entries{"lock", "read", "unlock", "transmit", "lock", "unlock", "transmit"});
  node.frames();
}

TEST_CASE("PDO lock: storing an RPDO until the SYNC does not lock") {
  SyncTable table;
  table.rpdo[0].on(0x201, 1, {noted});
  SyncNode node(table, add_noted);
  node.start();
  Diary diary(node);
  node.rx("201#01");
  CHECK(Diary::take() == Entries{"receive"});
}

#endif

TEST_CASE("PDO lock: a TPDO that an RPDO causes (flag A) locks after the objects of the RPDO are unlocked [X10]") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22110108, 0x22110208});
  table.tpdo[0].on(0x40000181, 255, {0x22110108, 0x22110208});
  PdoNode node(table);
  node.start();
  Diary diary(node);
  node.rx("201#4243");
  CHECK(Diary::take() == Entries{"receive", "lock", "unlock", "update", "lock", "unlock", "transmit"});
  node.tx("181#4243");
}

TEST_CASE("PDO lock: a driver without lock hooks works") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108});
  table.tpdo[0].on(0x40000181, 255, {0x22010108});
  PdoNode node(table);
  CO_NODE_EXT without = *node->Ext;
  without.OdLock = nullptr;
  without.OdUnlock = nullptr;
  const CO_NODE_EXT* const with = std::exchange(node->Ext, &without);
  node.start();
  Diary diary(node);
  node.rx("201#42");
  node.trigger(0);
  node.tx("181#42");
  CHECK(Diary::take() == Entries{"receive", "update", "transmit"});
  node->Ext = with;
}

TEST_CASE("PDO lock: the application may access the dictionary in every callback of PDOs") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108});
  table.tpdo[0].on(0x40000181, 255, {0x22010208});
  PdoNode node(table);
  node.start();
  const auto count = [&] {
    std::uint8_t value = 0;
    CHECK(CODictRdByte(&node->Dict, CO_DEV(0x2201, 3), &value) == CO_ERR_NONE);
    CHECK(CODictWrByte(&node->Dict, CO_DEV(0x2201, 3), static_cast<std::uint8_t>(value + 1)) == CO_ERR_NONE);
  };
  callbacks().pdo_transmit = [&](CO_IF_FRM*) { count(); };
  callbacks().pdo_receive = [&](CO_IF_FRM*) { return count(), std::int16_t{0}; };
  callbacks().pdo_update = [&](CO_RPDO*) { count(); };
  node.rx("201#42");
  node.trigger(0);
  node.tx("181#21");
  CHECK(node.u8[2] == 0x31 + 3);
}

}  // namespace

#endif
