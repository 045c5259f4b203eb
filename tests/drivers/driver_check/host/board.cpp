// SPDX-License-Identifier: Apache-2.0
#include "board.hpp"

#include <cstring>

namespace check {
namespace {

Board* the_board = nullptr;
std::vector<std::uint8_t> plain_memory(plain_nvm_size, 0);

Setting& setting(void* user) { return *static_cast<Setting*>(user); }

void print(void* user, const char* line) { setting(user).report.lines.emplace_back(line); }
void idle(void* user) { setting(user).board.step(); }
std::uint32_t clock_of(void* user) { return static_cast<std::uint32_t>(setting(user).board.time); }
void lock(void* user) { setting(user).board.locked = true; }
void unlock(void* user) { setting(user).board.locked = false; }

}  // namespace

Board::Board() : port(bus.attach({"own", 64, 3})), peer(bus.attach({"peer", 64, 3})) {
  the_board = this;
  bus.set_time([this] { return co::VirtualBus::Time{time * (1000000 / frequency)}; });
  bus.pace(1000000);
}

void Board::step() {
  ++time;
  bus.poll();
  if (each_turn) {
    each_turn();
  }
  if (compare.armed && time >= compare.at) {
    compare.matched = true;
  }
  const bool due = cyclic || (compare.matched && time >= compare.at + latency);
  if (due && !locked && interrupt) {
    interrupt();
  }
}

std::map<std::string, std::string> Report::verdicts() const {
  std::map<std::string, std::string> result;
  for (const std::string& line : lines) {
    for (const char* const word : {"ok ", "not ok ", "skipped "}) {
      const std::size_t colon = line.find(':');
      if (line.rfind(word, 0) == 0 && colon != std::string::npos) {
        std::string& verdict = result[line.substr(std::strlen(word), colon - std::strlen(word))];
        verdict = verdict == "not ok " ? verdict : word;
      }
    }
  }
  return result;
}

Setting::Setting() {
  ext.Size = sizeof ext;
  ext.Lock = lock;
  ext.Unlock = unlock;
  ext.User = this;
  peer.Can = &co::VirtualBusDriver;
  peer.CanCtx = &board.peer;
  check.Drv = &plain;
  check.Ext = &ext;
  check.Print = print;
  check.Idle = idle;
  check.Clock = clock_of;
  check.User = this;
  check.Bus = CO_CHECK_PEER;
  check.Peer = &peer;
  check.Baudrate = 1000000;
  check.Frames = CO_CHECK_29_BIT | CO_CHECK_REMOTE;
  check.TmrFreq = frequency;
  check.Late = late;
  check.Longest = 70000;
  check.NvmSize = plain_nvm_size;
  check.Patience = 2000;
  check.Quiet = 100;
  board.interrupt = [this] { CODriverCheckService(&check); };
}

namespace {

void init_can() { the_board->port.close(); }
void enable_can(std::uint32_t baud) { the_board->port.enable(baud); }
std::int16_t read_can(CO_IF_FRM* frm) { return co::VirtualBusDriver.Read(&the_board->port, frm); }

// Sends the frame, and changes the caller's frame, as a classic driver may do.
std::int16_t send_can(CO_IF_FRM* frm) {
  const std::int16_t result = the_board->port.send(*frm);
  *frm = {};
  return result;
}
void reset_can() { the_board->port.reset(); }
void close_can() { the_board->port.close(); }

// The timer of drivers/template: a free running counter and a compare match.
bool follows_match = false;

void init_timer(std::uint32_t /*freq*/) {
  the_board->compare = {};
  follows_match = false;
}
void reload_timer(std::uint32_t ticks) {
  Compare& compare = the_board->compare;
  compare = {(follows_match ? compare.at : the_board->time) + ticks, true, false};
  follows_match = false;
}
std::uint32_t delay_timer() {
  const Compare& compare = the_board->compare;
  return !compare.armed || the_board->time >= compare.at ? 0 : static_cast<std::uint32_t>(compare.at - the_board->time);
}
void stop_timer() {
  the_board->compare.armed = false;
  the_board->compare.matched = false;
  follows_match = false;
}
void start_timer() {}
std::uint8_t update_timer() {
  Compare& compare = the_board->compare;
  if (!compare.matched) {
    return 0;
  }
  compare.matched = false;
  compare.armed = false;
  follows_match = true;
  return 1;
}

void init_nvm() {}
CO_NVM_RAM plain_ram() { return {plain_memory.data(), plain_nvm_size}; }
std::uint32_t read_nvm(std::uint32_t start, std::uint8_t* buffer, std::uint32_t size) {
  CO_NVM_RAM ram = plain_ram();
  return RamNvmDriver.Read(&ram, start, buffer, size);
}
std::uint32_t write_nvm(std::uint32_t start, std::uint8_t* buffer, std::uint32_t size) {
  CO_NVM_RAM ram = plain_ram();
  return RamNvmDriver.Write(&ram, start, buffer, size);
}

Board& board(void* ctx) { return *static_cast<Board*>(ctx); }
void init_clock(void* ctx, std::uint32_t /*freq*/) { board(ctx).compare = {}; }
std::uint32_t now(void* ctx) { return static_cast<std::uint32_t>(board(ctx).time); }
void alarm(void* ctx, std::uint32_t ticks) { board(ctx).compare = {board(ctx).time + ticks, ticks != 0, false}; }

Flash& flash(void* ctx) { return *static_cast<Flash*>(ctx); }
bool is_inside(const Flash& memory, std::uint32_t start, std::uint32_t size) {
  return start <= memory.bytes.size() && size <= memory.bytes.size() - start;
}
void init_flash(void* /*ctx*/) {}
std::uint32_t read_flash(void* ctx, std::uint32_t start, std::uint8_t* buffer, std::uint32_t size) {
  const Flash& memory = flash(ctx);
  if (!is_inside(memory, start, size)) {
    return 0;
  }
  std::copy_n(memory.bytes.begin() + start, size, buffer);
  return size;
}

// Programs whole units that are erased.
std::uint32_t write_flash(void* ctx, std::uint32_t start, const std::uint8_t* buffer, std::uint32_t size) {
  Flash& memory = flash(ctx);
  const std::uint32_t unit = memory.shape.ProgramSize;
  if (!is_inside(memory, start, size) || start % unit != 0 || size % unit != 0) {
    return 0;
  }
  for (std::uint32_t n = 0; n < size; ++n) {
    if (memory.bytes[start + n] != 0xFF) {
      return n;
    }
    memory.bytes[start + n] = buffer[n];
  }
  return size;
}
bool erase_flash(void* ctx, std::uint32_t start, std::uint32_t size) {
  Flash& memory = flash(ctx);
  if (!is_inside(memory, start, size) || start % memory.shape.EraseSize != 0 || size % memory.shape.EraseSize != 0) {
    return false;
  }
  std::fill_n(memory.bytes.begin() + start, size, static_cast<std::uint8_t>(0xFF));
  return true;
}
CO_NVM_SHAPE shape_of_flash(void* ctx) { return flash(ctx).shape; }

}  // namespace

const CO_IF_CAN_DRV PlainCanDriver = {init_can, enable_can, read_can, send_can, reset_can, close_can};
const CO_IF_TIMER_DRV PlainTimerDriver = {init_timer, reload_timer, delay_timer, stop_timer, start_timer, update_timer};
const CO_IF_NVM_DRV PlainNvmDriver = {init_nvm, read_nvm, write_nvm};
const CO_IF_TIMER_DRV_EX ClockDriver = {init_clock, now, alarm};
const CO_IF_NVM_DRV_EX FlashDriver = {init_flash, read_flash, write_flash, erase_flash, shape_of_flash};

}  // namespace check
