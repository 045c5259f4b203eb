// SPDX-License-Identifier: Apache-2.0
// Initialisation of nodes that may have classic drivers. Only programs that call these functions link the adapters.
#include "hal/classic.hpp"
#include "node/node.hpp"
#include "storage/store.hpp"

using namespace co;

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

extern "C" {

void CONodeInit(CO_NODE* node, const CO_NODE_SPEC* spec) { CONodeInitEx(node, spec, nullptr); }

void CONodeInitEx(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext) {
  node::init(node, spec, ext == nullptr ? &no_extension : ext, add);
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
