// SPDX-License-Identifier: Apache-2.0
#include "simulate/disturbance.hpp"

namespace lexican::simulate {

const CO_IF_CAN_DRV_EX DisturbedCan::driver = {
    [](void* can) { of(can).below_.driver->Init(of(can).below_.context); },
    [](void* can, std::uint32_t rate) { of(can).below_.driver->Enable(of(can).below_.context, rate); },
    [](void* can, CO_IF_FRM* frame) { return of(can).read(frame); },
    [](void* can, const CO_IF_FRM* frame) { return of(can).send(*frame); },
    [](void* can) { of(can).below_.driver->Reset(of(can).below_.context); },
    [](void* can) { of(can).below_.driver->Close(of(can).below_.context); },
    [](void*, const std::uint32_t*, std::uint16_t) {},
    [](void* can, CO_NODE* node, const CO_IF_FRM* frame) {
      if (of(can).below_.driver->Report != nullptr) {
        of(can).below_.driver->Report(of(can).below_.context, node, frame);
      }
    },
};

std::int16_t DisturbedCan::read(CO_IF_FRM* frame) {
  std::int16_t result = below_.driver->Read(below_.context, frame);
  while (result > 0 && (is_off || happens(drop))) {
    result = below_.driver->Read(below_.context, frame);
  }
  return result;
}

std::int16_t DisturbedCan::send(const CO_IF_FRM& frame) {
  constexpr std::int16_t sent = sizeof frame;
  if (is_off || happens(drop)) {
    return sent;  // the device does not notice
  }
  const bool is_repeated = happens(repeat);
  if (delay == 0 && delayed_.empty()) {
    const std::int16_t result = pass(frame);
    if (result > 0 && is_repeated) {
      pass(frame);
    }
    return result;
  }
  for (int n = is_repeated ? 0 : 1; n < 2; ++n) {  // frames keep their order when the delay becomes shorter
    delayed_.push_back({now_() + delay, frame});
  }
  return sent;
}

void DisturbedCan::process() {
  while (!delayed_.empty() && delayed_.front().time <= now_() && pass(delayed_.front().frame) > 0) {
    delayed_.pop_front();
  }
}

}  // namespace lexican::simulate
