// SPDX-License-Identifier: Apache-2.0
/// \file cause.hpp
/// The causes that `lexican why` knows. Each has a page in docs/causes, with its name.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lexican::explain {

enum class CauseId : std::uint8_t {
  bus_off,
  bus_errors,
  bus_load,
  same_node_id,
  cob_id_collision,
  boot_loop,
  restarted,
  heartbeat_missing,
  heartbeat_time,
  guarding_unanswered,
  lss_unconfigured,
  emcy_storm,
  error_active,
  sync_missing,
  sync_too_fast,
  rpdo_missing,
  pdo_length,
  inhibit_time,
  sdo_refused,
  sdo_busy,
  segments_lost,
  toggle_wrong,
};

struct Cause {
  CauseId id;
  const char* name;   ///< of the page, and in JSON
  const char* title;  ///< one sentence without full stop
};

/// All causes, in the order of CauseId: the first ones have the others as consequences.
inline constexpr Cause causes[] = {
    {CauseId::bus_off, "bus-off", "A device was bus-off"},
    {CauseId::bus_errors, "bus-errors", "Frames are destroyed on the bus, or not acknowledged"},
    {CauseId::bus_load, "bus-load", "The bus load is above 80 %"},
    {CauseId::same_node_id, "same-node-id", "Two devices have the same node-ID"},
    {CauseId::cob_id_collision, "cob-id-collision", "Two devices send with the same COB-ID"},
    {CauseId::boot_loop, "boot-loop", "A device starts again and again"},
    {CauseId::restarted, "restarted", "A device in Operational has started anew"},
    {CauseId::heartbeat_missing, "heartbeat-missing", "A device does not send its heartbeat any more"},
    {CauseId::heartbeat_time, "heartbeat-time", "A device expects heartbeats sooner than they are sent"},
    {CauseId::guarding_unanswered, "guarding-unanswered", "A device does not answer node guarding"},
    {CauseId::lss_unconfigured, "lss-unconfigured", "A device has no node-ID and waits for LSS"},
    {CauseId::emcy_storm, "emcy-storm", "A device sends EMCY messages all the time"},
    {CauseId::error_active, "error-active", "A device reports an error that has not gone"},
    {CauseId::sync_missing, "sync-missing", "A device has synchronous PDOs, and there is no SYNC"},
    {CauseId::sync_too_fast, "sync-too-fast", "SYNC comes faster than the PDOs can follow"},
    {CauseId::rpdo_missing, "rpdo-missing", "A device in Operational never receives an RPDO"},
    {CauseId::pdo_length, "pdo-length", "A PDO has another length than its mapping"},
    {CauseId::inhibit_time, "inhibit-time", "The inhibit time of a TPDO is never over"},
    {CauseId::sdo_refused, "sdo-refused", "A device refuses the same SDO access again and again"},
    {CauseId::sdo_busy, "sdo-busy", "An SDO server is busy, or does not answer"},
    {CauseId::segments_lost, "segments-lost", "Segments of an SDO transfer are lost"},
    {CauseId::toggle_wrong, "toggle-wrong", "The toggle bit of SDO segments is wrong"},
};

inline const Cause& cause_of(CauseId id) { return causes[static_cast<std::size_t>(id)]; }

}  // namespace lexican::explain
