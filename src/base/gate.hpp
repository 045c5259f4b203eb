// SPDX-License-Identifier: Apache-2.0
// Access hook: the application permits or refuses what the network requests (co_callbacks.h).
#pragma once

#include "co_core.h"

#if USE_ACCESS_HOOK

namespace co::gate {

// Returns whether CO_NODE_EXT.Callbacks contains the function.
template <class Hook>
[[nodiscard]] inline bool has(const CO_NODE& node, Hook CO_CALLBACKS::*hook) {
  const CO_CALLBACKS* const callbacks = node.Ext->Callbacks;
  return callbacks != nullptr && callbacks->*hook != nullptr;
}

// Calls a function of CO_NODE_EXT.Callbacks. Returns 0 if the function permits the access or does not exist. The
// function may have called any API function: the node may be stopped or in another NMT state, and the dictionary may
// have changed.
template <class Result, class Access>
[[nodiscard]] inline Result ask(CO_NODE& node, Result (*CO_CALLBACKS::*hook)(CO_NODE*, void*, Access*),
                                Access& access) {
  return has(node, hook) ? (node.Ext->Callbacks->*hook)(&node, node.Ext->User, &access) : Result{};
}

}  // namespace co::gate

#endif
