// SPDX-License-Identifier: Apache-2.0
/// \file ports.hpp
/// One connection to a bus for several simulated devices, each with a port: they also receive each other's frames.
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "bus/bus.hpp"

namespace lexican::simulate {

class Ports {
 public:
  static constexpr std::size_t most_waiting = 4096;  ///< received frames of a port; further ones are lost

  /// A port as the bus of a device.
  class Port : public host_bus::Bus {
   public:
    explicit Port(Ports& ports) : ports_(ports) {}

    pollfd wanted() override { return ports_.bus_.wanted(); }
    std::optional<host_bus::Entry> receive() override;
    bool send(const CO_IF_FRM& frame) override;
    bool restore() override { return ports_.bus_.restore(); }
    const std::string& fault() const override { return ports_.bus_.fault(); }
    std::uint64_t lost() const override { return ports_.bus_.lost() + lost_; }
    bool is_physical() const override { return ports_.bus_.is_physical(); }
    std::uint32_t bit_rate() const override { return ports_.bus_.bit_rate(); }

   private:
    friend class Ports;
    void deliver(const host_bus::Entry& entry);

    Ports& ports_;
    std::deque<host_bus::Entry> waiting_;
    std::uint64_t lost_ = 0;
  };

  /// The bus must outlive the ports.
  explicit Ports(host_bus::Bus& bus) : bus_(bus) {}
  Port& add();

 private:
  host_bus::Bus& bus_;
  std::vector<std::unique_ptr<Port>> ports_;
};

}  // namespace lexican::simulate
