// SPDX-License-Identifier: Apache-2.0
#include "socketcan.hpp"

#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace co {
namespace {

constexpr std::int16_t one_frame = sizeof(CO_IF_FRM);

// Errors that the node processes. Single bus errors are left out: they may flood the receive queue.
constexpr can_err_mask_t reported_errors = CAN_ERR_BUSOFF | CAN_ERR_CRTL | CAN_ERR_RESTARTED;

// More frames than a receive queue holds: discard_received() must end on a bus that is faster than this loop.
constexpr int discard_limit = 4096;

// Returns true for errors after which the call can be repeated.
bool is_temporary(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == ENOBUFS || error == EINTR; }

// Returns true if the device of the socket no longer exists. The socket stays unusable even if a device of this name
// returns.
bool is_missing(int error) { return error == ENODEV || error == ENXIO; }

CO_IF_FRM overflow_frame() {
  return {CO_IF_FRM_ERROR | CAN_ERR_CRTL, {0, CAN_ERR_CRTL_RX_OVERFLOW, 0, 0, 0, 0, 0, 0}, CAN_ERR_DLC};
}

bool request(int fd, unsigned long what, const std::string& interface, ifreq& answer) {
  answer = {};
  std::memcpy(answer.ifr_name, interface.data(), interface.size());  // the length was checked by open()
  return ::ioctl(fd, what, &answer) == 0;
}

template <typename Value>
bool set_option(int fd, int level, int name, const Value& value) {
  return ::setsockopt(fd, level, name, &value, sizeof value) == 0;
}

}  // namespace

SocketCan::~SocketCan() { close_socket(); }

bool SocketCan::open(const std::string& interface) {
  close_socket();
  interface_ = interface;
  code_ = 0;
  error_.clear();
  on_bus_ = open_socket();
  return on_bus_;
}

void SocketCan::close() {
  close_socket();
  on_bus_ = false;
}

bool SocketCan::up() const {
  ifreq answer{};
  return fd_ >= 0 && request(fd_, SIOCGIFFLAGS, interface_, answer) && (answer.ifr_flags & IFF_UP) != 0;
}

void SocketCan::init() { discard_received(); }

void SocketCan::enable() {
  if (fd_ >= 0) {
    discard_received();
    return;
  }
  open_socket();
  on_bus_ = true;  // even if open_socket() has failed: the interface may appear later
}

std::int16_t SocketCan::read(CO_IF_FRM& frame) {
  if (!open_if_missing()) {
    return 0;
  }
  if (overrun_) {
    overrun_ = false;
    frame = overflow_frame();
    return one_frame;
  }
  can_frame raw{};
  const long bytes = receive(raw);
  if (bytes < 0) {
    return is_temporary(errno) ? std::int16_t{0} : fail_transfer("receiving", errno);
  }
  if (bytes != static_cast<long>(sizeof raw)) {
    return fail_transfer("receiving", EBADMSG);
  }
  frame = from_socketcan(raw);
  return one_frame;
}

std::int16_t SocketCan::send(const CO_IF_FRM& frame) {
  if (!open_if_missing()) {
    return -1;
  }
  const can_frame raw = to_socketcan(frame);
  const ssize_t bytes = ::send(fd_, &raw, sizeof raw, MSG_DONTWAIT);
  if (bytes < 0) {
    return is_temporary(errno) ? std::int16_t{0} : fail_transfer("sending", errno);
  }
  return one_frame;
}

void SocketCan::reset() {
  if (open_if_missing()) {
    discard_received();
  }
}

void SocketCan::filter(const std::uint32_t* ids, std::uint16_t num) {
  filters_ = socketcan_filters(ids, num);
  filtered_ = true;
  if (fd_ >= 0 && !apply_filters()) {
    fail_opening(SocketCanStep::option, errno);
  }
}

bool SocketCan::open_socket() {
  if (interface_.empty() || interface_.size() >= IFNAMSIZ) {
    return fail_opening(SocketCanStep::name, EINVAL);
  }
  fd_ = ::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  lost_on_socket_ = 0;
  if (fd_ < 0) {
    return fail_opening(SocketCanStep::socket, errno);
  }
  // The options have to be set before the socket is bound, because a bound socket receives at once.
  if (set_options() && bind_to_interface()) {
    return true;
  }
  close_socket();
  return false;
}

