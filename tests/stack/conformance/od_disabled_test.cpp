// SPDX-License-Identifier: Apache-2.0
// Objects that are disabled until they are extended (co_od.h: OD_DISABLED, OD_TNUMBER, OD_TSTREAM), and dictionaries
// with extensible types in a node without an index of the OD access interface.
#include "support/block_frames.hpp"
#include "support/logged_extension.hpp"

#if USE_OD

namespace {

using namespace test;

const OD_TYPE disabled_value = OD_VALUE(CO_TUNSIGNED32, OD_DISABLED);
const OD_TYPE disabled_stream = OD_STREAM(CO_TDOMAIN, OD_DISABLED);

// A node with 3000h UNSIGNED32, 3001h DOMAIN of 20 bytes, and two objects whose data exist only in an extension: 3002h
// of 8 bytes and 3003h, a stream.
struct Node : Fixture {
  std::uint32_t word = 0x44332211;
  Bytes memory = counting(20);
  CO_OBJ_DOM domain{0, 20, memory.data()};

  Node()
      : Fixture(Setup()
                    .only_small()
                    .with({CO_KEY(0x3000, 0, CO_OBJ____PRW), &disabled_value.Ex.Type, CO_DATA(&word)})
                    .with({CO_KEY(0x3001, 0, CO_OBJ_____RW), &disabled_stream.Ex.Type, CO_DATA(&domain)})
                    .with({CO_KEY(0x3002, 0, CO_OBJ_____RW), OD_TNUMBER, CO_DATA(8)})
                    .with({CO_KEY(0x3003, 0, CO_OBJ_____RW), OD_TSTREAM, CO_DATA(0)})) {}
};

void check_disabled(Node& node) {
  node.ask("601#4000300000000000", "581#8000300001000106");
  node.ask("601#2300300001020304", "581#8000300002000106");
  node.ask("601#4001300000000000", "581#8001300001000106");
  node.ask("601#2301300001020304", "581#8001300002000106");
  node.ask("601#2101300009000000", "581#8001300002000106");
  node.ask("601#4002300000000000", "581#8002300001000106");
  node.ask("601#2102300008000000", "581#6002300000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#1D08000000000000", "581#8002300002000106");
  node.ask("601#4003300000000000", "581#8003300001000106");
  node.ask("601#2303300001020304", "581#8003300002000106");
  node.ask("601#2003300000000000", "581#8003300002000106");
  if (USE_SDO_BLOCK != 0) {
    node.ask("601#A40130007F000000", "581#8001300001000106");
    node.ask("601#A40330007F000000", "581#8003300001000106");
    CHECK(node.block_download(0x3001, 0, counting(9)).abort == 0x06010002);
    CHECK(node.block_download(0x3003, 0, counting(9)).abort == 0x06010002);
  }
  std::uint32_t value = 0;
  std::uint8_t bytes[8] = {};
  node.call([&] {
    CHECK(CODictRdLong(&node->Dict, CO_DEV(0x3000, 0), &value) == CO_ERR_OBJ_ACC);
    CHECK(CODictWrLong(&node->Dict, CO_DEV(0x3000, 0), value) == CO_ERR_OBJ_ACC);
    CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x3003, 0), bytes, 8) == CO_ERR_OBJ_ACC);
    CHECK(CODictWrBuffer(&node->Dict, CO_DEV(0x3003, 0), bytes, 8) == CO_ERR_OBJ_ACC);
  });
  CHECK(node.word == 0x44332211);
  CHECK(node.memory == counting(20));
}

TEST_CASE("OD disabled: the object cannot be read or written: 0601 0001h and 0601 0002h") {
  Node node;
  check_disabled(node);
}

