// SPDX-License-Identifier: Apache-2.0
/// \file dictionary.hpp
/// The object dictionary of the clock. [301:7.4]
#pragma once

#include <cstdint>

#include "co_core.h"
#include "linux_node/clock.hpp"

namespace demo {

/// The time of day, which the dictionary refers to.
extern TimeOfDay clock_time;

struct Table {
  CO_OBJ* first;
  std::uint16_t length;
};

/// The dictionary, in the form in which CO_NODE_SPEC takes it.
Table clock_dictionary();

}  // namespace demo
