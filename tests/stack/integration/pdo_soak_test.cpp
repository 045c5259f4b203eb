// SPDX-License-Identifier: Apache-2.0
// A soak test of one minute, or of LEXICAN_SOAK_MINUTES (environment), on a saturated bus of 1 Mbit/s. The node under
// test has PDOs of every kind, SYNC, TIME, EMCY and heartbeats in both directions, and SDO; a second node produces SYNC
// and TIME, is guarded, and is the NMT master. Checks that frames are lost only where the stack may drop them. [T16]
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <random>
#include <vector>

#include "soak.hpp"
#include "soak_neighbour.hpp"
#include "support/callbacks.hpp"
#include "support/network.hpp"
#include "support/notation.hpp"

#if CO_RPDO_N > 1 && CO_TPDO_N > 2 && USE_SYNC && USE_EMCY && CO_HBCONS_N > 0

namespace {

using namespace std::chrono_literals;
using co::VirtualBus;
using test::Device;
using test::DeviceOptions;
using test::Line;
using test::Neighbour;
using test::Periodic;
using test::time_on_bus;
using test::World;
using Micros = std::chrono::microseconds;

constexpr Micros longest_frame = 131us;
constexpr Micros cycle = 10ms;        // SYNC
constexpr Micros event_period = 3ms;  // event timer of TPDO 1
constexpr Micros inhibit_time = 5ms;  // TPDO 3
constexpr Micros heartbeat_time = 7ms;
constexpr std::uint8_t counter_overflow = 240;

std::uint32_t value_of(const CO_IF_FRM& frame) { return CO_GET_LONG(&frame, 0); }

// Objects of the node. RPDO 1 is event-driven with 8 bytes, RPDO 2 is synchronous. TPDO 1 is sent by its event timer,
// TPDO 2 with every SYNC, TPDO 3 when RPDO 1 has changed its object, with an inhibit time. The heartbeats of node 9 are
// monitored.
struct Objects {
  std::uint32_t sync_id = 0x80;
  std::uint8_t error_register = 0;
  std::uint16_t heartbeat = static_cast<std::uint16_t>(heartbeat_time / 1ms);
  CO_HBCONS monitored{};
  std::uint32_t event_value = 0;  // RPDO 1, TPDO 3 (flag A)
  std::uint32_t event_copy = 0;   // RPDO 1
  std::uint32_t synchronous = 0;  // RPDO 2, TPDO 2
  std::uint32_t timed = 0x5EED;   // TPDO 1
  std::uint8_t history_number = 0;
  std::uint32_t history[2] = {};
  std::uint32_t time_id = 0x80000100;
  std::uint32_t emcy_of_node_9 = 0x89;

