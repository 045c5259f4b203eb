// SPDX-License-Identifier: Apache-2.0
/// \file transfer.hpp
/// SDO transfers to measure, one after the other, with given data.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

namespace speed {

using Time = std::chrono::microseconds;
using Bytes = std::vector<std::uint8_t>;

enum class Way { expedited, segmented, block };

struct Transfers {
  Way way;
  bool upload;
  std::vector<Bytes> data;  ///< data of each transfer, all of the same size: 4 bytes if expedited
};

/// Address of the object of the server.
constexpr std::uint16_t object_index = 0x2000;
constexpr std::uint8_t object_sub = 0;
/// Node-ID of the server.
constexpr std::uint8_t server_id = 5;

}  // namespace speed
