// SPDX-License-Identifier: Apache-2.0
// Initialisation of a node.
#pragma once

#include "co_core.h"

namespace co::node {

// Sets adapters of classic drivers for the drivers that a node lacks.
using AddDrivers = void (*)(CO_IF& cif, CO_IF_DRV* drivers);

// Initialises a node. ext: null if the node has no drivers; add_drivers: null if all drivers have a context argument
void init(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext, AddDrivers add_drivers);

}  // namespace co::node
