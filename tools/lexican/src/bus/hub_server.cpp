// SPDX-License-Identifier: Apache-2.0
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "bus/hub.hpp"
#include "bus/hub_messages.hpp"
#include "frame_bits.hpp"

namespace lexican::host_bus {
namespace {

HubMessage message_about_lost(std::uint32_t number) {
  HubMessage message{'L'};
  put(message, 4, 4, number);
  return message;
}

/// Returns true if a client may send the message. An error frame of another class would be about the controller of the
/// receiver.
bool is_valid(const HubMessage& message, ssize_t size, bool is_simulated) {
  constexpr std::uint32_t wrong_frame = CO_IF_FRM_ERROR | 0x088;
  CO_IF_FRM frame{};
  return size == static_cast<ssize_t>(message.size()) && message[0] == 'F' && frame_of(message, frame) &&
         ((frame.Identifier & CO_IF_FRM_ERROR) == 0 || (is_simulated && frame.Identifier == wrong_frame));
}

Micros micros(co::PacedWire::Time time) { return static_cast<Micros>(time.count()); }

CO_IF_FRM frame_in(const HubMessage& message) {
  CO_IF_FRM frame{};
  frame_of(message, frame);
  return frame;
}

unsigned bits_of(const HubMessage& message) { return co::frame_bits(frame_in(message)); }

/// Returns the bits of the arbitration field in the order of transmission; the lower value wins. [ISO 11898-1]
///   11-bit identifier: base ID, RTR, IDE = 0;  29-bit: base ID, SRR = 1, IDE = 1, ID extension, RTR
std::uint32_t arbitration(const HubMessage& message) {
  const std::uint32_t identifier = frame_in(message).Identifier;
  const std::uint32_t id = identifier & CO_IF_FRM_ID;
  const std::uint32_t rtr = (identifier & CO_IF_FRM_RTR) != 0 ? 1 : 0;
  return (identifier & CO_IF_FRM_EXT) == 0 ? id << 21 | rtr << 20
                                           : id >> 18 << 21 | 3U << 19 | (id & 0x3FFFFU) << 1 | rtr;
}

}  // namespace

HubServer::HubServer(const std::string& greeting, std::uint32_t bit_rate)
    : greeting_(std::string(hub_greeting) + greeting), bit_rate_(bit_rate), wire_(std::max(bit_rate, 1U)) {}

HubServer::~HubServer() {
  for (const Client& client : clients_) {
    close(client.fd);
  }
  if (listener_ >= 0) {
    close(listener_);
  }
}

bool HubServer::open(const std::string& path, std::string& why) {
  sockaddr_un address{};
  if (!address_of(path, address, why)) {
    return false;
  }
  listener_ = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (listener_ < 0 || bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      listen(listener_, static_cast<int>(most_clients)) != 0) {
    why = "the hub cannot use " + path + ": " + std::strerror(errno);
    return false;
  }
  path_ = path;
  return true;
}

std::vector<pollfd> HubServer::wanted() const {
  std::vector<pollfd> all{{clients_.size() < most_clients ? listener_ : -1, POLLIN, 0}};
  for (const Client& client : clients_) {
    const bool is_read = !client.is_ended && client.sent.size() < frames_in_turn;
    const int events = (is_read ? POLLIN : 0) | (client.waiting.empty() ? 0 : POLLOUT);
    all.push_back({events != 0 ? client.fd : -1, static_cast<short>(events), 0});
  }
  return all;
}

void HubServer::process(Micros now) {
  accept_clients();
  for (Client& client : clients_) {
    client.is_ended = client.is_ended || !read_from(client, now);
  }
  bit_rate_ != 0 ? transmit_paced(now) : transmit();
  for (Client& client : clients_) {
    write_to(client);
  }
  remove_ended();
}

void HubServer::remove_ended() {
  const auto first = std::stable_partition(
      clients_.begin(), clients_.end(), [](const Client& client) { return !client.is_ended || !client.sent.empty(); });
  for (auto client = first; client != clients_.end(); ++client) {
    close(client->fd);
    if (on_wire_ && on_wire_->from == client->fd) {
      on_wire_->from = -1;
    }
  }
  clients_.erase(first, clients_.end());
}

void HubServer::accept_clients() {
  while (clients_.size() < most_clients) {
    const int fd = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (fd < 0) {
      return;
    }
    if (::send(fd, greeting_.data(), greeting_.size(), MSG_NOSIGNAL) < 0) {
      close(fd);
      continue;
    }
    clients_.push_back({fd});
  }
}

/// \retval false  the client has ended, or has sent something else than a frame
bool HubServer::read_from(Client& from, Micros now) const {
  while (from.sent.size() < frames_in_turn) {
    HubMessage message{};
    const ssize_t size = recv(from.fd, message.data(), message.size(), MSG_TRUNC);
    if (size < 0) {
      // A client that has closed its socket with unread frames causes ECONNRESET before its own last frames.
      return errno == EAGAIN || errno == EINTR || errno == ECONNRESET;
    }
    if (!is_valid(message, size, greeting_.find(" simulated") != std::string::npos)) {
      return false;
    }
    from.sent.push_back({message, now});
  }
  return true;
}

/// Forwards all frames, those of one client before those of the next one.
void HubServer::transmit() {
  for (Client& client : clients_) {
    for (const Sent& sent : client.sent) {
      forward(client.fd, sent.message, sent.time);
    }
    client.sent.clear();
  }
}

void HubServer::transmit_paced(Micros now) {
  restart_wire(now);
  while ((on_wire_ || start_frame(now)) && micros(wire_.received()) <= now) {
    forward(on_wire_->from, on_wire_->message, micros(wire_.received()));
    on_wire_.reset();
  }
}

/// Returns the time of the next start of frame; no time: no frame waits.
std::optional<Micros> HubServer::next_start() const {
  std::optional<Micros> earliest;
  for (const Client& client : clients_) {
    if (!client.sent.empty()) {
      earliest = std::min(earliest.value_or(client.sent.front().time), client.sent.front().time);
    }
  }
  return earliest ? std::optional(std::max(*earliest, micros(wire_.free()))) : std::nullopt;
}

/// Returns the client whose first frame has the highest priority of those that were sent until \a start.
HubServer::Client* HubServer::arbitration_winner(Micros start) {
  Client* best = nullptr;
  for (Client& client : clients_) {
    const bool takes_part = !client.sent.empty() && client.sent.front().time <= start;
    if (takes_part &&
        (best == nullptr || arbitration(client.sent.front().message) < arbitration(best->sent.front().message))) {
      best = &client;
    }
  }
  return best;
}

/// \retval false  no frame starts until \a now
bool HubServer::start_frame(Micros now) {
  const std::optional<Micros> start = next_start();
  if (!start || *start > now) {
    return false;
  }
  Client& winner = *arbitration_winner(*start);
  on_wire_ = OnWire{winner.sent.front().message, winner.fd};
  winner.sent.pop_front();
  wire_.occupy(std::chrono::microseconds(*start), bits_of(on_wire_->message));
  return true;
}

/// Makes the wire free if the clock was set back: a frame takes less than a second at any rate.
void HubServer::restart_wire(Micros now) {
  constexpr Micros longest = 1'000'000;
  if (micros(wire_.free()) <= now + longest) {
    return;
  }
  wire_ = co::PacedWire(bit_rate_);
  if (on_wire_) {
    wire_.occupy(std::chrono::microseconds(now), bits_of(on_wire_->message));
  }
  for (Client& client : clients_) {
    for (Sent& sent : client.sent) {
      sent.time = std::min(sent.time, now);
    }
  }
}

std::optional<Micros> HubServer::due() const {
  return on_wire_ ? micros(wire_.received()) : bit_rate_ != 0 ? next_start() : std::nullopt;
}

/// \a from: descriptor of the sender.
void HubServer::forward(int from, HubMessage message, Micros time) {
  put(message, 8, 8, time);
  for (Client& client : clients_) {
    std::deque<HubMessage>& waiting = client.waiting;
    if (client.fd == from || client.is_ended) {
      continue;
    }
    if (waiting.size() < most_waiting) {
      waiting.push_back(message);
    } else if (waiting.back()[0] == 'L') {
      put(waiting.back(), 4, 4, number_at(waiting.back(), 4, 4) + 1);
    } else {
      waiting.push_back(message_about_lost(1));
    }
  }
}

/// Discards what a client that has ended cannot receive.
void HubServer::write_to(Client& client) {
  while (!client.waiting.empty()) {
    const HubMessage& message = client.waiting.front();
    const bool is_sent = ::send(client.fd, message.data(), message.size(), MSG_NOSIGNAL) >= 0;
    if (!is_sent && (errno == EAGAIN || errno == EINTR)) {
      return;
    }
    is_sent ? client.waiting.pop_front() : client.waiting.clear();
  }
}

}  // namespace lexican::host_bus
