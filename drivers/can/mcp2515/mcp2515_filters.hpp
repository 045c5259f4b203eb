// SPDX-License-Identifier: Apache-2.0
/// \file mcp2515_filters.hpp
/// Computes the two masks and six filters that pass the given identifiers, and few others.
#ifndef CO_DRIVERS_MCP2515_FILTERS_HPP_
#define CO_DRIVERS_MCP2515_FILTERS_HPP_

#include <cstdint>

#include "../mask_filters.hpp"
#include "co_can_mcp2515.h"

namespace co::mcp2515 {
/// \cond internal

inline constexpr unsigned receive_buffers = 2;
inline constexpr unsigned filter_number = 6;
/// Numbers of filters of the receive buffers.
inline constexpr unsigned filters_of_buffer[receive_buffers] = {2, 4};

using Filters = CO_MCP2515_ACCEPTANCE;
using identifiers::extended_bit;
using identifiers::word_of;

/// Returns filters that pass all frames.
constexpr Filters open_filters() { return {{0, 0}, {0, extended_bit, 0, extended_bit, 0, extended_bit}}; }

/// Returns filters for \a ids: coded like in CO_IF_CAN_DRV_EX.Filter, ascending. Without identifiers, only the 29-bit
/// identifier 1FFFFFFFh passes.
Filters filters_of(const std::uint32_t* ids, unsigned num);

/// Returns whether all \a ids pass.
bool all_pass(const Filters& filters, const std::uint32_t* ids, unsigned num);

/// Returns whether all frames pass.
inline bool is_open(const Filters& filters) { return filters.Mask[0] == 0; }

/// \endcond
}  // namespace co::mcp2515

#endif
