// SPDX-License-Identifier: Apache-2.0
#include "support/plain_drivers.hpp"
#include "support/timers.hpp"

namespace {

using namespace test;

// A node with a classic driver, cyclic or tickless.
struct OldNode : PlainNode {
  explicit OldNode(bool cyclic) : PlainNode(cyclic) { runs().clear(); }
  std::int16_t create(std::uint32_t start, std::uint32_t cycle, std::uintptr_t n) {
    return COTmrCreate(&node.Tmr, start, cycle, note, number(n));
  }
};

const PlainTimer& old = plain_timer();

TEST_CASE("timer: timers run on time with cyclic and with tickless classic drivers") {
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

TEST_CASE("timer: a classic driver that has elapsed is not programmed again before COTmrService()") {
  OldNode t(false);
  t.create(3, 0, 1);
  plain_timer().now += 3;
  plain_timer().left = 0;  // compare match; its interrupt is not processed yet
  const std::int16_t id = t.create(1, 0, 2);
  CHECK(plain_timer().left == 0);
  CHECK(COTmrDelete(&t.node.Tmr, id) == 0);
  CHECK(plain_timer().left == 0);
  t.create(1, 0, 3);
  CHECK(COTmrService(&t.node.Tmr) == 1);
  CHECK(plain_timer().left == 1);
  COTmrProcess(&t.node.Tmr);
  CHECK(runs() == Runs{1});
  t.tick();
  CHECK(runs() == Runs{1, 3});
}

bool is_refusing = false;
std::int16_t send_unless_refusing(CO_IF_FRM*) { return is_refusing ? std::int16_t{0} : sizeof(CO_IF_FRM); }

TEST_CASE("timer: classic drivers: COTmrService() returns 1 in each tick while a frame is queued") {
  OldNode t(true);
  CO_IF_CAN_DRV can = *t.drivers.Can;
  can.Send = send_unless_refusing;
  t.drivers.Can = &can;
  CO_IF_FRM frm{0x181, {}, 8};
  CHECK(COTmrService(&t.node.Tmr) == 0);
  is_refusing = true;
  CHECK(COIfCanSend(&t.node.If, &frm) == sizeof(CO_IF_FRM));
  CHECK(COTmrService(&t.node.Tmr) == 1);
  COTmrProcess(&t.node.Tmr);
  CHECK(COTmrService(&t.node.Tmr) == 1);
  is_refusing = false;
  COTmrProcess(&t.node.Tmr);
  CHECK(CONodeGetCounters(&t.node).Sent == 2);  // the boot-up message and this frame
  CHECK(COTmrService(&t.node.Tmr) == 0);
}

TEST_CASE("timer: classic drivers have no drift in a million ticks") {
  for (const bool cyclic : {true, false}) {
    CAPTURE(cyclic);
    OldNode t(cyclic);
    t.create(7, 7, 7);
    t.create(10, 10, 10);
    constexpr unsigned number = 1000000 / stride(20);
    t.ticks(number);
    unsigned sevens = 0;
    for (const std::uintptr_t n : runs()) sevens += n == 7 ? 1U : 0U;
    CHECK(sevens == number / 7);
    CHECK(runs().size() - sevens == number / 10);
  }
}

TEST_CASE("timer: classic drivers have no drift with a late main loop") {
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

TEST_CASE("timer: a spurious interrupt without timers or with all elapsed has no effect") {
  for (const bool cyclic : {true, false}) {
    CAPTURE(cyclic);
    OldNode t(cyclic);
    plain_timer().update_always = true;
    CHECK(COTmrService(&t.node.Tmr) == 0);
    CHECK(COTmrService(&t.node.Tmr) == 0);
    COTmrProcess(&t.node.Tmr);
    plain_timer().update_always = false;
    t.create(2, 0, 1);
    t.ticks(2, false);
    plain_timer().update_always = true;
    CHECK(COTmrService(&t.node.Tmr) == 1);
    COTmrProcess(&t.node.Tmr);
    CHECK(runs() == Runs{1});
    CHECK(COTmrService(&t.node.Tmr) == 0);
  }
}

TEST_CASE("timer: classic drivers: an elapsed timer may be deleted without other timers") {
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

TEST_CASE("timer: classic drivers are stopped when no timer is running") {
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

TEST_CASE("timer: classic drivers: a shorter timer may be started within a longer one") {
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
