// SPDX-License-Identifier: Apache-2.0
/// \file watched_bus.hpp
/// A bus whose frames are also processed by an observer, whichever part of the program receives or sends them.
#pragma once

#include <functional>

#include "bus/bus.hpp"
#include "bus/clock.hpp"

namespace lexican::program {

class WatchedBus : public host_bus::Bus {
 public:
  using Observer = std::function<void(const host_bus::Entry& entry)>;

  /// \a bus must outlive it. \a observer is called for each frame that is received or sent.
  WatchedBus(host_bus::Bus& bus, Observer observer) : bus_(bus), observer_(std::move(observer)) {}

  pollfd wanted() override { return bus_.wanted(); }
  std::optional<host_bus::Entry> receive() override {
    const std::optional<host_bus::Entry> entry = bus_.receive();
    if (entry) {
      observer_(*entry);
    }
    return entry;
  }
  bool send(const CO_IF_FRM& frame) override {
    const bool is_sent = bus_.send(frame);
    if (is_sent) {
      observer_({host_bus::clock_now(CLOCK_REALTIME), frame, host_bus::Direction::sent, 0});
    }
    return is_sent;
  }
  bool restore() override { return bus_.restore(); }
  bool configure(const host_bus::BusOptions& options) override { return bus_.configure(options); }
  void filter(const std::uint32_t* ids, std::uint16_t number) override { bus_.filter(ids, number); }
  const std::string& fault() const override { return bus_.fault(); }
  std::uint64_t lost() const override { return bus_.lost(); }
  bool is_physical() const override { return bus_.is_physical(); }
  std::uint32_t bit_rate() const override { return bus_.bit_rate(); }
  const host_bus::LogReader* log() const override { return bus_.log(); }
  std::string refusal() const override { return bus_.refusal(); }
  std::string note() const override { return bus_.note(); }

 private:
  host_bus::Bus& bus_;
  Observer observer_;
};

}  // namespace lexican::program
