// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"

namespace co {

#if !USE_FAST_PATHS
void count(uint32_t& counter) {
  const uint32_t next = counter + 1;
  if (next != 0) {
    counter = next;
  }
}
#endif

void error::report(CO_NODE& node, CO_ERR err, uint32_t key) {
  if (err != CO_ERR_NONE) {
    node.Error = err;
    node.ErrorKey = key;
  }
}

}  // namespace co

extern "C" {

CO_ERR CONodeGetErr(CO_NODE* node) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  const CO_ERR err = node->Error;
  if (err == CO_ERR_NONE) {
    node->ErrorKey = 0;
  }
  node->Error = CO_ERR_NONE;
  return err;
}

uint32_t CONodeGetErrKey(const CO_NODE* node) { return node == nullptr ? 0 : CO_GET_DEV(node->ErrorKey); }

}  // extern "C"

// Default callback of CO_ASSERT: a weak symbol, which a definition of the application replaces.
extern "C" WEAK void COAssertFailed(const char*, const char*, int) { CONodeFatalError(); }
