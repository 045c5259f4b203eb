// SPDX-License-Identifier: Apache-2.0
// 1F80h, NMT startup: self-start. [302-2]
#include "co_nmt.h"

#include "base/events.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/types/integer.hpp"
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

uint32_t size(CO_OBJ* obj, CO_NODE* node, uint32_t width) { return integer::Number<4>::size(obj, node, width); }

CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  return integer::Number<4>::read(obj, node, buffer, size);
}

// Refuses a change of any bit except CO_NMT_STARTUP_STAY: the others belong to an NMT master.
CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  uint32_t before = 0;
  const CO_ERR err = read(obj, node, &before, size);
  if (err != CO_ERR_NONE) {
    return err;
  }
  uint32_t value = 0;
  __builtin_memcpy(&value, buffer, sizeof value);
  if (((value ^ before) & ~uint32_t{CO_NMT_STARTUP_STAY}) != 0) {
    return CO_ERR_OBJ_RANGE;
  }
  return integer::Number<4>::write(obj, node, buffer, size);
}

}  // namespace

extern "C" const CO_OBJ_TYPE COTNmtStartup = {size, dict::checked_by<rules::nmt_startup>, read, write, nullptr};
