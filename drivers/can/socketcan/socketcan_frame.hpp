// SPDX-License-Identifier: Apache-2.0
/// \file socketcan_frame.hpp
/// Conversion of frames, filters and errors between the node and SocketCAN; uses no socket.
#ifndef CO_DRIVERS_SOCKETCAN_FRAME_HPP_
#define CO_DRIVERS_SOCKETCAN_FRAME_HPP_

#include <linux/can.h>

#include <cstdint>
#include <string>
#include <vector>

#include "co_if_can.h"

namespace co {

/// Returns the frame to be sent. An identifier above 7FFh without CO_IF_FRM_EXT is sent with 29 bits: truncated to 11
/// bits it would be another message, at worst an NMT command. DLC 9…15 mean 8 bytes [ISO 11898-1]. Unused bytes are 0.
can_frame to_socketcan(const CO_IF_FRM& frame);

/// Returns the received frame; unused bytes are 0. A length above 15 is copied, without data: the node counts such a
/// frame as malformed.
CO_IF_FRM from_socketcan(const can_frame& frame);

/// Returns filters that pass exactly these identifiers, or one filter that passes all frames if there are more than the
/// kernel supports. \a ids: with flags, in any order, duplicates allowed.
std::vector<can_filter> socketcan_filters(const std::uint32_t* ids, std::uint16_t num);

/// Step at which opening an interface has failed.
enum class SocketCanStep {
  name,       ///< the name is empty or too long
  socket,     ///< creating the socket
  interface,  ///< finding the interface
  option,     ///< setting a socket option
  bind,       ///< binding to the interface
};

/// Returns a text that describes the fault and its remedy. \a error: errno; \a interface: name of the interface.
std::string socketcan_error(SocketCanStep step, int error, const std::string& interface);

}  // namespace co

#endif
