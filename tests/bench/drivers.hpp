// SPDX-License-Identifier: Apache-2.0
/// \file drivers.hpp
/// Drivers for the bus and the timer of device.hpp.
#pragma once

#include "co_if.h"

namespace bench {

extern const CO_IF_CAN_DRV_EX can;
extern const CO_IF_TIMER_DRV_EX timer;

}  // namespace bench
