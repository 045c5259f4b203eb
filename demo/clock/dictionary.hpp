// SPDX-License-Identifier: Apache-2.0
/// \file dictionary.hpp
/// The object dictionary of the demo device [301:7.4]: a clock whose time of day, texts and picture can be read and
/// written over CANopen. It needs no operating system.
#pragma once

#include "clock/time_of_day.hpp"
#include "host/table.hpp"

namespace demo {

constexpr std::uint32_t clock_product_code = 0xC10C;
constexpr std::uint32_t clock_serial_number = 1;
constexpr char clock_name[] = "Lexican demo clock";

/// Bytes of memory that survive a loss of power.
constexpr std::uint32_t clock_memory_size = 256;

/// \name To be supplied by the program
/// \{
extern const std::uint8_t clock_hardware[];  ///< a text, 1009h
extern CO_OBJ_DOM clock_picture;             ///< 2200h: red, green and blue of each pixel, as many as it can afford
/// \}

Table clock_dictionary();

/// All variables get the values that they have when the program begins.
void forget_variables();

/// 1017h in ms; 0: no heartbeats.
std::uint16_t clock_heartbeat_time();

/// Hour, minute and second that no clock shows.
Errors clock_errors();

}  // namespace demo
