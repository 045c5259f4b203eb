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
void CONmtHbConsEvent(CO_NMT* nmt, std::uint8_t id) { test::call(test::callbacks().heartbeat_event, nmt, id); }
void CONmtHbConsChange(CO_NMT* nmt, std::uint8_t id, CO_MODE mode) {
  test::call(test::callbacks().heartbeat_change, nmt, id, mode);
}
void CONmtLifeGuardEvent(CO_NMT* nmt, bool occurred) { test::call(test::callbacks().life_guard, nmt, occurred); }
void COIfCanReceive(CO_IF_FRM* frm) { test::call(test::callbacks().can_receive, frm); }
void CONodeCanChange(CO_NODE* node, CO_CAN_EVENT event) { test::call(test::callbacks().can_change, node, event); }
void COPdoTransmit(CO_IF_FRM* frm) { test::call(test::callbacks().pdo_transmit, frm); }
int16_t COPdoReceive(CO_IF_FRM* frm) {
  const test::OutsideStack outside;
  return test::callbacks().pdo_receive ? test::callbacks().pdo_receive(frm) : std::int16_t{0};
}
void COPdoSyncUpdate(CO_RPDO* pdo) { test::call(test::callbacks().pdo_sync_update, pdo); }
void COPdoUpdate(CO_RPDO* pdo) { test::call(test::callbacks().pdo_update, pdo); }
#if USE_TIME
void COTimeUpdate(CO_NODE* node, const CO_TIME_OF_DAY* time) { test::call(test::callbacks().time_update, node, time); }
#endif
#if USE_GFC
void COGfcReceived(CO_NODE* node) { test::call(test::callbacks().gfc_received, node); }
#endif
#if CO_SRDO_N > 0
void COSrdoChange(CO_NODE* node, std::uint8_t number, CO_SRDO_STATE state) {
  test::call(test::callbacks().srdo_change, node, number, state);
}
#endif
#if USE_LED
void COLedChange(CO_NODE* node, std::uint8_t leds) { test::call(test::callbacks().led_change, node, leds); }
#endif
void COEmcyReceived(CO_NODE* node, uint8_t id, uint16_t code, uint8_t reg, const uint8_t msef[5]) {
  test::call(test::callbacks().emcy_received, node, id, code, reg, msef);
}
CO_ERR COLssLoad(std::uint32_t* baud, std::uint8_t* id) {
  const test::OutsideStack outside;
  return test::callbacks().lss_load ? test::callbacks().lss_load(baud, id) : CO_ERR_NONE;
}
CO_ERR COLssStore(std::uint32_t baud, std::uint8_t id) {
  const test::OutsideStack outside;
  return test::callbacks().lss_store ? test::callbacks().lss_store(baud, id) : CO_ERR_NONE;
}
std::int16_t COParaDefault(CO_PARA* pg) {
  const auto& wanted = test::callbacks().para_default;
  const test::OutsideStack outside;
  return wanted ? wanted(pg) : std::int16_t{0};
}
void COParaLost(CO_NODE* node, const CO_PARA* pg) { test::call(test::callbacks().para_lost, node, pg); }
void COTmrLock(void) { test::call(test::callbacks().lock); }
void COTmrUnlock(void) { test::call(test::callbacks().unlock); }
void CONodeFatalError(void) { ++test::callbacks().fatal_errors; }
}
