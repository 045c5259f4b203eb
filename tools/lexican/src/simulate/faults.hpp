// SPDX-License-Identifier: Apache-2.0
/// \file faults.hpp
/// Faults of a simulated device that change or swallow its frames, and faults of its controller.
#pragma once

#include <array>

#include "simulate/device.hpp"
#include "simulate/disturbance.hpp"
#include "simulate/ground.hpp"

namespace lexican::simulate {

/// Context: that of its simulation.
class Faults {
 public:
  Faults(Ground& ground, DisturbedCan& can);
  Faults(const Faults&) = delete;
  Faults& operator=(const Faults&) = delete;

  /// The faults are those of this device.
  void start(Device& device) { device_ = &device; }
  static bool has(const std::string& verb);
  /// Executes a command, see sim.md. \a words: its first one is a verb for which has() is true
  /// \retval text  a fault; empty: done
  std::string execute(const std::vector<std::string>& words);

 private:
  using Words = std::vector<std::string>;  ///< behind the verb
  struct Command;

  /// Requests of a client of an SDO server.
  struct Requests {
    unsigned segments = 0;  ///< since the begin of the transfer
    std::uint8_t last = 0;  ///< first byte
  };

  // Each returns false for wrong words.
  bool wrong_length(const Words& words);
  bool hang_sdo(const Words& words);
  bool wrong_toggle(const Words& words);
  bool bus_off(const Words& words);
  bool flood(const Words& words);

  bool hears(const CO_IF_FRM& frame);
  bool change(CO_IF_FRM& frame);
  bool is_transmit_pdo(std::uint32_t identifier);
  std::optional<std::size_t> server_of(std::uint32_t identifier, std::uint8_t sub_index);
  bool has_identifier(std::uint16_t index, std::uint8_t sub_index, std::uint32_t identifier);

  static const Command commands[];

  Ground& ground_;
  DisturbedCan& can_;
  Device* device_ = nullptr;
  bool has_wrong_length_ = false;
  std::optional<std::uint8_t> length_;  ///< nothing: one byte less
  Micros hang_end_ = 0;
  bool has_wrong_toggle_ = false;
  std::array<Requests, CO_SSDO_N> requests_{};
};

}  // namespace lexican::simulate
