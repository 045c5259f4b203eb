// SPDX-License-Identifier: Apache-2.0
// Default callbacks: weak symbols, which definitions of the application replace; those of services that can be switched
// off are in their files. Version.
#include "co_core.h"
#include "co_ver.h"

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

WEAK void COPdoTransmit(CO_IF_FRM*) {}

WEAK int16_t COPdoReceive(CO_IF_FRM*) { return 0; }

WEAK void COPdoSyncUpdate(CO_RPDO*) {}

WEAK void COPdoUpdate(CO_RPDO*) {}

WEAK void CONodeCanChange(CO_NODE*, CO_CAN_EVENT) {}

WEAK void COEmcyReceived(CO_NODE*, uint8_t, uint16_t, uint8_t, const uint8_t[5]) {}

uint8_t COVerMajor(void) { return CO_VER_MAJOR; }

uint8_t COVerMinor(void) { return CO_VER_MINOR; }

uint8_t COVerBuild(void) { return CO_VER_BUILD; }

uint32_t COVersion(void) { return CO_VER_MAJOR * 10000U + CO_VER_MINOR * 100U + CO_VER_BUILD; }

void CO_VerInit(void) {}

}  // extern "C"
