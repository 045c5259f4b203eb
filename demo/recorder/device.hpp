// SPDX-License-Identifier: Apache-2.0
/// \file device.hpp
/// A drive with a recorder of its speed (2301h, 2401h). The setpoint 2100h is written by the master.
#pragma once

#include <cstdint>

#include "co_core.h"

namespace lexican::demo {

/// Initialises the node. \a drivers: CAN and timer; Size is set here. The dictionary refers to variables by address, so
/// a program has one drive.
void make_drive(CO_NODE& node, CO_NODE_EXT& drivers, std::uint8_t node_id);

/// Simulates a millisecond of the motor: its speed approaches the setpoint and overshoots.
void run_motor();

}  // namespace lexican::demo
