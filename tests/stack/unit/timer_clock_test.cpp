// SPDX-License-Identifier: Apache-2.0
#include <random>

#include "support/timers.hpp"

namespace {

using namespace test;

TEST_CASE("timer: a late main loop runs a cyclic timer once and keeps its phase [Q8]") {
  Timers t;
  t.create(10, 10, 1);
  t.jump(95ms);
  CHECK(runs().size() == 1);
  t.after(4ms);
  CHECK(runs().size() == 1);
  t.after(1ms);
  CHECK(runs().size() == 2);
  t.jump(100ms);
  CHECK(runs().size() == 3);
  t.after(10ms);
  CHECK(runs().size() == 4);
}

TEST_CASE("timer: no drift in a million ticks with cycles that do not divide them [T15]") {
  for (const std::uint32_t start : clock_starts) {
    CAPTURE(start);
    Timers t(Setup().clock(start));
    t.create(7, 7, 7);
    t.create(13, 1000, 13);
    const unsigned ticks = 1000000 / stride(50);
    t.after(ticks * 1ms);
    unsigned sevens = 0;
    for (const std::uintptr_t n : runs()) sevens += n == 7 ? 1U : 0U;
    CHECK(sevens == ticks / 7);
    CHECK(runs().size() - sevens == ticks / 1000);
  }
}

TEST_CASE("timer: the longest times are kept [T15]") {
  for (const std::uint32_t start : clock_starts) {
    Timers t(Setup().clock(start));
    t.create(0x7FFFFFFF, 0, 1);
    t.create(0xFFFFFFFF, 0, 2);
    t.after(0x7FFFFFFE * 1ms);
    CHECK(runs().empty());
    t.after(1ms);
    CHECK(runs() == Runs{1});
    t.after(0x7FFFFFFF * 1ms);
    CHECK(runs() == Runs{1});
    t.after(1ms);
    CHECK(runs() == Runs{1, 2});
  }
}

TEST_CASE("timer: the next deadline is that of the first timer") {
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
  CHECK(runs() == Runs{1});
  CHECK(CONodeNextDeadline(&t.node) == 0xFFFFFFFF);
  t.remove(far);
}

TEST_CASE("timer: COTmrService returns whether an elapsed timer is pending for the main loop") {
  Timers t;
  t.elapse_only(0ms, 0);
  t.create(10, 0, 1);
  t.elapse_only(9ms, 0);
  t.elapse_only(1ms, 1);
  t.elapse_only(5ms, 1);
  t.call([&] { COTmrProcess(&t.node.Tmr); });
  CHECK(runs() == Runs{1});
  t.elapse_only(5ms, 0);
}

TEST_CASE("timer: random creations and deletions have the results of a model") {
  struct Expected {
    std::int16_t id;
    std::uint64_t at;
    std::uint32_t cycle;
    std::uintptr_t n;
    std::uint64_t order;
  };
  std::mt19937 random(4711);
  for (unsigned round = 0; round < 30 / stride(5); ++round) {
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
    CHECK(runs() == expected);
  }
}

}  // namespace
