// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <random>
#include <set>

#include "support/fixture.hpp"

namespace {

using namespace test;

// What ran, in order. The parameter of a timer is a number.
std::vector<std::uintptr_t> runs;

void note(void* para) {
  const OutsideStack outside;
  runs.push_back(reinterpret_cast<std::uintptr_t>(para));
}

void* number(std::uintptr_t n) { return reinterpret_cast<void*>(n); }

// A node of which only the timers are used; a tick is a millisecond unless said otherwise.
class Timers : public Fixture {
 public:
  explicit Timers(const Setup& setup = Setup()) : Fixture(setup) { runs.clear(); }
  std::int16_t create(std::uint32_t start, std::uint32_t cycle, std::uintptr_t n) {
    std::int16_t id = -1;
    call([&] { id = COTmrCreate(&node.Tmr, start, cycle, note, number(n)); });
    return id;
  }
  std::int16_t remove(std::int16_t id) {
    std::int16_t result = -2;
    call([&] { result = COTmrDelete(&node.Tmr, id); });
    return result;
  }
};

using Runs = std::vector<std::uintptr_t>;

CO_TMR with_frequency(std::uint32_t frequency) {
  CO_TMR tmr{};
  tmr.Freq = frequency;
  return tmr;
}

TEST_CASE("timer: time is converted to ticks exactly, rounded up, at any frequency") {
  struct Row {
    std::uint32_t frequency;
    std::uint16_t time;
    std::uint32_t unit;
    std::uint32_t ticks;
  };
  const Row rows[] = {
      {1000, 1, CO_TMR_UNIT_1MS, 1},
      {1000, 65535, CO_TMR_UNIT_1MS, 65535},
      {300, 1000, CO_TMR_UNIT_1MS, 300},
      {300, 1, CO_TMR_UNIT_1MS, 1},
      {300, 10, CO_TMR_UNIT_1MS, 3},
      {300, 11, CO_TMR_UNIT_1MS, 4},
      {1500, 1000, CO_TMR_UNIT_1MS, 1500},
      {1500, 1, CO_TMR_UNIT_1MS, 2},
      {1024, 1000, CO_TMR_UNIT_1MS, 1024},
      {1024, 1, CO_TMR_UNIT_1MS, 2},
      {1024, 125, CO_TMR_UNIT_1MS, 128},
      {32768, 1, CO_TMR_UNIT_1MS, 33},
      {32768, 1000, CO_TMR_UNIT_1MS, 32768},
      {72000000, 59000, CO_TMR_UNIT_1MS, 4248000000},
      {72000000, 59652, CO_TMR_UNIT_1MS, 4294944000},
      {72000000, 59653, CO_TMR_UNIT_1MS, 0},
      {72000000, 65535, CO_TMR_UNIT_1MS, 0},
      {1000, 1, CO_TMR_UNIT_100US, 1},
      {1000, 10, CO_TMR_UNIT_100US, 1},
      {1000, 11, CO_TMR_UNIT_100US, 2},
      {1000000, 3, CO_TMR_UNIT_100US, 300},
      {1, 1, CO_TMR_UNIT_1MS, 1},
      {1000, 0, CO_TMR_UNIT_1MS, 0},
      {0, 10, CO_TMR_UNIT_1MS, 0},
      {1000, 10, 0, 0},
      {4294967295, 1, 1, 4294967295},
      {4294967295, 1000, CO_TMR_UNIT_1MS, 4294967295},
      {4294967295, 1001, CO_TMR_UNIT_1MS, 0},
  };
  for (const Row& row : rows) {
    CAPTURE(row.frequency);
    CAPTURE(row.time);
    CAPTURE(row.unit);
    CO_TMR tmr = with_frequency(row.frequency);
    CHECK(COTmrGetTicks(&tmr, row.time, row.unit) == row.ticks);
  }
}

TEST_CASE("timer: the shortest time that can be told apart") {
  const auto shortest = [](std::uint32_t frequency, std::uint32_t unit) {
    CO_TMR tmr = with_frequency(frequency);
    return COTmrGetMinTime(&tmr, unit);
  };
  CHECK(shortest(1000, CO_TMR_UNIT_1MS) == 1);
  CHECK(shortest(1000000, CO_TMR_UNIT_1MS) == 1);
  CHECK(shortest(300, CO_TMR_UNIT_1MS) == 4);
  CHECK(shortest(10, CO_TMR_UNIT_1MS) == 100);
  CHECK(shortest(1000, CO_TMR_UNIT_100US) == 10);
  CHECK(shortest(0, CO_TMR_UNIT_1MS) == 0);
  CHECK(shortest(1000, 0) == 0);
  CHECK(shortest(1, 65535) == 65535);
  CHECK(shortest(1, 65536) == 0);
}

TEST_CASE("timer: runs once, exactly when its time has come") {
  Timers t;
  CHECK(t.create(10, 0, 1) >= 0);
  t.after(9ms);
  CHECK(runs.empty());
  t.after(1ms);
  CHECK(runs == Runs{1});
  t.after(100ms);
  CHECK(runs == Runs{1});
}

TEST_CASE("timer: runs after its start time, then every cycle") {
  Timers t;
  t.create(3, 10, 1);
  t.after(2ms);
  CHECK(runs.empty());
  t.after(1ms);
  CHECK(runs.size() == 1);
  t.after(9ms);
  CHECK(runs.size() == 1);
  t.after(1ms);
  CHECK(runs.size() == 2);
  t.after(100ms);
  CHECK(runs.size() == 12);
}

TEST_CASE("timer: start time 0 means after a cycle") {
  Timers t;
  t.create(0, 5, 1);
  t.after(4ms);
  CHECK(runs.empty());
  t.after(1ms);
  CHECK(runs.size() == 1);
}

TEST_CASE("timer: what cannot be started") {
  Timers t;
  CHECK(t.create(0, 0, 1) == -1);
  t.error();
  t.call([&] { CHECK(COTmrCreate(&t.node.Tmr, 1, 1, nullptr, nullptr) == -1); });
  CHECK(t.error() == CO_ERR_BAD_ARG);
  CHECK(COTmrCreate(nullptr, 1, 1, note, nullptr) == -1);
  CHECK(callbacks().fatal_errors == 1);
  CO_TMR without_node{};
  CHECK(COTmrCreate(&without_node, 1, 1, note, nullptr) == -1);
  CHECK(callbacks().fatal_errors == 2);
  CHECK(COTmrService(nullptr) == -1);
  CHECK(COTmrGetTicks(nullptr, 1, 1) == 0);
  CHECK(COTmrGetMinTime(nullptr, 1) == 0);
}

TEST_CASE("timer: an exhausted pool is told and counted; a timer that has run is free again") {
  Timers t;
  std::set<std::int16_t> ids;
  for (std::uintptr_t n = 0; n < 8; ++n) {
    ids.insert(t.create(10 + static_cast<std::uint32_t>(n), 0, n));
  }
  CHECK(ids.size() == 8);
  CHECK(*ids.begin() >= 0);
  CHECK(t.create(10, 0, 99) == -1);
  CHECK(t.error() == CO_ERR_TMR_NO_ACT);
  CHECK(t.counters().TimerExhausted == 1);
  t.after(10ms);
  CHECK(runs == Runs{0});
  CHECK(t.create(1, 0, 50) >= 0);
  t.after(1ms);
  CHECK(runs == Runs{0, 1, 50});
}

TEST_CASE("timer: those that are due at one tick run in the order in which they were started") {
  Timers t;
  t.create(20, 0, 1);
  t.after(5ms);
  t.create(15, 0, 2);
  t.create(10, 0, 3);
  t.after(5ms);
  t.create(10, 0, 4);
  t.create(5, 0, 5);
  t.after(10ms);
  CHECK(runs == Runs{3, 5, 1, 2, 4});
}

TEST_CASE("timer: order at one tick is kept when the loop is late") {
  Timers t;
  t.create(20, 0, 1);
  t.create(10, 0, 2);
  t.create(15, 0, 3);
  t.create(10, 0, 4);
  t.jump(100ms);
  CHECK(runs == Runs{2, 4, 3, 1});
}

TEST_CASE("timer: a cyclic timer starts anew with each expiry, behind those started before") {
  Timers t;
  t.create(10, 10, 1);
  t.create(20, 0, 2);
  t.after(20ms);
  CHECK(runs == Runs{1, 2, 1});
}

TEST_CASE("timer: a deleted timer does not run, and cannot be deleted twice") {
  Timers t;
  const std::int16_t first = t.create(10, 0, 1);
  const std::int16_t second = t.create(10, 0, 2);
  const std::int16_t third = t.create(20, 5, 3);
  CHECK(t.remove(second) == 0);
  CHECK(t.remove(second) == -1);
  t.after(10ms);
  CHECK(runs == Runs{1});
  CHECK(t.remove(first) == -1);
  CHECK(t.remove(third) == 0);
  t.after(100ms);
  CHECK(runs == Runs{1});
}

TEST_CASE("timer: deleting the first, the middle or the last leaves the times of the others") {
  for (unsigned deleted = 0; deleted < 3; ++deleted) {
    CAPTURE(deleted);
    Timers t;
    std::int16_t ids[3];
    for (std::uint32_t n = 0; n < 3; ++n) {
      ids[n] = t.create(10 * (n + 1), 0, n);
    }
    t.after(4ms);
    CHECK(t.remove(ids[deleted]) == 0);
    for (unsigned n = 0; n < 3; ++n) {
      t.after(n == 0 ? 6ms : 10ms);
      const bool ran = !runs.empty() && runs.back() == n;
      CHECK(ran == (n != deleted));
    }
  }
}

TEST_CASE("timer: ids that never were are not deleted") {
  Timers t;
  const std::int16_t id = t.create(10, 0, 1);
  for (int other = -3; other <= 32767; ++other) {
    if (other != id) {
      REQUIRE(COTmrDelete(&t.node.Tmr, static_cast<std::int16_t>(other)) == -1);
    }
  }
  CHECK(COTmrDelete(&t.node.Tmr, -32768) == -1);
  t.after(10ms);
  CHECK(runs == Runs{1});
}

TEST_CASE("timer: an old id deletes no younger timer in the same place") {
  Timers t(Setup().timers(1));
  const std::int16_t old = t.create(1, 0, 1);
  t.after(1ms);
  for (int use = 0; use < 128; ++use) {
    const std::int16_t young = t.create(1, 0, 2);
    CHECK(young != old);
    CHECK(t.remove(old) == -1);
    CHECK(t.remove(young) == 0);
  }
}

TEST_CASE("timer: an elapsed timer that has not run yet can be deleted") {
  for (std::uintptr_t victim = 1; victim <= 4; ++victim) {
    CAPTURE(victim);
    Timers t;
    std::int16_t ids[5];
    Runs left;
    for (std::uint32_t n = 1; n <= 4; ++n) {
      ids[n] = t.create(10, n == 3 ? 10 : 0, n);
      if (n != victim) left.push_back(n);
    }
    t.elapse_only(10ms);
    CHECK(t.remove(ids[victim]) == 0);
    CHECK(t.remove(ids[victim]) == -1);
    t.call([&] { COTmrProcess(&t.node.Tmr); });
    CHECK(runs == left);
  }
}

TEST_CASE("timer: the only elapsed timer can be deleted, with nothing else in use") {
  Timers t;
  const std::int16_t id = t.create(10, 0, 1);
  t.elapse_only(10ms);
  CHECK(t.remove(id) == 0);
  CHECK(t.remove(id) == -1);
  t.call([&] { COTmrProcess(&t.node.Tmr); });
  CHECK(runs.empty());
  CHECK(t.armed_timers() == 0);
  t.create(1, 0, 2);
  t.after(1ms);
  CHECK(runs == Runs{2});
}

// Actions that work on timers themselves.
struct Plan {
  CO_TMR* tmr;
  std::int16_t target;
  std::int16_t result;
};
Plan plan;

void delete_target(void* para) {
  note(para);
  plan.result = COTmrDelete(plan.tmr, plan.target);
}

TEST_CASE("timer: an action deletes its own cyclic timer") {
  Timers t;
  t.call([&] {
    const std::int16_t id = COTmrCreate(&t.node.Tmr, 5, 5, delete_target, number(1));
    plan = {&t.node.Tmr, id, -2};
  });
  t.after(100ms);
  CHECK(runs == Runs{1});
  CHECK(plan.result == 0);
  CHECK(t.armed_timers() == 0);
}

TEST_CASE("timer: in the action of a timer that runs once its id is used up") {
  Timers t;
  t.call([&] {
    const std::int16_t id = COTmrCreate(&t.node.Tmr, 5, 0, delete_target, number(1));
    plan = {&t.node.Tmr, id, -2};
  });
  t.after(100ms);
  CHECK(runs == Runs{1});
  CHECK(plan.result == -1);
}

TEST_CASE("timer: an action deletes a timer of the same tick, which then does not run") {
  for (const std::uint32_t cycle : {0U, 5U}) {
    CAPTURE(cycle);
    Timers t;
    t.call([&] { COTmrCreate(&t.node.Tmr, 5, 0, delete_target, number(1)); });
    plan = {&t.node.Tmr, t.create(5, cycle, 2), -2};
    t.create(5, 0, 3);
    t.after(50ms);
    CHECK(runs == Runs{1, 3});
    CHECK(plan.result == 0);
  }
}

TEST_CASE("timer: an action deletes another one that is still to come") {
  Timers t;
  t.call([&] { COTmrCreate(&t.node.Tmr, 5, 0, delete_target, number(1)); });
  plan = {&t.node.Tmr, t.create(6, 0, 2), -2};
  t.create(7, 0, 3);
  t.after(50ms);
  CHECK(runs == Runs{1, 3});
  CHECK(plan.result == 0);
}

void create_another(void* para) {
  note(para);
  COTmrCreate(plan.tmr, 5, 0, note, number(7));
}

TEST_CASE("timer: an action creates a timer, in the place that its own has left") {
  Timers t(Setup().timers(1));
  plan = {&t.node.Tmr, -1, -2};
  t.call([&] { COTmrCreate(&t.node.Tmr, 5, 0, create_another, number(1)); });
  t.after(9ms);
  CHECK(runs == Runs{1});
  t.after(1ms);
  CHECK(runs == Runs{1, 7});
}

TEST_CASE("timer: a late loop runs a cyclic timer once and keeps its phase [Q8]") {
  Timers t;
  t.create(10, 10, 1);
  t.jump(95ms);
  CHECK(runs.size() == 1);
  t.after(4ms);
  CHECK(runs.size() == 1);
  t.after(1ms);
  CHECK(runs.size() == 2);
  t.jump(100ms);
  CHECK(runs.size() == 3);
  t.after(10ms);
  CHECK(runs.size() == 4);
}

TEST_CASE("timer: no drift in a million ticks, with cycles that do not divide them [T15]") {
  for (const std::uint32_t start : clock_starts) {
    CAPTURE(start);
    Timers t(Setup().clock(start));
    t.create(7, 7, 7);
    t.create(13, 1000, 13);
    t.after(1000000ms);
    unsigned sevens = 0;
    for (const std::uintptr_t n : runs) sevens += n == 7 ? 1U : 0U;
    CHECK(sevens == 1000000 / 7);
    CHECK(runs.size() - sevens == 1000);
  }
}

TEST_CASE("timer: the longest times [T15]") {
  for (const std::uint32_t start : clock_starts) {
    Timers t(Setup().clock(start));
    t.create(0x7FFFFFFF, 0, 1);
    t.create(0xFFFFFFFF, 0, 2);
    t.after(0x7FFFFFFE * 1ms);
    CHECK(runs.empty());
    t.after(1ms);
    CHECK(runs == Runs{1});
    t.after(0x7FFFFFFF * 1ms);
    CHECK(runs == Runs{1});
    t.after(1ms);
    CHECK(runs == Runs{1, 2});
  }
}

TEST_CASE("timer: the next deadline") {
  Timers t;
  CHECK(CONodeNextDeadline(&t.node) == 0xFFFFFFFF);
  const std::int16_t far = t.create(100, 0, 1);
  CHECK(CONodeNextDeadline(&t.node) == 100);
  const std::int16_t near = t.create(30, 0, 2);
  CHECK(CONodeNextDeadline(&t.node) == 30);
  t.remove(near);
  CHECK(CONodeNextDeadline(&t.node) == 100);
  t.after(40ms);
  CHECK(CONodeNextDeadline(&t.node) == 60);
  t.elapse_only(60ms);
  CHECK(CONodeNextDeadline(&t.node) == 0);
  t.call([&] { COTmrProcess(&t.node.Tmr); });
  CHECK(runs == Runs{1});
  CHECK(CONodeNextDeadline(&t.node) == 0xFFFFFFFF);
  t.remove(far);
}

TEST_CASE("timer: COTmrService tells whether an elapsed timer waits for the loop") {
  Timers t;
  t.elapse_only(0ms, 0);
  t.create(10, 0, 1);
  t.elapse_only(9ms, 0);
  t.elapse_only(1ms, 1);
  t.elapse_only(5ms, 1);
  t.call([&] { COTmrProcess(&t.node.Tmr); });
  CHECK(runs == Runs{1});
  t.elapse_only(5ms, 0);
}

TEST_CASE("timer: the lock is held around the lists, not nested, and not in actions") {
  Timers t;
  static int depth;
  static int deepest;
  depth = deepest = 0;
  callbacks().lock = [&] { deepest = ++depth > deepest ? depth : deepest; };
  callbacks().unlock = [&] { --depth; };
  t.call([&] {
    COTmrCreate(
        &t.node.Tmr, 5, 5,
        [](void* para) {
          CHECK(depth == 0);
          note(para);
        },
        number(1));
    const std::int16_t id = COTmrCreate(&t.node.Tmr, 5, 0, note, nullptr);
    COTmrDelete(&t.node.Tmr, id);
  });
  t.after(20ms);
  CHECK(runs.size() == 4);
  CHECK(depth == 0);
  CHECK(deepest == 1);
}

TEST_CASE("timer: random creations and deletions, against a model") {
  struct Expected {
    std::int16_t id;
    std::uint64_t at;
    std::uint32_t cycle;
    std::uintptr_t n;
    std::uint64_t order;
  };
  std::mt19937 random(4711);
  for (int round = 0; round < 30; ++round) {
    Timers t(Setup().clock(round % 3 == 0 ? 0xFFFFFF00 : 0));
    std::vector<Expected> model;
    Runs expected;
    std::uint64_t order = 0;
    for (std::uintptr_t step = 1; step < 300; ++step) {
      if (random() % 3 == 0 && model.size() < 8) {
        const std::uint32_t start = 1 + static_cast<std::uint32_t>(random() % 20);
        const std::uint32_t cycle = random() % 2 == 0 ? 0 : 1 + static_cast<std::uint32_t>(random() % 20);
        model.push_back({t.create(start, cycle, step), t.now() + start, cycle, step, order++});
      } else if (random() % 4 == 0 && !model.empty()) {
        const auto victim = model.begin() + static_cast<std::ptrdiff_t>(random() % model.size());
        CHECK(t.remove(victim->id) == 0);
        model.erase(victim);
      }
      const std::uint64_t end = t.now() + random() % 5;
      t.after(std::chrono::milliseconds{end - t.now()});
      for (;;) {
        auto next = model.end();
        for (auto it = model.begin(); it != model.end(); ++it) {
          const bool sooner =
              next == model.end() || it->at < next->at || (it->at == next->at && it->order < next->order);
          if (it->at <= end && sooner) next = it;
        }
        if (next == model.end()) break;
        expected.push_back(next->n);
        if (next->cycle == 0) {
          model.erase(next);
        } else {
          next->at += next->cycle;
          next->order = order++;
        }
      }
    }
    CHECK(runs == expected);
  }
}

// Drivers without context ---------------------------------------------------------------------------------------------

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
    runs.clear();
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
    CHECK(runs.empty());
    t.tick();
    CHECK(runs == Runs{2});
    t.create(2, 0, 3);
    t.ticks(2);
    CHECK(runs == Runs{2, 1, 3});
    t.ticks(2);
    CHECK(runs == Runs{2, 1, 3, 2});
    t.ticks(8);
    CHECK(runs == Runs{2, 1, 3, 2, 2, 2});
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
    for (const std::uintptr_t n : runs) sevens += n == 7 ? 1U : 0U;
    CHECK(sevens == 1000000 / 7);
    CHECK(runs.size() - sevens == 100000);
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
    CHECK(runs.size() == 100);
    runs.clear();
    t.ticks(9);
    CHECK(runs.empty());
    t.tick();
    CHECK(runs.size() == 1);
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
    CHECK(runs == Runs{1});
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
    CHECK(runs.empty());
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
    CHECK(runs == Runs{2});
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
    CHECK(runs.empty());
    t.tick();
    CHECK(runs == Runs{2});
    t.ticks(29);
    CHECK(runs == Runs{2});
    t.tick();
    CHECK(runs == Runs{2, 1});
  }
}

}  // namespace
