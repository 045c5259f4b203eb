// SPDX-License-Identifier: Apache-2.0
/// \file dictionary.hpp
/// The object dictionary of the clock. [301:7.4]
#pragma once

#include "host/node.hpp"
#include "linux_node/clock.hpp"

namespace demo {

/// The time of day, which the dictionary refers to.
extern TimeOfDay clock_time;

Table clock_dictionary();

/// All variables get the values that they have when the program begins.
void forget_variables();

/// 1017h in ms; 0: no heartbeats.
std::uint16_t clock_heartbeat_time();

/// Hour, minute and second that no clock shows.
Errors clock_errors();

}  // namespace demo
