// SPDX-License-Identifier: Apache-2.0
#include "host/slcan_host.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace lexican::demo {
namespace {

// Length of the shortest frame on the line: "t0000" and CR.
constexpr std::size_t shortest_line = 6;

std::string message_of(int error) { return std::generic_category().message(error); }

bool is_socket(const std::string& path) {
  struct stat about {};
  return ::stat(path.c_str(), &about) == 0 && S_ISSOCK(about.st_mode);
}

int open_socket(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) {
    errno = ENAMETOOLONG;
    return -1;
  }
  path.copy(address.sun_path, path.size());
  const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (fd >= 0 && ::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    return fd;
  }
  const int error = errno;
  ::close(fd);
  errno = error;
  return -1;
}

// Opens a serial device and discards bytes received before. USB adapters ignore the speed; others use this one.
int open_terminal(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  termios settings{};
  if (fd >= 0 && ::tcgetattr(fd, &settings) == 0) {
    ::cfmakeraw(&settings);
    ::cfsetspeed(&settings, B115200);
    ::tcsetattr(fd, TCSAFLUSH, &settings);
  }
  return fd;
}

// Returns the name of a new pseudo-terminal; empty, with errno, if it fails. It transfers bytes unchanged, and reports
// a hang-up until another program opens it.
std::string name_of(int pseudo_terminal) {
  char name[64] = "";
  if (pseudo_terminal < 0 || ::grantpt(pseudo_terminal) != 0 || ::unlockpt(pseudo_terminal) != 0 ||
      ::ptsname_r(pseudo_terminal, name, sizeof name) != 0) {
    return {};
  }
  const int other_end = open_terminal(name);
  if (other_end < 0) {
    return {};
  }
  ::close(other_end);
  return name;
}

// Sends bytes. A socket whose other end is closed returns an error instead of raising a signal.
ssize_t write_bytes(int fd, const std::uint8_t* bytes, std::size_t size) {
  const ssize_t sent = ::send(fd, bytes, size, MSG_NOSIGNAL);
  return sent < 0 && errno == ENOTSOCK ? ::write(fd, bytes, size) : sent;
}

}  // namespace

const CO_IF_CAN_DRV_EX SlcanHost::driver = {
    [](void* host) { SlcanDriver.Init(&at(host).can_); },
    [](void* host, std::uint32_t baud) { SlcanDriver.Enable(&at(host).can_, baud); },
    [](void* host, CO_IF_FRM* frame) {
      at(host).receive();
      return SlcanDriver.Read(&at(host).can_, frame);
    },
    [](void* host, const CO_IF_FRM* frame) {
      at(host).send();  // bytes that could not be sent before
      return at(host).fd_ < 0 ? std::int16_t{-1} : SlcanDriver.Send(&at(host).can_, frame);
    },
    [](void* host) { SlcanDriver.Reset(&at(host).can_); },
    [](void* host) { SlcanDriver.Close(&at(host).can_); },
    nullptr,
    CONodeCanReport,
};

SlcanHost::~SlcanHost() {
  if (fd_ >= 0) {
    ::close(fd_);
  }
}

std::string SlcanHost::open(const std::string& path, std::uint32_t bit_rate) {
  path_ = path;
  fd_ = is_socket(path) ? open_socket(path) : open_terminal(path);
  if (fd_ < 0) {
    return "slcan adapter '" + path + "': " + message_of(errno);
  }
  start_controller();
  can_.Baud = bit_rate;
  return {};
}

std::string SlcanHost::open_pseudo_terminal() {
  is_pseudo_terminal_ = true;
  fd_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  path_ = name_of(fd_);
  if (path_.empty()) {
    return "no pseudo-terminal: " + message_of(errno);
  }
  start_controller();
  return {};
}

void SlcanHost::start_controller() {
  ::fcntl(fd_, F_SETFL, O_NONBLOCK);
  const auto start = [](void* host) { at(host).send(); };
  COSlcanInit(&can_, frames_.data(), static_cast<std::uint16_t>(frames_.size()), start, this);
}

std::string SlcanHost::bus_fault() {
  if (fault_.empty() && COSlcanRefused(&can_) != 0) {
    return "slcan adapter '" + path_ + "' has refused a command or a frame" +
           (can_.Baud == 0 ? "; perhaps it needs a --bit-rate" : "");
  }
  return fault_;
}

bool SlcanHost::has_other_end() const {
  pollfd end{fd_, 0, 0};
  return !is_pseudo_terminal_ || ::poll(&end, 1, 0) <= 0 || (end.revents & POLLHUP) == 0;
}

void SlcanHost::wait(Micros time) {
  constexpr Micros poll_interval = 10 * millisecond;  // interval of polling: poll() does not report that another
                                                      // program opens it
  LinuxHost::wait(has_other_end() ? time : std::min(time, poll_interval));
}

std::vector<pollfd> SlcanHost::poll_descriptors() {
  if (!has_other_end()) {
    return {};
  }
  const std::uint8_t* bytes = nullptr;
  const bool is_waiting = COSlcanPending(&can_, &bytes) != 0;
  return {{fd_, static_cast<short>(is_waiting ? POLLIN | POLLOUT : POLLIN), 0}};
}

void SlcanHost::receive() {
  send();
  std::array<std::uint8_t, 256> bytes{};
  static_assert(bytes.size() / shortest_line < std::tuple_size<decltype(frames_)>::value);
  if (fd_ < 0 || CORingCount(&can_.Frames) + bytes.size() / shortest_line >= frames_.size()) {
    return;  // the other bytes stay in the kernel
  }
  const ssize_t size = ::read(fd_, bytes.data(), bytes.size());
  if (size < 0 && errno == EIO && is_pseudo_terminal_) {
    return;  // no program has opened it
  }
  if (size == 0 || (size < 0 && errno != EAGAIN && errno != EINTR)) {
    close_with_fault(size == 0 ? "the other end is closed" : message_of(errno));
  }
  for (ssize_t n = 0; n < size; ++n) {
    COSlcanReceive(&can_, bytes[static_cast<std::size_t>(n)]);
  }
}

void SlcanHost::send() {
  const std::uint8_t* bytes = nullptr;
  std::uint32_t size = COSlcanPending(&can_, &bytes);
  const bool dropped = !has_other_end();
  while (fd_ >= 0 && size != 0) {
    const ssize_t sent = dropped ? static_cast<ssize_t>(size) : write_bytes(fd_, bytes, size);
    if (sent < 0 && (errno == EAGAIN || errno == EINTR)) {
      return;
    }
    if (sent < 0) {
      close_with_fault(message_of(errno));
      return;
    }
    COSlcanSent(&can_, static_cast<std::uint32_t>(sent));
    size = COSlcanPending(&can_, &bytes);
  }
}

void SlcanHost::close_with_fault(const std::string& why) {
  ::close(fd_);
  fd_ = -1;
  fault_ = "slcan adapter '" + path_ + "': " + why;
}

}  // namespace lexican::demo
