// SPDX-License-Identifier: Apache-2.0
// The demo clock without an operating system: main loop and interrupts of a node on a microcontroller. The CPU sleeps
// while it is idle.
#include "board.hpp"
#include "clock/dictionary.hpp"
#include "co_core.h"
#include "co_nvm_ram.h"
#include "co_slcan.h"
#include "parts.hpp"

namespace lexican::demo {
namespace {

constexpr std::uint8_t node_id = 1;  // until LSS stores another one
constexpr std::uint32_t bit_rate = 500000;
constexpr std::uint32_t ticks_per_second = 1000000;

// Length of the receive queue, frames: a block of 127 segments and the frames that other nodes send meanwhile.
constexpr std::uint16_t frames_received = 160;

std::uint8_t picture[48 * 32 * 3];              // object 2200h: 48 * 32 pixels of 3 bytes
const std::uint8_t hardware[] = LEXICAN_BOARD;  // object 1009h: the name of the board, set by CMakeLists.txt

CO_NODE node;
CO_NODE_EXT extension;
CO_TMR_MEM timers[1];  // for clock_tick()
std::uint8_t sdo_buffer[CO_SSDO_N * CO_SDO_BUF_BYTE];
CO_SLCAN can;
CO_IF_FRM frames[frames_received];
std::uint8_t memory_bytes[clock_memory_size];
CO_NVM_RAM memory = {memory_bytes, sizeof memory_bytes};
std::uint32_t interrupts_before_lock;

// Called by the driver in the loop when there is text to send. Interrupts are disabled, because the interrupt handler
// of the UART sends text, too.
void start_sending(void* controller) {
  const std::uint32_t before = board::disable_interrupts();
  uart_send(*static_cast<CO_SLCAN*>(controller));
  board::restore_interrupts(before);
}

void make_node() {
  const BoardTimer timer = board_timer();
  extension.Size = sizeof extension;
  extension.Can = &SlcanDriver;
  extension.CanCtx = &can;
  extension.Timer = timer.driver;
  extension.TimerCtx = timer.context;
  extension.Nvm = &RamNvmDriver;
  extension.NvmCtx = &memory;
  extension.EmcyNum = clock_errors().number;

  CO_NODE_SPEC spec = {};
  spec.NodeId = node_id;
  spec.Baudrate = bit_rate;
  spec.Dict = clock_dictionary().first;
  spec.DictLen = clock_dictionary().length;
  spec.EmcyCode = clock_errors().first;
  spec.TmrMem = timers;
  spec.TmrNum = 1;
  spec.TmrFreq = ticks_per_second;
  spec.SdoBuf = sdo_buffer;
  CONodeInitEx(&node, &spec, &extension);
}

// Prints the last error of the node, if there is one.
void print_error() {
  char text[CO_NODE_ERR_TEXT];
  if (CONodeGetErrText(&node, text, sizeof text) != CO_ERR_NONE) {
    board::print(text);
    board::print("\n");
  }
}

// Sleeps if the node is idle. Interrupts are disabled between the check and the sleep; a pending one ends the sleep.
void sleep_until_due() {
  const std::uint32_t before = board::disable_interrupts();
  if (CONodeNextDeadline(&node) != 0 && !COSlcanIsDue(&can) && uart_wakes_cpu()) {
    board::wait_for_interrupt();
  }
  board::restore_interrupts(before);
}

}  // namespace

}  // namespace lexican::demo

// Objects that the generated dictionary refers to and the program defines (clock/dictionary.hpp).
CO_OBJ_STR clock_1009_0 = {0, lexican::demo::hardware};
CO_OBJ_DOM clock_2200_0 = {0, sizeof lexican::demo::picture, lexican::demo::picture};

namespace board {

void on_uart() { lexican::demo::uart_interrupt(lexican::demo::can); }

void on_timer() {
  lexican::demo::timer_interrupt();
  COTmrService(&lexican::demo::node.Tmr);
}

}  // namespace board

// Disable and enable interrupts around accesses of the stack to its timers; calls are not nested.
void COTmrLock() { lexican::demo::interrupts_before_lock = board::disable_interrupts(); }
void COTmrUnlock() { board::restore_interrupts(lexican::demo::interrupts_before_lock); }

#if USE_LSS && USE_PARA
CO_ERR COLssLoad(std::uint32_t* baud, std::uint8_t* nodeId) {
  return COLssNvmLoad(&lexican::demo::node, 0, baud, nodeId);
}
CO_ERR COLssStore(std::uint32_t baud, std::uint8_t nodeId) {
  return COLssNvmStore(&lexican::demo::node, 0, baud, nodeId);
}
#endif

void CONodeFatalError() {
  board::print("fatal error of the node\n");
  board::leave(1);
}

int main() {
  using namespace lexican;
  using namespace lexican::demo;
  board::disable_interrupts();
  CONvmRamClear(&memory);
  COSlcanInit(&can, frames, frames_received, start_sending, &can);
  uart_begin();
  make_node();
  print_error();
  if (CONmtGetMode(&node.Nmt) == CO_INVALID) {
    board::leave(1);
  }
  COTmrCreate(&node.Tmr, ticks_per_second, ticks_per_second, clock_tick, &node);
  CONodeStart(&node);
  board::enable_interrupts();
  for (;;) {
    CONodeProcess(&node);
    COTmrProcess(&node.Tmr);
    sleep_until_due();
  }
}
