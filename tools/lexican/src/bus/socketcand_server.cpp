// SPDX-License-Identifier: Apache-2.0
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "bus/socketcand.hpp"

namespace lexican::host_bus {
namespace {

using Kind = SocketcandMessage::Kind;

}  // namespace

SocketcandServer::~SocketcandServer() {
  for (const Client& client : clients_) {
    close(client.fd);
  }
}

std::vector<pollfd> SocketcandServer::wanted() const {
  std::vector<pollfd> all{listener_.wanted(clients_.size())};
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
  for (int fd = 0; (fd = listener_.accept(clients_.size())) >= 0;) {
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
