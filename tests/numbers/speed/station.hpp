// SPDX-License-Identifier: Apache-2.0
/// \file station.hpp
/// A node on a virtual bus with a virtual clock, without an application.
#pragma once

#include <string>
#include <vector>

#include "co_core.h"
#include "transfer.hpp"
#include "virtual_bus.hpp"
#include "virtual_clock.hpp"

namespace speed {

class Station {
 public:
  /// \a transmit: number of transmit buffers of the controller. \a sdo_memory: CO_NODE_SPEC.SdoBuf, may be null; \a
  /// user: CO_NODE_EXT.User.
  Station(co::VirtualBus& bus, co::VirtualClock& clock, std::size_t transmit, std::uint8_t node_id,
          std::vector<CO_OBJ> dictionary, std::uint8_t* sdo_memory, void* user);
  ~Station();
  Station(const Station&) = delete;
  Station& operator=(const Station&) = delete;

  /// Executes one iteration of an application's main loop.
  void go_round();
  /// Executes iterations until all received frames are processed.
  void work_off();
  /// Returns true if the station has no frame to process or send, and no timer runs.
  bool is_at_rest();

  CO_NODE node{};

 private:
  co::VirtualBus::Port& port_;
  co::VirtualTimer timer_;
  std::vector<CO_OBJ> dictionary_;
  CO_NODE_EXT ext_{};
};

}  // namespace speed
