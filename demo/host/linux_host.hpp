// SPDX-License-Identifier: Apache-2.0
/// \file linux_host.hpp
/// Hosts on Linux: real time and SocketCAN, or a virtual bus with simulated time.
#pragma once

#include <poll.h>

#include <string>
#include <vector>

#include "host/host.hpp"
#include "host/interruption.hpp"
#include "linux_timer.hpp"
#include "socketcan.hpp"
#include "virtual_bus.hpp"
#include "virtual_clock.hpp"

namespace lexican::demo {

class LinuxHost : public Host {
 public:
  /// \a interruption must outlive the host.
  explicit LinuxHost(const Interruption& interruption) : interruption_(interruption) {}
  Timer device_timer() override { return {&co::LinuxTimerDriver, &device_timer_}; }
  Timer master_timer() override { return {&co::LinuxTimerDriver, &master_timer_}; }
  Micros now() override { return co::monotonic_ns() / 1000; }
  void wait(Micros time) override;
  bool interrupted() override { return Interruption::happened(); }

 private:
  /// Returns the descriptors that become readable when a frame arrives.
  virtual std::vector<pollfd> poll_descriptors() { return {}; }

  const Interruption& interruption_;
  co::LinuxTimer device_timer_;
  co::LinuxTimer master_timer_;
};

/// A virtual bus inside the program, with simulated time, which advances only in wait(). Frames take as long as on a
/// wire.
class VirtualBusHost : public LinuxHost {
 public:
  static constexpr std::uint32_t bit_rate = 1'000'000;  // bit/s

  explicit VirtualBusHost(const Interruption& interruption);
  Can device_can() override { return {&co::VirtualBusDriver, &device_}; }
  Can master_can() override { return {&co::VirtualBusDriver, &master_}; }
  Timer device_timer() override { return {&co::VirtualTimerDriver, &device_timer_}; }
  Timer master_timer() override { return {&co::VirtualTimerDriver, &master_timer_}; }
  Micros now() override { return static_cast<Micros>(clock_.time().count()); }
  void wait(Micros time) override;

 private:
  co::VirtualClock clock_;
  co::VirtualTimer device_timer_{clock_};
  co::VirtualTimer master_timer_{clock_};
  co::VirtualBus bus_;
  co::VirtualBus::Port& device_ = bus_.attach({"node"});
  co::VirtualBus::Port& master_ = bus_.attach({"master"});
};

class SocketCanHost : public LinuxHost {
 public:
  using LinuxHost::LinuxHost;
  /// Opens a socket for each end that is used. Returns why the interface cannot be used; empty: success.
  std::string open(const std::string& interface, bool device, bool master);

  Can device_can() override { return {&co::SocketCanDriver, &device_}; }
  Can master_can() override { return {&co::SocketCanDriver, &master_}; }
  std::string bus_fault() override { return device_.error().empty() ? master_.error() : device_.error(); }
  std::uint32_t lost_frames() override { return device_.lost() + master_.lost(); }

 private:
  std::vector<pollfd> poll_descriptors() override;

  co::SocketCan device_;
  co::SocketCan master_;
};

}  // namespace lexican::demo
