// SPDX-License-Identifier: Apache-2.0
#include "host/virtual_bus_host.hpp"

#include <poll.h>

#include <algorithm>
#include <chrono>

namespace lexican::demo {

VirtualBusHost::VirtualBusHost(const Interruption& interruption) : interruption_(interruption) {
  bus_.set_time([this] { return clock_.time(); });
  bus_.pace(bit_rate);
}

void VirtualBusHost::wait(Micros time) {
  const timespec at_once{};
  ppoll(nullptr, 0, &at_once, &interruption_.while_waiting());  // note_signal() stores pending signals
  const auto next = static_cast<Micros>(bus_.next_due().count());
  const Micros until_next = next > now() ? next - now() : 0;
  // One second at most, because time may be for_ever.
  const auto step = static_cast<std::int64_t>(std::min({time, until_next, second}));
  clock_.advance(clock_.ticks(std::chrono::microseconds{step}));
}

}  // namespace lexican::demo
