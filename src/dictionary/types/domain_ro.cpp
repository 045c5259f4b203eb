// SPDX-License-Identifier: Apache-2.0
// Functions of COTDomainRo: constant memory, read in pieces from CO_OBJ_DOM_RO.Offset on.
#include "co_domain.h"
#include "dictionary/types/stream.hpp"
#include "wire/bytes.hpp"

namespace {

static_assert(offsetof(CO_OBJ_DOM_RO, Offset) == 0);

// Returns the domain of an entry; null: the entry has no domain, or the domain no memory.
CO_OBJ_DOM_RO* usable(const CO_OBJ& obj) {
  auto* const domain = co::data_of<CO_OBJ_DOM_RO>(obj);
  return domain == nullptr || domain->Start == nullptr ? nullptr : domain;
}

uint32_t size(CO_OBJ* obj, CO_NODE_T*, uint32_t) {
  const CO_OBJ_DOM_RO* const domain = usable(*obj);
  return domain == nullptr ? 0 : domain->Size;
}

CO_ERR read(CO_OBJ* obj, CO_NODE_T*, void* buffer, uint32_t length) {
  CO_OBJ_DOM_RO* const domain = usable(*obj);
  if (domain == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  const uint32_t n = co::stream::clip(length, domain->Offset, domain->Size);
  co::wire::copy(static_cast<uint8_t*>(buffer), domain->Start + domain->Offset, n);
  domain->Offset += n;
  return CO_ERR_NONE;
}

}  // namespace

extern "C" const CO_OBJ_TYPE COTDomainRo = {size, co::stream::init, read, nullptr, co::stream::reset};
