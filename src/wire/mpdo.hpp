// SPDX-License-Identifier: Apache-2.0
// Multiplex PDOs: their frames [301:7.2.3], and the entries of the object scanner list and the object dispatching list
// [301:7.5.2.39-40].
#pragma once

#include "co_obj.h"
#include "wire/frame.hpp"

namespace co::wire {

inline constexpr uint8_t mpdo_dlc = 8;
inline constexpr uint32_t mpdo_data = 4;            // bytes
inline constexpr uint8_t mpdo_to_consumer = 0x80;   // bit 7 of the address, which is the consumer's; 0: the producer's
inline constexpr uint8_t mpdo_node_id = 0x7F;       // bits 6…0; 0: all consumers
inline constexpr uint32_t mpdo_next_sub = 1U << 8;  // added to a key

// Returns the first word of a frame: address, index, sub-index. key: CO_DEV()
constexpr uint32_t mpdo_low(uint8_t address, uint32_t key) {
  return address | ((key & 0xFFFF0000U) >> 8) | ((key & 0xFF00U) << 16);
}
constexpr uint8_t mpdo_address(uint32_t low) { return static_cast<uint8_t>(low); }
constexpr uint32_t mpdo_key(uint32_t low) { return ((low & 0x00FFFF00U) << 8) | ((low >> 24) << 8); }

inline CO_IF_FRM mpdo(uint32_t identifier, uint8_t address, uint32_t key, uint32_t data) {
  CO_IF_FRM frame = empty_frame(identifier, mpdo_dlc);
  put_low(frame, mpdo_low(address, key));
  put_high(frame, data);
  return frame;
}

static_assert(mpdo_low(0x85, CO_DEV(0x6200, 0x01)) == 0x01620085);
static_assert(mpdo_key(0x01620085) == CO_DEV(0x6200, 0x01) && mpdo_address(0x01620085) == 0x85);

// Returns the number of consecutive sub-indices in an entry of a list. high: the 32 bits of the entry that begin with
// the block size; block size 0 means a single object.
constexpr uint8_t mpdo_block(uint32_t high) { return static_cast<uint8_t>((high >> 24) != 0 ? high >> 24 : 1U); }

// Returns the key in an entry of the object scanner list: block size, index, sub-index.
constexpr uint32_t scan_key(uint32_t entry) { return entry << 8; }

static_assert(mpdo_block(0x03600001) == 3 && scan_key(0x03600001) == CO_DEV(0x6000, 0x01));
static_assert(mpdo_block(0x00600001) == 1);

// Return parts of an entry of the object dispatching list. dispatch_own(): block size, index and sub-index of the
// object of this node; dispatch_key(): its key; dispatch_producer(): index, sub-index and node-ID of the producer.
constexpr uint32_t dispatch_own(uint64_t entry) { return static_cast<uint32_t>(entry >> 32); }
constexpr uint32_t dispatch_key(uint64_t entry) { return dispatch_own(entry) << 8; }
constexpr uint32_t dispatch_producer(uint64_t entry) { return static_cast<uint32_t>(entry); }

static_assert(mpdo_block(dispatch_own(0x0224000120030A7F)) == 2);
static_assert(dispatch_key(0x0224000120030A7F) == CO_DEV(0x2400, 0x01));
static_assert(dispatch_producer(0x0224000120030A7F) == (CO_DEV(0x2003, 0x0A) | 0x7F));

}  // namespace co::wire
