// SPDX-License-Identifier: Apache-2.0
#ifdef LEXICAN_HAS_LIBSOCKETCAN
#include <libsocketcan.h>
#endif
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/ethtool.h>
#include <linux/sockios.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "bus/open.hpp"
#include "socketcan.hpp"

namespace lexican::host_bus {
namespace {

/// Returns true for an interface without a controller (vcan, vxcan), as far as the kernel says so.
bool is_virtual(const std::string& name) {
  ethtool_drvinfo driver{};
  driver.cmd = ETHTOOL_GDRVINFO;
  ifreq request{};
  name.copy(request.ifr_name, sizeof request.ifr_name - 1);
  request.ifr_data = reinterpret_cast<char*>(&driver);
  const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const bool is_answered = ioctl(fd, SIOCETHTOOL, &request) == 0;
  close(fd);
  const std::string_view kind = driver.driver;
  return is_answered && (kind == "vcan" || kind == "vxcan");
}

/// Returns the bit rate of an interface in bit/s; 0: it has none, or the program is built without libsocketcan.
std::uint32_t bit_rate_of([[maybe_unused]] const std::string& name) {
#ifdef LEXICAN_HAS_LIBSOCKETCAN
  can_bittiming timing{};
  return can_get_bittiming(name.c_str(), &timing) == 0 ? timing.bitrate : 0;
#else
  return 0;
#endif
}

class SocketCanBus : public Bus {
 public:
  explicit SocketCanBus(std::string name) : name_(std::move(name)) {}

  pollfd wanted() override { return {can_.fd(), static_cast<short>(is_refused_ ? POLLIN | POLLOUT : POLLIN), 0}; }

  std::optional<Entry> receive() override {
    Entry entry;
    while (can_.fd() >= 0) {
      const std::int16_t result = can_.read(entry.frame);
      if (result == 0) {
        return std::nullopt;
      }
      if (result > 0 && !is_overflow(entry.frame)) {
        entry.time = time_of_frame();
        entry.direction = Direction::received;
        return entry;
      }
      if (result < 0 && can_.fd() >= 0 && can_.code() != ENETDOWN) {
        can_.close();
      }
      fault_ = result < 0 ? can_.error() : fault_;
    }
    return std::nullopt;
  }

  bool send(const CO_IF_FRM& frame) override {
    if (can_.fd() < 0) {
      return false;
    }
    const std::int16_t result = can_.send(frame);
    is_refused_ = result == 0;
    fault_ = result < 0 ? can_.error() : fault_;
    return result > 0;
  }

  bool restore() override {
    if (can_.fd() < 0) {
      can_.open(name_);
      const can_err_mask_t all = CAN_ERR_MASK;
      if (can_.fd() >= 0 && setsockopt(can_.fd(), SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &all, sizeof all) == 0) {
        is_physical_ = !is_virtual(name_);
        bit_rate_ = is_physical_ ? bit_rate_of(name_) : 0;  // libsocketcan prints a message for a virtual interface
      }
      is_refused_ = false;
    }
    fault_ = can_.fd() < 0 ? can_.error() : can_.up() ? "" : name_ + " is down: ip link set " + name_ + " up";
    return fault_.empty();
  }

  void filter(const std::uint32_t* ids, std::uint16_t number) override { can_.filter(ids, number); }

  const std::string& fault() const override { return fault_; }
  std::uint64_t lost() const override { return can_.lost(); }
  bool is_physical() const override { return is_physical_; }
  std::uint32_t bit_rate() const override { return bit_rate_; }
  bool is_open() const { return can_.fd() >= 0; }

 private:
  /// The driver's report of frames that lost() counts.
  static bool is_overflow(const CO_IF_FRM& frame) {
    return frame.Identifier == (CO_IF_FRM_ERROR | CAN_ERR_CRTL) && frame.Data[1] == CAN_ERR_CRTL_RX_OVERFLOW;
  }

  /// Returns when the kernel has received the last frame, in µs since 1970.
  Micros time_of_frame() const {
    timeval time{};
    if (ioctl(can_.fd(), SIOCGSTAMP, &time) != 0) {  // the kernel stores the times of later frames only
      gettimeofday(&time, nullptr);
    }
    return static_cast<Micros>(time.tv_sec) * 1'000'000 + static_cast<Micros>(time.tv_usec);
  }

  std::string name_;
  co::SocketCan can_;
  bool is_physical_ = true;
  std::uint32_t bit_rate_ = 0;
  bool is_refused_ = false;  // the last frame to send
  std::string fault_;
};

}  // namespace

std::unique_ptr<Bus> open_socketcan(const std::string& name, const BusOptions& options, std::string& why) {
  auto bus = std::make_unique<SocketCanBus>(name);
  bus->restore();
  if (!bus->is_open()) {
    why = bus->fault();
    return nullptr;
  }
  if (options.bit_rate != 0 && bus->bit_rate() != 0 && bus->bit_rate() != options.bit_rate) {
    why = name + " has another bit rate (" + std::to_string(bus->bit_rate()) +
          " bit/s), which only root can change: ip link set " + name + " down; ip link set " + name +
          " up type can bitrate " + std::to_string(options.bit_rate);
    return nullptr;
  }
  return bus;
}

}  // namespace lexican::host_bus
