// SPDX-License-Identifier: Apache-2.0
/// \file pdo.hpp
/// The PDOs of a device with their values in force: the defaults, or the configured values of a DCF. [301: 7.5.2.35
/// ff.]
#pragma once

#include <cstdint>
#include <vector>

#include "model/device.hpp"

namespace lexican::codict {

/// Transmission types: values of sub-index 2 of the communication parameters. [301: 7.5.2.35, 7.5.2.37]
namespace transmission_type {
inline constexpr std::uint64_t last_synchronous = 240;    ///< 0: acyclic, 1…240: after each 1st to 240th SYNC
inline constexpr std::uint64_t remote_synchronous = 252;  ///< TPDO sampled at a SYNC, sent on a remote request
inline constexpr std::uint64_t remote = 253;              ///< TPDO sampled and sent on a remote request
inline constexpr std::uint64_t event_manufacturer = 254;  ///< event-driven, defined by the manufacturer
inline constexpr std::uint64_t event_profile = 255;       ///< event-driven, defined by the device profile
}  // namespace transmission_type

/// Directions of PDOs in which an entry can be mapped.
struct Directions {
  bool send = false;     ///< in TPDOs
  bool receive = false;  ///< in RPDOs
};

Directions directions_of(const Entry& entry);

/// An object that is mapped in a PDO.
struct MappedObject {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  std::uint8_t bits = 0;
  const Entry* entry = nullptr;    ///< null if the device does not describe it: a dummy, or a fault of the mapping
  const Entry* mapping = nullptr;  ///< the sub-object of the mapping parameter

  bool is_dummy() const { return index != 0 && index < 8 && sub_index == 0; }
};

/// Returns the objects that a mapping parameter maps: at most \a limit, without entries that are 0.
std::vector<MappedObject> mapped_objects(const Device& device, const Object& mapping, std::uint64_t limit);

struct Pdo {
  bool is_transmit = false;
  std::uint16_t number = 1;  ///< 1…512
  const Object* communication = nullptr;
  const Object* mapping = nullptr;  ///< null if only the communication parameter is described
  bool is_multiplexed = false;      ///< sub-index 0 of the mapping is FEh or FFh
  std::vector<MappedObject> mapped;

  unsigned bits() const;  ///< length in bits of all mapped objects; the limit is 64
  /// Returns a sub-object of the communication parameter; null if there is none.
  const Entry* parameter(std::uint8_t sub_index) const;
};

/// Returns the RPDOs, then the TPDOs, each sorted by number.
std::vector<Pdo> pdos_of(const Device& device);

}  // namespace lexican::codict
