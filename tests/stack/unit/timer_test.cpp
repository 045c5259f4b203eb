// SPDX-License-Identifier: Apache-2.0
#include <set>

#include "support/timers.hpp"

namespace {

using namespace test;

TEST_CASE("timer: runs once, exactly at its time") {
  Timers t;
  CHECK(t.create(10, 0, 1) >= 0);
  t.after(9ms);
  CHECK(runs().empty());
  t.after(1ms);
  CHECK(runs() == Runs{1});
  t.after(100ms);
  CHECK(runs() == Runs{1});
}

TEST_CASE("timer: runs after its start time, then every cycle") {
  Timers t;
  t.create(3, 10, 1);
  t.after(2ms);
  CHECK(runs().empty());
  t.after(1ms);
  CHECK(runs().size() == 1);
  t.after(9ms);
  CHECK(runs().size() == 1);
  t.after(1ms);
  CHECK(runs().size() == 2);
  t.after(100ms);
  CHECK(runs().size() == 12);
}

TEST_CASE("timer: start time 0 means after a cycle") {
  Timers t;
  t.create(0, 5, 1);
  t.after(4ms);
  CHECK(runs().empty());
  t.after(1ms);
  CHECK(runs().size() == 1);
}

TEST_CASE("timer: invalid timers are refused") {
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

TEST_CASE("timer: an exhausted pool is reported and counted; a timer that has run is free again") {
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
  CHECK(runs() == Runs{0});
  CHECK(t.create(1, 0, 50) >= 0);
  t.after(1ms);
  CHECK(runs() == Runs{0, 1, 50});
}

TEST_CASE("timer: timers due at one tick run in the order in which they were started") {
  Timers t;
  t.create(20, 0, 1);
  t.after(5ms);
  t.create(15, 0, 2);
  t.create(10, 0, 3);
  t.after(5ms);
  t.create(10, 0, 4);
  t.create(5, 0, 5);
  t.after(10ms);
  CHECK(runs() == Runs{3, 5, 1, 2, 4});
}

TEST_CASE("timer: the order at one tick is kept with a late main loop") {
  Timers t;
  t.create(20, 0, 1);
  t.create(10, 0, 2);
  t.create(15, 0, 3);
  t.create(10, 0, 4);
  t.jump(100ms);
  CHECK(runs() == Runs{2, 4, 3, 1});
}

TEST_CASE("timer: each expiry of a cyclic timer starts it again, after those started before") {
  Timers t;
  t.create(10, 10, 1);
  t.create(20, 0, 2);
  t.after(20ms);
  CHECK(runs() == Runs{1, 2, 1});
}

TEST_CASE("timer: the lock is held around the lists, not nested and not in actions") {
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
  CHECK(runs().size() == 4);
  CHECK(depth == 0);
  CHECK(deepest == 1);
}

}  // namespace
