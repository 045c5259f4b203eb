// SPDX-License-Identifier: Apache-2.0
// Abort codes that an object type chooses itself (COObjTypeUserSDOAbort).
#include "support/fixture.hpp"

namespace {

using namespace test;

constexpr unsigned always = 1000;

struct Script {
  std::uint32_t size = 4;
  std::uint32_t abort = 0;
  unsigned good_calls = 0;  // of Size, before it fails
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

TEST_CASE("SDO custom abort: FFFF FFFFh is a code as any other") {
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

TEST_CASE("SDO custom abort: set in the Size function, at every kind of initiate") {
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

}  // namespace
