// SPDX-License-Identifier: Apache-2.0
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "bus/hub.hpp"
#include "bus/hub_messages.hpp"

namespace lexican::host_bus {
namespace {

HubMessage message_about_lost(std::uint32_t number) {
  HubMessage message{'L'};
  put(message, 4, 4, number);
  return message;
}

/// Returns true if a client may send the message.
bool is_valid(const HubMessage& message, ssize_t size) {
  CO_IF_FRM frame{};
  return size == static_cast<ssize_t>(message.size()) && message[0] == 'F' && frame_of(message, frame) &&
         (frame.Identifier & CO_IF_FRM_ERROR) == 0;
}

}  // namespace

HubServer::HubServer(const std::string& greeting) : greeting_("lexican-hub 1 " + greeting) {}

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
    all.push_back({client.fd, static_cast<short>(client.waiting.empty() ? POLLIN : POLLIN | POLLOUT), 0});
  }
  return all;
}

void HubServer::process(Micros now) {
  accept_clients();
  for (Client& client : clients_) {
    if (!read_from(client, now)) {
      close(client.fd);
      client.fd = -1;
    }
  }
  for (Client& client : clients_) {
    write_to(client);
  }
  clients_.erase(std::remove_if(clients_.begin(), clients_.end(), [](const Client& client) { return client.fd < 0; }),
                 clients_.end());
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
bool HubServer::read_from(Client& from, Micros now) {
  for (std::size_t n = 0; n < frames_in_turn; ++n) {
    HubMessage message{};
    const ssize_t size = recv(from.fd, message.data(), message.size(), MSG_TRUNC);
    if (size < 0) {
      // A client that has closed its socket with unread frames causes ECONNRESET before its own last frames.
      return errno == EAGAIN || errno == EINTR || errno == ECONNRESET;
    }
    if (!is_valid(message, size)) {
      return false;
    }
    put(message, 8, 8, now);
    forward(from, message);
  }
  return true;
}

void HubServer::forward(const Client& from, const HubMessage& message) {
  for (Client& client : clients_) {
    std::deque<HubMessage>& waiting = client.waiting;
    if (&client == &from || client.fd < 0) {
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

/// Discards what a client that has ended cannot receive. read_from() closes it after its last frame.
void HubServer::write_to(Client& client) {
  while (client.fd >= 0 && !client.waiting.empty()) {
    const HubMessage& message = client.waiting.front();
    const bool is_sent = ::send(client.fd, message.data(), message.size(), MSG_NOSIGNAL) >= 0;
    if (!is_sent && (errno == EAGAIN || errno == EINTR)) {
      return;
    }
    is_sent ? client.waiting.pop_front() : client.waiting.clear();
  }
}

}  // namespace lexican::host_bus
