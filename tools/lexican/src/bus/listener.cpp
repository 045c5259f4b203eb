// SPDX-License-Identifier: Apache-2.0
#include "bus/listener.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>

namespace lexican::host_bus {

Listener::~Listener() {
  if (fd_ >= 0) {
    close(fd_);
  }
}

bool Listener::open(const std::string& address, std::uint16_t port, std::string& why) {
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
  fd_ = socket(found->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int reuse = 1;
  sockaddr_storage bound{};
  socklen_t size = sizeof bound;
  if (fd_ < 0 || setsockopt(fd_, SOL_SOCKET, SO_REUSEADDR, &reuse, sizeof reuse) != 0 ||
      bind(fd_, found->ai_addr, found->ai_addrlen) != 0 || listen(fd_, static_cast<int>(most_clients)) != 0 ||
      getsockname(fd_, reinterpret_cast<sockaddr*>(&bound), &size) != 0) {
    why = "the server cannot use port " + std::to_string(port) + " of " + host + ": " + std::strerror(errno);
    return false;
  }
  port_ = ntohs(bound.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(bound).sin6_port
                                            : reinterpret_cast<const sockaddr_in&>(bound).sin_port);
  return true;
}

int Listener::accept(std::size_t clients) const {
  const int fd = clients < most_clients ? accept4(fd_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC) : -1;
  if (fd >= 0) {
    prepare_connection(fd);
  }
  return fd;
}

void prepare_connection(int fd) {
  const int without_delay = 1;
  const int queued = 32768;  // the kernel doubles it
  setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &without_delay, sizeof without_delay);
  setsockopt(fd, SOL_SOCKET, SO_SNDBUF, &queued, sizeof queued);
}

}  // namespace lexican::host_bus
