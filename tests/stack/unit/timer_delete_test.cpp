// SPDX-License-Identifier: Apache-2.0
#include "support/timers.hpp"

namespace {

using namespace test;

TEST_CASE("timer: a deleted timer does not run and cannot be deleted twice") {
  Timers t;
  const std::int16_t first = t.create(10, 0, 1);
  const std::int16_t second = t.create(10, 0, 2);
  const std::int16_t third = t.create(20, 5, 3);
  CHECK(t.remove(second) == 0);
  CHECK(t.remove(second) == -1);
  t.after(10ms);
  CHECK(runs() == Runs{1});
  CHECK(t.remove(first) == -1);
  CHECK(t.remove(third) == 0);
  t.after(100ms);
  CHECK(runs() == Runs{1});
}

TEST_CASE("timer: deleting the first, the middle or the last one does not change the times of the others") {
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
      const bool ran = !runs().empty() && runs().back() == n;
      CHECK(ran == (n != deleted));
    }
  }
}

TEST_CASE("timer: unknown identifiers are refused") {
  Timers t;
  const std::int16_t id = t.create(10, 0, 1);
  for (int other = -3; other <= 32767; ++other) {
    if (other != id) {
      REQUIRE(COTmrDelete(&t.node.Tmr, static_cast<std::int16_t>(other)) == -1);
    }
  }
  CHECK(COTmrDelete(&t.node.Tmr, -32768) == -1);
  t.after(10ms);
  CHECK(runs() == Runs{1});
}

TEST_CASE("timer: an old identifier does not delete a newer timer in the same slot") {
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
    CHECK(runs() == left);
  }
}

TEST_CASE("timer: the only elapsed timer can be deleted while no other timer is in use") {
  Timers t;
  const std::int16_t id = t.create(10, 0, 1);
  t.elapse_only(10ms);
  CHECK(t.remove(id) == 0);
  CHECK(t.remove(id) == -1);
  t.call([&] { COTmrProcess(&t.node.Tmr); });
  CHECK(runs().empty());
  CHECK(t.armed_timers() == 0);
  t.create(1, 0, 2);
  t.after(1ms);
  CHECK(runs() == Runs{2});
}

// Arguments and result of an action that deletes a timer.
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

TEST_CASE("timer: an action may delete its own cyclic timer") {
  Timers t;
  t.call([&] {
    const std::int16_t id = COTmrCreate(&t.node.Tmr, 5, 5, delete_target, number(1));
    plan = {&t.node.Tmr, id, -2};
  });
  t.after(100ms);
  CHECK(runs() == Runs{1});
  CHECK(plan.result == 0);
  CHECK(t.armed_timers() == 0);
}

TEST_CASE("timer: the identifier of a one-shot timer is invalid within its action") {
  Timers t;
  t.call([&] {
    const std::int16_t id = COTmrCreate(&t.node.Tmr, 5, 0, delete_target, number(1));
    plan = {&t.node.Tmr, id, -2};
  });
  t.after(100ms);
  CHECK(runs() == Runs{1});
  CHECK(plan.result == -1);
}

TEST_CASE("timer: an action may delete a timer of the same tick, which then does not run") {
  for (const std::uint32_t cycle : {0U, 5U}) {
    CAPTURE(cycle);
    Timers t;
    t.call([&] { COTmrCreate(&t.node.Tmr, 5, 0, delete_target, number(1)); });
    plan = {&t.node.Tmr, t.create(5, cycle, 2), -2};
    t.create(5, 0, 3);
    t.after(50ms);
    CHECK(runs() == Runs{1, 3});
    CHECK(plan.result == 0);
  }
}

TEST_CASE("timer: an action may delete another timer that has not elapsed") {
  Timers t;
  t.call([&] { COTmrCreate(&t.node.Tmr, 5, 0, delete_target, number(1)); });
  plan = {&t.node.Tmr, t.create(6, 0, 2), -2};
  t.create(7, 0, 3);
  t.after(50ms);
  CHECK(runs() == Runs{1, 3});
  CHECK(plan.result == 0);
}

void create_another(void* para) {
  note(para);
  COTmrCreate(plan.tmr, 5, 0, note, number(7));
}

TEST_CASE("timer: an action may create a timer in its own slot") {
  Timers t(Setup().timers(1));
  plan = {&t.node.Tmr, -1, -2};
  t.call([&] { COTmrCreate(&t.node.Tmr, 5, 0, create_another, number(1)); });
  t.after(9ms);
  CHECK(runs() == Runs{1});
  t.after(1ms);
  CHECK(runs() == Runs{1, 7});
}

}  // namespace
