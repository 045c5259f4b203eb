// SPDX-License-Identifier: Apache-2.0
/// \file dictionary.hpp
/// The object dictionary of the clock. [301:7.4]
#pragma once

#include "host/node.hpp"
#include "linux_node/clock.hpp"

namespace demo {

/// The time of day, which the dictionary refers to.
extern TimeOfDay clock_time;

/// The dictionary.
Table clock_dictionary();

}  // namespace demo
