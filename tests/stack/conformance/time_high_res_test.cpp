// SPDX-License-Identifier: Apache-2.0
// High-resolution time stamp, 1013h: producer, and consumer whose clock drifts against the producer's. [301:7.5.2.16]
#include <cmath>
#include <cstdlib>

#include "support/fixture.hpp"

#if USE_TIME_HIGH_RES && CO_RPDO_N > 1 && CO_TPDO_N > 0

namespace {

using namespace test;

struct TimeStamp {
  std::uint32_t stamp = 0;
};

// A node with SYNC and 1013h, which RPDO 1 (201h), RPDO 2 (301h) and the synchronous TPDO 1 (181h) map; by default it
// is Operational and its timer counts microseconds.
class Clocked : private TimeStamp, public Fixture {
 public:
  explicit Clocked(std::uint8_t rpdo_type = 255, std::uint32_t rate = 1000000, std::uint32_t start = 0,
                   const CO_OBJ_TYPE* type = CO_TTIME_HIGH_RES, bool has_tpdo = false)
      : Fixture(setup(rpdo_type, rate, start, type, has_tpdo)) {
    rx("000#0101");
  }

  void sync() { rx("080#"); }
  void stamp(std::uint32_t value, std::uint32_t identifier = 0x201) {
    CO_IF_FRM frm{identifier, {}, 4};
    for (unsigned n = 0; n < 4; ++n) frm.Data[n] = static_cast<std::uint8_t>(value >> (8 * n));
    rx(frm);
  }
  // Sends a SYNC, and its time stamp 300 µs later.
  void sync_and_stamp(std::uint32_t value) {
    sync();
    after(300us);
    stamp(value);
  }
  // Returns the clock, which must be set.
  std::uint32_t clock() {
    std::uint32_t us = 0;
    call([&] { CHECK(COTimeHighResGet(&node, &us) == CO_ERR_NONE); });
    return us;
  }
  CO_ERR try_clock() {
    std::uint32_t us = 1;
    CO_ERR err = CO_ERR_NONE;
    call([&] { err = COTimeHighResGet(&node, &us); });
    CHECK((err == CO_ERR_NONE || us == 0));
    return err;
  }
  CO_ERR set(std::uint32_t us) {
    CO_ERR err = CO_ERR_NONE;
    call([&] { err = COTimeHighResSet(&node, us); });
    return err;
  }
  bool is_synchronised() { return COTimeHighResIsSynchronised(&node) == 1; }
  std::uint32_t value() const { return TimeStamp::stamp; }
  void count_microseconds(std::uint32_t (*counter)(void*)) {
    const_cast<CO_NODE_EXT*>(node.Ext)->Microseconds = counter;
  }

