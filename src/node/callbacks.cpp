// SPDX-License-Identifier: Apache-2.0
// Defaults of the callbacks: weak, so that the application's own definitions win.
#include "co_core.h"

extern "C" {

WEAK void CONodeFatalError(void) {
  for (volatile bool stuck = true; stuck;) {
  }
}

WEAK void COTmrLock(void) {}

WEAK void COTmrUnlock(void) {}

WEAK void CONmtModeChange(CO_NMT*, CO_MODE) {}

WEAK void CONmtResetRequest(CO_NMT*, CO_NMT_RESET) {}

WEAK void COIfCanReceive(CO_IF_FRM*) {}

WEAK void CONodeCanChange(CO_NODE*, CO_CAN_EVENT) {}

}  // extern "C"
