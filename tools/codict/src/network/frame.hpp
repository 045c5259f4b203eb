// SPDX-License-Identifier: Apache-2.0
/// \file frame.hpp
/// Lengths of classic CAN frames in bit times, with stuff bits and the 3 bits of interframe space. [ISO 11898-1]
#pragma once

#include <cstdint>
#include <string_view>

namespace lexican::codict::network {

struct Frame {
  std::uint32_t identifier = 0;
  bool is_extended = false;  ///< 29-bit identifier
  bool is_remote = false;
  std::uint8_t bytes = 0;  ///< 0…8: the DLC; a remote frame has no data field
};

/// Returns the largest length that any data can give: 55 + 10 n for 11 bits, 80 + 10 n for 29 bits. [Davis 2007, (1)]
unsigned longest_bits(const Frame& frame);

/// Returns the length of a frame whose data is known. data.size() is frame.bytes, or 0 for a remote frame.
unsigned exact_bits(const Frame& frame, std::string_view data);

/// Returns the mean length over all data: each bit of data field and CRC is 0 or 1 with the same probability.
double mean_bits(const Frame& frame);

}  // namespace lexican::codict::network