  std::vector<CO_OBJ> table() {
    const auto row = [](std::uint16_t index, unsigned sub, std::uint32_t flags, const CO_OBJ_TYPE* type, CO_DATA data) {
      return CO_OBJ{CO_KEY(index, sub, flags), type, data};
    };
    constexpr std::uint32_t d = CO_OBJ_D___R_;
    monitored.NodeId = 9;
    monitored.Time = 100;
    std::vector<CO_OBJ> table = {
      row(0x1000, 0, d, CO_TUNSIGNED32, 0),
      row(0x1001, 0, CO_OBJ_____R_, CO_TUNSIGNED8, CO_DATA(&error_register)),
      row(0x1003, 0, CO_OBJ_____RW, CO_TEMCY_HIST, CO_DATA(&history_number)),
      row(0x1003, 1, CO_OBJ_____R_, CO_TEMCY_HIST, CO_DATA(&history[0])),
      row(0x1003, 2, CO_OBJ_____R_, CO_TEMCY_HIST, CO_DATA(&history[1])),
      row(0x1005, 0, CO_OBJ_____R_, CO_TSYNC_ID, CO_DATA(&sync_id)),
#if USE_TIME
      row(0x1012, 0, CO_OBJ_____R_, CO_TTIME_ID, CO_DATA(&time_id)),
#endif
      row(0x1014, 0, CO_OBJ_DN__R_, CO_TUNSIGNED32, 0x80),
      row(0x1016, 0, d, CO_TUNSIGNED8, 1),
      row(0x1016, 1, CO_OBJ_____R_, CO_THB_CONS, CO_DATA(&monitored)),
      row(0x1017, 0, CO_OBJ_____R_, CO_THB_PROD, CO_DATA(&heartbeat)),
      row(0x1018, 0, d, CO_TUNSIGNED8, 1),
      row(0x1018, 1, d, CO_TUNSIGNED32, 0x11223344),
      row(0x1019, 0, d, CO_TSYNC_COUNT, counter_overflow),
#if CO_EMCY_CONS_N > 0
      row(0x1028, 1, CO_OBJ_____R_, CO_TEMCY_CONS, CO_DATA(&emcy_of_node_9)),
#endif
      row(0x1200, 0, d, CO_TUNSIGNED8, 2),
      row(0x1200, 1, CO_OBJ_DN__R_, CO_TSDO_ID, 0x600),
      row(0x1200, 2, CO_OBJ_DN__R_, CO_TSDO_ID, 0x580),
      row(0x1400, 1, CO_OBJ_DN__R_, CO_TPDO_ID, 0x200),
      row(0x1400, 2, d, CO_TPDO_TYPE, 255),
      row(0x1400, 5, d, CO_TPDO_EVENT, 100),
      row(0x1401, 1, CO_OBJ_DN__R_, CO_TPDO_ID, 0x300),
      row(0x1401, 2, d, CO_TPDO_TYPE, 1),
      row(0x1600, 0, d, CO_TPDO_NUM, 2),
      row(0x1600, 1, d, CO_TPDO_MAP, 0x20000020),
      row(0x1600, 2, d, CO_TPDO_MAP, 0x20010020),
      row(0x1601, 0, d, CO_TPDO_NUM, 1),
      row(0x1601, 1, d, CO_TPDO_MAP, 0x20020020),
      row(0x1800, 1, CO_OBJ_DN__R_, CO_TPDO_ID, 0x40000180),
      row(0x1800, 2, d, CO_TPDO_TYPE, 255),
      row(0x1800, 5, d, CO_TPDO_EVENT, event_period / 1ms),
      row(0x1801, 1, CO_OBJ_DN__R_, CO_TPDO_ID, 0x40000280),
      row(0x1801, 2, d, CO_TPDO_TYPE, 1),
      row(0x1802, 1, CO_OBJ_DN__R_, CO_TPDO_ID, 0x40000380),
      row(0x1802, 2, d, CO_TPDO_TYPE, 254),
      row(0x1802, 3, d, CO_TPDO_INHIBIT, inhibit_time / 100us),
      row(0x1A00, 0, d, CO_TPDO_NUM, 1),
      row(0x1A00, 1, d, CO_TPDO_MAP, 0x20030020),
      row(0x1A01, 0, d, CO_TPDO_NUM, 1),
      row(0x1A01, 1, d, CO_TPDO_MAP, 0x20020020),
      row(0x1A02, 0, d, CO_TPDO_NUM, 1),
      row(0x1A02, 1, d, CO_TPDO_MAP, 0x20000020),
      row(0x2000, 0, CO_OBJ___APRW, CO_TUNSIGNED32, CO_DATA(&event_value)),
      row(0x2001, 0, CO_OBJ____PRW, CO_TUNSIGNED32, CO_DATA(&event_copy)),
      row(0x2002, 0, CO_OBJ____PRW, CO_TUNSIGNED32, CO_DATA(&synchronous)),
      row(0x2003, 0, CO_OBJ____PR_, CO_TUNSIGNED32, CO_DATA(&timed)),
      CO_OBJ_DICT_ENDMARK,
    };
    return table;
  }
};

class PdoSoak {
 public:
  explicit PdoSoak(std::uint32_t seed) : random_(seed), table_(objects_.table()), device_(add_device()) {
    test::callbacks().pdo_update = [this](CO_RPDO* pdo) { update(pdo); };
    test::callbacks().time_update = [this](CO_NODE*, const CO_TIME_OF_DAY*) { ++times_; };
    test::callbacks().life_guard = [this](CO_NMT*, bool) { ++life_guard_events_; };
    test::callbacks().emcy_received = [this](CO_NODE*, auto...) { ++emergencies_heard_; };
    line_.bus.set_trace([this](const VirtualBus::Traffic& traffic) {
      if (traffic.sender == &device_.port) {
        hear(traffic.frame, traffic.time);
      } else if (neighbour_.sends(traffic)) {
        neighbour_.hear(traffic.frame, traffic.time);
      }
    });
    start_leds();
    say(test::frame("000#0105"));
    test::callbacks().mode_change = [this](CO_NMT*, CO_MODE) { ++mode_changes_; };
    timed_.begin = heartbeats_.begin = Micros(0);
    timed_.begin = world_.clock.time();
  }
  ~PdoSoak() { test::callbacks() = {}; }
  PdoSoak(const PdoSoak&) = delete;
  PdoSoak& operator=(const PdoSoak&) = delete;

