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
  std::string answer;   ///< in candump notation, empty: none
  std::string open;     ///< multiplexer of the transfer that is open afterwards, empty: none
  std::string written;  ///< multiplexer of the object that has changed, empty: none
};

struct SdoState {
  std::string name;
  std::string transfer;                                      ///< multiplexer of the open transfer, empty: idle
  std::string request;                                       ///< multiplexer that the requests of the sweep name
  std::vector<std::pair<std::string, std::string>> enter{};  ///< requests and answers that lead into it
  std::array<std::vector<SdoReaction>, 256> reactions{};     ///< by command byte; exactly one each in a right table
};

/// A table that cannot be read ends the test case.
std::vector<SdoState> sdo_states(std::string_view table);

}  // namespace test
