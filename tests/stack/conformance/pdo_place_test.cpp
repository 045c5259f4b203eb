// SPDX-License-Identifier: Apache-2.0
// PDO entries at indexes of PDOs that are not configured, or with a sub-index that the PDO does not have.
// [301:7.5.2.35-38]
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

#if USE_DICT_CHECK

#if CO_RPDO_N < 512 && CO_TPDO_N < 512

TEST_CASE("PDO place: an entry of a PDO beyond the configuration prevents the start of the node [D6]") {
  struct Beyond {
    std::uint16_t index;
    std::uint8_t sub;
    const CO_OBJ_TYPE* type;
  };
  std::uint32_t memory = 0x80000000;
  const Beyond entries[] = {{0x1400 + CO_RPDO_N, 1, CO_TPDO_ID},
                            {0x1400 + CO_RPDO_N, 5, CO_TPDO_EVENT},
                            {0x15FF, 2, CO_TPDO_TYPE},
                            {0x1600 + CO_RPDO_N, 0, CO_TPDO_NUM},
                            {0x17FF, 1, CO_TPDO_MAP},
                            {0x1800 + CO_TPDO_N, 1, CO_TPDO_ID},
                            {0x1800 + CO_TPDO_N, 5, CO_TPDO_EVENT},
                            {0x19FF, 3, CO_TPDO_INHIBIT},
                            {0x1A00 + CO_TPDO_N, 0, CO_TPDO_NUM},
                            {0x1BFF, 8, CO_TPDO_MAP},
                            {0x1400 + CO_RPDO_N, 1, CO_TUNSIGNED32}};
  for (const Beyond& one : entries) {
    CAPTURE(one.index);
    Fixture node(
        Setup().only_small().stay_in_init().with({CO_KEY(one.index, one.sub, CO_OBJ_____RW), one.type, &memory}));
    CHECK(node.mode() == CO_INVALID);
    CHECK(node.error() == CO_ERR_DICT_INIT);
    std::uint32_t key = 0;
    CHECK(CODictGetFault(&node->Dict, &key) == CO_DICT_NOT_CONFIGURED);
    CHECK(CO_GET_DEV(key) == CO_DEV(one.index, one.sub));
  }
}

#endif

TEST_CASE("PDO place: a type of a PDO entry at a wrong index prevents the start of the node [D6]") {
  struct Wrong {
    std::uint16_t index;
    std::uint8_t sub;
    const CO_OBJ_TYPE* type;
  };
  std::uint64_t memory = 0;
  const Wrong entries[] = {{0x1400, 7, CO_TPDO_ID},    {0x2400, 1, CO_TPDO_ID},    {0x1800, 7, CO_TPDO_TYPE},
                           {0x2400, 2, CO_TPDO_TYPE},  {0x2400, 5, CO_TPDO_EVENT}, {0x1800, 8, CO_TPDO_EVENT},
                           {0x1400, 6, CO_TPDO_START}, {0x2400, 6, CO_TPDO_START}, {0x2400, 3, CO_TPDO_INHIBIT},
                           {0x2400, 0, CO_TPDO_NUM},   {0x1600, 65, CO_TPDO_MAP},  {0x2400, 1, CO_TPDO_MAP}};
  for (const Wrong& one : entries) {
    CAPTURE(one.index);
    CAPTURE(unsigned{one.sub});
    PdoNode node({}, [&](Setup& setup) { setup.with({CO_KEY(one.index, one.sub, CO_OBJ_____RW), one.type, &memory}); });
    CHECK(node.mode() == CO_INVALID);
    CHECK(node.error() == CO_ERR_DICT_INIT);
    std::uint32_t key = 0;
    CHECK(CODictGetFault(&node->Dict, &key) == CO_DICT_WRONG_PLACE);
    CHECK(CO_GET_DEV(key) == CO_DEV(one.index, one.sub));
  }
}

#else

TEST_CASE("PDO place: without USE_DICT_CHECK entries of PDOs beyond the configuration access no PDO") {
  struct Beyond {
    std::uint16_t index;
    std::uint8_t sub;
    const CO_OBJ_TYPE* type;
    std::uint32_t value;
  };
  const Beyond entries[] = {{0x1400 + CO_RPDO_N, 1, CO_TPDO_ID, 0x80000181},
                            {0x15FF, 1, CO_TPDO_ID, 0x80000181},
                            {0x1800 + CO_TPDO_N, 1, CO_TPDO_ID, 0xC0000181},
                            {0x19FF, 1, CO_TPDO_ID, 0xC0000181},
                            {0x1400 + CO_RPDO_N, 2, CO_TPDO_TYPE, 254},
                            {0x19FF, 2, CO_TPDO_TYPE, 254},
                            {0x1400 + CO_RPDO_N, 5, CO_TPDO_EVENT, 10},
                            {0x15FF, 5, CO_TPDO_EVENT, 10},
                            {0x1800 + CO_TPDO_N, 5, CO_TPDO_EVENT, 10},
                            {0x19FF, 5, CO_TPDO_EVENT, 10},
                            {0x2405, 1, CO_TPDO_ID, 0xC0000181},
                            {0x25FF, 5, CO_TPDO_EVENT, 10}};
  for (const Beyond& one : entries) {
    CAPTURE(one.index);
    CAPTURE(unsigned{one.sub});
    std::uint32_t memory = one.sub == 1 ? 0x80000000 : 0;
    PdoNode node({}, [&](Setup& setup) { setup.with({CO_KEY(one.index, one.sub, CO_OBJ_____RW), one.type, &memory}); });
    node.start();
    std::uint32_t value = one.value;
    CO_OBJ* const obj = CODictFind(&node->Dict, CO_DEV(one.index, one.sub));
    REQUIRE(obj != nullptr);
    const auto width = static_cast<std::uint8_t>(COObjGetSize(obj, &node.node, 0));
    CHECK(COObjWrValue(obj, &node.node, &value, width) == CO_ERR_NONE);
    CHECK(memory == one.value);
    for (const CO_PDO* pdo : {node->RPdo, node->TPdo}) {
      CHECK_FALSE(pdo->Node == nullptr);
      CHECK(pdo->Map.Length == 0);
      CHECK(pdo->Tmr.Running == 0);
    }
    node.rx("000#8201");
    node.tx("701#00");
  }
}

#endif

}  // namespace
