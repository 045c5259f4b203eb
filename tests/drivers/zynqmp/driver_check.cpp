// SPDX-License-Identifier: Apache-2.0
// Runs the driver check for ports (tests/drivers/driver_check) on this port: the CAN driver with the second controller
// as peer, the timer driver, and a memory.
#include "co_driver_check.h"

#include "bus.hpp"
#include "co_nvm_ram.h"
#include "machine.hpp"

namespace {

constexpr std::uint32_t late_by_instructions = 20;  // ticks

CO_DRIVER_CHECK check;
CO_NODE_EXT own;
CO_NODE_EXT peer;
std::uint8_t bytes[1024];
CO_NVM_RAM memory = {bytes, sizeof bytes};

void print_line(void* /*user*/, const char* line) {
  zynqmp::print(line);
  zynqmp::print("\n");
}

void serve_timer(void* /*ctx*/) { CODriverCheckService(&check); }
zynqmp::GenericTimer timer = {serve_timer, nullptr, 0, nullptr};
std::uint32_t clock_now(void* /*user*/) { return zynqmp::GenericTimerDriver.Now(&timer); }

}  // namespace

extern "C" int main() {
  using namespace zynqmp;
  serve_controllers();
  add(timer);
  own.Size = sizeof own;
  own.Can = &ZynqmpCanDriver;
  own.CanCtx = &device_can;
  own.Timer = &GenericTimerDriver;
  own.TimerCtx = &timer;
  own.Nvm = &RamNvmDriver;
  own.NvmCtx = &memory;
  peer.Size = sizeof peer;
  peer.Can = &ZynqmpCanDriver;
  peer.CanCtx = &peer_can;
  check.Ext = &own;
  check.Print = print_line;
  check.Bus = CO_CHECK_PEER;
  check.Peer = &peer;
  check.Frames = CO_CHECK_29_BIT | CO_CHECK_REMOTE;
  check.TmrFreq = ticks_per_second;
  check.Clock = clock_now;
  check.Late = late_by_instructions;
  const int status = CODriverCheck(&check) == 0 ? 0 : 1;
  print("1..");
  print(std::uint64_t{check.Passed} + check.Failed);
  print("\n");
  return status;
}
