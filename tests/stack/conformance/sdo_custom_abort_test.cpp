// SPDX-License-Identifier: Apache-2.0
// Abort codes that an object type sets (COObjTypeUserSDOAbort()).
#include "support/block_frames.hpp"
#include "support/logged_stream.hpp"

namespace {

using namespace test;

constexpr unsigned always = 1000;

struct Script {
  std::uint32_t size = 4;
  std::uint32_t abort = 0;
  unsigned good_calls = 0;  // calls of Size that succeed before one fails
  unsigned calls = 0;
} script;

CO_ERR refuse(CO_OBJ* obj, CO_NODE* node, CO_ERR error) {
  COObjTypeUserSDOAbort(obj, node, script.abort);
  return error;
}

uint32_t scripted_size(CO_OBJ* obj, CO_NODE* node, uint32_t) {
  if (script.calls++ < script.good_calls) {
    return script.size;
  }
  refuse(obj, node, CO_ERR_NONE);
  return 0;
}

CO_ERR refused_read(CO_OBJ* obj, CO_NODE* node, void*, uint32_t) { return refuse(obj, node, CO_ERR_TYPE_RD); }
CO_ERR refused_write(CO_OBJ* obj, CO_NODE* node, void*, uint32_t) { return refuse(obj, node, CO_ERR_TYPE_WR); }

const CO_OBJ_TYPE type = {scripted_size, nullptr, refused_read, refused_write, nullptr};

Setup scripted(std::uint32_t size, std::uint32_t abort, unsigned good_calls) {
  script = Script{size, abort, good_calls, 0};
  return Setup().with({CO_KEY(0x3000, 0, CO_OBJ_____RW), &type, 0});
}

void check_idle(Fixture& node) { node.ask("601#0011223300000000", "581#8011223301000405"); }

TEST_CASE("SDO custom abort: FFFF FFFFh is sent like any other code") {
  for (const char* request : {"601#4000300000000000", "601#2300300001000000"}) {
    CAPTURE(std::string(request));
    Fixture node(scripted(4, 0xFFFFFFFF, always));
    node.ask(request, "581#80003000FFFFFFFF");
    check_idle(node);
  }
  Fixture node(scripted(8, 0xFFFFFFFF, always));
  node.ask("601#4000300000000000", "581#80003000FFFFFFFF");
  check_idle(node);
  node.ask("601#2100300008000000", "581#6000300000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#1D08000000000000", "581#80003000FFFFFFFF");
  check_idle(node);
}

TEST_CASE("SDO custom abort: set in the Size function at every kind of initiate") {
  for (const char* request : {"601#4000300000000000", "601#2300300001000000", "601#2200300001000000",
                              "601#2100300004000000", "601#2000300000000000"}) {
    CAPTURE(std::string(request));
    Fixture node(scripted(4, 0x06060000, 0));
    node.ask(request, "581#8000300000000606");
    check_idle(node);
  }
}

TEST_CASE("SDO custom abort: set in the Size function at the last segment of a download of unknown length") {
  Fixture node(scripted(8, 0x06060000, 1));
  node.ask("601#2000300000000000", "581#6000300000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#1D08000000000000", "581#8000300000000606");
  check_idle(node);
}

#if USE_OBJ_EX && CO_SSDO_N > 1
TEST_CASE("SDO custom abort: every code but 0 is sent, in every kind of transfer") {
  for (const std::uint32_t code : {1U, 2U, 0x05040005U, 0x80000000U}) {
    CAPTURE(code);
    LoggedStream refusing;
    refusing.data = counting(20);
    refusing.on_piece = [&](CO_OBJ* obj, CO_NODE* node) {
      COObjTypeUserSDOAbort(obj, node, code);
      return CO_ERR_TYPE_WR;
    };
    CO_IF_FRM abort = frame("581#8000310000000000");
    CO_SET_LONG(&abort, code, 4);
    const std::string refused = notation(abort);
    Fixture node(Setup().only_small().with(refusing.extended(0x3100)));
    node.ask("601#4000310000000000", "581#4100310014000000");
    node.ask("601#6000000000000000", refused);
    node.ask("601#2100310014000000", "581#6000310000000000");
    node.ask("601#0001020304050607", refused);
    node.ask("601#230031000A0B0C0D", refused);
    check_idle(node);
#if USE_SDO_BLOCK
    refusing.data = counting(20);
    node.ask("601#A40031007F000000", "581#C600310014000000");
    node.ask("601#A300000000000000", refused);
    CO_IF_FRM accepted = frame("581#A400310000000000");
    CO_SET_BYTE(&accepted, CO_SDO_BUF_SEG, 4);
    node.ask("601#C200310007000000", notation(accepted));
    node.rx("601#8101020304050607");
    node.frames();
    node.ask("601#C100000000000000", refused);
    check_idle(node);
#endif
  }
}

// A node with an open transfer of its second SDO server, of an object whose type has an End function.
struct TwoTransfers : LoggedStream, Fixture {
  explicit TwoTransfers(CO_OBJ other)
      : Fixture(Setup().only_small().with(extended(0x3100)).with(other).before_init([](Objects& memory) {
          memory.sdo2_rx = 0x640;
          memory.sdo2_tx = 0x5C0;
        })) {
    data = counting(20);
    ask("640#4000310000000000", "5C0#4100310014000000");
  }
};

void end_other_transfers(CO_NODE* node) { CONmtSetMode(&node->Nmt, CO_STOP); }

TEST_CASE("SDO custom abort: set before or after the type function leaves the NMT state, it is the answer") {
  for (const bool before : {true, false}) {
    CAPTURE(before);
    LoggedStream refusing;
    refusing.data = {1, 2, 3, 4};
    refusing.on_piece = [&](CO_OBJ* obj, CO_NODE* node) {
      if (before) {
        COObjTypeUserSDOAbort(obj, node, 0x12345678);
      }
      end_other_transfers(node);
      if (!before) {
        COObjTypeUserSDOAbort(obj, node, 0x12345678);
      }
      return CO_ERR_TYPE_WR;
    };
    TwoTransfers node(refusing.value(0x3101));
    node.ask("601#2301310001020304", "581#8001310078563412");
    CHECK(node.log.back() == "end up 08000022");
    node.rx("000#8001");
    node.ask("601#4001310000000000", "581#8001310078563412");
  }
}

TEST_CASE(
    "SDO custom abort: set in End of a transfer that an initiate ends, it does not affect the answer to it [D8]") {
  LoggedStream refusing;
  refusing.data = {1, 2, 3, 4};
  refusing.on_piece = [](CO_OBJ*, CO_NODE*) { return CO_ERR_OBJ_RANGE; };
  TwoTransfers node(refusing.value(0x3101));
  node.on_end = [](CO_OBJ* obj, CO_NODE* of) {
    COObjTypeUserSDOAbort(obj, of, 0x12345678);
    return CO_ERR_TYPE_WR;
  };
  node.ask("640#2301310001020304", "5C0#8001310030000906");
  CHECK(node.log.back() == "end up 08000022");
}
#endif

#if USE_OD
TEST_CASE("SDO custom abort: set in an access of the application, it affects no SDO transfer") {
  LoggedStream refusing;
  refusing.data = {1, 2, 3, 4};
  Fixture node(Setup().only_small().with(refusing.value(0x3101)));
  const auto write = [&] {
    ODR_t result = ODR_OK;
    refusing.on_piece = [](CO_OBJ* obj, CO_NODE* of) {
      COObjTypeUserSDOAbort(obj, of, CO_SDO_ERR_RANGE_HIGH);
      return CO_ERR_OBJ_RANGE;
    };
    node.call([&] { result = OD_set_u32(OD_find(&node.od, 0x3101), 0, 5, false); });
    refusing.on_piece = nullptr;
    return result;
  };
  refusing.data = {1, 2, 3, 4};
  CHECK(write() == ODR_INVALID_VALUE);
  refusing.data = {1, 2, 3, 4};
  node.rx("601#4001310000000000");
  CHECK(node.frames().size() == 1);
  CHECK(write() == ODR_INVALID_VALUE);
}
#endif

}  // namespace
