// SPDX-License-Identifier: Apache-2.0
/// \file dictionary.hpp
/// The object dictionary of the demo device [301:7.4]: a clock whose time of day, texts and picture can be read and
/// written over CANopen. It is made of clock.xdd, by demo/generate; here is what the description leaves to the
/// application. It needs no operating system.
#pragma once

#include "clock/generated/clock_od.h"
#include "clock/time_of_day.hpp"
#include "host/table.hpp"

namespace demo {

constexpr std::uint32_t clock_product_code = 0xC10C;
constexpr std::uint32_t clock_serial_number = 1;
constexpr char clock_name[] = "Lexican demo clock";

/// Bytes of memory that survive a loss of power.
constexpr std::uint32_t clock_memory_size = 256;

// To be supplied by the program, beside this library:
//   clock_1009_0   what the clock runs on, a text
//   clock_2200_0   red, green and blue of each pixel, as many as it can afford

Table clock_dictionary();

/// Hour, minute and second that no clock shows.
Errors clock_errors();

}  // namespace demo
