// SPDX-License-Identifier: Apache-2.0
// Adapters for classic drivers (CO_IF_DRV, as in CANopen-Stack). Only programs that call CONodeInit() or CONodeInitEx()
// link them.
#pragma once

#include "co_core.h"

namespace co::classic {

// Sets adapters to the classic drivers, except for those kinds of drivers that the node already has.
void add_drivers(CO_IF& cif, CO_IF_DRV& drivers);

}  // namespace co::classic
