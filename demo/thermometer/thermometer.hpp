// SPDX-License-Identifier: Apache-2.0
/// \file thermometer.hpp
/// A small device whose object dictionary is written by hand: a beginning for one of your own. TPDO1 tells the
/// temperature when it changes; one above the limit in 2001h is an emergency. It needs no operating system.
#pragma once

#include <cstdint>

#include "co_core.h"

namespace demo {

/// Makes the node. \a drivers: CAN and timer, Size is set here. A program has one thermometer, as a dictionary names
/// its variables by address.
void make_thermometer(CO_NODE& node, CO_NODE_EXT& drivers, std::uint8_t node_id);

/// What was measured, in tenths of a degree Celsius.
void set_temperature(CO_NODE& node, std::int16_t tenths);

}  // namespace demo
