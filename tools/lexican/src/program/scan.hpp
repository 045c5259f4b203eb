// SPDX-License-Identifier: Apache-2.0
/// \file scan.hpp
/// Finds the devices of a bus by SDO requests to all node-IDs. It never has more than eight requests in flight.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bus/bus.hpp"
#include "host/host.hpp"

namespace lexican::program {

/// A device that has answered.
struct Found {
  std::uint8_t node = 0;
  std::uint32_t device_type = 0;      ///< 1000h
  bool has_type = false;              ///< it has answered the upload of 1000h with a value, not with an abort
  std::optional<std::uint8_t> state;  ///< of its error control, if it was seen
};

/// Frames that the scan sends and receives; time of the bus.
struct Line {
  virtual ~Line() = default;
  virtual bool send(const CO_IF_FRM& frame) = 0;
  virtual std::optional<CO_IF_FRM> receive() = 0;
  virtual Micros now() = 0;
  virtual void wait(Micros time) = 0;
  virtual bool is_ended() = 0;  ///< interrupted, or the bus is lost
};

/// Asks each node-ID from 1 to 127. \a answer_time: µs for each answer. Ends early if the line accepts no frame for
/// half a second: no node acknowledges the frames that are queued.
/// \return the devices by node-ID
std::vector<Found> find_devices(Line& line, Micros answer_time);

}  // namespace lexican::program
