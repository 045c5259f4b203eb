// SPDX-License-Identifier: Apache-2.0
// COB-IDs: CAN-ID and flags of a communication object. [301:7.2.2.1, 7.3.5]
#pragma once

#include "co_if_can.h"

namespace co::wire {

enum class CobId : uint32_t {
  nmt = 0x000,
  gfc = 0x001,
  sdo_tx = 0x580,
  sdo_rx = 0x600,
  error_control = 0x700,
};

constexpr uint32_t operator+(CobId base, uint8_t node_id) { return static_cast<uint32_t>(base) + node_id; }

inline constexpr uint32_t cob_invalid = 1U << 31;  // the object does not exist
inline constexpr uint32_t cob_frame = 1U << 29;    // 29-bit CAN-ID
inline constexpr uint32_t base_ids = 0x7FF;
inline constexpr uint32_t extended_ids = CO_IF_FRM_ID;

// CAN-IDs that no configurable object may use. [301:7.3.5 table 38]
struct Range {
  uint16_t first;
  uint16_t last;
};
inline constexpr Range restricted[] = {{0x000, 0x07F}, {0x101, 0x180}, {0x581, 0x5FF},
                                       {0x601, 0x67F}, {0x6E0, 0x6FF}, {0x701, 0x7FF}};

constexpr bool is_restricted(uint32_t id) {
  for (const Range& range : restricted) {
    if (id >= range.first && id <= range.last) {
      return true;
    }
  }
  return false;
}

// Returns whether a default SDO server transmits (tx) or receives (rx) with this CAN-ID.
constexpr bool is_default_sdo_tx(uint32_t id) { return id >= 0x581 && id <= 0x5FF; }
constexpr bool is_default_sdo_rx(uint32_t id) { return id >= 0x601 && id <= 0x67F; }

constexpr bool is_valid(uint32_t cob_id) { return (cob_id & cob_invalid) == 0; }

// Returns whether the CAN-ID fits the frame format that bit 29 selects.
constexpr bool fits_format(uint32_t cob_id) { return (cob_id & cob_frame) != 0 || (cob_id & extended_ids) <= base_ids; }

// Returns whether an object can have frames with this COB-ID: it is valid, its CAN-ID fits its frame format and is not
// 000h, which always belongs to NMT.
constexpr bool is_usable(uint32_t cob_id) {
  return is_valid(cob_id) && fits_format(cob_id) && (cob_id & extended_ids) != 0;
}

// Value that is no identifier of a frame: the object has no frames.
inline constexpr uint32_t no_frame = UINT32_MAX;

// Returns the identifier of frames with this COB-ID, in the format of drivers.
constexpr uint32_t frame_id(uint32_t cob_id) {
  return (cob_id & extended_ids) | ((cob_id & cob_frame) != 0 ? CO_IF_FRM_EXT : 0);
}

// Returns the identifier of a driver's frame with CO_IF_FRM_EXT set if its value needs 29 bits: not all drivers set the
// flag.
constexpr uint32_t normalised(uint32_t identifier) {
  return (identifier & extended_ids) > base_ids ? identifier | CO_IF_FRM_EXT : identifier;
}

static_assert(is_restricted(0x000) && is_restricted(0x07F) && !is_restricted(0x080) && !is_restricted(0x100));
static_assert(is_restricted(0x101) && is_restricted(0x180) && !is_restricted(0x181) && !is_restricted(0x580));
static_assert(is_restricted(0x581) && is_restricted(0x5FF) && !is_restricted(0x600) && is_restricted(0x601));
static_assert(is_restricted(0x67F) && !is_restricted(0x680) && is_restricted(0x6E0) && !is_restricted(0x700));
static_assert(is_restricted(0x701) && is_restricted(0x7FF) && !is_restricted(0x800));
static_assert(frame_id(0x20000123) == 0x80000123 && frame_id(0xC0000601) == 0x601);
static_assert(is_usable(0x00000001) && !is_usable(0x20000000) && !is_usable(0x80000001) && !is_usable(0x00000800));
static_assert(!fits_format(0x00000800) && fits_format(0x20000800));

}  // namespace co::wire
