// SPDX-License-Identifier: Apache-2.0
/// \file sdo_client_states.hpp
/// All states of an SDO client, the frames that lead to each of them, and the reactions to each command byte of the
/// server. Copied from the standard [301:7.2.4.3]. The object is 2000h:05 of node-ID 5, its bytes are 1, 2, 3, …
#pragma once

#include <string>
#include <vector>

#include "sdo_client_fixture.hpp"

#if USE_CSDO

namespace test {

/// Reaction of the client to a frame of the server.
struct ClientReaction {
  std::string commands;  ///< bytes and ranges of bytes; "rest": all not listed by another reaction of the state
  std::vector<std::string> sent;  ///< frames of the client
  std::uint32_t code;             ///< abort code of the transfer; 0: success, goes_on_code: the transfer does not end
};

inline constexpr std::uint32_t goes_on_code = 0xFFFFFFFF;

struct ClientState {
  struct Step {
    std::string answer;             ///< frame of the server
    std::vector<std::string> sent;  ///< frames of the client
  };
  std::string name;
  bool is_upload;
  std::uint32_t size;      ///< bytes of the buffer
  std::string request;     ///< first frame of the client
  std::vector<Step> path;  ///< steps that lead to the state
  std::string payload;     ///< bytes 1…7 of the server's frame in the state
  std::vector<ClientReaction> reactions;
};

/// Returns all states; those of block transfers only if CO_CSDO_BLOCK is not 0.
const std::vector<ClientState>& client_states();

/// Returns the reactions of \a state to a command byte: exactly one if the table is correct.
std::vector<const ClientReaction*> reactions_to(const ClientState& state, unsigned command);

/// Starts the transfer of \a state and leads the client to the state.
void enter(SdoClient& node, const ClientState& state, std::uint32_t timeout = 1000);

}  // namespace test

#endif
