// SPDX-License-Identifier: Apache-2.0
/// \file hub_messages.hpp
/// Messages between a hub's server and its clients, see hub.hpp.
#pragma once

#include <sys/un.h>

#include <cstring>
#include <string_view>

#include "bus/hub.hpp"
#include "bus/log_formats.hpp"

namespace lexican::host_bus {

constexpr std::string_view hub_greeting = "lexican-hub 1 ";  ///< the beginning of the greeting

/// Stores the \a bytes low bytes of a number in a message.
inline void put(HubMessage& message, std::size_t begin, unsigned bytes, std::uint64_t number) {
  for (unsigned n = 0; n < bytes; ++n) {
    message[begin + n] = static_cast<std::uint8_t>(number >> (8 * n));
  }
}

inline std::uint64_t number_at(const HubMessage& message, std::size_t begin, unsigned bytes) {
  std::uint64_t number = 0;
  for (unsigned n = 0; n < bytes; ++n) {
    number |= std::uint64_t{message[begin + n]} << (8 * n);
  }
  return number;
}

inline HubMessage message_with(const CO_IF_FRM& frame) {
  HubMessage message{'F', frame.DLC};
  put(message, 4, 4, frame.Identifier);
  std::memcpy(&message[16], frame.Data, sizeof frame.Data);
  return message;
}

/// \retval false  it is not a frame of classic CAN
inline bool frame_of(const HubMessage& message, CO_IF_FRM& frame) {
  frame.Identifier = static_cast<std::uint32_t>(number_at(message, 4, 4));
  frame.DLC = message[1];
  std::memcpy(frame.Data, &message[16], sizeof frame.Data);
  const bool is_base = (frame.Identifier & (CO_IF_FRM_EXT | CO_IF_FRM_ERROR)) == 0;
  return frame.DLC <= 8 && (!is_base || (frame.Identifier & max_extended_id) <= max_base_id);
}

/// \retval false  the path is too long for a socket
inline bool address_of(const std::string& path, sockaddr_un& address, std::string& why) {
  if (path.size() >= sizeof address.sun_path) {
    why = "the path " + path + " is too long for a socket";
    return false;
  }
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path.data(), path.size());
  return true;
}

}  // namespace lexican::host_bus
