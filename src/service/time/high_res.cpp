// SPDX-License-Identifier: Apache-2.0
// High-resolution time stamp, 1013h: a clock in µs that is synchronised by SYNC and time stamps. [301:7.5.2.16]
//
// Local time is that of this node in µs. The clock is a straight line through (Base, Time) whose rate differs from that
// of the local time by Rate. A time stamp is the producer's clock at the last SYNC: with the local time at that SYNC it
// corrects the line.
#include "base/events.hpp"
#include "base/timer.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/parameter.hpp"
#include "dictionary/types/integer.hpp"
#include "service/time/time.hpp"

#if USE_TIME_HIGH_RES

namespace co::time {
namespace {

constexpr uint32_t high_res_key = CO_DEV(0x1013, 0);
constexpr uint32_t second = 1000000;  // µs

// The unit of Rate is 2^-24: products are divided in two steps, so that 32 bits are enough.
constexpr int32_t rate_unit_high = 1024;
constexpr int32_t rate_unit_low = 16384;
constexpr int32_t fastest = 16384;       // 977 ppm
constexpr uint32_t shortest = 1U << 20;  // the rate is measured over at least 1 s,
constexpr uint32_t longest = 1U << 26;   // and the line is extended after 67 s
constexpr uint32_t tolerance = 250;      // µs, besides 977 ppm and the resolution of the local time
constexpr uint8_t rejections = 4;        // time stamps that do not fit, after which the clock is set anew

// CO_TIME_HIGH_RES.Flags
enum Flag : uint8_t { set = 1, measured = 2, fits = 4 };

bool has(const CO_TIME_HIGH_RES& clock, Flag flag) { return (clock.Flags & flag) != 0; }

uint32_t magnitude(int32_t value) {
  const auto bits = static_cast<uint32_t>(value);
  return value < 0 ? 0U - bits : bits;
}
int32_t difference(uint32_t a, uint32_t b) { return static_cast<int32_t>(a - b); }

// Returns the local time. Without a counter of the application it has the resolution of the timer.
uint32_t local_time(CO_NODE& node) {
  if (node.Ext->Microseconds != nullptr) {
    return node.Ext->Microseconds(node.Ext->User);
  }
  CO_TIME_HIGH_RES& clock = node.Time.HighRes;
  uint32_t seconds = 0;
  const uint32_t ticks = take_seconds(node, clock.Tick, seconds);
  clock.Seconds += seconds * second;
  return clock.Seconds + fraction_of_second(ticks, node.Tmr.Freq, 6);
}

// Returns the clock at a local time. The rate applies to at most 134 s.
uint32_t clock_at(const CO_TIME_HIGH_RES& clock, uint32_t local) {
  constexpr int32_t most = INT32_MAX / fastest;
  const int32_t since = difference(local, clock.Base);
  int32_t parts = since / rate_unit_high;
  parts = parts > most ? most : parts < -most ? -most : parts;
  return clock.Time + static_cast<uint32_t>(since) + static_cast<uint32_t>(parts * clock.Rate / rate_unit_low);
}

void move_base(CO_TIME_HIGH_RES& clock, uint32_t local, uint32_t time) {
  clock.Base = local;
  clock.Time = time;
}

// Once a second: the timer's clock must not wrap unnoticed, and the line must not become too long.
void count_second(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  CO_TIME_HIGH_RES& clock = node.Time.HighRes;
  const uint32_t local = local_time(node);
  if (local - clock.Base >= longest) {
    move_base(clock, local, clock_at(clock, local));
  }
}

// Starts to count the local time, unless it is counted. Returns whether it is.
bool start_local_time(CO_NODE& node) {
  CO_TIME_HIGH_RES& clock = node.Time.HighRes;
  if (!tmr::is_running(clock.Tmr) && node.Nmt.Mode != CO_INVALID && node.Tmr.Freq != 0) {
    tmr::start(node, clock.Tmr, 0, node.Tmr.Freq, count_second, &node);
    clock.Tick = tmr::now(node);
  }
  return tmr::is_running(clock.Tmr);
}

// Sets the clock at a local time. Its rate remains.
void set_high_res(CO_TIME_HIGH_RES& clock, uint32_t local, uint32_t time) {
  move_base(clock, local, time);
  clock.MeasuredLocal = local;
  clock.MeasuredTime = time;
  clock.Rejected = 0;
  clock.Flags = static_cast<uint8_t>((clock.Flags & measured) | set);
}

// Measures the rate of the producer's clock between time stamps that are at least a second apart, and averages it.
void measure_rate(CO_TIME_HIGH_RES& clock, uint32_t local, uint32_t time) {
  const uint32_t span = local - clock.MeasuredLocal;
  if (span < shortest) {
    return;
  }
  constexpr int32_t part = 4096;  // of the unit of Rate
  const int32_t gained = difference(time - clock.MeasuredTime, span);
  if (span < longest && magnitude(gained) < span / rate_unit_high) {
    const int32_t rate = gained * part / static_cast<int32_t>(span / part);
    clock.Rate = has(clock, measured) ? clock.Rate + (rate - clock.Rate) / 4 : rate;
    clock.Flags |= measured;
  }
  clock.MeasuredLocal = local;
  clock.MeasuredTime = time;
}

// Corrects the clock by a time stamp. One that does not fit is ignored, because a SYNC was lost or there are two
// producers, unless several do not fit in succession. Returns whether it was used.
bool synchronise(const CO_NODE& node, CO_TIME_HIGH_RES& clock, uint32_t local, uint32_t time) {
  const uint32_t expected = clock_at(clock, local);
  const int32_t error = difference(time, expected);
  const uint32_t resolution = node.Ext->Microseconds != nullptr ? 0 : second / node.Tmr.Freq;
  const uint32_t allowed = tolerance + 2 * resolution + magnitude(difference(local, clock.Base)) / rate_unit_high;
  if (!has(clock, set)) {
    set_high_res(clock, local, time);
  } else if (magnitude(error) <= allowed) {
    measure_rate(clock, local, time);
    move_base(clock, local, expected + static_cast<uint32_t>(error / 4));
    clock.Rejected = 0;
    clock.Flags |= fits;
  } else if (++clock.Rejected == rejections) {
    set_high_res(clock, local, time);
  } else {
    return false;
  }
  return true;
}

// Processes a time stamp that is written to 1013h. In a synchronous RPDO, which is written at the next SYNC, it belongs
// to the SYNC before. A second time stamp for the same SYNC is ignored.
void apply_time_stamp(CO_NODE& node, CO_OBJ&, uint32_t value, uint32_t) {
  CO_TIME_HIGH_RES& clock = node.Time.HighRes;
  const uint32_t local = clock.InSync != 0 ? clock.Before : clock.Sync;
  if (clock.Syncs > clock.InSync && synchronise(node, clock, local, value)) {
    clock.Syncs = clock.InSync;
  }
}

}  // namespace

// Stores the clock at the SYNC in 1013h, before synchronous TPDOs are sampled.
void on_sync(CO_NODE& node, uint8_t) {
  CO_TIME_HIGH_RES& clock = node.Time.HighRes;
  CO_OBJ* const obj = dict::find(node, high_res_key);
  if (obj == nullptr || obj->Type != CO_TTIME_HIGH_RES || !start_local_time(node)) {
    return;
  }
  clock.Before = clock.Sync;
  clock.Sync = local_time(node);
  clock.InSync = 1;
  clock.Syncs = static_cast<uint8_t>(clock.Syncs == 0 ? 1 : 2);
  uint32_t value = has(clock, set) ? clock_at(clock, clock.Sync) : 0;
  (void)integer::Number<sizeof value>::write(obj, &node, &value, sizeof value);
}

void on_synced(CO_NODE& node) { node.Time.HighRes.InSync = 0; }

void stop_high_res(CO_NODE& node) {
  CO_TIME_HIGH_RES& clock = node.Time.HighRes;
  clock.Syncs = 0;
  if (node.Nmt.Mode == CO_INVALID) {
    tmr::stop(node, clock.Tmr);
    clock.Flags = 0;
  }
}

}  // namespace co::time

