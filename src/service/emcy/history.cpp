// SPDX-License-Identifier: Apache-2.0
// 1003h, pre-defined error field. [301:7.5.2.4] Its entries are a ring, so that adding an error moves no other.
#include "service/emcy/emcy.hpp"

#if USE_EMCY

#include "base/error.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/types/integer.hpp"

namespace co::emcy {
namespace {

constexpr uint16_t index = 0x1003;

// Converts a sub-index that the network uses (1: the newest error) to the sub-index of the entry in the ring. sub:
// 1…history.Num
uint8_t sub_of(const CO_EMCY_HIST& history, uint8_t sub) {
  const unsigned newest = history.Off >= sub ? history.Off : history.Off + history.Max;
  return static_cast<uint8_t>(newest + 1U - sub);
}

// Returns the length of an entry. Sub-index 0 needs no variable.
uint32_t size(CO_OBJ* obj, CO_NODE*, uint32_t) {
  if (CO_GET_SUB(obj->Key) == 0) {
    return 1;
  }
  return uintptr_t{obj->Data} == 0 ? 0 : 4;
}

// Adds an error to the ring. Value of CO_EMCY_HIST.Add, so that only programs with 1003h link it.
void add_error(CO_NODE* node_pointer, uint32_t entry) {
  CO_NODE& node = *node_pointer;
  CO_EMCY_HIST& history = node.Emcy.Hist;
  if (history.Max == 0) {
    return;
  }
  const unsigned next = history.Off + 1U;
  history.Off = static_cast<uint8_t>(next <= history.Max ? next : 1);
  if (history.Num < history.Max) {
    ++history.Num;
  }
  const uint32_t key = CO_DEV(index, history.Off);
  CO_OBJ* const entry_obj = dict::find(node, key);
  const CO_ERR err =
      entry_obj == nullptr ? CO_ERR_OBJ_NOT_FOUND : integer::Number<4>::write(entry_obj, &node, &entry, sizeof entry);
  error::report(node, err, key);
}

// Init function: counts the entries from sub-index 1 on, without a gap, in Found.
CO_ERR init_entry(CO_OBJ* obj, CO_NODE* node) {
  const uint8_t sub = CO_GET_SUB(obj->Key);
  if (sub == 0) {
    const CO_ERR err = dict::check_type(*obj, *node, rules::emcy_history_number);
    const bool has_entries = dict::find(*node, CO_DEV(index, 1)) != nullptr;
    return err == CO_ERR_NONE && !has_entries ? CO_ERR_TYPE_INIT : err;
  }
  uint8_t& found = node->Emcy.Hist.Found;
  node->Emcy.Hist.Add = add_error;
  const bool has_data = uintptr_t{obj->Data} != 0;
  found = has_data && (sub == 1 || sub == found + 1) ? sub : found;
  return dict::check_type(*obj, *node, rules::emcy_history);
}

CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  const CO_EMCY_HIST& history = node->Emcy.Hist;
  const uint8_t sub = CO_GET_SUB(obj->Key);
  if (size == 0 || size != COTEmcyHist.Size(obj, node, size)) {
    return CO_ERR_BAD_ARG;
  }
  if (sub == 0) {
    *static_cast<uint8_t*>(buffer) = history.Num;
    return CO_ERR_NONE;
  }
  CO_OBJ* const entry_obj = sub > history.Num ? nullptr : dict::find(*node, CO_DEV(index, sub_of(history, sub)));
  if (entry_obj == nullptr) {
    COObjTypeUserSDOAbort(obj, node, CO_SDO_ERR_NO_DATA);
    return CO_ERR_TYPE_RD;
  }
  return integer::Number<4>::read(entry_obj, node, buffer, size);
}

CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  if (CO_GET_SUB(obj->Key) != 0) {
    COObjTypeUserSDOAbort(obj, node, CO_SDO_ERR_WR);
    return CO_ERR_TYPE_WR;
  }
  if (size != 1) {
    return CO_ERR_BAD_ARG;
  }
  if (*static_cast<const uint8_t*>(buffer) != 0) {
    return CO_ERR_OBJ_RANGE;
  }
  clear_history(*node);
  return CO_ERR_NONE;
}

}  // namespace
}  // namespace co::emcy

extern "C" const CO_OBJ_TYPE COTEmcyHist = {co::emcy::size, co::emcy::init_entry, co::emcy::read, co::emcy::write,
                                            nullptr};

#endif
