// SPDX-License-Identifier: Apache-2.0
// co_od.h: deferred work of a function is complete when the function returns. It must not be left to the next
// received frame, because a node may receive none.
#include <algorithm>

#include "support/block_frames.hpp"
#include "support/failing_nvm.hpp"
#include "support/logged_extension.hpp"
#include "support/od.hpp"
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

#if USE_OD && CO_TPDO_N > 0 && CO_SSDO_N >= 2

constexpr std::uint32_t new_request = 0x241;

// Read function of an object that enables an SDO server. The new COB-IDs become effective as deferred work.
CO_ERR read_and_configure(CO_OBJ*, CO_NODE* node, void* buffer, std::uint32_t) {
  std::uint32_t cob_ids[] = {new_request, 0x1C1};
  for (std::uint8_t sub = 1; sub <= 2; ++sub) {
    CO_OBJ* const obj = CODictFind(&node->Dict, CO_DEV(0x1201, sub));
    obj->Type->Write(obj, node, &cob_ids[sub - 1], sizeof cob_ids[0]);
  }
  *static_cast<std::uint8_t*>(buffer) = 0x77;
  return CO_ERR_NONE;
}
constexpr CO_OBJ_TYPE configuring = {[](CO_OBJ*, CO_NODE*, std::uint32_t) { return std::uint32_t{1}; }, nullptr,
                                     read_and_configure, nullptr, nullptr};

PdoTable table_of_one() {
  PdoTable table;
  table.tpdo[0].on(0x40000181, 255, {0x22700008});
  return table;
}

class SettlingNode : public PdoNode {
 public:
  explicit SettlingNode(const std::function<void(Setup&)>& change = {})
      : PdoNode(table_of_one(), [&](Setup& setup) {
          setup.with({CO_KEY(0x2270, 0, CO_OBJ____PR_), &configuring, CO_DATA(&memory)});
          setup.may_change(0x1201, 1).may_change(0x1201, 2);
          if (change) {
            change(setup);
          }
        }) {
    start();
    CHECK(!is_settled());
  }
  OD_entry_t* entry() { return OD_find(&od, 0x2270); }
  bool is_settled() { return node.Sdo[1].RxId == new_request; }
  std::uint8_t memory = 0;
};

TEST_CASE("OD deferred work: OD_requestTPDO sends the PDO and carries out the requests of its objects") {
  SettlingNode node;
  node.call([&] { OD_requestTPDO(node.entry(), 0); });
  node.tx("181#77");
  CHECK(node.is_settled());
}

TEST_CASE("OD deferred work: OD_clearFlagsPDO sends the PDO and carries out the requests of its objects") {
  SettlingNode node;
  node.call([&] { OD_clearFlagsPDO(node.entry(), 0, 2); });
  node.tx("181#77");
  CHECK(node.is_settled());
}

TEST_CASE("OD deferred work: requests while the objects are locked are carried out after the unlock") {
  SettlingNode node;
  node.call([&] {
    CO_LOCK_OD(&node.node);
    CO_LOCK_OD(&node.node);
    OD_requestTPDO(node.entry(), 0);
    CO_UNLOCK_OD(&node.node);
    CHECK(node.can.sent.empty());
    CHECK(!node.is_settled());
    CO_UNLOCK_OD(&node.node);
  });
  node.tx("181#77");
  CHECK(node.is_settled());
}

#if USE_REAL_TIME
TEST_CASE("OD deferred work: run before the node lock is released") {
  SettlingNode node([](Setup& setup) { setup.turns(); });
  bool was_settled = false;
  callbacks().leave = [&] { was_settled = node.is_settled(); };
  node.call([&] {
    CO_LOCK_OD(&node.node);
    std::uint8_t value = 0;
    CHECK(configuring.Read(nullptr, &node.node, &value, 1) == CO_ERR_NONE);
    CHECK(!node.is_settled());
    CO_UNLOCK_OD(&node.node);
  });
  CHECK(was_settled);
}

TEST_CASE("OD deferred work: a TPDO that is requested with the node lock held is sent before its release") {
  SettlingNode node([](Setup& setup) { setup.turns(); });
  for (const bool cleared : {false, true}) {
    node.call([&] {
      CO_LOCK_CAN_SEND(&node.node);
      cleared ? OD_clearFlagsPDO(node.entry(), 0, 2) : OD_requestTPDO(node.entry(), 0);
      CHECK(node.can.sent.size() == 1);
      CO_UNLOCK_CAN_SEND(&node.node);
    });
    node.tx("181#77");
  }
}