  void run(Micros time) {
    while (world_.clock.time() < time) {
      neighbour_.act();
      say(next_frame());
    }
    for (int i = 0; i < 500; ++i) {
      neighbour_.act();
      say(foreign());  // gives every frame that depends on a timer enough time to be sent
    }
  }

  void check() const {
    const CO_NODE_COUNTERS counters = device_.counters();
    CHECK(counters.Dropped == 0);
    CHECK(counters.Malformed == too_short_);
    CHECK(counters.Unclaimed == 0);
    CHECK(device_.port.lost() == 0);
    CHECK(updates_ == rpdos_);
    CHECK(synchronous_updates_ == synchronous_expected_);
    CHECK(answers_ == requests_ + neighbour_.sdo_requests());
    CHECK(aborts_ == 0);
    CHECK(synchronous_sent_ == syncs_);
    CHECK(emergencies_ == 2 * faults_);
    CHECK(objects_.error_register == 0);
    CHECK(last_event_ == objects_.event_value);
    CHECK(events_ > 0);
    CHECK(mode_changes_ == 0);
    CHECK(life_guard_events_ == 0);
    CHECK(times_ == (Neighbour::produces_time ? neighbour_.times() : 0));
    CHECK(emergencies_heard_ == (CO_EMCY_CONS_N > 0 ? emergencies_of_node_9_ : 0));
    check_periods();
    neighbour_.check(longest_frame);
  }

 private:
  void start_leds() {
#if USE_LED
    COLedStart(&device_.node);
#endif
  }

  Device& add_device() {
    DeviceOptions options{5};
    options.table = table_.data();
    return world_.add_device(line_, options);
  }

  void check_periods() const {
    const Micros end = world_.clock.time();
    timed_.check(end, longest_frame);
    heartbeats_.check(end, longest_frame);
  }

  void say(const CO_IF_FRM& frame) {
    line_.bus.inject(frame);
    world_.clock.advance(world_.clock.ticks(time_on_bus(frame)));
    world_.settle();
  }

  void update(CO_RPDO* pdo) {
    if (pdo == &device_.node.RPdo[0]) {
      ++updates_;
      CHECK(objects_.event_value == last_value_);
      CHECK(objects_.event_copy == ~last_value_);
    } else {
      ++synchronous_updates_;
      CHECK(objects_.synchronous == kept_);
    }
  }

  void hear(const CO_IF_FRM& frame, Micros time) {
    switch (frame.Identifier) {
      case 0x185: timed_.take(time); break;
      case 0x705: heartbeats_.take(time); break;
      case 0x285:
        ++synchronous_sent_;
        CHECK(value_of(frame) == applied_before_);
        break;
      case 0x385: hear_event(frame, time); break;
      case 0x085: ++emergencies_; break;
      case 0x585:
        ++answers_;
        aborts_ += frame.Data[0] == 0x80 ? 1 : 0;
        break;
      default: FAIL_CHECK("unexpected ", test::notation(frame)); break;
    }
  }

  void hear_event(const CO_IF_FRM& frame, Micros time) {
    CHECK((events_ == 0 || time - last_event_time_ >= inhibit_time));
    CHECK(value_of(frame) != last_event_);
    last_event_ = value_of(frame);
    last_event_time_ = time;
    ++events_;
  }

