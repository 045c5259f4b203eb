// SPDX-License-Identifier: Apache-2.0
// Default callbacks: weak symbols, which definitions of the application replace; those of storage,
// LED, GFC, SRDO, LSS and TIME are in the files of these. Version. CONodeInit() and CONodeInitEx().
#include "co_core.h"
#include "co_ver.h"
#include "hal/port.hpp"
#include "node/node.hpp"
#include "storage/store.hpp"

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

// Initialisation of nodes that may have classic drivers. Only programs that call these functions link the adapters.

namespace co::node {
namespace {

// Adds the adapters for classic drivers, and the format of groups in a memory without Shape.
void add(CO_IF& cif, CO_IF_DRV* drivers) {
  if (drivers != nullptr) {
    classic::add_drivers(cif, *drivers);
  }
#if USE_PARA
  cif.Raw = &store::bytes;
#endif
}

constexpr CO_NODE_EXT empty_extension() {
  CO_NODE_EXT ext = {};
  ext.Size = sizeof ext;
  return ext;
}
constexpr CO_NODE_EXT no_extension = empty_extension();

}  // namespace
}  // namespace co::node

extern "C" {

void CONodeInit(CO_NODE* node, const CO_NODE_SPEC* spec) { CONodeInitEx(node, spec, nullptr); }

void CONodeInitEx(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext) {
  co::node::init(node, spec, ext == nullptr ? &co::node::no_extension : ext, co::node::add);
}

// The symbols of both functions contain this library's configuration (lexican/detail/configuration.h); programs that
// declare them without co_core.h link these aliases.
#ifdef CO_CONFIGURED_SYMBOL
void node_init_plain(CO_NODE*, const CO_NODE_SPEC*) __asm__("CONodeInit")
    __attribute__((alias(CO_CONFIGURED_SYMBOL("CONodeInit"))));
void node_init_ex_plain(CO_NODE*, const CO_NODE_SPEC*, const CO_NODE_EXT*) __asm__("CONodeInitEx")
    __attribute__((alias(CO_CONFIGURED_SYMBOL("CONodeInitEx"))));
#endif

}  // extern "C"
