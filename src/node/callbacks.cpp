// SPDX-License-Identifier: Apache-2.0
// Default callbacks: weak symbols, which definitions of the application replace.
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

WEAK void CONmtHbConsEvent(CO_NMT*, uint8_t) {}

WEAK void CONmtHbConsChange(CO_NMT*, uint8_t, CO_MODE) {}

WEAK void CONmtLifeGuardEvent(CO_NMT*, bool) {}

WEAK void COIfCanReceive(CO_IF_FRM*) {}

#if USE_LSS
WEAK CO_ERR COLssLoad(uint32_t*, uint8_t*) { return CO_ERR_NONE; }

WEAK CO_ERR COLssStore(uint32_t, uint8_t) { return CO_ERR_LSS_NO_STORE; }
#endif

#if USE_PARA
WEAK int16_t COParaDefault(CO_PARA*) { return 0; }

WEAK void COParaLost(CO_NODE*, const CO_PARA*) {}
#endif

WEAK void COPdoTransmit(CO_IF_FRM*) {}

WEAK int16_t COPdoReceive(CO_IF_FRM*) { return 0; }

WEAK void COPdoSyncUpdate(CO_RPDO*) {}

WEAK void COPdoUpdate(CO_RPDO*) {}

WEAK void CONodeCanChange(CO_NODE*, CO_CAN_EVENT) {}

#if USE_TIME
WEAK void COTimeUpdate(CO_NODE*, const CO_TIME_OF_DAY*) {}
#endif

#if USE_LED
WEAK void COLedChange(CO_NODE*, uint8_t) {}
#endif

WEAK void COEmcyReceived(CO_NODE*, uint8_t, uint16_t, uint8_t, const uint8_t[5]) {}

}  // extern "C"
