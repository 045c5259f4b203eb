// SPDX-License-Identifier: Apache-2.0
/// \file hub.hpp
/// hub:NAME, a simulated bus between programs of one user on this machine. It needs neither root nor a driver. The
/// first program that opens a hub starts its server, a process that ends when no program has used it for two seconds.
///
/// The socket is $XDG_RUNTIME_DIR/lexican/NAME.hub, else /tmp/lexican-UID/NAME.hub. A directory that belongs to another
/// user, or that others may enter, is refused. Messages are datagrams of a socket of the type SOCK_SEQPACKET:
///
///   server, first:        "lexican-hub 1 simulated", "lexican-hub 1 simulated BIT/S" if it is paced, or
///                         "lexican-hub 1 physical BIT/S" of an adapter that is shared
///   frame, both ways:     'F', length, 2 bytes 0, CAN-ID with flags (4 bytes), time (8 bytes, µs since 1970; 0 to the
///                         server), 8 bytes of data; to a simulated hub also an error frame, 2000 0088h only
///   server, frames lost:  'L', 3 bytes 0, their number (4 bytes)
///
/// A paced hub, hub:NAME@RATE, has the timing of a wire of that rate: one frame at a time, as long as its bits take; of
/// the first frames of all programs, the one with the highest priority is next. The time of a frame is that of its end.
///
/// Numbers are little-endian. The sender of a frame does not receive it. A program that sends faster than the hub
/// forwards has to wait; a program that reads too slowly loses frames, which are counted, and does not delay the
/// others.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <vector>

#include "bus/bus.hpp"
#include "paced_wire.hpp"

namespace lexican::host_bus {

using HubMessage = std::array<std::uint8_t, 24>;

/// Server of a hub. Context: one thread.
class HubServer {
 public:
  static constexpr std::size_t most_clients = 64;
  static constexpr std::size_t most_waiting = 16384;  ///< frames that a client has not read yet
  static constexpr std::size_t frames_in_turn = 32;   ///< of a client that wait for the bus; more remain in its socket

  /// \a greeting: behind "lexican-hub 1 ". \a bit_rate: of a paced hub, bit/s; 0: frames take no time.
  explicit HubServer(const std::string& greeting, std::uint32_t bit_rate = 0);
  /// Closes the sockets. The path remains, as another process may have inherited the server.
  ~HubServer();
  HubServer(const HubServer&) = delete;
  HubServer& operator=(const HubServer&) = delete;

  /// Creates the socket. The caller has made sure that no other server has it.
  /// \retval false  \a why says why
  bool open(const std::string& path, std::string& why);
  /// Returns the descriptors and events for poll().
  std::vector<pollfd> wanted() const;
  /// Accepts clients, and forwards frames. \a now: time of the frames; of a paced hub, the time up to which frames end.
  void process(Micros now);
  /// Returns the time at which a paced hub has to be processed, even if poll() reports nothing; no time: never.
  std::optional<Micros> due() const;
  std::size_t clients() const { return clients_.size(); }
  int listener() const { return listener_; }
  const std::string& path() const { return path_; }

 private:
  /// A frame from a client, with its time.
  struct Sent {
    HubMessage message;
    Micros time;
  };
  struct Client {
    int fd = -1;
    bool is_ended = false;  ///< it is removed after its last frame
    std::deque<Sent> sent{};
    std::deque<HubMessage> waiting{};  ///< for the client
  };
  struct OnWire {
    HubMessage message;
    int from;  ///< descriptor of the sender; -1: it has been removed
  };

  void accept_clients();
  bool read_from(Client& from, Micros now) const;
  void transmit();
  void transmit_paced(Micros now);
  Client* arbitration_winner(Micros start);
  std::optional<Micros> next_start() const;
  bool start_frame(Micros now);
  void restart_wire(Micros now);
  void forward(int from, HubMessage message, Micros time);
  void remove_ended();
  static void write_to(Client& client);

  std::string greeting_;
  std::uint32_t bit_rate_;
  co::PacedWire wire_;  ///< of a paced hub
  std::optional<OnWire> on_wire_;
  std::string path_;
  int listener_ = -1;
  std::vector<Client> clients_;
};

/// Runs a server until no client has been connected for two seconds, and removes its path.
void run_hub(HubServer& server);

/// Returns the path of the socket of hub:NAME. Creates its directory.
/// \retval empty  the name is not valid, or the directory is not safe; \a why says so
std::string hub_path(const std::string& name, std::string& why);

/// Returns the fault of NAME or NAME@RATE; empty: it has none. Separates the rate.
std::string hub_name_fault(std::string& name, BusOptions& options);

/// Opens NAME or NAME@RATE. Starts its server in a process if there is none. Waits at most a second for its greeting.
/// \retval null  \a why says why, such as a hub of another rate
std::unique_ptr<Bus> open_hub(std::string name, std::string& why);

/// Connects to a server that exists. It is regarded as physical until receive() has read its greeting.
/// \retval null  \a why says why
std::unique_ptr<Bus> connect_to_hub(const std::string& path, std::string& why);

}  // namespace lexican::host_bus