TEST_CASE("OD disabled: an extension enables the object; removing it disables the object again") {
  Node node;
  LoggedExtension extension;
  for (unsigned times = 0; times < 2; ++times) {
    for (std::uint16_t index = 0x3000; index <= 0x3003; ++index) {
      extension.put_at(node, index);
    }
    extension.data = number_of({1, 2, 3, 4});
    node.ask("601#4000300000000000", "581#4300300001020304");
    CHECK(node.upload(0x3003, 0) == number_of({1, 2, 3, 4}));
    CHECK(node.download(0x3001, 0, counting(9)) == 0);
    CHECK(extension.data == counting(9));
    CHECK(node.download(0x3002, 0, counting(8)) == 0);
    CHECK(node.upload(0x3002, 0) == counting(8));
    for (std::uint16_t index = 0x3000; index <= 0x3003; ++index) {
      node.call([&] { CHECK(OD_extension_init(OD_find(&node.od, index), nullptr) == ODR_OK); });
    }
    check_disabled(node);
  }
}

TEST_CASE("OD disabled: the original functions access the memory of the object if there is any") {
  Node node;
  OD_extension_t extension{nullptr, OD_readOriginal, OD_writeOriginal, {}};
  for (std::uint16_t index = 0x3000; index <= 0x3003; ++index) {
    node.call([&] { CHECK(OD_extension_init(OD_find(&node.od, index), &extension) == ODR_OK); });
  }
  node.ask("601#4000300000000000", "581#4300300011223344");
  node.ask("601#2300300001020304", "581#6000300000000000");
  CHECK(node.word == 0x04030201);
  CHECK(node.upload(0x3001, 0) == counting(20));
  node.ask("601#4002300000000000", "581#8002300011000906");
  node.ask("601#2303300001020304", "581#8003300011000906");
  node.ask("601#4003300000000000", "581#4103300000000000");
  node.rx("601#8003300000000008");
}

TEST_CASE("OD disabled: a stream of length 0 refuses a download; an extension accepts an empty one [301:7.2.4.3.17]") {
  Node node;
  node.ask("601#2103300000000000", "581#8003300002000106");
  LoggedExtension extension;
  extension.put_at(node, 0x3003);
  extension.data = {1};
  node.ask("601#2103300000000000", "581#6003300000000000");
  node.ask("601#0F00000000000000", "581#2000000000000000");
  CHECK(extension.data.empty());
}

TEST_CASE("OD disabled: a node without an index uses the original types of extensible ones") {
  Node node;
  const_cast<CO_NODE_EXT*>(node->Ext)->Od = nullptr;
  check_disabled(node);
  std::uint32_t plain = 5;
  Bytes memory = counting(20);
  CO_OBJ_DOM domain{0, 20, memory.data()};
  Fixture other(Setup()
                    .only_small()
                    .with({CO_KEY(0x3000, 0, CO_OBJ_____RW), OD_TUNSIGNED32, CO_DATA(&plain)})
                    .with({CO_KEY(0x3001, 0, CO_OBJ_____RW), OD_TDOMAIN, CO_DATA(&domain)}));
  const_cast<CO_NODE_EXT*>(other->Ext)->Od = nullptr;
  other.ask("601#4000300000000000", "581#4300300005000000");
  CHECK(other.upload(0x3001, 0) == counting(20));
  CHECK(other.download(0x3001, 0, counting(20, 7)) == 0);
  CHECK(memory == counting(20, 7));
}

#if USE_DICT_CHECK

// A C compiler does not detect this error.
TEST_CASE("OD disabled: an OD_TYPE around an OD_TYPE prevents the start of the node and is reported") {
  static const CO_OBJ_TYPE* const number = OD_TUNSIGNED32;
  static const OD_TYPE twice = OD_VALUE(number, OD_ORIGINAL);
  static const OD_TYPE itself = OD_VALUE(&itself.Ex.Type, OD_DISABLED);
  std::uint32_t memory = 0;
  for (const OD_TYPE* const type : {&twice, &itself}) {
    const Fixture node(
        Setup().only_small().with({CO_KEY(0x3000, 5, CO_OBJ_____RW), &type->Ex.Type, CO_DATA(&memory)}).stay_in_init());
    std::uint32_t key = 0;
    CHECK(CODictGetFault(&node.node.Dict, &key) == CO_DICT_NO_TYPE);
    CHECK(key == CO_KEY(0x3000, 5, CO_OBJ_____RW));
    CHECK(node.mode() == CO_INVALID);
    CHECK(CONodeGetErr(const_cast<CO_NODE*>(&node.node)) == CO_ERR_DICT_INIT);
  }
}

#endif

}  // namespace

#endif
