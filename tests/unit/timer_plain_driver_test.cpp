// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "support/timers.hpp"

namespace {

using namespace test;

// Drivers without context, cyclic and tickless.

struct OldDriver {
  bool cyclic;
  std::uint64_t now;
  std::uint64_t left;  // cyclic: count-down; tickless: ticks until the compare match
  bool running;
  bool update_always;  // Update answers 1 whatever happens
  unsigned inits;
} old;

void old_init(std::uint32_t) { ++old.inits; }
void old_reload(std::uint32_t ticks) { old.left = ticks; }
std::uint32_t old_delay() { return static_cast<std::uint32_t>(old.left); }
void old_stop() {
  old.running = false;
  old.left = 0;
}
void old_start() { old.running = true; }
std::uint8_t old_update() {
  if (old.update_always || !old.cyclic) {
    return 1;
  }
  if (!old.running || old.left == 0) {
    return 0;
  }
  --old.left;
  return old.left == 0 ? 1U : 0U;
}

void nothing() {}
void nothing_with_baud(std::uint32_t) {}
std::int16_t no_frame(CO_IF_FRM*) { return 0; }
std::int16_t taken(CO_IF_FRM*) { return sizeof(CO_IF_FRM); }

const CO_IF_CAN_DRV old_can = {nothing, nothing_with_baud, no_frame, taken, nothing, nothing};
const CO_IF_TIMER_DRV old_timer = {old_init, old_reload, old_delay, old_stop, old_start, old_update};

// A node with drivers without context, at 1000 ticks/s.
struct OldNode {
  CO_OBJ dictionary[1] = {CO_OBJ_DICT_ENDMARK};
  CO_TMR_MEM memory[8];
  CO_IF_DRV drivers{&old_can, &old_timer, nullptr};
  CO_NODE node;

  explicit OldNode(bool cyclic) {
    runs().clear();
    old = OldDriver{};
    old.cyclic = cyclic;
    std::memset(static_cast<void*>(&node), 0xA5, sizeof node);
    const CO_NODE_SPEC spec = {1, 250000, dictionary, 1, nullptr, memory, 8, 1000, &drivers, nullptr};
    CONodeInit(&node, &spec);
    CONodeStart(&node);
    CONodeGetErr(&node);
  }

  // A tick of the hardware: the interrupt, then the loop if it is in time.
  void tick(bool loop = true) {
    ++old.now;
    if (old.cyclic) {
      COTmrService(&node.Tmr);
    } else if (old.running && old.left > 0 && --old.left == 0) {
      COTmrService(&node.Tmr);
    }
    if (loop) {
      COTmrProcess(&node.Tmr);
    }
  }
  void ticks(unsigned number, bool loop = true) {
    for (unsigned i = 0; i < number; ++i) tick(loop);
  }
  std::int16_t create(std::uint32_t start, std::uint32_t cycle, std::uintptr_t n) {
    return COTmrCreate(&node.Tmr, start, cycle, note, number(n));
  }
};

TEST_CASE("timer: drivers without context, cyclic and tickless, run timers at their times") {
  for (const bool cyclic : {true, false}) {
    CAPTURE(cyclic);
    OldNode t(cyclic);
    CHECK(old.inits == 1);
    t.create(5, 0, 1);
    t.create(3, 4, 2);
    t.ticks(2);
    CHECK(runs().empty());
    t.tick();
    CHECK(runs() == Runs{2});
    t.create(2, 0, 3);
    t.ticks(2);
    CHECK(runs() == Runs{2, 1, 3});
    t.ticks(2);
    CHECK(runs() == Runs{2, 1, 3, 2});
    t.ticks(8);
    CHECK(runs() == Runs{2, 1, 3, 2, 2, 2});
  }
}

TEST_CASE("timer: drivers without context, no drift in a million ticks") {
  for (const bool cyclic : {true, false}) {
    CAPTURE(cyclic);
    OldNode t(cyclic);
    t.create(7, 7, 7);
    t.create(10, 10, 10);
    t.ticks(1000000);
    unsigned sevens = 0;
    for (const std::uintptr_t n : runs()) sevens += n == 7 ? 1U : 0U;
    CHECK(sevens == 1000000 / 7);
    CHECK(runs().size() - sevens == 100000);
  }
}

TEST_CASE("timer: drivers without context, no drift when the loop is late") {
  for (const bool cyclic : {true, false}) {
    CAPTURE(cyclic);
    OldNode t(cyclic);
    t.create(10, 10, 1);
    for (int round = 0; round < 50; ++round) {
      t.ticks(13, false);
      t.ticks(7);
    }
    CHECK(runs().size() == 100);
    runs().clear();
    t.ticks(9);
    CHECK(runs().empty());
    t.tick();
    CHECK(runs().size() == 1);
  }
}

TEST_CASE("timer: a spurious interrupt is harmless, with no timer in use and with all elapsed") {
  for (const bool cyclic : {true, false}) {
    CAPTURE(cyclic);
    OldNode t(cyclic);
    old.update_always = true;
    CHECK(COTmrService(&t.node.Tmr) == 0);
    CHECK(COTmrService(&t.node.Tmr) == 0);
    COTmrProcess(&t.node.Tmr);
    old.update_always = false;
    t.create(2, 0, 1);
    t.ticks(2, false);
    old.update_always = true;
    CHECK(COTmrService(&t.node.Tmr) == 1);
    COTmrProcess(&t.node.Tmr);
    CHECK(runs() == Runs{1});
    CHECK(COTmrService(&t.node.Tmr) == 0);
  }
}

TEST_CASE("timer: drivers without context, deletion of an elapsed timer with nothing else in use") {
  for (const bool cyclic : {true, false}) {
    CAPTURE(cyclic);
    OldNode t(cyclic);
    const std::int16_t id = t.create(3, 0, 1);
    t.ticks(3, false);
    CHECK(COTmrDelete(&t.node.Tmr, id) == 0);
    COTmrProcess(&t.node.Tmr);
    CHECK(runs().empty());
    CHECK_FALSE(old.running);
  }
}

TEST_CASE("timer: drivers without context are stopped when nothing is to wait for") {
  for (const bool cyclic : {true, false}) {
    CAPTURE(cyclic);
    OldNode t(cyclic);
    const std::int16_t id = t.create(100, 0, 1);
    CHECK(old.running);
    COTmrDelete(&t.node.Tmr, id);
    CHECK_FALSE(old.running);
    t.create(2, 0, 2);
    CHECK(old.running);
    t.ticks(5);
    CHECK(runs() == Runs{2});
    CHECK_FALSE(old.running);
  }
}

TEST_CASE("timer: drivers without context, a shorter timer is set in the middle of a longer one") {
  for (const bool cyclic : {true, false}) {
    CAPTURE(cyclic);
    OldNode t(cyclic);
    t.create(100, 0, 1);
    t.ticks(60);
    t.create(10, 0, 2);
    CHECK(CONodeNextDeadline(&t.node) == 10);
    t.ticks(9);
    CHECK(runs().empty());
    t.tick();
    CHECK(runs() == Runs{2});
    t.ticks(29);
    CHECK(runs() == Runs{2});
    t.tick();
    CHECK(runs() == Runs{2, 1});
  }
}

}  // namespace
