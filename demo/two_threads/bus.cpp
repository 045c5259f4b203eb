// SPDX-License-Identifier: Apache-2.0
#include "bus.h"

#include <mutex>

#include "virtual_bus.hpp"

namespace {

// The simulated bus is not thread-safe: the mutex protects it.
struct Wire {
  std::mutex mutex;
  co::VirtualBus bus;
};

Wire& wire() {
  static Wire wire;
  return wire;
}

const CO_IF_CAN_DRV_EX& controller = co::VirtualBusDriver;

void init(void* ctx) {
  const std::lock_guard<std::mutex> guard(wire().mutex);
  controller.Init(ctx);
}

void enable(void* ctx, std::uint32_t baud) {
  const std::lock_guard<std::mutex> guard(wire().mutex);
  controller.Enable(ctx, baud);
}

std::int16_t read(void* ctx, CO_IF_FRM* frame) {
  const std::lock_guard<std::mutex> guard(wire().mutex);
  return controller.Read(ctx, frame);
}

std::int16_t send(void* ctx, const CO_IF_FRM* frame) {
  const std::lock_guard<std::mutex> guard(wire().mutex);
  return controller.Send(ctx, frame);
}

void reset(void* ctx) {
  const std::lock_guard<std::mutex> guard(wire().mutex);
  controller.Reset(ctx);
}

void close(void* ctx) {
  const std::lock_guard<std::mutex> guard(wire().mutex);
  controller.Close(ctx);
}

}  // namespace

extern "C" {

const CO_IF_CAN_DRV_EX BusDriver = {init, enable, read, send, reset, close, nullptr, CONodeCanReport};

void* BusAttach() {
  const std::lock_guard<std::mutex> guard(wire().mutex);
  return &wire().bus.attach();
}

}  // extern "C"
