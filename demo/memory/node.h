// SPDX-License-Identifier: Apache-2.0
/// \file node.h
/// A node that stores its parameters.
#ifndef NODE_H_
#define NODE_H_

#include "co_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Starts the node: it loads its parameters. \a drivers: the drivers of CAN controller and timer are set; \a memory and
/// \a context: driver and context of the memory. Returns the node.
CO_NODE* StartNode(CO_NODE_EXT* drivers, const CO_IF_NVM_DRV_EX* memory, const void* context);

#ifdef __cplusplus
}
#endif

#endif
