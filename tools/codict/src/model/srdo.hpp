// SPDX-License-Identifier: Apache-2.0
/// \file srdo.hpp
/// The SRDOs of a device with their values in force, and their signatures. [EN 50325-5]
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "model/device.hpp"
#include "model/pdo.hpp"

namespace lexican::codict {

/// Objects of SRDOs and of the global fail-safe command (GFC).
namespace srdo_index {
inline constexpr std::uint16_t global_fail_safe = 0x1300;  ///< 1: the GFC is used
inline constexpr std::uint16_t communication = 0x1301;     ///< 1301h…1340h
inline constexpr std::uint16_t mapping = 0x1381;           ///< 1381h…13C0h
inline constexpr std::uint16_t valid = 0x13FE;             ///< A5h: the configuration is valid
inline constexpr std::uint16_t signatures = 0x13FF;        ///< sub-index n: signature of SRDO n
}  // namespace srdo_index

inline constexpr std::uint8_t srdo_limit = 64;           ///< highest number of an SRDO
inline constexpr std::uint8_t srdo_mapped_limit = 16;    ///< highest number of mapped objects
inline constexpr std::uint64_t srdo_transmitted = 1;     ///< direction
inline constexpr std::uint64_t srdo_received = 2;        ///< direction
inline constexpr std::uint64_t srdo_type = 254;          ///< transmission type
inline constexpr std::uint64_t srdo_valid_value = 0xA5;  ///< value of 13FEh

/// An SRDO whose communication parameter is described and whose direction is not 0.
struct Srdo {
  std::uint8_t number = 1;      ///< 1…64
  std::uint64_t direction = 0;  ///< srdo_transmitted, srdo_received, or an invalid value
  const Object* communication = nullptr;
  const Object* mapping = nullptr;   ///< null if it is not described
  std::vector<MappedObject> mapped;  ///< alternately the data and the inverted data

  bool is_transmit() const { return direction == srdo_transmitted; }
  /// Returns the length of each frame: that of the mapped data, at most 8.
  std::uint8_t bytes() const;
  /// Returns a sub-object of the communication parameter; null if there is none.
  const Entry* parameter(std::uint8_t sub_index) const { return communication->find(sub_index); }
};

/// Returns the SRDOs, sorted by number.
std::vector<Srdo> srdos_of(const Device& device);

/// Returns the number that is the value of an entry; 0 if there is no such entry; nothing if the value is unknown or
/// depends on the node-ID.
using NumberOf = std::function<std::optional<std::uint64_t>(std::uint16_t index, std::uint8_t sub_index)>;

/// Returns the signature of SRDO \a number, as the stack computes it (co_srdo.h, COSrdoSignature()); nothing if it does
/// not exist, if a value is unknown, or if it maps more than 16 objects.
std::optional<std::uint16_t> srdo_signature(std::uint8_t number, const NumberOf& number_of);
/// Returns the signature of SRDO \a number of a device, from the values in force.
std::optional<std::uint16_t> srdo_signature(std::uint8_t number, const Device& device);

}  // namespace lexican::codict
