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
  /// \a transmit: buffers of the controller. \a sdo_memory: CO_NODE_SPEC.SdoBuf, may be null; \a user:
  /// CO_NODE_EXT.User.
  Station(co::VirtualBus& bus, co::VirtualClock& clock, std::size_t transmit, std::uint8_t node_id,
          std::vector<CO_OBJ> dictionary, std::uint8_t* sdo_memory, void* user);
  ~Station();
  Station(const Station&) = delete;
  Station& operator=(const Station&) = delete;

  /// Once round the loop of an application.
  void go_round();
  /// Until all that was received is processed.
  void work_off();
  /// Returns true if the station has nothing to process, send or wait for.
  bool is_at_rest();

  CO_NODE node{};

 private:
  co::VirtualBus::Port& port_;
  co::VirtualTimer timer_;
  std::vector<CO_OBJ> dictionary_;
  CO_NODE_EXT ext_{};
};

}  // namespace speed
