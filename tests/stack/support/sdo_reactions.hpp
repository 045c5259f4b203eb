// SPDX-License-Identifier: Apache-2.0
/// \file sdo_reactions.hpp
/// Reads the table of reactions of an SDO server (conformance/sdo_sweep_golden.txt, which explains its format).
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace test {

struct SdoReaction {
  std::vector<std::string> answers;  ///< in candump notation
  std::string open;                  ///< multiplexer of the transfer that is open afterwards; empty: none
  std::string written;               ///< multiplexer of the object that has changed; empty: none
  bool in_block;                     ///< the server is within a sub-block of a download afterwards
};

struct SdoExchange {
  std::string request;
  std::vector<std::string> answers;
};

struct SdoState {
  std::string name;
  std::string transfer;                                   ///< multiplexer of the open transfer; empty: idle
  std::string request;                                    ///< multiplexer in the requests of the sweep
  std::vector<SdoExchange> enter{};                       ///< frames that lead to the state
  std::array<std::vector<SdoReaction>, 256> reactions{};  ///< by command byte; one each if the table is correct
};

/// Returns the states of the table. A table with errors ends the test case. \a block: the server has block transfer.
std::vector<SdoState> sdo_states(std::string_view table, bool block);

}  // namespace test