  CO_IF_FRM next_frame() {
    const Micros now = world_.clock.time();
    if (now >= next_sync_) {
      next_sync_ += cycle;
      return sync();
    }
    if (now >= next_heartbeat_) {
      next_heartbeat_ += 50ms;
      return test::frame("709#05");
    }
    if (now >= next_emergency_) {
      next_emergency_ += 30ms;
      ++emergencies_of_node_9_;
      return test::frame("089#1082110000000000");
    }
    switch (random_() % 8) {
      case 0: return rpdo();
      case 1: return synchronous_rpdo();
      case 2: ++requests_; return test::frame("605#4018100100000000");
      default: return foreign();
    }
  }

  // Produces a SYNC. It applies the last RPDO received before it; TPDO 2 then has the value of the SYNC before.
  CO_IF_FRM sync() {
    ++syncs_;
    applied_before_ = applied_;
    if (is_kept_) {
      ++synchronous_expected_;
      applied_ = kept_;
    }
    is_kept_ = false;
    return {0x80, {static_cast<std::uint8_t>((syncs_ - 1) % counter_overflow + 1)}, 1};
  }

  // Returns RPDO 1, sometimes with too few bytes: the node reports the first of consecutive short ones.
  CO_IF_FRM rpdo() {
    CO_IF_FRM frame{0x205, {}, 8};
    if (random_() % 64 == 0) {
      frame.DLC = static_cast<std::uint8_t>(random_() % 8);
      ++too_short_;
      faults_ += is_short_ ? 0U : 1U;
      is_short_ = true;
      return frame;
    }
    is_short_ = false;
    ++rpdos_;
    last_value_ = static_cast<std::uint32_t>(rpdos_);
    CO_SET_LONG(&frame, last_value_, 0);
    CO_SET_LONG(&frame, ~last_value_, 4);
    return frame;
  }

  CO_IF_FRM synchronous_rpdo() {
    CO_IF_FRM frame{0x305, {}, 4};
    kept_ = static_cast<std::uint32_t>(random_());
    is_kept_ = true;
    CO_SET_LONG(&frame, kept_, 0);
    return frame;
  }

  CO_IF_FRM foreign() {
    CO_IF_FRM frame{
        0x186U + static_cast<std::uint32_t>(random_() % 0x7F), {}, static_cast<std::uint8_t>(random_() % 9)};
    frame.Identifier |= random_() % 4 == 0 ? CO_IF_FRM_EXT : 0U;
    return frame;
  }

  std::mt19937 random_;
  Objects objects_;
  std::vector<CO_OBJ> table_;
  World world_{1000000, 0xFFF00000};  // ticks are microseconds; the clock wraps after a second
  Line& line_ = world_.add_line("full");
  Device& device_;
  Neighbour neighbour_{world_, line_};
  Periodic timed_{event_period};
  Periodic heartbeats_{heartbeat_time};
  Micros next_sync_ = 1ms;
  Micros next_heartbeat_{0};
  Micros next_emergency_{0};
  Micros last_event_time_{0};
  std::uint32_t last_value_ = 0, last_event_ = 0, kept_ = 0, applied_ = 0, applied_before_ = 0;
  std::uint64_t rpdos_ = 0, updates_ = 0, synchronous_expected_ = 0, synchronous_updates_ = 0, syncs_ = 0;
  std::uint64_t synchronous_sent_ = 0, requests_ = 0, answers_ = 0, aborts_ = 0, faults_ = 0, emergencies_ = 0;
  std::uint64_t too_short_ = 0, events_ = 0, times_ = 0, emergencies_heard_ = 0, emergencies_of_node_9_ = 0;
  std::uint64_t mode_changes_ = 0, life_guard_events_ = 0;
  bool is_kept_ = false, is_short_ = false;
};

}  // namespace

TEST_CASE(
    "soak: a minute at full bus load with all services: no PDO, EMCY, answer or heartbeat is lost or late [T16]") {
  PdoSoak soak(1801);
  soak.run(test::soak_time());
  soak.check();
}

#endif
