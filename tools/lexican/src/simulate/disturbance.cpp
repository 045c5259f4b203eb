// SPDX-License-Identifier: Apache-2.0
#include "simulate/disturbance.hpp"

#include <algorithm>

namespace lexican::simulate {
namespace {

// Error frames in the coding of SocketCAN.
constexpr std::uint32_t event_bus_off = 0x040;
constexpr std::uint32_t event_restarted = 0x100;
constexpr CO_IF_FRM bus_error = {CO_IF_FRM_ERROR | 0x088, {0, 0, 0x81}, 8};  // a wrong bit of a sent frame

}  // namespace

const CO_IF_CAN_DRV_EX DisturbedCan::driver = {
    [](void* can) {
      of(can).bus_off_end_ = 0;
      of(can).events_.clear();
      of(can).below_.driver->Init(of(can).below_.context);
    },
    [](void* can, std::uint32_t rate) { of(can).below_.driver->Enable(of(can).below_.context, rate); },
    [](void* can, CO_IF_FRM* frame) { return of(can).read(frame); },
    [](void* can, const CO_IF_FRM* frame) { return of(can).send(*frame); },
    [](void* can) {
      of(can).recover();
      of(can).below_.driver->Reset(of(can).below_.context);
    },
    [](void* can) { of(can).below_.driver->Close(of(can).below_.context); },
    [](void*, const std::uint32_t*, std::uint16_t) {},
    CONodeCanReport,
};

std::int16_t DisturbedCan::read(CO_IF_FRM* frame) {
  if (!events_.empty()) {
    *frame = {CO_IF_FRM_ERROR | events_.front(), {}, 8};
    events_.pop_front();
    return sizeof *frame;
  }
  std::int16_t result = below_.driver->Read(below_.context, frame);
  while (result > 0 && (is_off || is_bus_off() || happens(drop) || (received_ && !received_(*frame)))) {
    result = below_.driver->Read(below_.context, frame);
  }
  return result;
}

std::int16_t DisturbedCan::send(CO_IF_FRM frame) {
  constexpr std::int16_t sent = sizeof frame;
  if (is_bus_off()) {
    return -1;
  }
  if (is_off || happens(drop) || (sent_ && !sent_(frame))) {
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

void DisturbedCan::enter_bus_off(Micros time, unsigned errors) {
  if (!is_bus_off()) {
    errors_ = errors;
    events_.push_back(event_bus_off);
  }
  bus_off_end_ = time != for_ever ? now_() + std::max(time, Micros{1}) : for_ever;
}

void DisturbedCan::recover() {
  if (is_bus_off()) {
    bus_off_end_ = 0;
    events_.push_back(event_restarted);
  }
}

void DisturbedCan::flood(std::uint32_t identifier, unsigned rate) {
  const double interval = rate != 0 ? static_cast<double>(second) / rate : 0;
  flood_ = {{identifier, {}, 8}, interval, static_cast<double>(now_())};
}

/// Sends the frames of the flood, which have a counter in their first 4 bytes. Those that the bus does not take are not
/// sent later.
void DisturbedCan::send_flood() {
  constexpr int at_most = 32;  // so that the device continues
  constexpr double latest = 100 * millisecond;
  flood_.next = std::max(flood_.next, static_cast<double>(now_()) - latest);
  for (int n = 0; n < at_most && flood_.next <= static_cast<double>(now_()); ++n) {
    if (pass(flood_.frame) <= 0) {
      flood_.next = static_cast<double>(now_()) + static_cast<double>(second) / most_flooding;
      return;
    }
    COFrmSetLong(&flood_.frame, CO_GET_LONG(&flood_.frame, 0) + 1, 0);
    flood_.next += flood_.interval;
  }
}

void DisturbedCan::process() {
  while (errors_ > 0 && pass(bus_error) > 0) {
    --errors_;
  }
  if (is_bus_off() && bus_off_end_ <= now_()) {
    recover();
  }
  if (is_bus_off()) {
    return;
  }
  while (!delayed_.empty() && delayed_.front().time <= now_() && pass(delayed_.front().frame) > 0) {
    delayed_.pop_front();
  }
  if (flood_.interval > 0 && !is_off) {
    send_flood();
  }
}

Micros DisturbedCan::due() const {
  const Micros errors = errors_ > 0 ? now_() + millisecond : for_ever;
  if (is_bus_off()) {
    return std::min(errors, bus_off_end_);
  }
  const Micros delayed = delayed_.empty() ? for_ever : delayed_.front().time;
  const Micros flooding = flood_.interval > 0 && !is_off ? static_cast<Micros>(flood_.next) : for_ever;
  return std::min({errors, delayed, flooding});
}

}  // namespace lexican::simulate
