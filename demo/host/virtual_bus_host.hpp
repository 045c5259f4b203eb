// SPDX-License-Identifier: Apache-2.0
/// \file virtual_bus_host.hpp
/// A virtual bus inside the program, with simulated time.
#pragma once

#include "host/host.hpp"
#include "host/interruption.hpp"
#include "virtual_bus.hpp"
#include "virtual_clock.hpp"

namespace lexican::demo {

/// The time advances only in wait(). Frames take as long as on a wire.
class VirtualBusHost : public Host {
 public:
  static constexpr std::uint32_t bit_rate = 1'000'000;  // bit/s

  /// \a interruption must outlive the host.
  explicit VirtualBusHost(const Interruption& interruption);
  Can device_can() override { return {&co::VirtualBusDriver, &device_}; }
  Can master_can() override { return {&co::VirtualBusDriver, &master_}; }
  Timer device_timer() override { return {&co::VirtualTimerDriver, &device_timer_}; }
  Timer master_timer() override { return {&co::VirtualTimerDriver, &master_timer_}; }
  Micros now() override { return static_cast<Micros>(clock_.time().count()); }
  void wait(Micros time) override;
  bool interrupted() override { return Interruption::happened(); }

 private:
  const Interruption& interruption_;
  co::VirtualClock clock_;
  co::VirtualTimer device_timer_{clock_};
  co::VirtualTimer master_timer_{clock_};
  co::VirtualBus bus_;
  co::VirtualBus::Port& device_ = bus_.attach({"node"});
  co::VirtualBus::Port& master_ = bus_.attach({"master"});
};

}  // namespace lexican::demo
