// SPDX-License-Identifier: Apache-2.0
// The PDOs of a node as ranges, which are empty where the configuration has none.
#pragma once

#include "co_core.h"

namespace co::pdo {

struct Pdos {
  CO_PDO* first;
  unsigned num;

  [[nodiscard]] CO_PDO* begin() const { return first; }
  [[nodiscard]] CO_PDO* end() const { return first + num; }
};

#if CO_RPDO_N > 0
[[nodiscard]] inline Pdos rpdos(CO_NODE& node) { return {node.RPdo, CO_RPDO_N}; }
#else
[[nodiscard]] inline Pdos rpdos(CO_NODE&) { return {nullptr, 0}; }
#endif

#if CO_TPDO_N > 0
[[nodiscard]] inline Pdos tpdos(CO_NODE& node) { return {node.TPdo, CO_TPDO_N}; }
#else
[[nodiscard]] inline Pdos tpdos(CO_NODE&) { return {nullptr, 0}; }
#endif

}  // namespace co::pdo
