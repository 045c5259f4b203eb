// SPDX-License-Identifier: Apache-2.0
/// \file dictionary.hpp
/// Object dictionary of the demo device [301:7.4]: a clock whose time of day, texts and picture can be read and written
/// over CANopen. demo/generate generates it from clock.xdd; these files define the parts that the application has to
/// supply. It needs no operating system.
#pragma once

#include "clock/generated/clock_od.h"
#include "clock/time_of_day.hpp"
#include "host/table.hpp"

namespace lexican::demo {

constexpr std::uint32_t clock_product_code = 0xC10C;
constexpr std::uint32_t clock_serial_number = 1;
constexpr char clock_name[] = "Lexican demo clock";

/// Size of the non-volatile memory, bytes.
constexpr std::uint32_t clock_memory_size = 256;

// Objects that the program has to define:
//  clock_1009_0   text, names the hardware or host
//  clock_2200_0   red, green and blue of each pixel; the size is the program's choice

Table clock_dictionary();

/// Errors of the clock: invalid hour, minute and second.
Errors clock_errors();

}  // namespace lexican::demo
