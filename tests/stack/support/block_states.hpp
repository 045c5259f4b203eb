// SPDX-License-Identifier: Apache-2.0
/// \file block_states.hpp
/// All states of a server channel during a block transfer, and how they are reached. [301:7.2.4.3.9-15]
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "block_frames.hpp"

namespace test {

struct BlockState {
  std::string name;
  std::string multiplexer;              ///< of the transfer, in the order of the frame
  bool in_sub_block;                    ///< within a sub-block of a download: all commands but 80h are segments
  std::string reminder;                 ///< frame that the server repeats while the client is silent; empty: none
  std::function<void(Fixture&)> enter;  ///< leads the channel of a fresh fixture into the state
};

/// Returns the states: downloads to and uploads of 2104h (890 bytes), 2100h:15, and 2008h (8 bytes). In one of them the
/// controller refuses all frames.
const std::vector<BlockState>& block_states();

/// Makes the controller accept all frames, and runs the loop.
void let_go_on(Fixture& node);

/// Checks that the server is idle, and that all kinds of transfers succeed.
void check_all_transfers(Fixture& node, Where at = {__builtin_FILE(), __builtin_LINE()});

}  // namespace test
