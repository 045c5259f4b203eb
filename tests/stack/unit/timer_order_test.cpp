// SPDX-License-Identifier: Apache-2.0
// Order of the list of armed timers after timers were deleted or have elapsed.
#include <algorithm>
#include <memory>
#include <random>

#include "support/plain_drivers.hpp"
#include "support/timers.hpp"

namespace {

using namespace test;

// A node with a free-running clock, and a loop that is never late.
class Clocked {
 public:
  explicit Clocked(std::uint32_t start) : timers_(Setup().clock(start)) {}
  std::int16_t create(std::uint32_t start, std::uint32_t cycle, std::uintptr_t n) {
    return timers_.create(start, cycle, n);
  }
  std::int16_t remove(std::int16_t id) { return timers_.remove(id); }
  void pass(unsigned ticks) { timers_.after(std::chrono::milliseconds{ticks}); }

 private:
  Timers timers_;
};

class Counting {
 public:
  explicit Counting(bool cyclic) : plain_(cyclic) { runs().clear(); }
  std::int16_t create(std::uint32_t start, std::uint32_t cycle, std::uintptr_t n) {
    return COTmrCreate(&plain_.node.Tmr, start, cycle, note, number(n));
  }
  std::int16_t remove(std::int16_t id) { return COTmrDelete(&plain_.node.Tmr, id); }
  void pass(unsigned ticks) { plain_.ticks(ticks); }

 private:
  PlainNode plain_;
};

// Calls the function with each kind of driver: clocks with different start values, cyclic and tickless counters.
template <class Check>
void with_each_driver(Check check) {
  for (const std::uint32_t start : clock_starts) {
    CAPTURE(start);
    check([=] { return std::make_unique<Clocked>(start); });
  }
  for (const bool cyclic : {true, false}) {
    CAPTURE(cyclic);
    check([=] { return std::make_unique<Counting>(cyclic); });
  }
}

TEST_CASE("timer order: after any deletions new timers are sorted correctly") {
  with_each_driver([](const auto& make) {
    for (unsigned deleted = 0; deleted < 16; ++deleted) {
      CAPTURE(deleted);
      const auto timers = make();
      std::int16_t ids[4];
      Runs expected;
      for (std::uint32_t n = 0; n < 4; ++n) {
        ids[n] = timers->create(10 * (n + 1), 0, 10 * (n + 1));
      }
      for (unsigned n = 4; n > 0; --n) {
        if ((deleted >> (n - 1) & 1) != 0) CHECK(timers->remove(ids[n - 1]) == 0);
      }
      for (const std::uint32_t at : {40U, 5U, 45U, 25U}) {
        CHECK(timers->create(at, 0, 100 + at) >= 0);
      }
      for (unsigned at = 5; at <= 45; at += 5) {
        const bool is_left = at % 10 == 0 && (deleted >> (at / 10 - 1) & 1) == 0;
        if (is_left) expected.push_back(at);
        if (at == 5 || at == 25 || at == 40 || at == 45) expected.push_back(100 + at);
      }
      timers->pass(45);
      CHECK(runs() == expected);
    }
  });
}

TEST_CASE("timer order: after all timers have elapsed or are deleted new ones start a new list") {
  with_each_driver([](const auto& make) {
    const auto timers = make();
    timers->create(1, 0, 1);
    timers->create(2, 0, 2);
    timers->pass(3);
    timers->create(8, 0, 3);
    timers->create(4, 0, 4);
    timers->pass(8);
    CHECK(runs() == Runs{1, 2, 4, 3});
    const std::int16_t only = timers->create(5, 0, 5);
    CHECK(timers->remove(only) == 0);
    timers->create(3, 0, 6);
    timers->create(3, 0, 7);
    timers->create(2, 0, 8);
    timers->pass(3);
    CHECK(runs() == Runs{1, 2, 4, 3, 8, 6, 7});
  });
}

// Model of timers, with a clock that does not wrap.
class Model {
 public:
  void create(std::int16_t id, std::uint32_t start, std::uint32_t cycle, std::uintptr_t n) {
    timers_.push_back({id, now_ + start, cycle, n, order_++});
  }
  std::size_t size() const { return timers_.size(); }
  std::int16_t remove(std::size_t victim) {
    const std::int16_t id = timers_[victim].id;
    timers_.erase(timers_.begin() + static_cast<std::ptrdiff_t>(victim));
    return id;
  }
  void pass(unsigned ticks) {
    for (now_ += ticks; !timers_.empty();) {
      const auto next = std::min_element(timers_.begin(), timers_.end(), [](const Timer& a, const Timer& b) {
        return a.at != b.at ? a.at < b.at : a.order < b.order;
      });
      if (next->at > now_) return;
      runs.push_back(next->n);
      if (next->cycle == 0) {
        timers_.erase(next);
      } else {
        next->at += next->cycle;
        next->order = order_++;
      }
    }
  }

