// SPDX-License-Identifier: Apache-2.0
/// \file drivers.hpp
/// What device.hpp tells of the bus and the timer, as drivers.
#pragma once

#include "co_if.h"

namespace bench {

extern CO_IF_DRV drivers;

}  // namespace bench
