// SPDX-License-Identifier: Apache-2.0
#include "example.hpp"

#include <algorithm>
#include <array>
#include <deque>

#include "example_board.h"
#include "example_cpu.h"
#include "example_main.h"

EXAMPLE_CAN ExampleCan;
EXAMPLE_TIMER ExampleTimer;

namespace check {
namespace {

constexpr std::size_t fifo_size = 3;

Board* the_board = nullptr;
std::deque<CO_IF_FRM> fifo;
bool awake = true;  // an interrupt has woken the CPU
std::array<std::uint8_t, EXAMPLE_EEPROM_SIZE> eeprom;

std::uint32_t word(const std::uint8_t* bytes) {
  std::uint32_t value = 0;
  for (unsigned n = 0; n < 4; ++n) {
    value |= static_cast<std::uint32_t>(bytes[n]) << (8 * n);
  }
  return value;
}

void transmit() {
  if (ExampleCan.Transmit.Request == 0) {
    return;
  }
  CO_IF_FRM frame = {ExampleCan.Transmit.Id, {}, static_cast<std::uint8_t>(ExampleCan.Transmit.Length)};
  for (unsigned n = 0; n < 8; ++n) {
    frame.Data[n] = static_cast<std::uint8_t>(ExampleCan.Transmit.Data[n / 4] >> (8 * (n % 4)));
  }
  if (the_board->port.send(frame) > 0) {
    ExampleCan.Transmit.Request = 0;
    ExampleCan.Status = ExampleCan.Status | EXAMPLE_CAN_SENT;
  }
}

void show_received() {
  const bool any = !fifo.empty();
  ExampleCan.Status = (ExampleCan.Status & ~EXAMPLE_CAN_RECEIVED) | (any ? EXAMPLE_CAN_RECEIVED : 0U);
  if (any) {
    ExampleCan.Receive.Id = fifo.front().Identifier;
    ExampleCan.Receive.Length = fifo.front().DLC;
    ExampleCan.Receive.Data[0] = word(&fifo.front().Data[0]);
    ExampleCan.Receive.Data[1] = word(&fifo.front().Data[4]);
  }
}

void receive() {
  while (const auto frame = the_board->port.read()) {
    if (fifo.size() == fifo_size) {
      ExampleCan.Status = ExampleCan.Status | EXAMPLE_CAN_LOST;
    } else if ((frame->Identifier & CO_IF_FRM_ERROR) == 0) {
      fifo.push_back(*frame);
    }
  }
  show_received();
}

void step_can(const std::function<void()>& interrupt) {
  const bool on = (ExampleCan.Control & EXAMPLE_CAN_ON) != 0;
  if (on != the_board->port.enabled()) {
    on ? the_board->port.enable(0) : the_board->port.close();
    fifo.clear();
  }
  if (on) {
    transmit();
    receive();
  }
  if (ExampleCan.Status == 0 || (ExampleCan.Control & EXAMPLE_CAN_INTERRUPTS) == 0) {
    return;
  }
  awake = true;
  if (the_board->locked) {
    return;
  }
  interrupt();
  if (ExampleCan.Release != 0 && !fifo.empty()) {
    fifo.pop_front();
  }
  ExampleCan.Status = ExampleCan.Status & ~ExampleCan.Clear;
  ExampleCan.Release = 0;
  ExampleCan.Clear = 0;
  show_received();
}

void step_timer(const std::function<void()>& interrupt) {
  ExampleTimer.Counter = (ExampleTimer.Counter + 1) & 0xFFFF;
  if (ExampleTimer.Counter == ExampleTimer.Compare) {
    ExampleTimer.Match = 1;
  }
  if (ExampleTimer.Enable == 0 || ExampleTimer.Match == 0) {
    return;
  }
  awake = true;
  if (!the_board->locked) {
    interrupt();
  }
}

}  // namespace

void connect_example(Board& board, std::function<void()> can_interrupt, std::function<void()> timer_interrupt) {
  the_board = &board;
  ExampleCan = {};
  ExampleTimer = {};
  ExampleTimer.Counter = 0xFFC0;
  fifo.clear();
  board.each_turn = [can = std::move(can_interrupt), timer = std::move(timer_interrupt)] {
    step_can(can);
    step_timer(timer);
  };
}

namespace {

// Like NodeRunOnce(), but sleeps without checking for events since its start.
void run_once_carelessly() {
  CONodeProcess(&Node);
  COTmrProcess(&Node.Tmr);
  CpuDisableInterrupts();
  CpuWaitForInterrupt();
  CpuEnableInterrupts();
}

CO_IF_FRM read_request() { return {0x602, {0x40, 0x00, 0x10, 0x00, 0, 0, 0, 0}, 8}; }

unsigned count_answers(Board& board) {
  unsigned answers = 0;
  while (const auto frame = board.peer.read()) {
    answers += frame->Identifier == 0x582 && frame->Data[0] == 0x43 ? 1U : 0U;
  }
  return answers;
}

// Sends two requests, the second \a delay ticks after the first, so that it arrives at any point of the loop. Returns
// true if both are answered.
bool answers(Board& board, unsigned delay, bool careful) {
  const std::uint64_t begin = board.time;
  const std::function<void()> registers = board.each_turn;
  board.each_turn = [&board, &registers, begin, delay] {
    if (board.time == begin + 1 || board.time == begin + 2 + delay) {
      board.peer.send(read_request());
    }
    registers();
  };
  while (board.time < begin + 500) {
    careful ? NodeRunOnce() : run_once_carelessly();
  }
  board.each_turn = registers;
  return count_answers(board) == 2;
}

std::uint8_t error_register = 0;
CO_OBJ objects[] = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(1)},
                    {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, CO_DATA(&error_register)},
                    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_DATA(1)},
                    CO_OBJ_DICT_ENDMARK};

}  // namespace

