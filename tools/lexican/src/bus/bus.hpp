// SPDX-License-Identifier: Apache-2.0
/// \file bus.hpp
/// A CAN bus as the tool uses it, whatever connects to it.
#pragma once

#include <poll.h>

#include <cstdint>
#include <optional>
#include <string>

#include "bus/log.hpp"

namespace lexican::host_bus {

struct BusOptions {
  std::uint32_t bit_rate = 0;  ///< bit/s; 0: that of the name, else that of the adapter. An adapter may not have it.
  bool listens_only = false;   ///< nothing is sent, and an adapter that can do so acknowledges nothing either
  bool acknowledges = false;   ///< an adapter that listens only acknowledges frames
};

/// Context: one thread. receive() and send() do not wait, except that receive() of a log reads its file.
class Bus {
 public:
  virtual ~Bus() = default;

  /// Returns the descriptor and the events for poll(); the descriptor is -1 while the bus is lost. That of a log is
  /// readable until the log has ended. The caller calls receive() until it returns nothing whenever poll() reports an
  /// event; receive() also transmits what remains of a frame that send() has queued.
  virtual pollfd wanted() = 0;
  /// Reads the next frame that another participant has sent, or an error frame.
  /// \retval nothing  there is none, or the bus is lost; fault() says why
  virtual std::optional<Entry> receive() = 0;
  /// Sends a frame.
  /// \retval true   it is queued
  /// \retval false  there is no space: try again when poll() reports POLLOUT; or the bus is lost
  virtual bool send(const CO_IF_FRM& frame) = 0;
  /// Tries to open again a bus that is lost.
  /// \retval true  it is open
  virtual bool restore() = 0;
  /// Sets the bit rate and the mode of an open adapter again.
  /// \retval false  the bus has no commands for them
  virtual bool configure(const BusOptions& /*options*/) { return false; }

  /// Restricts receive() to these identifiers (CO_IF_CAN_DRV_EX.Filter) where the kernel can do so.
  virtual void filter(const std::uint32_t* /*ids*/, std::uint16_t /*number*/) {}

  /// Returns why the bus is lost, in words; empty: it is not.
  virtual const std::string& fault() const = 0;
  /// Returns the number of frames since the opening that this participant did not receive, because it read too late.
  virtual std::uint64_t lost() const = 0;
  /// Returns false if all participants are simulated.
  virtual bool is_physical() const = 0;
  /// Returns the bit rate in bit/s; 0: it has none, or it is unknown.
  virtual std::uint32_t bit_rate() const = 0;
  /// Returns the reader of a bus that is a log: its channels and counters.
  /// \retval nullptr  the bus is not a log
  virtual const LogReader* log() const { return nullptr; }
  /// Returns what an adapter has refused, in words; empty: nothing.
  virtual std::string refusal() const { return {}; }
  /// Returns a line for the user, such as the path of a pseudo-terminal; empty: there is none.
  virtual std::string note() const { return {}; }
};

}  // namespace lexican::host_bus
