// SPDX-License-Identifier: Apache-2.0
/// \file co_callbacks.h
/// Callbacks of one node: a constant table of functions that CO_NODE_EXT.Callbacks names. Every function receives the
/// node and CO_NODE_EXT.User, so several nodes in one program need no global variables. Null entries are not called.
///
/// Context: the loop; with USE_REAL_TIME the mainline. The node lock is held.
#ifndef CO_CALLBACKS_H_
#define CO_CALLBACKS_H_

#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;
struct CO_PARA_T;

/// Initialise it with zero, set the functions that the application needs. It must live as long as the node.
typedef struct CO_CALLBACKS_T {
  /// Called when the newest stored record of a parameter group is damaged and an older one was loaded in its place.
  void (*ParaRecovered)(struct CO_NODE_T* node, void* user, const struct CO_PARA_T* group);
} CO_CALLBACKS;

#ifdef __cplusplus
}
#endif

#endif
