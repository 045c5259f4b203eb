// SPDX-License-Identifier: Apache-2.0
/// \file drivers.hpp
/// Drivers for the bus and the timer of device.hpp.
#pragma once

#include "co_core.h"

namespace bench {

/// Initialises the node of device.hpp with the drivers.
void init_node(CO_NODE_SPEC& spec);

}  // namespace bench
