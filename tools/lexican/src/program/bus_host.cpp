// SPDX-License-Identifier: Apache-2.0
#include "program/bus_host.hpp"

#include <poll.h>
#include <time.h>

#include <algorithm>

namespace lexican::program {

const CO_IF_CAN_DRV_EX BusHost::driver = {
    [](void*) {},
    [](void*, std::uint32_t) {},
    [](void* host, CO_IF_FRM* frame) { return at(host).read(*frame); },
    [](void* host, const CO_IF_FRM* frame) { return at(host).send(*frame); },
    [](void*) {},
    [](void*) {},
    nullptr,
    CONodeCanReport,
};

std::int16_t BusHost::read(CO_IF_FRM& frame) {
  const std::optional<host_bus::Entry> entry = bus_.receive();
  if (!entry) {
    return bus_lost() ? std::int16_t{-1} : std::int16_t{0};
  }
  frame = entry->frame;
  return sizeof frame;
}

std::int16_t BusHost::send(const CO_IF_FRM& frame) {
  constexpr std::uint32_t error_control = 0x700;
  const bool is_own_state = (frame.Identifier & ~std::uint32_t{0x7F}) == error_control;
  if (is_own_state && role_ == Role::client) {
    return sizeof frame;
  }
  const bool is_sent = bus_.send(frame);
  return is_sent ? static_cast<std::int16_t>(sizeof frame) : bus_lost() ? std::int16_t{-1} : std::int16_t{0};
}

void BusHost::wait(Micros time) {
  pollfd wanted = bus_.wanted();
  timespec timeout{};
  const Micros limit = std::min(time, second);
  timeout.tv_sec = static_cast<time_t>(limit / second);
  timeout.tv_nsec = static_cast<long>(limit % second * 1000);
  ppoll(&wanted, 1, &timeout, &interruption_.while_waiting());
}

}  // namespace lexican::program
