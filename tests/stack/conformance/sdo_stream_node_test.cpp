// SPDX-License-Identifier: Apache-2.0
// Types with Begin and End (CO_OBJ_TYPE_EX) whose functions call functions of the node. [Q9]
#include <algorithm>

#include "support/block_frames.hpp"
#include "support/logged_stream.hpp"

#if USE_OBJ_EX

namespace {

using namespace test;

struct Stream : LoggedStream, Fixture {
  explicit Stream(Setup setup = {}) : Fixture(setup.only_small().with(extended(0x3000))) { data = counting(9); }
};

long count_ends(const Log& log) {
  return std::count_if(log.begin(), log.end(), [](const std::string& call) { return call[0] == 'e'; });
}

// Enters Stopped, which permits no SDO.
const auto stop_sdo = [](CO_OBJ*, CO_NODE* node) {
  CONmtSetMode(&node->Nmt, CO_STOP);
  return CO_ERR_NONE;
};
const auto stop_node = [](CO_OBJ*, CO_NODE* node) {
  CONodeStop(node);
  return CO_ERR_NONE;
};
const auto reset_node = [](CO_OBJ*, CO_NODE* node) {
  CONmtReset(&node->Nmt, CO_RESET_NODE);
  return CO_ERR_NONE;
};

TEST_CASE("SDO stream types: if Begin enters Stopped then End is called once, after the answer [Q9] [N8]") {
  for (const char* request : {"601#2100300014000000", "601#4000300000000000", "601#2B00300011220000"}) {
    CAPTURE(std::string(request));
    Stream node;
    node.on_begin = stop_sdo;
    node.rx(request);
    CHECK(node.frames().size() == 1);
    CHECK(node.mode() == CO_STOP);
    CHECK(count_ends(node.log) == 1);
    CHECK(node.log.back().substr(0, 3) == "end");
    node.rx("000#8001");
    node.on_begin = nullptr;
    node.data = counting(9);
    node.ask("601#4000300000000000", "581#4100300009000000");
  }
}

TEST_CASE("SDO stream types: if Begin calls CONodeStop then End is called once and no answer is sent [Q9]") {
  Stream node;
  node.on_begin = stop_node;
  node.rx("601#2100300014000000");
  node.silent();
  CHECK(count_ends(node.log) == 1);
  CHECK(node.mode() == CO_INVALID);
}

TEST_CASE("SDO stream types: if End requests a reset the download is answered before the reset [Q3] [Q9]") {
  Stream node;
  node.frames_per_call(2);
  node.on_end = reset_node;
  node.rx("601#2B00300011220000");
  node.tx({"581#6000300000000000", "701#00"});
  CHECK(count_ends(node.log) == 1);
}

TEST_CASE(
    "SDO stream types: if End enters Stopped it is called once before the answer, and CONodeStop prevents it [Q9] "
    "[N8]") {
  for (const bool stops_node : {false, true}) {
    Stream node;
    node.on_end = stops_node ? std::function<CO_ERR(CO_OBJ*, CO_NODE*)>(stop_node) : stop_sdo;
    node.ask("601#2100300002000000", "581#6000300000000000");
    node.rx("601#0B01020000000000");
    stops_node ? node.silent() : node.tx("581#2000000000000000");
    CHECK(count_ends(node.log) == 1);
  }
}

TEST_CASE("SDO stream types: Begin and End may access the dictionary including their own object [Q9]") {
  Stream node;
  node.may_change(0x2001, 0);
  const auto access_dictionary = [](CO_OBJ*, CO_NODE* stack) {
    std::uint32_t word = 0;
    CHECK(CODictRdLong(&stack->Dict, CO_DEV(0x1000, 0), &word) == CO_ERR_NONE);
    CHECK(CODictWrByte(&stack->Dict, CO_DEV(0x2001, 0), 0x77) == CO_ERR_NONE);
    CHECK(CODictRdLong(&stack->Dict, CO_DEV(0x3000, 0), &word) == CO_ERR_NONE);
    return CO_ERR_NONE;
  };
  node.on_begin = access_dictionary;
  node.on_end = access_dictionary;
  CHECK(node.download(0x3000, 0, counting(20)) == 0);
  CHECK(node.data == counting(20));
  CHECK(count_ends(node.log) == 1);
}

#if CO_SSDO_N >= 2

// Returns a node with a second SDO server at 690h/6A0h.
Setup two_channels() {
  return Setup().before_init([](Objects& o) {
    o.sdo2_rx = 0x690;
    o.sdo2_tx = 0x6A0;
  });
}

TEST_CASE("SDO stream types: a transfer on a second channel is refused with 0800 0022h and Begin is not called") {
  Stream node(two_channels());
  node.ask("601#4000300000000000", "581#4100300009000000");
  node.take_log();
  for (const char* request : {"690#4000300000000000", "690#2100300014000000", "690#2B00300011220000",
                              "690#A40030007F000000", "690#C600300014000000"}) {
    if (!USE_SDO_BLOCK && (request[4] == 'A' || request[4] == 'C')) continue;
    CAPTURE(std::string(request));
    node.ask(request, "6A0#8000300022000008");
  }
  CHECK(node.log.empty());
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.ask("601#7000000000000000", "581#1B08090000000000");
  CHECK(node.take_log() == Log{"read 7", "read 2", "end up 0"});
  node.ask("690#2B00300011220000", "6A0#6000300000000000");
}

TEST_CASE("SDO stream types: End is called when the COB-IDs of the channel change [D16]") {
  Stream node(two_channels());
  node.ask("690#2100300014000000", "6A0#6000300000000000");
  node.take_log();
  node.ask("601#2301120190060080", "581#6001120100000000");
  CHECK(node.take_log() == Log{"end down 08000022"});
}

TEST_CASE("SDO stream types: End is called when its own channel is aborted and not when another one is") {
  Stream node(two_channels());
  node.ask("690#2100300014000000", "6A0#6000300000000000");
  node.take_log();
  node.ask("601#4000100000000000", "581#4300100091010F00");
  node.rx("601#8000300000000008");
  CHECK(node.log.empty());
  node.rx("690#8000300000000008");
  CHECK(node.take_log() == Log{"end down 08000000"});
}

#endif

}  // namespace

#endif
