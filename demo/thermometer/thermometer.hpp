// SPDX-License-Identifier: Apache-2.0
/// \file thermometer.hpp
/// A small device with a hand-written object dictionary, as a starting point for a new device. TPDO1 transmits the
/// temperature when it changes; a temperature above the limit in 2001h raises an emergency. It needs no operating
/// system.
#pragma once

#include <cstdint>

#include "co_core.h"

namespace lexican::demo {

/// Initialises the node. \a drivers: CAN and timer; Size is set here. The dictionary refers to variables by address, so
/// a program has one thermometer.
void make_thermometer(CO_NODE& node, CO_NODE_EXT& drivers, std::uint8_t node_id);

/// Sets the measured temperature, in tenths of a degree Celsius.
void set_temperature(CO_NODE& node, std::int16_t tenths);

}  // namespace lexican::demo
