// SPDX-License-Identifier: Apache-2.0
/// \file soak_neighbour.hpp
/// Node 6 of the soak test: it produces SYNC (with a separate identifier) and TIME, is guarded, is the NMT master, and
/// reads an object of node 5. It counts the frames that it sends.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <vector>

#include "support/network.hpp"
#include "support/notation.hpp"

namespace test {

/// Checks that one frame of an identifier comes in every period, never early.
struct Periodic {
  using Micros = std::chrono::microseconds;

  Micros period;
  Micros begin{0};
  std::uint64_t seen = 0;
  Micros latest{0};

  void take(Micros time) {
    ++seen;
    const Micros due = begin + period * static_cast<std::int64_t>(seen);
    CHECK(time >= due);
    latest = std::max(latest, time - due);
  }

  void check(Micros end, Micros tolerance) const {
    CHECK(seen == static_cast<std::uint64_t>((end - begin) / period));
    CHECK(latest <= tolerance);
  }
};

#if USE_TIME && USE_SYNC && USE_GUARDING && USE_NMT_MASTER && USE_CSDO

class Neighbour {
 public:
  using Micros = std::chrono::microseconds;
  static constexpr bool produces_time = true;

  Neighbour(World& world, Line& line) : world_(world), line_(line), device_(add_device()) {
    const CO_TIME_OF_DAY noon = {12 * 60 * 60 * 1000, 12345};
    REQUIRE(COTimeSet(&device_.node, &noon) == CO_ERR_NONE);
    REQUIRE(COTimeProduce(&device_.node, time_period / std::chrono::milliseconds(1)) == CO_ERR_NONE);
  }

  bool sends(const co::VirtualBus::Traffic& traffic) const { return traffic.sender == &device_.port; }

  /// Sends a guard request, an NMT command or an SDO request when one is due.
  void act() {
    const Micros now = world_.clock.time();
    if (now >= next_guarding_) {
      next_guarding_ += guarding;
      ++requests_;
      line_.bus.inject(frame("706#R"));
    }
    if (now >= next_command_) {
      next_command_ += std::chrono::seconds(1);
      CHECK(CONmtCommand(&device_.node.Nmt, CO_NMT_COMMAND_START, 5) == CO_ERR_NONE);
      ++commands_;
    }
    if (now >= next_reading_) {
      next_reading_ += reading;
      ++sdo_requests_;
      CHECK(COCSdoRequestUpload(COCSdoFind(&device_.node, 0), CO_DEV(0x1017, 0), value_, sizeof value_, on_end, 50) ==
            CO_ERR_NONE);
    }
  }

  void hear(const CO_IF_FRM& frame, Micros time) {
    switch (frame.Identifier) {
      case 0x000: ++commands_seen_; break;
      case 0x0C1: syncs_.take(time); break;
      case 0x605: break;
      case 0x100: times_.take(time); break;
      case 0x706: hear_guarding(frame); break;
      default: FAIL_CHECK("unexpected ", notation(frame)); break;
    }
  }

  void check(Micros tolerance) const {
    const CO_NODE_COUNTERS counters = device_.counters();
    CHECK(counters.Dropped == 0);
    CHECK(counters.Malformed == 0);
    CHECK(commands_seen_ == commands_);
    CHECK(answers_ == requests_);
    CHECK(readings_ == sdo_requests_);
    CHECK(CONmtGetMode(&device_.node.Nmt) == CO_PREOP);
    syncs_.check(world_.clock.time(), tolerance);
    times_.check(world_.clock.time(), tolerance);
  }

  std::uint64_t times() const { return times_.seen; }
  std::uint64_t sdo_requests() const { return sdo_requests_; }

 private:
  static constexpr Micros sync_period{4000};
  static constexpr Micros time_period{100000};
  static constexpr Micros guarding{15000};  // half of the life time
  static constexpr Micros reading{40000};
  static constexpr std::uint8_t heartbeat_time_of_node_5 = 7;  // ms

