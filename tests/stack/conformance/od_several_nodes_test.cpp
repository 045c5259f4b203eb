// SPDX-License-Identifier: Apache-2.0
// Several nodes and dictionaries in one program (co_od.h): each has a separate index, extensions and transfers, even if
// they share one constant table.
#include "support/block_frames.hpp"
#include "support/logged_extension.hpp"

#if USE_OD

namespace {

using namespace test;

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

}  // namespace

#endif
