// SPDX-License-Identifier: Apache-2.0
/// \file cob_id.hpp
/// The COB-IDs of a device.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/device.hpp"

namespace lexican::codict {

constexpr std::uint64_t cob_id_invalid = 0x80000000U;  ///< bit 31 of a COB-ID: the PDO or service does not exist

inline constexpr std::uint32_t cob_id_extended = 0x20000000U;  ///< bit of a COB-ID: 29-bit identifier

struct CobId {
  std::string service;      ///< "TPDO 3", "SDO server 1, request"
  std::uint16_t index = 0;  ///< index of the object that holds it; 0: fixed by CiA 301
  std::uint8_t sub_index = 0;
  std::uint32_t value = 0;     ///< with the node-ID added, and with all flags
  bool is_known = false;       ///< the description has a value
  bool can_be_invalid = true;  ///< bit 31 marks it as not valid; not so for SYNC and TIME
  bool is_safety = false;      ///< frame of an SRDO, or the global fail-safe command [EN 50325-5]

  bool is_valid() const { return is_known && !(can_be_invalid && (value & 0x80000000U) != 0); }
  bool is_extended() const { return (value & cob_id_extended) != 0; }
  std::uint32_t identifier() const { return value & (is_extended() ? 0x1FFFFFFFU : 0x7FFU); }
};

/// Returns the COB-IDs of a device: first those that CiA 301 fixes, then those of objects. SRDOs and the GFC are
/// included if they exist (1301h sub 1, 1300h).
std::vector<CobId> cob_ids_of(const Device& device, std::uint8_t node_id);

}  // namespace lexican::codict
