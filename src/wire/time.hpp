// SPDX-License-Identifier: Apache-2.0
// TIME_OF_DAY as 6 bytes, which are also the data of the TIME message. [301:7.1.6.5, 7.2.6]
#pragma once

#include "co_time_of_day.h"
#include "wire/bytes.hpp"

namespace co::wire {

inline constexpr uint32_t time_bytes = 6;
inline constexpr uint32_t ms_bits = 0x0FFFFFFF;  // the 4 bits above are reserved
inline constexpr uint32_t ms_per_day = 86400000;

constexpr void put_time(uint8_t* p, const CO_TIME_OF_DAY& time) {
  put_u32(p, time.Ms & ms_bits);
  put_u16(p + 4, time.Days);
}

constexpr CO_TIME_OF_DAY get_time(const uint8_t* p) { return {get_u32(p) & ms_bits, get_u16(p + 4)}; }

// Returns whether a time is less than a day: a time of day must be, a time difference need not.
constexpr bool is_time_of_day(const CO_TIME_OF_DAY& time) { return time.Ms < ms_per_day; }

// 12:34:56.789 on 2026-11-21
inline constexpr uint8_t time_vector[] = {0x95, 0x2C, 0xB3, 0xF2, 0x31, 0x3D};
static_assert(get_time(time_vector).Ms == ((12 * 60 + 34) * 60 + 56) * 1000 + 789);
static_assert(get_time(time_vector).Days == 15665);
static_assert(is_time_of_day({86399999, 0}) && !is_time_of_day({86400000, 0}));

}  // namespace co::wire
