// SPDX-License-Identifier: Apache-2.0
/// \file table.hpp
/// Parameters of a node in the form required by CO_NODE_SPEC.
#pragma once

#include <cstdint>

#include "co_core.h"

namespace lexican {

/// Entries of an object dictionary.
struct Table {
  CO_OBJ* first;
  std::uint16_t length;
};

/// Errors that a device can raise (CO_NODE_SPEC.EmcyCode).
struct Errors {
  CO_EMCY_TBL* first;
  std::uint16_t number;
};

constexpr std::uint8_t no_node_id = 255;  // node-ID of an unconfigured node [305]

/// Bytes at the beginning of the node's memory used for node-ID and bit rate.
#if USE_LSS && USE_PARA
constexpr std::uint32_t lss_memory_size = CO_PARA_SPACE(8U, 1U, 1U);
#else
constexpr std::uint32_t lss_memory_size = 0;
#endif

}  // namespace lexican
