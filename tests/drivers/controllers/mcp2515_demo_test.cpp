// SPDX-License-Identifier: Apache-2.0
// The program demo/mcp2515/main.c on the model of MCP2515: the test is its board and the rest of the bus.
#include <functional>

#include "bench.hpp"
#include "demo/mcp2515/board.h"
#include "mcp2515.hpp"

extern "C" int Mcp2515Demo(void);  // main() of the program

namespace {

using namespace test;

// A board whose loop runs each 20 bit times, that is each 40 us.
struct Board {
  CanWire wire;
  Mcp2515 can{wire};
  CanPeer peer{wire};
  bool are_interrupts_enabled = true;
  bool is_low = false;
  bool is_led_on = false;
  unsigned rounds = 0;
  unsigned rounds_at_most = 0;
  std::function<void()> on_millisecond;

  void interrupt() {
    const bool was_low = is_low;
    is_low = can.interrupt();
    if (is_low && !was_low && are_interrupts_enabled) {
      CanInterrupt();
    }
  }
};
Board* board;

TEST_CASE("MCP2515: the program of the documentation is a node with boot-up, heartbeat, SDO, RPDO and bus-off") {
  Board one;
  board = &one;
  one.wire.accesses_per_bit = 2;
  one.can.on_transfer = [&] { one.interrupt(); };
  one.rounds_at_most = 25 * 2700;
  unsigned milliseconds = 0;
  bool was_led_on = false;
  one.on_millisecond = [&] {
    ++milliseconds;
    if (milliseconds == 10) {
      one.peer.send(standard_frame(0x605, {0x40, 0x17, 0x10, 0, 0, 0, 0, 0}));
      one.peer.send(standard_frame(0x000, {0x01, 0x05}));
      one.peer.send(standard_frame(0x205, {1}));
    }
    was_led_on = was_led_on || (milliseconds == 20 && one.is_led_on);
    if (milliseconds == 1500) {
      one.can.node().set_counters(256, 0);
    }
  };
  CHECK(Mcp2515Demo() == 0);
  CHECK(was_led_on);
  CHECK(one.can.fault_text() == "");
  REQUIRE(one.peer.received.size() == 4);
  CHECK(one.peer.received[0] == standard_frame(0x705, {0x00}));
  CHECK(one.peer.received[1] == standard_frame(0x585, {0x4B, 0x17, 0x10, 0, 0xE8, 0x03, 0, 0}));
  CHECK(one.peer.received[2] == standard_frame(0x705, {0x05}));
  CHECK(one.peer.received[3] == standard_frame(0x705, {0x7F}));  // 1029h: Pre-operational since the bus-off
}

}  // namespace

extern "C" {

void BoardStart(void) {}
void BoardSelect(void* /*ctx*/, bool selected) { selected ? board->can.select() : board->can.deselect(); }
void BoardTransfer(void* /*ctx*/, uint8_t* bytes, uint8_t num) {
  for (unsigned n = 0; n < num; ++n) {
    bytes[n] = board->can.transfer(bytes[n]);
  }
}
bool BoardHasInterrupt(void* /*ctx*/) { return board->can.interrupt(); }
void BoardDisableInterrupts(void* /*user*/) { board->are_interrupts_enabled = false; }
void BoardEnableInterrupts(void* /*user*/) { board->are_interrupts_enabled = true; }
void BoardLed(bool on) { board->is_led_on = on; }

bool BoardWait(void) {
  for (unsigned bits = 0; bits < 20; ++bits) {
    board->wire.advance(1);
    board->interrupt();
  }
  if (++board->rounds % 25 == 0) {
    TickInterrupt();
    board->on_millisecond();
  }
  return board->rounds < board->rounds_at_most;
}
}