#if USE_PARA
TEST_CASE("OD deferred work: a reset that another thread requests while a group is stored or restored follows it") {
  static Fixture* reset_by_other_thread;
  CO_IF_NVM_DRV_EX slow = FailingNvm::driver;
  slow.Write = [](void* ctx, std::uint32_t start, const std::uint8_t* buffer, std::uint32_t size) {
    if (Fixture* const node = std::exchange(reset_by_other_thread, nullptr); node != nullptr) {
      CONmtReset(&node->node.Nmt, CO_RESET_COM);
      CHECK(node->mode() == CO_PREOP);
      CHECK(node->can.sent.empty());
    }
    return FailingNvm::driver.Write(ctx, start, buffer, size);
  };
  FailingNvm memory{{512, 4, 64}};
  std::uint32_t value = 1;
  std::uint32_t initial = 2;
  const CO_PARA group = OD_GROUP("GROUP", value, initial, 0, CO_RESET_NODE, CO_PARA___E);
  Fixture node(Setup()
                   .only_small()
                   .nvm(slow, &memory)
                   .with({CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, CO_DATA(&group)})
                   .with({CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, CO_DATA(&group)}));
  for (const auto command : {OD_storeGroup, OD_restoreGroup}) {
    reset_by_other_thread = &node;
    node.call([&] { CHECK(command(&node.od, 1) == ODR_OK); });
    CHECK(reset_by_other_thread == nullptr);
    node.tx("701#00");
  }
}
#endif
#endif

#endif

// Effects of a write by co_od.h, which are complete when the function returns.

#if USE_OD && CO_SSDO_N >= 2

TEST_CASE("OD_set: COB-IDs of an SDO server that the application writes take effect at once [301:7.5.2.33]") {
  Fixture node;
  node.may_change(0x1201, 1);
  node.may_change(0x1201, 2);
  node.call([&] {
    CHECK(OD_set_u32(OD_find(&node.od, 0x1201), 1, 0x6A1, false) == ODR_OK);
    CHECK(OD_set_u32(OD_find(&node.od, 0x1201), 2, 0x6A2, false) == ODR_OK);
  });
  const auto& heard = node.can.filter;
  CHECK(std::find(heard.begin(), heard.end(), 0x6A1U) != heard.end());
  node.ask("6A1#4000100000000000", "6A2#4300100091010F00");
}

#endif

// Several nodes and dictionaries in one program (co_od.h): each has a separate index, extensions and transfers, even
// if they share one constant table.

#if USE_OD

Setup streams() {
  return Setup()
      .only_small()
      .with({CO_KEY(0x3000, 0, CO_OBJ_____RW), OD_TSTREAM, CO_DATA(0)})
      .with({CO_KEY(0x3001, 0, CO_OBJ_____RW), OD_TNUMBER, CO_DATA(4)});
}

TEST_CASE("OD several nodes: each has its own extensions, and simultaneous transfers are independent") {
  Fixture one(streams());
  Fixture other(streams().node_id(2));
  LoggedExtension of_one;
  LoggedExtension of_other;
  of_one.put_at(one, 0x3000);
  of_other.put_at(other, 0x3000);
  of_one.data = counting(20);
  of_other.data = counting(20, 100);
  one.ask("601#4000300000000000", "581#4000300000000000");
  other.ask("602#4000300000000000", "582#4000300000000000");
  one.ask("601#6000000000000000", "581#0001020304050607");
  other.ask("602#6000000000000000", "582#006465666768696A");
  one.ask("601#7000000000000000", "581#1008090A0B0C0D0E");
  other.ask("602#7000000000000000", "582#106B6C6D6E6F7071");
  one.ask("601#6000000000000000", "581#030F101112131400");
  other.ask("602#6000000000000000", "582#0372737475767700");
  one.ask("601#4001300000000000", "581#8001300001000106");
}

TEST_CASE("OD several nodes: one constant table is used with an index for each") {
  static std::uint16_t memory = 0;
  static const CO_OBJ table[] = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(0)},
                                 {CO_KEY(0x3000, 0, CO_OBJ_____RW), OD_TUNSIGNED16, CO_DATA(&memory)}};
  Fixture one;
  Fixture other(Setup().node_id(2));
  OD_t ods[2] = {};
  OD_entry_t lists[2][OD_LIST_N(2)] = {};
  Fixture* const nodes[] = {&one, &other};
  for (unsigned n = 0; n < 2; ++n) {
    auto* const root = const_cast<CO_OBJ*>(table);
    nodes[n]->call([&] {
      CHECK(OD_init(&ods[n], lists[n], 3, &nodes[n]->node, root, 2) == ODR_OK);
      const_cast<CO_NODE_EXT*>(nodes[n]->node.Ext)->Od = &ods[n];
      CHECK(CODictInit(&nodes[n]->node.Dict, &nodes[n]->node, root, 2) == 2);
    });
  }
  LoggedExtension of_one;
  of_one.data = number_of({0xA1, 0xA2});
  one.call([&] { CHECK(OD_extension_init(OD_find(&ods[0], 0x3000), &of_one.extension) == ODR_OK); });
  one.ask("601#4000300000000000", "581#4B003000A1A20000");
  other.ask("602#4000300000000000", "582#4B00300000000000");
  other.ask("602#2B00300001020000", "582#6000300000000000");
  CHECK(memory == 0x0201);
  one.ask("601#2B00300007080000", "581#6000300000000000");
  CHECK(of_one.data == number_of({7, 8}));
  CHECK(memory == 0x0201);
}

#endif

}  // namespace
