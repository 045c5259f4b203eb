// SPDX-License-Identifier: Apache-2.0
/// \file tour_steps.hpp
/// What the steps of the tour have in common, and those of them that are about process data, LSS and storage.
#pragma once

#include <string>

#include "client/sdo_client.hpp"
#include "clock/time_of_day.hpp"
#include "tour/master.hpp"
#include "tour/view.hpp"

namespace demo {

struct Finding {
  bool good;
  std::string text;
};

struct Tour {
  Device& device;
  Master& master;
  View& view;
  SdoClient& sdo = master.sdo();
  const DeviceTraits& traits = device.traits();
  TimeOfDay set_to = {};  // the clock
  Micros set_at = 0;      // when; 0: not yet
};

constexpr char station_name[] = "Central Station";

Bytes bytes_of(const char* text);

constexpr std::uint32_t seconds_per_day = 24 * 60 * 60;

/// Since midnight.
constexpr std::uint32_t seconds_of(const TimeOfDay& time) {
  return (time.hour * 60u + time.minute) * 60u + time.second;
}

inline Finding failure(const char* what, const Transfer& transfer) {
  return {false, std::string(what) + ": " + transfer.outcome()};
}

/// The node is in Operational: TPDO1 tells the time.
Finding hear_time(Tour& tour);

/// RPDO1 sets it.
Finding set_clock_by_pdo(Tour& tour);

/// RPDO1 sets it to what no clock shows.
Finding set_nonsense_by_pdo(Tour& tour);

/// The node produces SYNC for a while, with a synchronous TPDO1.
Finding produce_sync(Tour& tour);

#if USE_LSS_MASTER
/// The node starts without node-ID.
Finding find_unconfigured(Tour& tour);

/// The node that was found gets its node-ID, stores it and boots.
Finding give_node_id(Tour& tour);
#endif

/// How long the tour waits for what should happen within \a time.
inline Micros at_most(const Tour& tour, Micros time) { return time * tour.traits.patience; }

/// The time zone is set, and stored with the name of the station.
Finding save_settings(Tour& tour);

/// The node is started again, and has what was stored.
Finding lose_power(Tour& tour);

/// Another time zone is set, but not stored; an NMT reset brings the one back that was.
Finding reset_settings(Tour& tour);

}  // namespace demo
