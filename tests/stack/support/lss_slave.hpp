// SPDX-License-Identifier: Apache-2.0
/// \file lss_slave.hpp
/// Adds the LSS address 319h, 12345678h, 10002h, 44h to a fixture, and the frames of an LSS master.
#pragma once

#include "fixture.hpp"

namespace test {

inline Setup& with_lss_address(Setup& setup) {
  constexpr std::uint32_t address[] = {0x319, 0x12345678, 0x10002, 0x44};
  for (std::uint8_t sub = 1; sub <= 4; ++sub) {
    setup.with({CO_KEY(0x1018, sub, CO_OBJ_D___R_), CO_TUNSIGNED32, address[sub - 1]});
  }
  return setup.with({CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 4});
}

inline constexpr const char* lss_to_configuration = "7E5#0401000000000000";
inline constexpr const char* lss_to_waiting = "7E5#0400000000000000";
inline constexpr const char* lss_inquire_node_id = "7E5#5E00000000000000";

/// Sends the four frames of switch state selective.
inline void select_lss_slave(Fixture& node) {
  for (const char* part :
       {"7E5#4019030000000000", "7E5#4178563412000000", "7E5#4202000100000000", "7E5#4344000000000000"}) {
    node.rx(part);
  }
}

}  // namespace test
