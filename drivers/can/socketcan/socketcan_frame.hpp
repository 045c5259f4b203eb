// SPDX-License-Identifier: Apache-2.0
/// \file socketcan_frame.hpp
/// What the kernel's side of SocketCAN looks like: frames, filters and errors, without a socket.
#ifndef CO_DRIVERS_SOCKETCAN_FRAME_HPP_
#define CO_DRIVERS_SOCKETCAN_FRAME_HPP_

#include <linux/can.h>

#include <cstdint>
#include <string>
#include <vector>

#include "co_if_can.h"

namespace co {

/// The frame to be sent. An identifier above 7FFh without CO_IF_FRM_EXT goes out as a 29-bit one: cut to 11 bits it
/// would be another message, at worst an NMT command. DLC 9…15 stand for 8 bytes [ISO 11898-1]. Bytes not in use are 0.
can_frame to_socketcan(const CO_IF_FRM& frame);

/// The frame received; bytes not in use are 0. A length above 15 is kept, without data: the node counts such a frame as
/// malformed.
CO_IF_FRM from_socketcan(const can_frame& frame);

/// Filters that let exactly these identifiers through; none of them if there are more than the kernel takes: then
/// everything comes through. \a ids: with flags, any order, may repeat.
std::vector<can_filter> socketcan_filters(const std::uint32_t* ids, std::uint16_t num);

/// Where opening an interface can fail.
enum class SocketCanStep {
  name,       ///< the name is empty or too long
  socket,     ///< making the socket
  interface,  ///< looking the interface up
  option,     ///< setting a socket option
  bind,       ///< binding to the interface
};

/// What has failed, in words a user can act on. \a error: errno.
std::string socketcan_error(SocketCanStep step, int error, const std::string& interface);

}  // namespace co

#endif
