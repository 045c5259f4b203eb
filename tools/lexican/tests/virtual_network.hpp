// SPDX-License-Identifier: Apache-2.0
/// \file virtual_network.hpp
/// Nodes of the stack on a virtual bus with the timing of a wire, for tests without real time.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "host/node.hpp"
#include "virtual_bus.hpp"
#include "virtual_clock.hpp"

namespace lexican {

/// A bus with nodes of the stack, in virtual time, as the bus of a host.
class VirtualNetwork : public Host {
 public:
  static constexpr std::uint32_t bit_rate = 500'000;

  VirtualNetwork() {
    clock_.set_frequency(Node::ticks_per_second);
    bus_.set_time([this] { return clock_.time(); });
    bus_.pace(bit_rate);
  }

  /// \a node: node-ID, or CO_LSS_NO_NODE_ID. \a domain: bytes of the object 2009h.
  void add(std::uint8_t node, std::uint32_t serial, std::uint32_t domain = 1) {
    devices_.push_back(std::make_unique<Member>(*this, node, serial, domain));
    CONodeStart(&devices_.back()->node.stack());
    wait(millisecond);
  }

  /// Returns a further port of the bus.
  Can attach() { return {&co::VirtualBusDriver, &bus_.attach({"device"})}; }
  Timer add_timer() {
    timers_.push_back(std::make_unique<co::VirtualTimer>(clock_));
    return {&co::VirtualTimerDriver, timers_.back().get()};
  }
  /// Runs further nodes in wait(). \a process: returns the time until it has to be called again.
  void run(std::function<Micros()> process) { others_.push_back(std::move(process)); }

  Can device_can() override { return master_can(); }
  Can master_can() override { return {&co::VirtualBusDriver, &master_}; }
  Timer device_timer() override { return master_timer(); }
  Timer master_timer() override { return {&co::VirtualTimerDriver, &timer_}; }
  Micros now() override { return static_cast<Micros>(clock_.time().count()); }
  void wait(Micros time) override {
    for (const auto& device : devices_) {
      device->node.process();
    }
    for (const std::function<Micros()>& process : others_) {
      time = std::min(time, std::max(process(), Micros{1}));
    }
    const auto due = static_cast<Micros>(bus_.next_due().count());
    const Micros until_due = due > now() ? due - now() : 0;
    const auto step = static_cast<std::int64_t>(std::min({time, until_due, second}));
    clock_.advance(clock_.ticks(std::chrono::microseconds{step}));
  }
  bool interrupted() override { return false; }

  /// Returns the bytes of 2009h of the node that was added as number \a n, from 0 on.
  std::vector<std::uint8_t>& domain(std::size_t n) { return devices_[n]->bytes; }
  co::VirtualBus& bus() { return bus_; }

 private:
  struct Member {
    Member(VirtualNetwork& network, std::uint8_t id, std::uint32_t serial, std::uint32_t size)
        : bytes(size),
          domain{0, size, bytes.data()},
          objects{{
              {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0x00020192},
              {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)0},
              {CO_KEY(0x1008, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&name)},
              {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)4},
              {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0xB7},
              {CO_KEY(0x1018, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0x2001},
              {CO_KEY(0x1018, 3, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)3},
              {CO_KEY(0x1018, 4, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(serial)},
              {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)2},
              {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)0x600},
              {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)0x580},
              {CO_KEY(0x2009, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&domain)},
          }},
          timer(network.clock_),
          node({id,
                {&co::VirtualBusDriver, &network.bus_.attach({"device"})},
                {&co::VirtualTimerDriver, &timer},
                {objects.data(), static_cast<std::uint16_t>(objects.size())}}) {}

    std::vector<std::uint8_t> bytes;
    CO_OBJ_DOM domain;
    CO_OBJ_STR name{0, reinterpret_cast<const std::uint8_t*>("SD-400 servo drive")};
    std::array<CO_OBJ, 12> objects;
    co::VirtualTimer timer;
    Node node;
  };

  co::VirtualClock clock_;
  co::VirtualBus bus_;
  co::VirtualBus::Port& master_ = bus_.attach({"adapter", 512, 10, false});
  co::VirtualTimer timer_{clock_};
  std::vector<std::unique_ptr<Member>> devices_;
  std::vector<std::unique_ptr<co::VirtualTimer>> timers_;
  std::vector<std::function<Micros()>> others_;
};

}  // namespace lexican
