// SPDX-License-Identifier: Apache-2.0
// Functions of COTDomain: memory of fixed size, read and written in pieces from CO_OBJ_DOM.Offset on.
#include "co_domain.h"

#include "dictionary/types/stream.hpp"
#include "hal/port.hpp"
#include "wire/bytes.hpp"

namespace {

using co::stream::clip;

// Returns the domain of an entry; null: the entry has no domain, or the domain has no memory.
CO_OBJ_DOM* find_domain(const CO_OBJ& obj) {
  auto* const domain = co::data_of<CO_OBJ_DOM>(obj);
  return domain == nullptr || domain->Start == nullptr ? nullptr : domain;
}

// Returns the length in bytes of an upload (width 0): the size of the domain. Returns the length nearest to width that
// a download may have: a download may be shorter than the domain.
uint32_t size(CO_OBJ* obj, CO_NODE*, uint32_t width) {
  const CO_OBJ_DOM* const domain = find_domain(*obj);
  if (domain == nullptr) {
    return 0;
  }
  return width != 0 && width < domain->Size ? width : domain->Size;
}

CO_ERR read(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t size) {
  CO_OBJ_DOM* const domain = find_domain(*obj);
  if (domain == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  const uint32_t n = clip(size, domain->Offset, domain->Size);
  co::wire::copy(static_cast<uint8_t*>(buffer), domain->Start + domain->Offset, n);
  domain->Offset += n;
  return CO_ERR_NONE;
}

CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  CO_OBJ_DOM* const domain = find_domain(*obj);
  if (domain == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if (!co::port::is_writable(*node, domain->Start, domain->Size)) {
    return CO_ERR_OBJ_ACC;
  }
  const uint32_t n = clip(size, domain->Offset, domain->Size);
  co::wire::copy(domain->Start + domain->Offset, static_cast<const uint8_t*>(buffer), n);
  domain->Offset += n;
  return CO_ERR_NONE;
}

}  // namespace

extern "C" const CO_OBJ_TYPE COTDomain = {size, co::stream::init, read, write, co::stream::reset};