  struct Objects {
    std::uint8_t error_register = 0;
    std::uint32_t sync_id = 0x400000C1;
    std::uint32_t sync_cycle = sync_period.count();
    std::uint32_t time_id = 0x40000100;
    std::uint32_t sdo_tx = 0x605;
    std::uint32_t sdo_rx = 0x585;
  };

  Device& add_device() {
    const auto row = [](std::uint32_t index, std::uint32_t flags, const CO_OBJ_TYPE* type, CO_DATA data,
                        std::uint32_t sub = 0) {
      return CO_OBJ{CO_KEY(index, sub, flags), type, data};
    };
    constexpr std::uint32_t d = CO_OBJ_D___R_;
    table_ = {
        row(0x1000, d, CO_TUNSIGNED32, 0),
        row(0x1001, CO_OBJ_____R_, CO_TUNSIGNED8, CO_DATA(&objects_.error_register)),
        row(0x1005, CO_OBJ_____R_, CO_TSYNC_ID, CO_DATA(&objects_.sync_id)),
        row(0x1006, CO_OBJ_____R_, CO_TSYNC_CYCLE, CO_DATA(&objects_.sync_cycle)),
        row(0x100C, d, CO_TUNSIGNED16, 10),
        row(0x100D, d, CO_TUNSIGNED8, 3),
        row(0x1012, CO_OBJ_____R_, CO_TTIME_ID, CO_DATA(&objects_.time_id)),
        row(0x1018, d, CO_TUNSIGNED8, 1),
        row(0x1018, d, CO_TUNSIGNED32, 0, 1),
        row(0x1280, CO_OBJ_____R_, CO_TSDO_ID, CO_DATA(&objects_.sdo_tx), 1),
        row(0x1280, CO_OBJ_____R_, CO_TSDO_ID, CO_DATA(&objects_.sdo_rx), 2),
        row(0x1280, d, CO_TUNSIGNED8, 5, 3),
        CO_OBJ_DICT_ENDMARK,
    };
    DeviceOptions options{6};
    options.table = table_.data();
    options.user = this;
    return world_.add_device(line_, options);
  }

  static void on_end(CO_CSDO* client, std::uint16_t, std::uint8_t, std::uint32_t code) {
    auto& neighbour = *static_cast<Neighbour*>(CONodeGetUser(client->Node));
    CHECK(code == 0);
    CHECK(neighbour.value_[0] == heartbeat_time_of_node_5);
    ++neighbour.readings_;
  }

  // Checks the toggle bit and the state. [301:7.2.8.3.2.1]
  void hear_guarding(const CO_IF_FRM& frame) {
    if (frame.Data[0] != 0x00) {  // not the boot-up message
      CHECK(frame.Data[0] == (answers_ % 2 == 0 ? 0x7F : 0xFF));
      ++answers_;
    }
  }

  World& world_;
  Line& line_;
  Objects objects_;
  std::vector<CO_OBJ> table_;
  Periodic syncs_{sync_period};
  Periodic times_{time_period};
  Micros next_guarding_{0}, next_command_{500000}, next_reading_{1000};
  std::uint8_t value_[2] = {};
  std::uint64_t sdo_requests_ = 0, readings_ = 0;
  std::uint64_t requests_ = 0, answers_ = 0, commands_ = 0, commands_seen_ = 0;
  Device& device_;
};

#else

/// Empty replacement for configurations without the second node.
class Neighbour {
 public:
  static constexpr bool produces_time = false;
  Neighbour(World&, Line&) {}
  bool sends(const co::VirtualBus::Traffic&) const { return false; }
  void act() {}
  void hear(const CO_IF_FRM&, std::chrono::microseconds) {}
  void check(std::chrono::microseconds) const {}
  std::uint64_t times() const { return 0; }
  std::uint64_t sdo_requests() const { return 0; }
};

#endif

}  // namespace test
