// SPDX-License-Identifier: Apache-2.0
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "bus/log_formats.hpp"
#include "bus/socketcand.hpp"

namespace lexican::host_bus {
namespace {

using Kind = SocketcandMessage::Kind;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds opening_timeout{2000};

/// Waits for an event of a socket.
/// \retval false  the time is over
bool wait_for(int fd, short events, Clock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd wanted{fd, events, 0};
    const int number = poll(&wanted, 1, static_cast<int>(std::max<decltype(left)>(left, 0)));
    if (number > 0 || left <= 0) {
      return number > 0;
    }
  }
}

/// Returns a text of the server so that it can be shown on a terminal.
std::string printable(std::string_view text) {
  constexpr std::size_t max_length = 100;
  std::string result(text.substr(0, max_length));
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < ' ' || c >= '\x7F'; }, '?');
  return result;
}

class SocketcandBus : public Bus {
 public:
  SocketcandBus() = default;
  ~SocketcandBus() override { disconnect(""); }
  SocketcandBus(const SocketcandBus&) = delete;
  SocketcandBus& operator=(const SocketcandBus&) = delete;

  /// Parses HOST:PORT/BUS.
  /// \retval false  it is none
  bool parse(const std::string& name) {
    const std::size_t slash = std::min(name.rfind('/'), name.size());
    const std::string_view address = std::string_view(name).substr(0, slash);
    const std::size_t colon = std::min(address.rfind(':'), address.size());
    std::string_view host = address.substr(0, colon);
    if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
      host = host.substr(1, host.size() - 2);
    }
    bus_ = name.substr(std::min(slash + 1, name.size()));
    const bool is_bus = !bus_.empty() && bus_.size() <= 16 && channel_name(bus_) == bus_ &&
                        bus_.find_first_of("<>") == std::string::npos;
    address_ = address;
    host_ = host;
    return is_bus && !host.empty() && colon != address.size() && parse_number(address.substr(colon + 1), port_) &&
           port_ != 0;
  }

  /// Parses HOST:PORT/BUS, and looks up the host.
  bool find(const std::string& name, std::string& why) {
    if (!parse(name)) {
      why = "socketcand needs HOST:PORT/BUS, such as 127.0.0.1:29536/can0";
      return false;
    }
    addrinfo form{};
    form.ai_flags = AI_NUMERICSERV;
    form.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int error = getaddrinfo(host_.c_str(), std::to_string(port_).c_str(), &form, &found);
    if (error != 0) {
      why = host_ + ": " + gai_strerror(error);
      return false;
    }
    found_.reset(found);
    return true;
  }

  pollfd wanted() override { return {fd_, static_cast<short>(unsent_.empty() ? POLLIN : POLLIN | POLLOUT), 0}; }

  std::optional<Entry> receive() override {
    transmit();
    std::optional<Entry> entry = next_entry();
    if (entry || fd_ < 0) {
      return entry;
    }
    const ssize_t size = input_.read(fd_);
    if (size == 0 || (size < 0 && errno != EAGAIN && errno != EINTR)) {
      disconnect(size == 0 ? ended : std::strerror(errno));
      return std::nullopt;
    }
    entry = next_entry();
    if (!entry && fd_ >= 0 && input_.is_full()) {
      disconnect(no_socketcand);
    }
    return entry;
  }

  bool send(const CO_IF_FRM& frame) override {
    transmit();
    if (fd_ < 0 || !unsent_.empty()) {
      return false;
    }
    if ((frame.Identifier & (CO_IF_FRM_RTR | CO_IF_FRM_ERROR)) != 0) {
      ++lost_;
      return true;
    }
    unsent_ = to_socketcand_send(frame);
    transmit();
    return fd_ >= 0;
  }

  bool restore() override {
    if (fd_ >= 0) {
      return true;
    }
    const Clock::time_point deadline = Clock::now() + opening_timeout;
    disconnect("");
    input_ = {};
    unsent_.clear();
    return connect_until(deadline) && expect(Kind::hi, "< open " + bus_ + " >", deadline) &&
           expect(Kind::ok, "< rawmode >", deadline) && expect(Kind::ok, "", deadline);
  }

  const std::string& fault() const override { return fault_; }
  std::uint64_t lost() const override { return lost_; }
  bool is_physical() const override { return true; }
  std::uint32_t bit_rate() const override { return 0; }

 private:
  static constexpr const char* ended = "the server has ended the connection";
  static constexpr const char* no_socketcand = "the program at this port does not follow the protocol of socketcand";
  static constexpr const char* no_answer = "no answer within 2 s";

  bool connect_until(Clock::time_point deadline) {
    for (const addrinfo* at = found_.get(); at != nullptr && fd_ < 0; at = at->ai_next) {
      fd_ = socket(at->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
      int error = fd_ >= 0 && connect(fd_, at->ai_addr, at->ai_addrlen) == 0 ? 0 : errno;
      if (error == EINPROGRESS) {
        socklen_t size = sizeof error;
        error = wait_for(fd_, POLLOUT, deadline) && getsockopt(fd_, SOL_SOCKET, SO_ERROR, &error, &size) == 0
                    ? error
                    : ETIMEDOUT;
      }
      if (error == 0) {
        prepare_connection(fd_);
      } else {
        disconnect(error == ETIMEDOUT ? no_answer : std::strerror(error));
      }
    }
    fault_ = fd_ >= 0 ? "" : fault_;
    return fd_ >= 0;
  }

  /// Waits for a message of the server, and answers it. Reads single bytes, so that the first frames remain in the
  /// socket, where poll() finds them.
  /// \retval false  the bus is lost
  bool expect(Kind kind, std::string answer, Clock::time_point deadline) {
    std::optional<std::string_view> text;
    while (!(text = input_.next())) {
      char byte = 0;
      const ssize_t size = recv(fd_, &byte, 1, 0);
      const bool is_empty = size < 0 && (errno == EAGAIN || errno == EINTR);
      if (size > 0) {
        input_.append({&byte, 1});
      }
      if (size <= 0 && !is_empty) {
        disconnect(size == 0 ? ended : std::strerror(errno));
      } else if (input_.is_full()) {
        disconnect(no_socketcand);
      } else if (is_empty && !wait_for(fd_, POLLIN, deadline)) {
        disconnect(no_answer);
      }
      if (fd_ < 0) {
        return false;
      }
    }
    const SocketcandMessage message = parse_socketcand(*text);
    if (message.kind != kind) {
      disconnect(message.kind == Kind::error ? "the server refuses " + bus_ + ": " + printable(message.text)
                                             : no_socketcand);
      return false;
    }
    unsent_ = std::move(answer);
    transmit();
    return fd_ >= 0;
  }

  /// Returns the next frame that has been read.
  std::optional<Entry> next_entry() {
    while (const std::optional<std::string_view> text = fd_ < 0 ? std::nullopt : input_.next()) {
      SocketcandMessage message = parse_socketcand(*text);
      if (message.kind == Kind::frame) {
        message.entry.direction = Direction::received;
        return message.entry;
      }
      if (message.kind == Kind::error) {
        disconnect("the server reports: " + printable(message.text));
      }
      lost_ += message.kind == Kind::malformed ? 1 : 0;
    }
    return std::nullopt;
  }

  /// Transmits what is queued, as far as the socket has space for it.
  void transmit() {
    while (fd_ >= 0 && !unsent_.empty()) {
      const ssize_t size = ::send(fd_, unsent_.data(), unsent_.size(), MSG_NOSIGNAL);
      if (size < 0 && (errno == EAGAIN || errno == EINTR)) {
        return;
      }
      if (size < 0) {
        disconnect(ended);
        return;
      }
      unsent_.erase(0, static_cast<std::size_t>(size));
    }
  }

  /// \a why: empty at the end of the program.
  void disconnect(const std::string& why) {
    if (fd_ >= 0) {
      close(fd_);
    }
    fd_ = -1;
    fault_ = why.empty() ? "" : address_ + ": " + why;
  }

  struct Free {
    void operator()(addrinfo* found) const { freeaddrinfo(found); }
  };

  std::string address_;  // HOST:PORT
  std::string host_;
  std::uint16_t port_ = 0;
  std::string bus_;
  std::unique_ptr<addrinfo, Free> found_;
  int fd_ = -1;
  SocketcandInput input_;
  std::string unsent_;  // message that the socket had no space for
  std::uint64_t lost_ = 0;
  std::string fault_;
};

}  // namespace

bool has_wrong_socketcand_name(const std::string& name, const BusOptions& /*options*/) {
  return !SocketcandBus().parse(name);
}

std::unique_ptr<Bus> connect_to_socketcand(const std::string& name, const BusOptions& /*options*/, std::string& why) {
  auto bus = std::make_unique<SocketcandBus>();
  if (!bus->find(name, why)) {
    return nullptr;
  }
  if (!bus->restore()) {
    why = bus->fault();
    return nullptr;
  }
  return bus;
}

}  // namespace lexican::host_bus
