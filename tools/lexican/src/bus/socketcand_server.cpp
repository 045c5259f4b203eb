// SPDX-License-Identifier: Apache-2.0
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "bus/socketcand.hpp"

namespace lexican::host_bus {

SocketcandServer::~SocketcandServer() {
  for (const Client& client : clients_) {
    close(client.fd);
  }
  if (listener_ >= 0) {
    close(listener_);
  }
}

bool SocketcandServer::open(const std::string& address, std::uint16_t port, std::string& why) {
  const std::string host = address.empty() ? "127.0.0.1" : address;
  addrinfo form{};
  form.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;
  form.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &form, &found);
  if (error != 0) {
    why = "the server cannot use the address " + host + ": " + gai_strerror(error);
    return false;
  }
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(found, freeaddrinfo);
  listener_ = socket(found->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int reuse = 1;
  sockaddr_storage bound{};
  socklen_t size = sizeof bound;
  if (listener_ < 0 || setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &reuse, sizeof reuse) != 0 ||
      bind(listener_, found->ai_addr, found->ai_addrlen) != 0 ||
      listen(listener_, static_cast<int>(most_clients)) != 0 ||
      getsockname(listener_, reinterpret_cast<sockaddr*>(&bound), &size) != 0) {
    why = "the server cannot use port " + std::to_string(port) + " of " + host + ": " + std::strerror(errno);
    return false;
  }
  port_ = ntohs(bound.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(bound).sin6_port
                                            : reinterpret_cast<const sockaddr_in&>(bound).sin_port);
  return true;
}

std::vector<pollfd> SocketcandServer::wanted() const {
  std::vector<pollfd> all{{clients_.size() < most_clients ? listener_ : -1, POLLIN, 0}};
  for (const Client& client : clients_) {
    const int events = (is_read(client) ? POLLIN : 0) | (client.waiting.empty() ? 0 : POLLOUT);
    all.push_back({events == 0 ? -1 : client.fd, static_cast<short>(events), 0});
  }
  return all;
}

void SocketcandServer::process(Micros now) {
  accept_clients();
  for (Client& client : clients_) {
    if (!read_from(client, now)) {
      close(client.fd);
      client.fd = -1;
      client.is_raw = false;
    }
  }
  for (Client& client : clients_) {
    if (client.fd >= 0 && !write_to(client)) {
      close(client.fd);
      client.fd = -1;
    }
  }
  clients_.erase(std::remove_if(clients_.begin(), clients_.end(), [](const Client& client) { return client.fd < 0; }),
                 clients_.end());
}

std::optional<CO_IF_FRM> SocketcandServer::receive() {
  if (frames_.empty()) {
    return std::nullopt;
  }
  const CO_IF_FRM frame = frames_.front();
  frames_.pop_front();
  return frame;
}

void SocketcandServer::send(const Entry& entry) { forward(nullptr, entry); }

void SocketcandServer::accept_clients() {
  while (clients_.size() < most_clients) {
    const int fd = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (fd < 0) {
      return;
    }
    prepare_socketcand(fd);
    clients_.emplace_back();
    clients_.back().fd = fd;
    clients_.back().waiting = "< hi >";
  }
}

/// Returns false while the answers to a client, or its frames, could exceed the memory for them.
bool SocketcandServer::is_read(const Client& client) const {
  return !client.is_ending && client.waiting.size() <= most_waiting && frames_.size() < most_frames;
}

/// \retval false  the client has ended, or has sent too many bytes without a message
bool SocketcandServer::read_from(Client& client, Micros now) {
  if (!is_read(client)) {
    return true;
  }
  const ssize_t size = client.input.read(client.fd);
  if (size <= 0) {
    return size < 0 && (errno == EAGAIN || errno == EINTR);
  }
  while (const std::optional<std::string_view> text = client.input.next()) {
    handle(client, parse_socketcand(*text), now);
  }
  return !client.input.is_full();
}

void SocketcandServer::handle(Client& client, const SocketcandMessage& message, Micros now) {
  using Kind = SocketcandMessage::Kind;
  if (client.is_ending) {
    return;
  }
  if (message.kind == Kind::echo) {
    client.waiting += "< echo >";
  } else if (message.kind == Kind::open && !client.is_open) {
    client.is_open = message.text == bus_;
    client.is_ending = !client.is_open;
    client.waiting += client.is_open ? "< ok >" : "< error could not open bus >";
  } else if ((message.kind == Kind::rawmode || message.kind == Kind::bcmmode) && client.is_open) {
    client.is_raw = message.kind == Kind::rawmode;
    client.waiting += "< ok >";
  } else if (message.kind == Kind::send && client.is_open) {
    frames_.push_back(message.entry.frame);
    forward(&client, {now, message.entry.frame, Direction::received, 0});
  } else {
    client.waiting += message.kind == Kind::malformed ? "< error syntax error >" : "< error unknown command >";
  }
}

void SocketcandServer::forward(const Client* from, const Entry& entry) {
  if ((entry.frame.Identifier & CO_IF_FRM_ERROR) != 0) {
    return;
  }
  const bool is_remote = (entry.frame.Identifier & CO_IF_FRM_RTR) != 0;
  const std::string message = to_socketcand_frame(entry);
  for (Client& client : clients_) {
    if (&client == from || !client.is_raw) {
      continue;
    }
    if (is_remote || client.waiting.size() + message.size() > most_waiting) {
      ++lost_;
    } else {
      client.waiting += message;
    }
  }
}

/// \retval false  the client has ended, or is to end
bool SocketcandServer::write_to(Client& client) {
  while (!client.waiting.empty()) {
    const ssize_t size = ::send(client.fd, client.waiting.data(), client.waiting.size(), MSG_NOSIGNAL);
    if (size < 0) {
      return errno == EAGAIN || errno == EINTR;
    }
    client.waiting.erase(0, static_cast<std::size_t>(size));
  }
  return !client.is_ending;
}

}  // namespace lexican::host_bus