extern "C" {

CO_ERR COTimeHighResSet(CO_NODE* node, uint32_t us) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  if (!co::time::start_local_time(*node)) {
    return node->Nmt.Mode == CO_INVALID ? CO_ERR_NMT_MODE : CO_ERR_TMR_CREATE;
  }
  co::time::set_high_res(node->Time.HighRes, co::time::local_time(*node), us);
  node->Time.HighRes.Syncs = 0;
  return CO_ERR_NONE;
}

CO_ERR COTimeHighResGet(CO_NODE* node, uint32_t* us) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  ASSERT_PTR_ERR(us, CO_ERR_BAD_ARG);
  const CO_TIME_HIGH_RES& clock = node->Time.HighRes;
  *us = 0;
  if (!co::time::has(clock, co::time::set)) {
    return CO_ERR_OBJ_NO_DATA;
  }
  *us = co::time::clock_at(clock, co::time::local_time(*node));
  return CO_ERR_NONE;
}

int16_t COTimeHighResIsSynchronised(const CO_NODE* node) {
  ASSERT_PTR_ERR(node, -1);
  const CO_TIME_HIGH_RES& clock = node->Time.HighRes;
  return co::time::has(clock, co::time::fits) && clock.Rejected == 0 ? 1 : 0;
}

const CO_OBJ_TYPE COTTimeHighRes =
    co::parameter<4, co::rules::time_high_res, co::at_most<UINT32_MAX>, co::time::apply_time_stamp>;

}  // extern "C"

#endif
