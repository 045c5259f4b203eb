// SPDX-License-Identifier: Apache-2.0
// SDO frames. [301:7.2.4.3]
#pragma once

#include "co_if_can.h"
#include "co_obj.h"
#include "co_sdo.h"
#include "wire/bytes.hpp"

namespace co::wire {

inline constexpr uint8_t sdo_dlc = 8;
inline constexpr uint32_t segment_bytes = 7;
inline constexpr uint32_t expedited_bytes = 4;

// Client command specifier, bits 7…5 of the first byte.
enum class Ccs : uint8_t {
  download_segment = 0,
  initiate_download = 1,
  initiate_upload = 2,
  upload_segment = 3,
  abort = 4,
  block_upload = 5,
  block_download = 6,
  unknown = 7,
};
inline constexpr uint8_t ccs_count = 8;

// Bits of a command that are always 0, by client command specifier. [301:7.2.4.3] The rest of an abort does not matter.
inline constexpr uint8_t reserved_bits[ccs_count] = {0x00, 0x10, 0x1F, 0x0F, 0x00, 0x00, 0x00, 0x00};

constexpr Ccs ccs_of(uint8_t command) {
  const unsigned specifier = command >> 5;
  return (command & reserved_bits[specifier]) == 0 ? static_cast<Ccs>(specifier) : Ccs::unknown;
}
constexpr Ccs ccs(const CO_IF_FRM& frame) { return ccs_of(frame.Data[0]); }

inline constexpr uint8_t toggle_bit = 0x10;
constexpr uint8_t toggle(const CO_IF_FRM& frame) { return frame.Data[0] & toggle_bit; }

// Multiplexer: index in bytes 1 and 2, sub-index in byte 3; as a key without flags.
constexpr uint32_t multiplexer(const CO_IF_FRM& frame) {
  return CO_DEV(static_cast<uint32_t>(frame.Data[1]) | (static_cast<uint32_t>(frame.Data[2]) << 8), frame.Data[3]);
}

constexpr void put_head(CO_IF_FRM& frame, uint8_t command, uint32_t key) {
  frame.Data[0] = command;
  frame.Data[1] = static_cast<uint8_t>(key >> 16);
  frame.Data[2] = static_cast<uint8_t>(key >> 24);
  frame.Data[3] = static_cast<uint8_t>(key >> 8);
}

// Initiate: 0ssx nnes. e: expedited, s: size indicated, n: bytes of the four that hold no data.
constexpr bool is_expedited(uint8_t command) { return (command & 0x02) != 0; }
constexpr bool is_size_indicated(uint8_t command) { return (command & 0x01) != 0; }
constexpr uint32_t expedited_length(uint8_t command) { return expedited_bytes - ((command >> 2) & 0x03U); }

// Segment: 000t nnnc. n: bytes of the seven that hold no data, c: no more segments.
constexpr uint32_t segment_length(uint8_t command) { return segment_bytes - ((command >> 1) & 0x07U); }
constexpr bool is_last_segment(uint8_t command) { return (command & 0x01) != 0; }

// Answers of a server.
inline constexpr uint8_t initiate_download_response = 0x60;
inline constexpr uint8_t initiate_upload_response_sized = 0x41;
inline constexpr uint8_t abort_command = 0x80;
constexpr uint8_t expedited_upload_response(uint32_t length) {
  return static_cast<uint8_t>(0x43U | ((expedited_bytes - length) << 2));
}
constexpr uint8_t download_segment_response(uint8_t toggle) { return static_cast<uint8_t>(0x20U | toggle); }
constexpr uint8_t upload_segment_response(uint8_t toggle, uint32_t length, bool last) {
  return static_cast<uint8_t>(toggle | ((segment_bytes - length) << 1) | (last ? 1U : 0U));
}

static_assert(ccs_of(0x2F) == Ccs::initiate_download && ccs_of(0x30) == Ccs::unknown && ccs_of(0x41) == Ccs::unknown);
static_assert(ccs_of(0x70) == Ccs::upload_segment && ccs_of(0x61) == Ccs::unknown && ccs_of(0x9F) == Ccs::abort);
static_assert(expedited_upload_response(4) == 0x43 && expedited_upload_response(3) == 0x47);
static_assert(expedited_upload_response(2) == 0x4B && expedited_upload_response(1) == 0x4F);
static_assert(expedited_length(0x2F) == 1 && expedited_length(0x23) == 4 && !is_size_indicated(0x22));
static_assert(segment_length(0x0F) == 0 && segment_length(0x00) == 7 && segment_length(0x1D) == 1);
static_assert(upload_segment_response(0x10, 2, true) == 0x1B && download_segment_response(0x10) == 0x30);

}  // namespace co::wire
