// SPDX-License-Identifier: Apache-2.0
// Adapters for classic drivers (CO_IF_DRV, as in CANopen-Stack). Only programs that call CONodeInit() or CONodeInitEx()
// link them.
#pragma once

#include "co_core.h"

namespace co::classic {

// Sets the adapters of the classic drivers for those drivers that the node lacks.
void add_drivers(CO_IF& cif, CO_IF_DRV& drivers);

}  // namespace co::classic
