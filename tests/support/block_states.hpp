// SPDX-License-Identifier: Apache-2.0
/// \file block_states.hpp
/// Every state that a server channel can be in during a block transfer, and how it is reached. [301:7.2.4.3.9-15]
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "block_frames.hpp"

namespace test {

struct BlockState {
  std::string name;
  std::string multiplexer;              ///< of the transfer, in the order of the frame
  bool in_sub_block;                    ///< of a download: all commands but 80h are segments
  std::string reminder;                 ///< what the server repeats while the client is silent; empty: nothing
  std::function<void(Fixture&)> enter;  ///< from the idle state of a fresh fixture
};

/// Downloads to and uploads of 2104h (890 bytes), 2100h:15, and 2008h (eight bytes). In one of them the controller
/// refuses all frames.
const std::vector<BlockState>& block_states();

/// The controller takes frames again, if it did not.
void let_go_on(Fixture& node);

/// The server is idle and serves all kinds of transfers.
void check_all_transfers(Fixture& node, Where at = {__builtin_FILE(), __builtin_LINE()});

}  // namespace test
