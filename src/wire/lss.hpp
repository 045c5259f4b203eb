// SPDX-License-Identifier: Apache-2.0
// Layer setting services. [305]
#pragma once

#include "wire/frame.hpp"
#include "wire/nmt.hpp"

namespace co::wire {

inline constexpr uint32_t lss_request = 0x7E5;
inline constexpr uint32_t lss_answer = 0x7E4;
inline constexpr uint8_t lss_dlc = 8;

// Command specifiers. Those of an LSS address are consecutive: vendor-ID, product code, revision and serial number.
enum class Lss : uint8_t {
  switch_global = 0x04,
  configure_node_id = 0x11,
  configure_bit_timing = 0x13,
  activate_bit_timing = 0x15,
  store = 0x17,
  switch_selective = 0x40,  // …43h
  selected = 0x44,
  identify = 0x46,  // …4Bh: vendor-ID, product code, then lowest and highest revision and serial number
  identify_unconfigured = 0x4C,
  identified = 0x4F,
  unconfigured = 0x50,
  fastscan = 0x51,
  inquire = 0x5A,  // …5Dh
  inquire_node_id = 0x5E,
};

inline constexpr uint8_t lss_address_parts = 4;
inline constexpr uint8_t lss_identify_parts = 6;

// Returns whether "configure node-ID" accepts this value: a node-ID, or 255 for an unconfigured node.
constexpr bool may_be_configured(uint8_t id) { return is_node_id(id) || id == no_node_id; }

// Returns the bit rate of an index of table 0, in bit/s; 0: there is none. [305 table 1]
constexpr uint32_t bit_rate(uint8_t index) {
  constexpr uint32_t rates[] = {1000000, 800000, 500000, 250000, 125000, 0, 50000, 20000, 10000};
  return index < sizeof rates / sizeof *rates ? rates[index] : 0;
}

// Number of indexes of table 0.
inline constexpr uint8_t lss_bit_rates = 9;
// Returns the index of a bit rate in table 0; lss_bit_rates if the table does not contain it.
constexpr uint8_t index_of_bit_rate(uint32_t rate) {
  uint8_t index = 0;
  while (index < lss_bit_rates && (rate == 0 || bit_rate(index) != rate)) {
    ++index;
  }
  return index;
}

// Returns a frame with a command byte; all other bytes are 0.
inline CO_IF_FRM lss_frame(uint32_t identifier, uint8_t command) {
  CO_IF_FRM frame = empty_frame(identifier, lss_dlc);
  frame.Data[0] = command;
  return frame;
}

// Parameters of LSS fastscan. A part of the LSS address is named by its index, 0…3.
struct Fastscan {
  uint32_t number;  // IDNumber
  uint8_t bit;      // BitCheck: lowest bit that is compared; 80h: all slaves begin fastscan
  uint8_t part;     // LSSSub: the part that is compared
  uint8_t next;     // LSSNext: the part that follows when all bits of this one have matched
};
inline constexpr uint8_t fastscan_begin = 0x80;

inline void put_fastscan(CO_IF_FRM& frame, const Fastscan& scan) {
  put_u32(frame.Data + 1, scan.number);
  frame.Data[5] = scan.bit;
  frame.Data[6] = scan.part;
  frame.Data[7] = scan.next;
}

inline Fastscan get_fastscan(const CO_IF_FRM& frame) {
  return {get_u32(frame.Data + 1), frame.Data[5], frame.Data[6], frame.Data[7]};
}

// Returns whether all parameters are in range. fastscan_begin is no bit to compare, and out of range.
constexpr bool is_possible(const Fastscan& scan) {
  return scan.bit < 32 && scan.part < lss_address_parts && scan.next < lss_address_parts;
}

// Returns whether a number is equal in the bits that are compared.
constexpr bool is_match(const Fastscan& scan, uint32_t number) { return ((scan.number ^ number) >> scan.bit) == 0; }

static_assert(bit_rate(0) == 1000000 && bit_rate(5) == 0 && bit_rate(8) == 10000 && bit_rate(9) == 0);
static_assert(index_of_bit_rate(1000000) == 0 && index_of_bit_rate(10000) == 8);
static_assert(index_of_bit_rate(0) == lss_bit_rates && index_of_bit_rate(100000) == lss_bit_rates);
static_assert(is_match({0x80000000, 31, 0, 0}, 0xFFFFFFFF) && !is_match({0, 31, 0, 0}, 0x80000000));
static_assert(is_match({5, 0, 0, 0}, 5) && !is_match({5, 0, 0, 0}, 4) && is_match({5, 1, 0, 0}, 4));

}  // namespace co::wire