  Runs runs;

 private:
  struct Timer {
    std::int16_t id;
    std::uint64_t at;
    std::uint32_t cycle;
    std::uintptr_t n;
    std::uint64_t order;
  };
  std::vector<Timer> timers_;
  std::uint64_t now_ = 0;
  std::uint64_t order_ = 0;
};

TEST_CASE("timer order: random creations and deletions with drivers without a clock have the results of a model") {
  std::mt19937 random(1947);
  for (int round = 0; round < 60; ++round) {
    Counting timers(round % 2 == 0);
    Model model;
    for (std::uintptr_t step = 1; step < 400; ++step) {
      if (random() % 3 == 0 && model.size() < 8) {
        const std::uint32_t start = 1 + static_cast<std::uint32_t>(random() % 12);
        const std::uint32_t cycle = random() % 2 == 0 ? 0 : 1 + static_cast<std::uint32_t>(random() % 12);
        const std::int16_t id = timers.create(start, cycle, step);
        REQUIRE(id >= 0);
        model.create(id, start, cycle, step);
      } else if (random() % 4 == 0 && model.size() != 0) {
        CHECK(timers.remove(model.remove(random() % model.size())) == 0);
      }
      const auto ticks = static_cast<unsigned>(random() % 4);
      for (unsigned n = 0; n < ticks; ++n) {
        timers.pass(1);
        model.pass(1);
      }
    }
    CHECK(runs() == model.runs);
  }
}

TEST_CASE("timer order: a pool whose size is no power of two has ids for all its timers") {
  for (const std::uint16_t size : {std::uint16_t{1}, std::uint16_t{3}, std::uint16_t{5}, std::uint16_t{7}}) {
    CAPTURE(size);
    Timers t(Setup().timers(size));
    for (int generation = 0; generation < 3; ++generation) {
      std::vector<std::int16_t> ids;
      for (unsigned n = 0; n < size; ++n) {
        ids.push_back(t.create(100, 0, n));
      }
      std::sort(ids.begin(), ids.end());
      CHECK(ids.front() >= 0);
      CHECK(std::adjacent_find(ids.begin(), ids.end()) == ids.end());
      for (const std::int16_t id : ids) {
        CHECK(t.remove(id) == 0);
        CHECK(t.remove(id) == -1);
      }
    }
  }
}

TEST_CASE("timer order: an identifier is reused after 32768 / (pool size) uses of its slot, not before") {
  Timers t(Setup().timers(4));
  std::vector<std::int16_t> ids;
  for (int use = 0; use <= 8192; ++use) {
    ids.push_back(COTmrCreate(&t.node.Tmr, 1, 0, note, nullptr));
    CHECK(COTmrDelete(&t.node.Tmr, ids.back()) == 0);
  }
  CHECK(ids.back() == ids.front());
  ids.pop_back();
  std::sort(ids.begin(), ids.end());
  CHECK(ids.front() >= 0);
  CHECK(std::adjacent_find(ids.begin(), ids.end()) == ids.end());
}

}  // namespace
