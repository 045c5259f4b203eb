// SPDX-License-Identifier: Apache-2.0
#include "host/linux_host.hpp"

#include <algorithm>
#include <chrono>

namespace lexican::demo {
void LinuxHost::wait(Micros time) {
  std::vector<pollfd> ends = poll_descriptors();
  timespec timeout{};
  timeout.tv_sec = static_cast<time_t>(time / second);
  timeout.tv_nsec = static_cast<long>(time % second * 1000);
  ppoll(ends.data(), ends.size(), &timeout, &interruption_.while_waiting());
}

VirtualBusHost::VirtualBusHost(const Interruption& interruption) : LinuxHost(interruption) {
  bus_.set_time([this] { return clock_.time(); });
  bus_.pace(bit_rate);
}

void VirtualBusHost::wait(Micros time) {
  LinuxHost::wait(0);  // unblocks the signals for a moment: note_signal() stores pending ones
  const auto next = static_cast<Micros>(bus_.next_due().count());
  const Micros until_next = next > now() ? next - now() : 0;
  // One second at most, because time may be for_ever.
  const auto step = static_cast<std::int64_t>(std::min({time, until_next, second}));
  clock_.advance(clock_.ticks(std::chrono::microseconds{step}));
}

std::string SocketCanHost::open(const std::string& interface, bool device, bool master) {
  const auto fault = [&](co::SocketCan& end) {
    if (!end.open(interface)) {
      return end.error();
    }
    return end.up() ? std::string()
                    : "CAN interface '" + interface + "' is down; as root: ip link set " + interface + " up";
  };
  const std::string found = device ? fault(device_) : std::string();
  return found.empty() && master ? fault(master_) : found;
}

std::vector<pollfd> SocketCanHost::poll_descriptors() {
  return {{device_.fd(), POLLIN, 0}, {master_.fd(), POLLIN, 0}};  // -1: not open, which poll() ignores
}

}  // namespace lexican::demo
