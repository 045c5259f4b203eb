// SPDX-License-Identifier: Apache-2.0
// co_od.h: deferred work of a function is complete when the function returns. It must not be left to the next received
// frame, because a node may receive none.
#include "support/failing_nvm.hpp"
#include "support/od.hpp"
#include "support/pdo_fixture.hpp"

#if USE_OD && CO_TPDO_N > 0 && CO_SSDO_N >= 2

namespace {

using namespace test;

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

}  // namespace

#endif
