// SPDX-License-Identifier: Apache-2.0
// Functions of COTDomain, memory of fixed size, and COTDomainRo, constant memory: read and written in pieces from
// Offset on.
#include "co_domain.h"

#include "dictionary/types/stream.hpp"
#include "hal/port.hpp"
#include "wire/bytes.hpp"

namespace co::domain {
namespace {

using stream::clip;

// Returns the domain of an entry; null: the entry has no domain, or the domain has no memory.
template <class Domain>
Domain* find_domain(const CO_OBJ& obj) {
  auto* const domain = data_of<Domain>(obj);
  return domain == nullptr || domain->Start == nullptr ? nullptr : domain;
}

// Returns the length in bytes of an upload (width 0): the size of the domain. Returns the length nearest to width that
// a download may have: a download may be shorter than the domain.
uint32_t size(CO_OBJ* obj, CO_NODE*, uint32_t width) {
  const CO_OBJ_DOM* const domain = find_domain<CO_OBJ_DOM>(*obj);
  if (domain == nullptr) {
    return 0;
  }
  return width != 0 && width < domain->Size ? width : domain->Size;
}

template <class Domain>
CO_ERR read(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t size) {
  Domain* const domain = find_domain<Domain>(*obj);
  if (domain == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  const uint32_t n = clip(size, domain->Offset, domain->Size);
  wire::copy(static_cast<uint8_t*>(buffer), domain->Start + domain->Offset, n);
  domain->Offset += n;
  return CO_ERR_NONE;
}

// Ignores bytes beyond the domain: an SDO server refuses such a download by its length.
CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  CO_OBJ_DOM* const domain = find_domain<CO_OBJ_DOM>(*obj);
  if (domain == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if (!port::is_writable(*node, domain->Start, domain->Size)) {
    return CO_ERR_OBJ_ACC;
  }
  const uint32_t n = clip(size, domain->Offset, domain->Size);
  wire::copy(domain->Start + domain->Offset, static_cast<const uint8_t*>(buffer), n);
  domain->Offset += n;
  return CO_ERR_NONE;
}

static_assert(offsetof(CO_OBJ_DOM_RO, Offset) == 0, "stream::seek() sets the first member");

uint32_t size_of_constant(CO_OBJ* obj, CO_NODE*, uint32_t) {
  const auto* const domain = find_domain<CO_OBJ_DOM_RO>(*obj);
  return domain == nullptr ? 0 : domain->Size;
}

}  // namespace
}  // namespace co::domain

extern "C" {

const CO_OBJ_TYPE COTDomain = {co::domain::size, co::stream::init, co::domain::read<CO_OBJ_DOM>, co::domain::write,
                               co::stream::reset};

const CO_OBJ_TYPE COTDomainRo = {co::domain::size_of_constant, co::stream::init, co::domain::read<CO_OBJ_DOM_RO>,
                                 nullptr, co::stream::reset};

}  // extern "C"
