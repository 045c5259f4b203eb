// SPDX-License-Identifier: Apache-2.0
// Access hook: the application permits or refuses what the network requests (co_callbacks.h).
#pragma once

#include "base/callbacks.hpp"
#include "co_core.h"

#if USE_ACCESS_HOOK

namespace co::access_hook {

// Calls a function of CO_NODE_EXT.Callbacks. Returns 0 if the function permits the access or does not exist.
template <class Result, class Access>
[[nodiscard]] inline Result ask(CO_NODE& node, Result (*CO_CALLBACKS::*hook)(CO_NODE*, void*, Access*),
                                Access& access) {
  const auto function = callback::find(node, hook);
  return function != nullptr ? function(&node, node.Ext->User, &access) : Result{};
}

}  // namespace co::access_hook

#endif
