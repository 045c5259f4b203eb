// SPDX-License-Identifier: Apache-2.0
/// \file listener.hpp
/// The TCP socket of a server, for its clients.
#pragma once

#include <poll.h>

#include <cstdint>
#include <string>

namespace lexican::host_bus {

/// A TCP socket that accepts clients. Context: one thread.
class Listener {
 public:
  static constexpr std::size_t most_clients = 16;  ///< that a server has at the same time

  Listener() = default;
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// Creates the socket. \a address: of an interface of this machine, in numbers; empty: 127.0.0.1. \a port: 0 for any
  /// that is free.
  /// \retval false  \a why says why
  bool open(const std::string& address, std::uint16_t port, std::string& why);
  /// Returns the port; 0: the socket is not open.
  std::uint16_t port() const { return port_; }
  /// Returns the descriptor and the event for poll() of a server that has \a clients.
  pollfd wanted(std::size_t clients) const { return {clients < most_clients ? fd_ : -1, POLLIN, 0}; }
  /// Returns the descriptor of a new client of a server that has \a clients; the caller closes it.
  /// \retval -1  there is none, or the server has most_clients
  int accept(std::size_t clients) const;

 private:
  int fd_ = -1;
  std::uint16_t port_ = 0;
};

/// Prepares a connection: short delays, and less than 100 KiB that the socket queues, so that the sender of frames
/// notices early that they are not read.
void prepare_connection(int fd);

}  // namespace lexican::host_bus
