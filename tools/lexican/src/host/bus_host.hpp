// SPDX-License-Identifier: Apache-2.0
/// \file bus_host.hpp
/// A bus of lexican::host_bus as the bus of nodes of the stack, in real time.
#pragma once

#include "bus/bus.hpp"
#include "host/host.hpp"
#include "host/interruption.hpp"
#include "linux_timer.hpp"

namespace lexican {

class BusHost : public Host {
 public:
  /// A client announces no boot-up and no state. A device continues when the bus is lost, and opens it again.
  enum class Role { client, master, device };

  /// The bus and the interruption must outlive the host.
  BusHost(host_bus::Bus& bus, const Interruption& interruption, Role role = Role::client)
      : BusHost(bus, bus, interruption, role) {}
  /// A device and a master in one program, each with its own connection to the same bus.
  BusHost(host_bus::Bus& device, host_bus::Bus& master, const Interruption& interruption, Role role)
      : device_{device, role}, master_{master, role}, interruption_(interruption) {}

  Can device_can() override { return {&driver, &device_}; }
  Can master_can() override { return {&driver, &master_}; }
  Timer device_timer() override { return {&co::LinuxTimerDriver, &device_timer_}; }
  Timer master_timer() override { return {&co::LinuxTimerDriver, &master_timer_}; }
  std::string bus_fault() override;
  std::uint32_t lost_frames() override;
  /// Returns the bits of the frames received and sent, on a wire, with stuff bits and intermissions.
  std::uint64_t bits() const { return device_.bits + master_.bits; }
  bool bus_lost() override { return device_.is_lost() || master_.is_lost(); }
  Micros now() override { return co::monotonic_ns() / 1000; }
  void wait(Micros time) override;
  bool interrupted() override {
    return Interruption::happened() || is_cancelled() || (device_.role != Role::device && bus_lost());
  }
  /// Returns true if the user has cancelled what the nodes do, but not the program.
  virtual bool is_cancelled() const { return false; }

 protected:
  /// Returns a descriptor that also ends wait() when it is readable; -1: none.
  virtual int further_descriptor() const { return -1; }

 private:
  /// The bus as a node uses it.
  struct End {
    bool is_lost() const { return bus.wanted().fd < 0; }
    std::int16_t read(CO_IF_FRM& frame);
    std::int16_t send(const CO_IF_FRM& frame);
    void count(const CO_IF_FRM& frame);

    host_bus::Bus& bus;
    Role role;
    std::uint64_t bits = 0;
    bool may_have_frames = false;  // the bus may have received more frames than were read; poll() does not report them
  };
  static const CO_IF_CAN_DRV_EX driver;

  End device_;
  End master_;
  const Interruption& interruption_;
  co::LinuxTimer device_timer_;
  co::LinuxTimer master_timer_;
};

}  // namespace lexican
