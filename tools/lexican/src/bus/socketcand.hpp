// SPDX-License-Identifier: Apache-2.0
/// \file socketcand.hpp
/// socketcand:HOST:PORT/BUS, the protocol of socketcand over TCP: client and server of its raw mode. A message is a
/// text in angle brackets; bytes between messages are ignored.
///
///   server, first:    < hi >
///   client:           < open can0 >, answered with < ok >, or with < error ... > and the end of the connection
///   client:           < rawmode >, answered with < ok >
///   server, a frame:  < frame 123 23.424242 11223344 >: identifier, time in seconds, data
///   client, a frame:  < send 123 4 11 22 33 44 >: identifier, number of bytes, data
///   client:           < echo >, answered with < echo >
///
/// Identifiers and data are hexadecimal. An identifier with 8 digits, or greater than 7FF, has 29 bits. Spaces between
/// data bytes are optional. Remote frames are received (< rtr 123 23.424242 4 >, < sendrtr 123 4 >), but never sent:
/// servers and clients before these messages were defined do not know them.
///
/// For python-can 4.1 the server sends a space before each frame (it loses frames otherwise), no spaces between data
/// bytes (it reads the first word only), and two spaces behind the time of a frame without data (it fails otherwise).
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bus/listener.hpp"
#include "bus/open.hpp"

namespace lexican::host_bus {

struct SocketcandMessage {
  enum class Kind : std::uint8_t {
    hi,
    ok,
    error,
    open,
    rawmode,
    bcmmode,
    echo,
    frame,      ///< to a client; also a remote frame, or an error frame (< error 4 >)
    send,       ///< to a server; also a remote frame
    malformed,  ///< a frame with an invalid identifier, time or length, or with too many data bytes
    unknown
  };
  Kind kind = Kind::unknown;
  Entry entry{};            ///< of frame and send
  std::string_view text{};  ///< open: name of the bus; error: reason
};

/// Parses the text between the brackets of a message. The result refers to \a text.
SocketcandMessage parse_socketcand(std::string_view text);

/// Returns the message of a server with a data frame.
std::string to_socketcand_frame(const Entry& entry);

/// Returns the message of a client with a data frame.
std::string to_socketcand_send(const CO_IF_FRM& frame);

/// Finds the messages in the bytes of a connection, in a bounded memory.
class SocketcandInput {
 public:
  static constexpr std::size_t max_size = 4096;

  /// Appends bytes. Returns their number, which is less than that of \a bytes if the memory is full.
  std::size_t append(std::string_view bytes);
  /// Appends bytes that a socket has received. The caller has checked is_full(). Returns the result of recv().
  ssize_t read(int fd);
  /// Returns the text between the brackets of the next message. It is valid until bytes are appended.
  std::optional<std::string_view> next();
  /// Returns true if the memory is full without a complete message, after next() has returned nothing.
  bool is_full() const { return bytes_.size() - used_ >= max_size; }

 private:
  std::string bytes_;
  std::size_t used_ = 0;
};

/// Server for one bus. Context: one thread.
class SocketcandServer {
 public:
  static constexpr std::size_t most_waiting = 65536;  ///< bytes that a client has not read yet, before frames are lost
  static constexpr std::size_t most_frames = 256;     ///< for receive(), before the server stops reading of clients

  /// \a bus: the name that clients open, at most 16 characters without spaces.
  explicit SocketcandServer(std::string bus) : bus_(std::move(bus)) {}
  ~SocketcandServer();
  SocketcandServer(const SocketcandServer&) = delete;
  SocketcandServer& operator=(const SocketcandServer&) = delete;

  /// Creates the socket, as Listener::open() does.
  bool open(const std::string& address, std::uint16_t port, std::string& why) {
    return listener_.open(address, port, why);
  }
  std::uint16_t port() const { return listener_.port(); }
  /// Returns the descriptors and events for poll().
  std::vector<pollfd> wanted() const;
  /// Accepts clients, receives their frames, also for the other clients, and transmits. \a now: time of the frames.
  void process(Micros now);
  /// Returns the next frame that a client has sent.
  /// \retval nothing  there is none
  std::optional<CO_IF_FRM> receive();
  /// Queues a frame of the bus for all clients; process() transmits it. Error frames have no effect.
  void send(const Entry& entry);
  std::size_t clients() const { return clients_.size(); }
  /// Returns the number of frames that clients did not receive, because they read too slowly, or as remote frames.
  std::uint64_t lost() const { return lost_; }

 private:
  struct Client {
    int fd = -1;
    bool is_open = false;    // the bus
    bool is_raw = false;     // it receives frames
    bool is_ending = false;  // it is disconnected as soon as it has been informed
    SocketcandInput input{};
    std::string waiting{};
  };

  void accept_clients();
  bool is_read(const Client& client) const;
  bool read_from(Client& client, Micros now);
  void handle(Client& client, const SocketcandMessage& message, Micros now);
  void forward(const Client* from, const Entry& entry);
  static bool write_to(Client& client);

  std::string bus_;
  Listener listener_;
  std::vector<Client> clients_;
  std::deque<CO_IF_FRM> frames_;
  std::uint64_t lost_ = 0;
};

}  // namespace lexican::host_bus
