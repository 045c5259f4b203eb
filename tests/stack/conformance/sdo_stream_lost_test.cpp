// SPDX-License-Identifier: Apache-2.0
// SDO server: type functions that move the dictionary or change the size of the object of an open transfer, and the
// timer that monitors transfers.
#include "support/block_frames.hpp"
#include "support/logged_stream.hpp"

namespace {

using namespace test;

// A node whose object 3100h has a type that tries to move the dictionary.
struct MovingStream : LoggedStream, Fixture {
  std::vector<CO_OBJ> table;

  explicit MovingStream(std::uint32_t size) : Fixture(Setup().only_small().with(plain(0x3100))) {
    data = counting(size);
  }

  std::function<CO_ERR(CO_OBJ*, CO_NODE*)> move() {
    return [this](CO_OBJ*, CO_NODE* of) {
      if (table.empty()) {
        table.assign(of->Dict.Root, of->Dict.Root + of->Dict.Num);
        CHECK(CODictInit(&of->Dict, of, table.data(), of->Dict.Num) == -1);
      }
      return CO_ERR_NONE;
    };
  }
};

TEST_CASE("SDO stream types: CODictInit() in a type function is refused and the transfer continues") {
  MovingStream node(0);
  node.on_open = node.move();
  node.ask("601#2100310003000000", "581#6000310000000000");
  node.ask("601#0901020300000000", "581#2000000000000000");
  CHECK(node.error() == CO_ERR_DICT_BUSY);
}

#if USE_OBJ_EX  // objects of unknown size
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
