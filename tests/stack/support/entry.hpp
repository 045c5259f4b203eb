// SPDX-License-Identifier: Apache-2.0
/// \file entry.hpp
/// A single dictionary entry, for tests of object types.
#pragma once

#include "fixture.hpp"

namespace test {

/// Entry 2000h of any type, outside the dictionary of a node with node-ID 5.
struct Entry {
  CO_OBJ obj;
  Fixture node{Setup().only_small().node_id(5)};

  Entry(const CO_OBJ_TYPE* type, std::uint32_t flags, CO_DATA data) : obj{CO_KEY(0x2000, 0, flags), type, data} {}
  CO_ERR read(void* to, std::uint8_t width) { return COObjRdValue(&obj, &node.node, to, width); }
  CO_ERR write(const void* from, std::uint8_t width) {
    return COObjWrValue(&obj, &node.node, const_cast<void*>(from), width);
  }
  std::uint32_t size(std::uint32_t width = 0) { return COObjGetSize(&obj, &node.node, width); }
};

}  // namespace test
