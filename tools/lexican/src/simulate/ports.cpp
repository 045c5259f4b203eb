// SPDX-License-Identifier: Apache-2.0
#include "simulate/ports.hpp"

#include "bus/clock.hpp"

namespace lexican::simulate {

using host_bus::Entry;

std::optional<Entry> Ports::Port::receive() {
  while (waiting_.empty()) {
    const std::optional<Entry> entry = ports_.bus_.receive();
    if (!entry) {
      return std::nullopt;
    }
    for (const std::unique_ptr<Port>& port : ports_.ports_) {
      port->deliver(*entry);
    }
  }
  const Entry entry = waiting_.front();
  waiting_.pop_front();
  return entry;
}

bool Ports::Port::send(const CO_IF_FRM& frame) {
  if (!ports_.bus_.send(frame)) {
    return false;
  }
  const Entry entry{host_bus::clock_now(CLOCK_REALTIME), frame};
  for (const std::unique_ptr<Port>& port : ports_.ports_) {
    if (port.get() != this) {
      port->deliver(entry);
    }
  }
  return true;
}

void Ports::Port::deliver(const Entry& entry) {
  if (waiting_.size() < most_waiting) {
    waiting_.push_back(entry);
  } else {
    ++lost_;
  }
}

Ports::Port& Ports::add() {
  ports_.push_back(std::make_unique<Port>(*this));
  return *ports_.back();
}

}  // namespace lexican::simulate
