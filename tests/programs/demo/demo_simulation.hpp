// SPDX-License-Identifier: Apache-2.0
/// \file demo_simulation.hpp
/// Host of the demo's device and master: a virtual bus and a virtual clock.
#pragma once

#include <cstdint>
#include <functional>

#include "host/host.hpp"
#include "virtual_bus.hpp"
#include "virtual_clock.hpp"

namespace test {

class SimulatedHost : public lexican::Host {
 public:
  lexican::Can device_can() override { return {&co::VirtualBusDriver, &device_}; }
  lexican::Can master_can() override { return {&co::VirtualBusDriver, &master_}; }
  lexican::Timer device_timer() override { return {&co::VirtualTimerDriver, &device_timer_}; }
  lexican::Timer master_timer() override { return {&co::VirtualTimerDriver, &master_timer_}; }
  std::string bus_fault() override { return fault; }
  bool bus_lost() override { return lost; }
  lexican::Micros now() override { return clock_.elapsed(); }  // a tick of the nodes' clock is a microsecond
  void wait(lexican::Micros time) override {
    if (!others || !others()) {
      pass(time);
    }
  }
  void pass(lexican::Micros time) { clock_.advance(time); }
  bool interrupted() override { return now() >= interrupted_at; }

  co::VirtualBus bus;
  lexican::Micros interrupted_at = UINT64_MAX;
  std::string fault;
  bool lost = false;
  /// Function that is called while the program waits; returns false if it had nothing to do. May be empty.
  std::function<bool()> others;

 private:
  co::VirtualClock clock_{0xFFFFFF00};  // wraps after 256 us
  co::VirtualTimer device_timer_{clock_};
  co::VirtualTimer master_timer_{clock_};
  co::VirtualBus::Port& device_ = bus.attach({"node"});
  co::VirtualBus::Port& master_ = bus.attach({"master"});
};

}  // namespace test
