// SPDX-License-Identifier: Apache-2.0
// The clock of TIME: exact to 1 ms for all timer frequencies and intervals of the loop. [T15] [Q8]
#include <random>

#include "support/fixture.hpp"
#include "support/plain_drivers.hpp"

#if USE_TIME

namespace {

using namespace test;

constexpr std::uint64_t day = 86400000;  // ms
constexpr CO_TIME_OF_DAY set_to = {86399990, 15665};

CO_TIME_OF_DAY time_of(CO_NODE& node) {
  CO_TIME_OF_DAY now{};
  COTimeGet(&node, &now);
  return now;
}

// Returns the milliseconds since the beginning of day 0.
std::uint64_t ms_of(const CO_TIME_OF_DAY& time) { return time.Days * day + time.Ms; }

void set(Fixture& node) {
  node.call([&] { CHECK(COTimeSet(&node.node, &set_to) == CO_ERR_NONE); });
}

struct Clock : Fixture {
  std::uint32_t rate;
  std::uint64_t set_at;
  Clock(std::uint32_t ticks_per_second, std::uint32_t start)
      : Fixture(Setup().only_small().rate(ticks_per_second).clock(start)), rate(ticks_per_second) {
    after(123ms);
    set(*this);
    set_at = now();
  }
  std::uint64_t passed_ms() const { return (now() - set_at) * 1000 / rate; }
  bool is_right() {
    CO_TIME_OF_DAY time{};
    call([&] { time = time_of(node); });
    return time.Ms < day && ms_of(time) == ms_of(set_to) + passed_ms();
  }
};

TEST_CASE("clock: correct to the millisecond for 30 days with a main loop up to 40 minutes late [T15] [Q8]") {
  for (const std::uint32_t rate : {1000U, 32768U, 1000000U, 300U}) {
    for (const std::uint32_t start : clock_starts) {
      CAPTURE(rate);
      CAPTURE(start);
      std::mt19937 random(rate);
      Clock clock(rate, start);
      unsigned wrong = 0;
      while (clock.passed_ms() < 30 / stride(15) * day) {
        const std::chrono::milliseconds longest = random() % 2 == 0 ? 40min : 3s;
        clock.jump(Time{random() % (1000 * static_cast<std::uint64_t>(longest.count()))});
        wrong += clock.is_right() ? 0U : 1U;
      }
      CHECK(wrong == 0);
      CHECK(time_of(clock.node).Days == set_to.Days + 30 / stride(15) + 1);
    }
  }
}

TEST_CASE("clock: correct to the millisecond for a night with a punctual main loop [T15]") {
  for (const std::uint32_t rate : clock_rates) {
    for (const std::uint32_t start : clock_starts) {
      CAPTURE(rate);
      CAPTURE(start);
      std::mt19937 random(rate);
      Clock clock(rate, start);
      unsigned wrong = 0;
      while (clock.passed_ms() < day / 3 / stride(40)) {
        clock.after(Time{random() % 200000000});
        wrong += clock.is_right() ? 0U : 1U;
      }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("clock: it can be read before and after the timer runs at every tick of three seconds") {
  for (const std::uint32_t rate : {300U, 1024U}) {
    Clock clock(rate, 0xFFFFFFFFU - rate);
    for (unsigned tick = 0; tick < 3 * rate; ++tick) {
      const Time one{1000000 / rate};
      clock.elapse_only(one, (tick + 1) % rate == 0 ? 1 : 0);
      CHECK(clock.is_right());
      clock.jump(Time{0});
      CHECK(clock.is_right());
    }
  }
}

TEST_CASE("clock: correct with the fastest timers") {
  for (const std::uint32_t rate : {80000000U, 429000000U}) {
    CAPTURE(rate);
    std::mt19937 random(1);
    Clock clock(rate, 0x80000000);
    unsigned wrong = 0;
    for (int i = 0; i < 1000; ++i) {
      clock.after(Time{random() % 3000000});
      wrong += clock.is_right() ? 0U : 1U;
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("clock: it is correct with a timer of 1 Hz and 100 years late") {
  Clock clock(1, 0);
  clock.after(1000s);
  CHECK(clock.is_right());
  clock.jump(std::chrono::hours{24 * 365 * 100});
  CHECK(clock.is_right());
}

TEST_CASE("clock: without a running timer it is 0 until it is set") {
  Fixture node(Setup().only_small());
  CO_TIME_OF_DAY now{1, 1};
  CHECK(COTimeGet(&node.node, &now) == CO_ERR_OBJ_NO_DATA);
  CHECK(ms_of(now) == 0);
  CHECK(node.armed_timers() == 0);
  node.after(10s);
  CHECK(ms_of(time_of(node.node)) == 0);
  set(node);
  CHECK(COTimeGet(&node.node, &now) == CO_ERR_NONE);
  CHECK(ms_of(now) == ms_of(set_to));
  CHECK(node.armed_timers() == 1);
  set(node);
  CHECK(node.armed_timers() == 1);
}

TEST_CASE("clock: runs through NMT states and resets and ends with CONodeStop()") {
  Fixture node(Setup().only_small());
  set(node);
  for (const char* command : {"000#0101", "000#0201", "000#8001", "000#8201", "000#8101"}) {
    node.rx(command);
    node.trace();
    node.after(1000ms);
  }
  CHECK(ms_of(time_of(node.node)) == ms_of(set_to) + 5000);
  node.call([&] { CONodeStop(&node.node); });
  CHECK(node.armed_timers() == 0);
  CHECK(ms_of(time_of(node.node)) == 0);
  CHECK(COTimeSet(&node.node, &set_to) == CO_ERR_NMT_MODE);
  node.init_again();
  CHECK(ms_of(time_of(node.node)) == 0);
  set(node);
  CHECK(ms_of(time_of(node.node)) == ms_of(set_to));
}

TEST_CASE("clock: wrong arguments are refused and change nothing") {
  Fixture node(Setup().only_small());
  CO_TIME_OF_DAY time{86400000, 1};
  CHECK(COTimeSet(nullptr, &time) == CO_ERR_BAD_ARG);
  CHECK(COTimeSet(&node.node, nullptr) == CO_ERR_BAD_ARG);
  CHECK(COTimeSet(&node.node, &time) == CO_ERR_BAD_ARG);
  CHECK(COTimeGet(nullptr, &time) == CO_ERR_BAD_ARG);
  CHECK(COTimeGet(&node.node, nullptr) == CO_ERR_BAD_ARG);
  CHECK(COTimeGet(&node.node, &time) == CO_ERR_OBJ_NO_DATA);
}

TEST_CASE("clock: without a frequency of the timer it cannot be set and returns 0") {
  Fixture node(Setup().only_small().timers(0).before_init([](Objects&) {}));
  node->Tmr.Freq = 0;
  CHECK(COTimeSet(&node.node, &set_to) == CO_ERR_TMR_CREATE);
  CHECK(ms_of(time_of(node.node)) == 0);
  node->Tmr.Freq = 1000;
}

// --- The clock as an object

Setup with_clock() { return Setup().only_small().with({CO_KEY(0x2500, 0, CO_OBJ____PRW), CO_TTIME_CLOCK, 0}); }

TEST_CASE("clock: read and written through its object [301:7.1.6.5]") {
  Fixture node(with_clock());
  node.ask("601#4000250000000000", "581#4100250006000000");
  node.ask("601#6000000000000000", "581#0300000000000000");
  node.ask("601#2100250006000000", "581#6000250000000000");
  node.ask("601#03952CB302313D00", "581#2000000000000000");
  CHECK(ms_of(time_of(node.node)) == 15665 * day + 45296789);
  node.after(1000ms);
  node.ask("601#4000250000000000", "581#4100250006000000");
  node.ask("601#6000000000000000", "581#037D30B302313D00");
}

TEST_CASE("clock: its object refuses 24:00 and other lengths and ignores the reserved bits") {
  Fixture node(with_clock());
  CHECK(node.download(0x2500, 0, {0x00, 0x5C, 0x26, 0x05, 0x01, 0x00}) == 0x06090030);
  CHECK(node.download(0x2500, 0, {0x00, 0x5C, 0x26, 0x05, 0x01}) == 0x06070013);
  CHECK(node.download(0x2500, 0, {0x00, 0x5C, 0x26, 0x05, 0x01, 0x00, 0x00}) == 0x06070012);
  CHECK(ms_of(time_of(node.node)) == 0);
  CHECK(node.download(0x2500, 0, {0xFF, 0x5B, 0x26, 0xF5, 0x01, 0x00}) == 0);
  CHECK(ms_of(time_of(node.node)) == 2 * day - 1);
  node.after(1ms);
  CHECK(node.upload(0x2500, 0) == Bytes{0x00, 0x00, 0x00, 0x00, 0x02, 0x00});
  std::uint8_t byte = 0;
  CHECK(COObjRdValue(node.find(0x2500, 0), &node.node, &byte, 1) == CO_ERR_BAD_ARG);
  CHECK(COObjWrValue(node.find(0x2500, 0), &node.node, &byte, 1) == CO_ERR_BAD_ARG);
}

#if CO_RPDO_N > 0 && CO_TPDO_N > 0
TEST_CASE("clock: PDOs write and transmit it; 24:00 is refused") {
  const auto entry = [](std::uint16_t index, std::uint8_t sub, const CO_OBJ_TYPE* type, std::uint32_t value) {
    return CO_OBJ{CO_KEY(index, sub, CO_OBJ_D___R_), type, value};
  };
  Fixture node(with_clock()
                   .with(entry(0x1400, 0, CO_TUNSIGNED8, 2))
                   .with(entry(0x1400, 1, CO_TPDO_ID, 0x201))
                   .with(entry(0x1400, 2, CO_TPDO_TYPE, 255))
                   .with(entry(0x1600, 0, CO_TPDO_NUM, 1))
                   .with(entry(0x1600, 1, CO_TPDO_MAP, CO_LINK(0x2500, 0, 48)))
                   .with(entry(0x1800, 0, CO_TUNSIGNED8, 2))
                   .with(entry(0x1800, 1, CO_TPDO_ID, 0x40000181))
                   .with(entry(0x1800, 2, CO_TPDO_TYPE, 255))
                   .with(entry(0x1A00, 0, CO_TPDO_NUM, 1))
                   .with(entry(0x1A00, 1, CO_TPDO_MAP, CO_LINK(0x2500, 0, 48))));
  node.rx("000#0101");
  node.rx("201#952CB302313D");
  CHECK(ms_of(time_of(node.node)) == 15665 * day + 45296789);
  node.rx("201#005C26050000");
  node.after(1000ms);
  node.call([&] { CHECK(COTPdoRequest(&node.node, 0) == CO_ERR_NONE); });
  node.tx("181#7D30B302313D");
}
#endif

// --- Drivers without a clock

TEST_CASE("clock: correct with drivers without a clock at every tick of an hour with timers and a late main loop") {
  for (const bool cyclic : {true, false}) {
    CAPTURE(cyclic);
    std::mt19937 random(5);
    PlainNode plain(cyclic);
    plain.ticks(77);
    CHECK(COTimeSet(&plain.node, &set_to) == CO_ERR_NONE);
    const std::uint64_t set_at = plain_timer().now;
    unsigned wrong = 0;
    for (unsigned i = 0; i < 2200 / stride(20); ++i) {
      const auto ticks = static_cast<unsigned>(random() % 3600);
      if (random() % 2 == 0) {
        COTmrCreate(
            &plain.node.Tmr, 1 + ticks / 3, 0, [](void*) {}, nullptr);
      }
      plain.ticks(ticks, random() % 4 != 0);
      wrong += ms_of(time_of(plain.node)) == ms_of(set_to) + plain_timer().now - set_at ? 0U : 1U;
      plain.tick();
    }
    CHECK(plain_timer().now >= 3600000 / stride(20));
    CHECK(wrong == 0);
  }
}

}  // namespace

#endif
