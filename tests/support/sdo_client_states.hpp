// SPDX-License-Identifier: Apache-2.0
/// \file sdo_client_states.hpp
/// Every state of an SDO client, how to get there, and what it does with each command byte of its server.
/// [301:7.2.4.3] Typed from the standard. The object is 2000h:05 of node-ID 5, its bytes are 1, 2, 3, …
#pragma once

#include <string>
#include <vector>

#include "sdo_client_fixture.hpp"

#if USE_CSDO

namespace test {

/// Reaction of the client to a frame of the server.
struct ClientReaction {
  std::string commands;           ///< bytes and ranges of bytes; "rest": all that no other reaction of the state names
  std::vector<std::string> sent;  ///< by the client
  std::uint32_t code;             ///< with which the transfer ends; 0: all is done, goes_on_code: it does not end
};

inline constexpr std::uint32_t goes_on_code = 0xFFFFFFFF;

struct ClientState {
  struct Step {
    std::string answer;             ///< of the server
    std::vector<std::string> sent;  ///< by the client
  };
  std::string name;
  bool is_upload;
  std::uint32_t size;      ///< of the buffer
  std::string request;     ///< that is sent at once
  std::vector<Step> path;  ///< into the state
  std::string payload;     ///< bytes 1…7 of the frame that comes then
  std::vector<ClientReaction> reactions;
};

/// All states; those of block transfers only if they are configured.
const std::vector<ClientState>& client_states();

/// The reactions of \a state to a command byte: exactly one in a right table.
std::vector<const ClientReaction*> reactions_to(const ClientState& state, unsigned command);

/// Starts the transfer of \a state and leads it there.
void enter(SdoClient& node, const ClientState& state, std::uint32_t timeout = 1000);

}  // namespace test

#endif
