// SPDX-License-Identifier: Apache-2.0
// Drivers that store frames and times in memory. Their instructions are counted, too.
#include "drivers.hpp"

#include "device.hpp"
#include "machine.hpp"

namespace bench {
namespace {

constexpr std::size_t places = 256;  // enough for a block and its response

CO_IF_FRM received_frames[places];
std::size_t received_num = 0;
std::size_t received_next = 0;

CO_IF_FRM sent_frames[places];
std::size_t sent_num = 0;

std::uint32_t clock_ticks = 0;

void nothing(void*) {}
void set_rate(void*, std::uint32_t) {}

std::int16_t read(void*, CO_IF_FRM* to) {
  if (received_next == received_num) {
    return 0;
  }
  *to = received_frames[received_next++];
  return sizeof *to;
}

std::int16_t send(void*, const CO_IF_FRM* from) {
  sent_frames[sent_num++ % places] = *from;
  return sizeof *from;
}

std::uint32_t now(void*) { return clock_ticks; }

}  // namespace

const CO_IF_CAN_DRV_EX can = {nothing, set_rate, read, send, nothing, nothing, nullptr, nullptr};
const CO_IF_TIMER_DRV_EX timer = {set_rate, now, nullptr};

CO_IF_FRM frame(std::uint32_t identifier, std::initializer_list<std::uint8_t> data) {
  CO_IF_FRM made = {identifier, {}, 0};
  for (const std::uint8_t byte : data) {
    made.Data[made.DLC++] = byte;
  }
  return made;
}

void receive(const CO_IF_FRM& frame) {
  if (received_next == received_num) {
    received_next = 0;
    received_num = 0;
  }
  if (received_num == places) {
    fail("bus", "too many frames wait");
  }
  received_frames[received_num++] = frame;
}

std::size_t sent() { return sent_num; }
const CO_IF_FRM& sent(std::size_t place) { return sent_frames[place]; }
void forget_sent() { sent_num = 0; }

bool is_same(const CO_IF_FRM& a, const CO_IF_FRM& b) {
  bool same = a.Identifier == b.Identifier && a.DLC == b.DLC;
  for (std::size_t n = 0; n < a.DLC && same; ++n) {
    same = a.Data[n] == b.Data[n];
  }
  return same;
}

bool has_sent(const CO_IF_FRM& frame) { return sent_num == 1 && is_same(sent_frames[0], frame); }

void elapse() { clock_ticks += CONodeNextDeadline(&node); }

void advance(std::uint32_t ticks) {
  for (std::uint32_t wait = CONodeNextDeadline(&node); wait <= ticks; wait = CONodeNextDeadline(&node)) {
    ticks -= wait;
    clock_ticks += wait;
    COTmrService(&node.Tmr);
    COTmrProcess(&node.Tmr);
  }
  clock_ticks += ticks;
}

}  // namespace bench