 private:
  Setup setup(std::uint8_t rpdo_type, std::uint32_t rate, std::uint32_t start, const CO_OBJ_TYPE* type, bool has_tpdo) {
    const auto entry = [](std::uint16_t index, std::uint8_t sub, const CO_OBJ_TYPE* of, std::uint32_t data) {
      return CO_OBJ{CO_KEY(index, sub, CO_OBJ_D___R_), of, data};
    };
    const std::uint32_t mapped = CO_LINK(0x1013, 0, 32);
    Setup all = Setup().only_small().rate(rate).clock(start);
    all.with(entry(0x1005, 0, CO_TSYNC_ID, 0x80))
        .with({CO_KEY(0x1013, 0, CO_OBJ____PRW), type, CO_DATA(&(TimeStamp::stamp))})
        .may_change(0x1013, 0);
    for (const std::uint16_t n : {std::uint16_t{0}, std::uint16_t{1}}) {
      all.with(entry(static_cast<std::uint16_t>(0x1400 + n), 0, CO_TUNSIGNED8, 2))
          .with(entry(static_cast<std::uint16_t>(0x1400 + n), 1, CO_TPDO_ID, 0x201U + 0x100U * n))
          .with(entry(static_cast<std::uint16_t>(0x1400 + n), 2, CO_TPDO_TYPE, rpdo_type))
          .with(entry(static_cast<std::uint16_t>(0x1600 + n), 0, CO_TPDO_NUM, 1))
          .with(entry(static_cast<std::uint16_t>(0x1600 + n), 1, CO_TPDO_MAP, mapped));
    }
    if (has_tpdo) {
      all.with(entry(0x1800, 0, CO_TUNSIGNED8, 2))
          .with(entry(0x1800, 1, CO_TPDO_ID, 0x40000181))
          .with(entry(0x1800, 2, CO_TPDO_TYPE, 1))
          .with(entry(0x1A00, 0, CO_TPDO_NUM, 1))
          .with(entry(0x1A00, 1, CO_TPDO_MAP, mapped));
    }
    return all;
  }
};

// The producer's clock: it differs from the node's by an offset and a rate in ppm.
struct Producer {
  double ppm = 0;
  std::uint32_t offset = 0;
  std::uint32_t at(std::uint64_t ticks, std::uint32_t rate = 1000000) const {
    const double us = static_cast<double>(ticks) * 1e6 / rate;
    return offset + static_cast<std::uint32_t>(static_cast<std::uint64_t>(std::llround(us * (1 + ppm * 1e-6))));
  }
};

std::int32_t error_of(Clocked& node, const Producer& producer, std::uint32_t rate = 1000000) {
  return static_cast<std::int32_t>(node.clock() - producer.at(node.now(), rate));
}

// Sends SYNCs and time stamps, of which some are lost, and returns the largest error after 2 s.
std::int32_t largest_error(Clocked& node, const Producer& producer, std::uint8_t type, std::chrono::microseconds period,
                           unsigned cycles, std::uint32_t rate = 1000000) {
  std::int32_t largest = 0;
  std::uint64_t synced = node.now();
  const std::uint64_t first = node.now();
  for (unsigned n = 0; n < cycles; ++n) {
    if (type != 255 && n % 13 != 0) node.stamp(producer.at(synced, rate));  // that of the SYNC before
    synced = node.now();
    if (n % 10 != 9) node.sync();
    node.after(period / 10);
    if (type == 255 && n % 13 != 0) node.stamp(producer.at(synced, rate));
    for (unsigned part = 0; part < 3; ++part) {
      node.after(period * 3 / 10);
      if (node.now() - first > 2 * std::uint64_t{rate}) {
        largest = std::max(largest, std::abs(error_of(node, producer, rate)));
      }
    }
  }
  return largest;
}

TEST_CASE("1013h: the clock follows the producer within 10 us after 2 s if one of ten SYNCs is lost [Z2]") {
  for (const std::uint8_t type : {std::uint8_t{255}, std::uint8_t{1}}) {
    for (const double ppm : {100.0, -100.0, 500.0, -500.0, 0.0}) {
      for (const std::uint32_t offset : {0U, 0xFFFFFFFFU - 2500000U, 0x7FFFFF00U}) {
        for (const std::uint32_t start : clock_starts) {
          CAPTURE(int{type});
          CAPTURE(ppm);
          CAPTURE(offset);
          CAPTURE(start);
          Clocked node(type, 1000000, start);
          CHECK(largest_error(node, {ppm, offset}, type, 10ms, 350) <= 10);
          CHECK(node.is_synchronised());
        }
      }
    }
  }
}

TEST_CASE("1013h: the clock follows with other periods of SYNC, and its rate remains without time stamps") {
  for (const double ppm : {100.0, -100.0}) {
    CAPTURE(ppm);
    const Producer producer{ppm, 1000};
    Clocked fast;
    CHECK(largest_error(fast, producer, 255, 1ms, 2500) <= 10);
    Clocked slow;
    CHECK(largest_error(slow, producer, 255, 1000ms, 20) <= 300);
    CHECK(std::abs(error_of(slow, producer)) <= 20);
    Clocked node;
    largest_error(node, producer, 255, 10ms, 500);
    node.after(10s);
    CHECK(std::abs(error_of(node, producer)) <= 40);  // 4 ppm
    node.after(10min);
    CHECK(std::abs(error_of(node, producer)) <= 4000);
    CHECK(node.is_synchronised());
  }
}

TEST_CASE("1013h: the resolution is a tick of the timer") {
  for (const std::uint32_t rate : {1000U, 300U, 1024U, 32768U, 72000000U}) {
    CAPTURE(rate);
    Clocked node(255, rate);
    const auto period = std::chrono::microseconds{100000};
    CHECK(largest_error(node, {100.0, 77}, 255, period, 60, rate) <= static_cast<std::int32_t>(20 + 3000000U / rate));
  }
}

std::uint32_t microseconds_of(void* user) {
  const auto* const fixture = static_cast<const Fixture*>(user);
  return static_cast<std::uint32_t>(fixture->now() * 1000) + 0xFFFFF000U;
}

TEST_CASE("1013h: CO_NODE_EXT.Microseconds replaces the timer") {
  Clocked node(255, 1000);
  node.count_microseconds(microseconds_of);
  CHECK(node.set(5) == CO_ERR_NONE);
  node.after(10ms);
  CHECK(node.clock() == 10005);
  node.after(3s);
  CHECK(node.clock() == 3010005);
}

TEST_CASE("1013h: the tolerance is 250 us, two ticks and 1/1024 of the time since the last time stamp") {
  for (const std::uint32_t rate : {1000000U, 100000U}) {
    for (const bool has_counter : {false, true}) {
      for (const bool is_behind : {false, true}) {
        for (const bool fits : {false, true}) {
          CAPTURE(rate);
          CAPTURE(has_counter);
          CAPTURE(is_behind);
          Clocked node(255, rate);
          if (has_counter) {
            node.count_microseconds([](void* user) {
              const auto* const fixture = static_cast<const Fixture*>(user);
              return static_cast<std::uint32_t>(fixture->now() * 1000000 / fixture->node.Tmr.Freq);
            });
          }
          node.sync_and_stamp(1000);
          node.after(511700us);  // 512 ms after the SYNC
          node.sync();
          const std::uint32_t limit = 250 + 500 + (has_counter ? 0 : 2000000 / rate);
          const std::uint32_t error = fits ? limit : limit + 1;
          node.stamp(is_behind ? 513000 - error : 513000 + error);
          CHECK(node.is_synchronised() == fits);
          const std::uint32_t step = fits ? error / 4 : 0;
          CHECK(node.clock() == (is_behind ? 513000 - step : 513000 + step));
        }
      }
    }
  }
}

TEST_CASE("1013h: a time stamp for a SYNC before the clock was set by the application has no effect") {
  Clocked node;
  node.sync();
  node.after(300us);
  CHECK(node.set(1000000) == CO_ERR_NONE);
  node.stamp(999800);  // it would fit
  CHECK(node.clock() == 1000000);
  CHECK_FALSE(node.is_synchronised());
}

TEST_CASE("1013h: after a minute without time stamps one that is wrong by seconds does not fit") {
  Clocked node;
  node.sync_and_stamp(1000);
  node.after(67s);
  node.sync();
  node.after(2s);
  node.stamp(1000 + 67000300 + 3000000);
  CHECK(node.clock() == 1000 + 300 + 69000000);
  CHECK_FALSE(node.is_synchronised());
}

TEST_CASE("1013h: the rate is the average of several seconds") {
  Clocked node;
  largest_error(node, {100.0, 0}, 255, 10ms, 300);
  const std::uint64_t begin = node.now();
  const std::uint32_t before = node.clock();
  largest_error(node, {500.0, static_cast<std::uint32_t>(0U - begin * 4 / 10000)}, 255, 10ms, 130);
  const std::uint32_t now = node.clock();
  node.after(10s);
  const auto gained = static_cast<std::int32_t>(node.clock() - now - 10000000);
  CHECK(gained > 1500);  // a quarter of the way from 100 to 500 ppm: 200 ppm
  CHECK(gained < 2500);
  CHECK(before != now);
}

TEST_CASE("1013h: a producer sends its clock at the last SYNC [Z2]") {
  Clocked node(255, 1000000, 0, CO_TTIME_HIGH_RES, true);
  node.after(5ms);
  node.sync();
  node.tx("181#00000000");
  CHECK(node.try_clock() == CO_ERR_OBJ_NO_DATA);
  CHECK(node.set(0xFFFFFFF0) == CO_ERR_NONE);
  CHECK(node.clock() == 0xFFFFFFF0);
  node.after(10ms);
  node.sync();
  node.tx("181#00270000");  // 10000 - 16
  node.after(3ms);
  node.ask("601#4013100000000000", "581#4313100000270000");
  CHECK(node.value() == 0x2700);
  CHECK(node.clock() == 0x2700 + 3000);
  CHECK_FALSE(node.is_synchronised());
}

TEST_CASE("1013h: the first time stamp sets the clock") {
  Clocked node;
  node.sync();
  CHECK(node.value() == 0);
  CHECK(node.try_clock() == CO_ERR_OBJ_NO_DATA);
  node.after(300us);
  node.stamp(1000);
  CHECK(node.clock() == 1300);
  CHECK_FALSE(node.is_synchronised());
  node.after(9700us);
  node.sync();
  CHECK(node.value() == 11000);
  node.stamp(11000);
  CHECK(node.is_synchronised());
}

TEST_CASE("1013h: a time stamp without a SYNC, and a second one for the same SYNC, have no effect") {
  Clocked node;
  node.stamp(1000);
  CHECK(node.try_clock() == CO_ERR_OBJ_NO_DATA);
  node.sync_and_stamp(2000);
  CHECK(node.clock() == 2300);
  node.stamp(2200);
  CHECK(node.clock() == 2300);
  node.stamp(900000, 0x301);
  node.rx("601#2313100040420F00");
  node.tx("581#6013100000000000");
  CHECK(node.clock() == 2300);
}

TEST_CASE("1013h: after a jump of the producer three time stamps are ignored, the fourth sets the clock") {
  for (const std::uint32_t jump : {300U, 5000U, 0x80000000U, 0U - 5000U, 0U - 400000000U}) {
    CAPTURE(jump);
    Clocked node;
    std::uint32_t time = 1000;
    for (int n = 0; n < 3; ++n, time += 10000) {
      node.sync_and_stamp(time);
      node.after(9700us);
    }
    CHECK(node.is_synchronised());
    time += jump;
    for (int n = 0; n < 3; ++n, time += 10000) {
      node.sync_and_stamp(time);
      CHECK(node.clock() == time - jump + 300);
      CHECK_FALSE(node.is_synchronised());
      node.after(9700us);
    }
    node.sync_and_stamp(time);
    CHECK(node.clock() == time + 300);
    CHECK_FALSE(node.is_synchronised());
    node.after(9700us);
    node.sync_and_stamp(time + 10000);
    CHECK(node.is_synchronised());
  }
}

TEST_CASE("1013h: of two producers the first one is followed, whichever sends first, until it is gone") {
  Clocked node;
  const Producer one{100.0, 1000};
  const Producer two{-100.0, 77777};
  for (unsigned n = 0; n < 400; ++n) {
    const std::uint64_t synced = node.now();
    node.sync();
    node.after(300us);
    const bool first = n == 0 || n % 3 != 0;
    node.stamp((first ? one : two).at(synced), first ? 0x201 : 0x301);
    node.stamp((first ? two : one).at(synced), first ? 0x301 : 0x201);
    node.after(9700us);
    if (n > 200) REQUIRE(std::abs(error_of(node, one)) <= 10);
  }
  for (unsigned n = 0; n < 4; ++n) {
    const std::uint64_t synced = node.now();
    node.sync();
    node.after(300us);
    node.stamp(two.at(synced), 0x301);
    node.after(9700us);
  }
  CHECK(std::abs(error_of(node, two)) <= 10);
}

TEST_CASE("1013h: time stamps of a wrong length are refused") {
  Clocked node;
  node.sync_and_stamp(1000);
  node.sync();
  node.rx("201#0102");
  node.frames();  // EMCY
  CHECK(node.clock() == 1300);
  node.ask("601#2F13100011000000", "581#8013100013000706");
  node.ask("601#2B13100011220000", "581#8013100013000706");
  CHECK(node.clock() == 1300);
  Clocked longer;
  longer.sync();
  longer.rx("201#E803000099");  // the bytes behind those of the mapping are ignored
  longer.frames();
  CHECK(longer.clock() == 1000);
}

TEST_CASE("1013h: the clock runs through states and resets and ends with CONodeStop()") {
  Clocked node;
  node.sync_and_stamp(1000);
  node.rx("000#0201");
  node.after(10ms);
  CHECK(node.clock() == 11300);
  node.rx("000#0101");
  node.sync();
  node.rx("000#0201");
  node.rx("000#0101");
  node.stamp(11200);  // no SYNC since Stopped
  CHECK(node.clock() == 11300);
  for (const char* reset : {"000#8201", "000#8101"}) {
    node.rx(reset);
    node.frames();
  }
  CHECK(node.clock() == 11300);
  node.call([&] { CONodeStop(&node.node); });
  node.frames();
  CHECK(node.try_clock() == CO_ERR_OBJ_NO_DATA);
  CHECK(node.set(1) == CO_ERR_NMT_MODE);
}

TEST_CASE("1013h: without the type of the stack it is a number, and no timer runs") {
  Clocked node(255, 1000000, 0, CO_TUNSIGNED32);
  node.sync_and_stamp(1000);
  CHECK(node.value() == 1000);
  CHECK(node.try_clock() == CO_ERR_OBJ_NO_DATA);
  CHECK(CONodeNextDeadline(&node.node) == UINT32_MAX);
}

TEST_CASE("1013h: wrong arguments are refused") {
  Clocked node;
  std::uint32_t us = 0;
  CHECK(COTimeHighResSet(nullptr, 1) == CO_ERR_BAD_ARG);
  CHECK(COTimeHighResGet(nullptr, &us) == CO_ERR_BAD_ARG);
  CHECK(COTimeHighResGet(&node.node, nullptr) == CO_ERR_BAD_ARG);
  CHECK(COTimeHighResIsSynchronised(nullptr) == -1);
  CHECK(node.set(1) == CO_ERR_NONE);
}

}  // namespace

#endif
