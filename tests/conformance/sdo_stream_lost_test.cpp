// SPDX-License-Identifier: Apache-2.0
// SDO server: type functions that move the dictionary or change the size of the object of an open transfer, and the
// timer that monitors transfers.
#include "support/block_frames.hpp"
#include "support/logged_stream.hpp"

namespace {

using namespace test;

// A node whose object 3100h has a type that moves the dictionary, which ends the transfers of all objects.
struct MovingStream : LoggedStream, Fixture {
  std::vector<CO_OBJ> table;

  explicit MovingStream(std::uint32_t size) : Fixture(Setup().only_small().with(plain(0x3100))) {
    data = counting(size);
  }

  std::function<CO_ERR(CO_OBJ*, CO_NODE*)> move() {
    return [this](CO_OBJ*, CO_NODE* of) {
      if (table.empty()) {
        table.assign(of->Dict.Root, of->Dict.Root + of->Dict.Num);
        CODictInit(&of->Dict, of, table.data(), of->Dict.Num);
      }
      return CO_ERR_NONE;
    };
  }
};

TEST_CASE("SDO stream types: a Write that opens the object and moves the table aborts the download") {
  MovingStream segmented(0);
  segmented.on_open = segmented.move();
  segmented.ask("601#2100310003000000", "581#6000310000000000");
  segmented.ask("601#0901020300000000", "581#8000310022000008");
#if USE_SDO_BLOCK
  MovingStream by_block(0);
  by_block.on_open = by_block.move();
  by_block.rx("601#C600310003000000");
  by_block.frames();
  by_block.rx("601#8101020300000000");
  by_block.frames();
  by_block.rx(block_end(0x601, {1, 2, 3}));
  by_block.tx("581#8000310022000008");
  CHECK(by_block.take_log() == Log{"reset 0", "write 0"});
#endif
}

#if USE_OBJ_EX  // objects of unknown size
TEST_CASE("SDO stream types: a Read that moves the table aborts an upload of unknown size") {
  MovingStream node(20);
  node.knows_size = false;
  node.on_piece = node.move();
  node.ask("601#4000310000000000", "581#4000310000000000");
  node.ask("601#6000000000000000", "581#8000310022000008");
}

TEST_CASE(
    "SDO stream types: an object of unknown size that becomes shorter than the read part is aborted with 0604 0047h") {
  MovingStream node(20);
  node.knows_size = false;
  node.ask("601#4000310000000000", "581#4000310000000000");
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.on_piece = [&](CO_OBJ*, CO_NODE*) {
    node.data.resize(3);
    node.at_end = true;
    return CO_ERR_NONE;
  };
  node.ask("601#7000000000000000", "581#8000310047000406");
}

#endif

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127
TEST_CASE("SDO stream types: a Reset that moves the table in a repeated block aborts the upload") {
  MovingStream node(1800);
  node.ask("601#A00031007F000000", "581#C600310008070000");
  node.rx("601#A300000000000000");
  expect_segments(node, counting(1800), 0, 127);
  node.rx("601#A2647F0000000000");
  expect_segments(node, counting(1800), 100, 127);
  node.on_reset = node.move();
  node.ask("601#A2007F0000000000", "581#8000310022000008");
  CHECK(node.take_log().back() == "reset 700");
}
#endif

// Time-out of transfers ---------------------------------------------------------------------------------------------

#if CO_SDO_TIMEOUT != 0
TEST_CASE("SDO server: the timer of the time-outs stops when no transfer is open [D18]") {
  for (const char* end : {"601#8008100000000000", "601#4000100000000000", "601#E000000000000000"}) {
    CAPTURE(std::string(end));
    Fixture node;
    node.rx("601#4008100000000000");
    node.frames();
    CHECK(node.armed_timers() == 1);
    node.rx(end);
    node.frames();
    node.after(node.sdo_time_out());
    CHECK(node.armed_timers() == 0);
    CHECK(CONodeNextDeadline(&node.node) == 0xFFFFFFFF);
  }
}

TEST_CASE("SDO server: the timer of the time-outs stops at a reset and in states without SDO") {
  for (const char* command : {"000#0201", "000#8201"}) {
    CAPTURE(std::string(command));
    Fixture node;
    node.rx("601#4008100000000000");
    node.frames();
    CHECK(node.armed_timers() == 1);
    node.rx(command);
    node.frames();
    CHECK(node.armed_timers() == 0);
  }
}
#endif

}  // namespace