bool SocketCan::set_options() {
  const int off = 0;
  const int on = 1;
  const bool done = apply_filters() && set_option(fd_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, reported_errors) &&
                    set_option(fd_, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, off) &&
                    set_option(fd_, SOL_SOCKET, SO_RXQ_OVFL, on);
  return done || fail_opening(SocketCanStep::option, errno);
}

bool SocketCan::apply_filters() {
  if (!filtered_) {
    return true;  // a new socket receives every frame
  }
  const auto size = static_cast<socklen_t>(filters_.size() * sizeof(can_filter));
  return ::setsockopt(fd_, SOL_CAN_RAW, CAN_RAW_FILTER, filters_.empty() ? nullptr : filters_.data(), size) == 0;
}

bool SocketCan::bind_to_interface() {
  ifreq answer{};
  if (!request(fd_, SIOCGIFINDEX, interface_, answer)) {
    return fail_opening(SocketCanStep::interface, errno);
  }
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = answer.ifr_ifindex;
  if (::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return fail_opening(SocketCanStep::bind, errno);
  }
  return true;
}

// Returns true if there is a socket. Opens the interface again if it had vanished.
bool SocketCan::open_if_missing() { return fd_ >= 0 || (on_bus_ && open_socket()); }

void SocketCan::close_socket() {
  if (fd_ >= 0) {
    ::close(fd_);
  }
  fd_ = -1;
  overrun_ = false;
}

void SocketCan::discard_received() {
  can_frame raw{};
  for (int i = 0; i < discard_limit && fd_ >= 0; ++i) {
    if (receive(raw) >= 0) {
      continue;
    }
    if (is_temporary(errno)) {
      break;
    }
    fail_transfer("receiving", errno);  // a pending error hides the frames behind it
  }
  overrun_ = false;
}

long SocketCan::receive(can_frame& frame) {
  iovec data{&frame, sizeof frame};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(std::uint32_t))];
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  const ssize_t bytes = ::recvmsg(fd_, &message, MSG_DONTWAIT);
  const cmsghdr* const extra = (bytes < 0) ? nullptr : CMSG_FIRSTHDR(&message);
  if (extra != nullptr && extra->cmsg_level == SOL_SOCKET && extra->cmsg_type == SO_RXQ_OVFL) {
    std::uint32_t total = 0;
    std::memcpy(&total, CMSG_DATA(extra), sizeof total);
    count_lost(total);
  }
  return bytes;
}

// Adds the frames that the kernel has lost since the last call. \a total: its counter for this socket.
void SocketCan::count_lost(std::uint32_t total) {
  const std::uint32_t more = total - lost_on_socket_;
  lost_on_socket_ = total;
  lost_ += more;
  overrun_ = overrun_ || more != 0;
}

// Stores the error of a step of opening, and its text. Returns false. open_socket() closes the socket then.
bool SocketCan::fail_opening(SocketCanStep step, int error) {
  code_ = error;
  error_ = socketcan_error(step, error, interface_);
  return false;
}

// Stores the error of a transfer and its text. Closes the socket if the interface has vanished. Returns -1.
std::int16_t SocketCan::fail_transfer(const char* action, int error) {
  code_ = error;
  error_ = "CAN interface '" + interface_ + "': " + action + " failed: " + std::generic_category().message(error);
  if (is_missing(error)) {
    close_socket();
  }
  return -1;
}

namespace {

SocketCan& can(void* ctx) { return *static_cast<SocketCan*>(ctx); }

void init(void* ctx) { can(ctx).init(); }
void enable(void* ctx, std::uint32_t /*baud*/) { can(ctx).enable(); }
std::int16_t read(void* ctx, CO_IF_FRM* frm) { return can(ctx).read(*frm); }
std::int16_t send(void* ctx, const CO_IF_FRM* frm) { return can(ctx).send(*frm); }
void reset(void* ctx) { can(ctx).reset(); }
void close(void* ctx) { can(ctx).close(); }
void filter(void* ctx, const std::uint32_t* ids, std::uint16_t num) { can(ctx).filter(ids, num); }

}  // namespace

}  // namespace co

const CO_IF_CAN_DRV_EX COSocketCanDriver = {co::init,  co::enable, co::read,   co::send,
                                            co::reset, co::close,  co::filter, CONodeCanReport};
