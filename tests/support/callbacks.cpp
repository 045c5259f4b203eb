// SPDX-License-Identifier: Apache-2.0
#include "callbacks.hpp"

#include "heap_watch.hpp"

namespace test {

Callbacks& callbacks() {
  static Callbacks all;
  return all;
}

namespace {

template <class Function, class... Arguments>
void call(const Function& function, Arguments... arguments) {
  if (function) {
    const OutsideStack outside;
    function(arguments...);
  }
}

}  // namespace
}  // namespace test

extern "C" {
void CONmtModeChange(CO_NMT* nmt, CO_MODE mode) { test::call(test::callbacks().mode_change, nmt, mode); }
void CONmtResetRequest(CO_NMT* nmt, CO_NMT_RESET reset) { test::call(test::callbacks().reset_request, nmt, reset); }
void COIfCanReceive(CO_IF_FRM* frm) { test::call(test::callbacks().can_receive, frm); }
void CONodeCanChange(CO_NODE* node, CO_CAN_EVENT event) { test::call(test::callbacks().can_change, node, event); }
void COTmrLock(void) { test::call(test::callbacks().lock); }
void COTmrUnlock(void) { test::call(test::callbacks().unlock); }
void CONodeFatalError(void) { ++test::callbacks().fatal_errors; }
}
