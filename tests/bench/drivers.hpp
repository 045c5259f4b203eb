// SPDX-License-Identifier: Apache-2.0
/// \file drivers.hpp
/// Drivers for the bus and the timer of device.hpp.
#pragma once

#include "co_if.h"

namespace bench {

extern CO_IF_DRV drivers;

}  // namespace bench
