// SPDX-License-Identifier: Apache-2.0
#include "host/bus_host.hpp"

#include <poll.h>
#include <time.h>

#include <algorithm>

#include "frame_bits.hpp"

namespace lexican {

const CO_IF_CAN_DRV_EX BusHost::driver = {
    [](void*) {},
    [](void*, std::uint32_t) {},
    [](void* end, CO_IF_FRM* frame) { return static_cast<End*>(end)->read(*frame); },
    [](void* end, const CO_IF_FRM* frame) { return static_cast<End*>(end)->send(*frame); },
    [](void*) {},
    [](void*) {},
    [](void* end, const std::uint32_t* ids, std::uint16_t number) {
      if (static_cast<End*>(end)->role != Role::client) {
        static_cast<End*>(end)->bus.filter(ids, number);
      }
    },
    CONodeCanReport,
};

std::int16_t BusHost::End::read(CO_IF_FRM& frame) {
  const std::optional<host_bus::Entry> entry = bus.receive();
  may_have_frames = entry.has_value();
  if (!entry) {
    return is_lost() ? std::int16_t{-1} : std::int16_t{0};
  }
  frame = entry->frame;
  count(frame);
  return sizeof frame;
}

void BusHost::End::count(const CO_IF_FRM& frame) {
  const bool is_error = (frame.Identifier & CO_IF_FRM_ERROR) != 0;
  bits += is_error ? 0 : co::frame_bits(frame) + co::intermission_bits;
}

std::int16_t BusHost::End::send(const CO_IF_FRM& frame) {
  constexpr std::uint32_t error_control = 0x700;
  const bool is_own_state = (frame.Identifier & ~std::uint32_t{0x7F}) == error_control;
  if (is_own_state && role == Role::client) {
    return sizeof frame;
  }
  if (bus.send(frame)) {
    count(frame);
    return sizeof frame;
  }
  const bool is_broken = is_lost() || (role != Role::client && !bus.fault().empty());  // also an interface that is down
  return is_broken ? std::int16_t{-1} : std::int16_t{0};
}

std::string BusHost::bus_fault() {
  for (const End* const end : {&device_, &master_}) {
    if (!end->bus.fault().empty() || !end->bus.refusal().empty()) {
      return end->bus.fault().empty() ? end->bus.refusal() : end->bus.fault();
    }
  }
  return {};
}

std::uint32_t BusHost::lost_frames() {
  const bool is_one = &device_.bus == &master_.bus;
  return static_cast<std::uint32_t>(device_.bus.lost() + (is_one ? 0 : master_.bus.lost()));
}

void BusHost::wait(Micros time) {
  pollfd wanted[] = {device_.bus.wanted(), master_.bus.wanted(), {further_descriptor(), POLLIN, 0}};
  timespec timeout{};
  const bool has_frames = device_.may_have_frames || master_.may_have_frames;
  const Micros limit = has_frames ? 0 : std::min(time, second);
  timeout.tv_sec = static_cast<time_t>(limit / second);
  timeout.tv_nsec = static_cast<long>(limit % second * 1000);
  ppoll(wanted, 3, &timeout, &interruption_.while_waiting());
  for (const End* const end : {&device_, &master_}) {
    if (end->role != Role::client && !end->bus.fault().empty()) {
      end->bus.restore();
    }
  }
}

}  // namespace lexican