unsigned answered_by_loop(unsigned num, bool careful) {
  unsigned good = 0;
  for (unsigned delay = 0; delay < num; ++delay) {
    Board board;
    connect_example(board, CAN_IRQHandler, TIMER_IRQHandler);
    board.peer.enable();
    CO_NODE_SPEC spec = {2, 1000000, objects, 4, nullptr, nullptr, 0, frequency, nullptr, nullptr};
    if (NodeStart(&spec)) {
      NodeRunOnce();
      good += answers(board, delay, careful) ? 1U : 0U;
    }
  }
  return good;
}

}  // namespace check

extern "C" {

// Lets an interrupt occur at the worst moment: after the work of the loop, before it sleeps.
void CpuDisableInterrupts(void) {
  if (check::the_board != nullptr) {
    check::the_board->step();
    check::the_board->locked = true;
  }
}

void CpuEnableInterrupts(void) {
  if (check::the_board != nullptr) {
    check::the_board->locked = false;
  }
}

// Sleeps until an interrupt, at most 10 ms: after that time the test assumes that the CPU sleeps for ever.
void CpuWaitForInterrupt(void) {
  check::awake = false;
  for (unsigned tick = 0; tick < 1000 && !check::awake; ++tick) {
    check::the_board->step();
  }
}

bool ExampleEepromRead(uint32_t address, uint8_t* to, uint32_t size) {
  std::copy_n(check::eeprom.begin() + address, size, to);
  return true;
}

bool ExampleEepromWrite(uint32_t address, const uint8_t* from, uint32_t size) {
  const uint32_t page = address / EXAMPLE_EEPROM_PAGE * EXAMPLE_EEPROM_PAGE;
  for (uint32_t n = 0; n < size; ++n) {
    check::eeprom[page + (address + n) % EXAMPLE_EEPROM_PAGE] = from[n];
  }
  return true;
}

}  // extern "C"
