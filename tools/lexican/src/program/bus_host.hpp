// SPDX-License-Identifier: Apache-2.0
/// \file bus_host.hpp
/// A bus of lexican::host_bus as the bus of a node of the stack, in real time.
#pragma once

#include "bus/bus.hpp"
#include "host/host.hpp"
#include "host/interruption.hpp"
#include "linux_timer.hpp"

namespace lexican::program {

class BusHost : public Host {
 public:
  /// A client announces no boot-up and no state; a device does.
  enum class Role { client, device };

  /// The bus and the interruption must outlive the host.
  BusHost(host_bus::Bus& bus, const Interruption& interruption, Role role = Role::client)
      : bus_(bus), interruption_(interruption), role_(role) {}

  Can device_can() override { return {&driver, this}; }
  Can master_can() override { return {&driver, this}; }
  Timer device_timer() override { return {&co::LinuxTimerDriver, &timer_}; }
  Timer master_timer() override { return {&co::LinuxTimerDriver, &timer_}; }
  std::string bus_fault() override { return bus_.fault(); }
  bool bus_lost() override { return bus_.wanted().fd < 0; }
  Micros now() override { return co::monotonic_ns() / 1000; }
  void wait(Micros time) override;
  bool interrupted() override { return Interruption::happened() || bus_lost(); }

 private:
  static const CO_IF_CAN_DRV_EX driver;
  static BusHost& at(void* host) { return *static_cast<BusHost*>(host); }

  std::int16_t read(CO_IF_FRM& frame);
  std::int16_t send(const CO_IF_FRM& frame);

  host_bus::Bus& bus_;
  const Interruption& interruption_;
  Role role_;
  co::LinuxTimer timer_;
};

}  // namespace lexican::program
