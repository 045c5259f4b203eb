// SPDX-License-Identifier: Apache-2.0
// 1F80h, NMT startup: self-start. [302-2]
#include "co_nmt.h"

#include "base/events.hpp"
#include "dictionary/parameter.hpp"
#include "service/nmt/nmt.hpp"

namespace co::nmt {
namespace {

// Returns whether 1F80h exists and requests the self-start.
bool starts_itself(CO_NODE& node) {
  return (dict::read_number(node, CO_DEV(0x1F80, 0), sizeof(uint32_t), CO_NMT_STARTUP_STAY) & CO_NMT_STARTUP_STAY) == 0;
}

}  // namespace

// Executes the self-start if the first state after Initialisation is Pre-operational. It is another one if
// CONmtModeChange() has requested it, which has priority over the self-start.
void on_mode(CO_NODE& node) {
  CO_NMT& nmt = node.Nmt;
  const bool first = nmt.Booting != 0;
  nmt.Booting = nmt.Mode == CO_INIT ? 1 : 0;
  if (first && nmt.Mode == CO_PREOP && starts_itself(node)) {
    event::request_mode(node, CO_OPERATIONAL);
  }
}

}  // namespace co::nmt

namespace {

using namespace co;

// Refuses a change of any bit except CO_NMT_STARTUP_STAY: the others belong to an NMT master.
CO_ERR may_replace(CO_NODE&, CO_OBJ&, uint32_t value, uint32_t before) {
  return ((value ^ before) & ~uint32_t{CO_NMT_STARTUP_STAY}) != 0 ? CO_ERR_OBJ_RANGE : CO_ERR_NONE;
}

}  // namespace

extern "C" const CO_OBJ_TYPE COTNmtStartup = parameter<4, rules::nmt_startup, may_replace>;
