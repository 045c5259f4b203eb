// SPDX-License-Identifier: Apache-2.0
/// \file tour_steps.hpp
/// Common parts of the steps of the tour, and the steps for process data, LSS and storage.
#pragma once

#include <string>

#include "client/sdo_client.hpp"
#include "clock/time_of_day.hpp"
#include "tour/master.hpp"
#include "tour/view.hpp"

namespace lexican::demo {

/// Result of a step.
struct Finding {
  bool good;         // as expected
  std::string text;  // shown to the user
};

struct Tour {
  Device& device;
  Master& master;
  View& view;
  SdoClient& sdo = master.sdo();
  const DeviceTraits& traits = device.traits();
  TimeOfDay set_to = {};  // time that the clock was set to
  Micros set_at = 0;      // when it was set; 0: not yet
};

constexpr char station_name[] = "Central Station";

Bytes bytes_of(const char* text);

constexpr std::uint32_t seconds_per_day = 24 * 60 * 60;

/// Returns the seconds since midnight.
constexpr std::uint32_t seconds_of(const TimeOfDay& time) {
  return (time.hour * 60u + time.minute) * 60u + time.second;
}

inline Finding failure(const char* what, const Transfer& transfer) {
  return {false, std::string(what) + ": " + transfer.outcome()};
}

/// Checks that TPDO1 transmits the time. The node must be in Operational.
Finding receive_time(Tour& tour);

/// Sets the clock by RPDO1.
Finding set_clock_by_pdo(Tour& tour);

/// Sets the clock by RPDO1 to an invalid time, and expects an EMCY message.
Finding set_invalid_time_by_pdo(Tour& tour);

/// Lets the node produce SYNC for a while, with a synchronous TPDO1.
Finding produce_sync(Tour& tour);

#if USE_LSS_MASTER
/// Starts the node without node-ID, and finds it by fastscan.
Finding find_unconfigured(Tour& tour);

/// Configures and stores the node-ID of the found node, which boots then.
Finding configure_node_id(Tour& tour);
#endif

/// Returns the time-out for an event that is expected within \a time.
inline Micros scaled_timeout(const Tour& tour, Micros time) { return time * tour.traits.timeout_factor; }

/// Sets the time zone, and stores it with the name of the station.
Finding save_settings(Tour& tour);

/// Restarts the node after a power failure, and checks the stored values.
Finding lose_power(Tour& tour);

/// Sets another time zone without storing it, and checks that an NMT reset restores the stored one.
Finding reset_settings(Tour& tour);

}  // namespace lexican::demo
