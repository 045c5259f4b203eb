// SPDX-License-Identifier: Apache-2.0
// The thermometer on a bus inside of this program, in a time of its own: three seconds, in which it gets warm. What is
// on the bus is shown. A program for a device has a driver of its own for each: docs/porting.md.
#include <chrono>
#include <cstdio>

#include "thermometer/thermometer.hpp"
#include "virtual_bus.hpp"
#include "virtual_clock.hpp"

using namespace std::chrono_literals;

namespace {

constexpr std::uint8_t node_id = 1;

void show(co::VirtualClock& clock, const CO_IF_FRM& frame) {
  std::printf("%6lld ms  %03X ", static_cast<long long>(clock.time() / 1ms), static_cast<unsigned>(frame.Identifier));
  for (unsigned n = 0; n < frame.DLC; ++n) {
    std::printf(" %02X", static_cast<unsigned>(frame.Data[n]));
  }
  std::printf("\n");
}

}  // namespace

int main() {
  CO_NODE node{};
  co::VirtualClock clock;
  co::VirtualTimer timer(clock, [&node] { COTmrService(&node.Tmr); });
  co::VirtualBus bus;
  bus.set_trace([&clock](const co::VirtualBus::Traffic& traffic) { show(clock, traffic.frame); });

  CO_NODE_EXT drivers{};
  drivers.Can = &co::VirtualBusDriver;
  drivers.CanCtx = &bus.attach({"thermometer"});
  drivers.Timer = &co::VirtualTimerDriver;
  drivers.TimerCtx = &timer;
  demo::make_thermometer(node, drivers, node_id);
  CONodeStart(&node);

  bus.inject({0x000, {0x01, node_id}, 2});        // NMT: start
  bus.inject({0x601, {0x40, 0x01, 0x20, 0}, 8});  // SDO: what is the limit?
  for (std::int16_t tenths = 985; tenths <= 1015; ++tenths) {
    CONodeProcess(&node);
    COTmrProcess(&node.Tmr);
    if (tenths % 10 == 0) {
      demo::set_temperature(node, tenths);
    }
    clock.advance(clock.ticks(100ms));
  }
  const bool is_well = CONodeGetErr(&node) == CO_ERR_NONE;
  CONodeStop(&node);
  return is_well ? 0 : 1;
}
