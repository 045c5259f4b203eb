// SPDX-License-Identifier: Apache-2.0
/// \file sdo_reactions.hpp
/// Reads the table of reactions of an SDO server (conformance/sdo_sweep_golden.txt, which explains its form).
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace test {

struct SdoReaction {
  std::vector<std::string> answers;  ///< in candump notation
  std::string open;                  ///< multiplexer of the transfer that is open afterwards, empty: none
  std::string written;               ///< multiplexer of the object that has changed, empty: none
  bool in_block;                     ///< within a sub-block of a download afterwards
};

struct SdoExchange {
  std::string request;
  std::vector<std::string> answers;
};

struct SdoState {
  std::string name;
  std::string transfer;                                   ///< multiplexer of the open transfer, empty: idle
  std::string request;                                    ///< multiplexer that the requests of the sweep name
  std::vector<SdoExchange> enter{};                       ///< what leads into it
  std::array<std::vector<SdoReaction>, 256> reactions{};  ///< by command byte; exactly one each in a right table
};

/// A table that cannot be read ends the test case. \a block: the states and reactions of a server with block transfer,
/// else those of one without.
std::vector<SdoState> sdo_states(std::string_view table, bool block);

}  // namespace test
