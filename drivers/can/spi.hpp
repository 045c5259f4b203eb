// SPDX-License-Identifier: Apache-2.0
/// \file spi.hpp
/// The use of an SPI bus by the drivers for CAN controllers, in the loop and in the interrupt, without a lock: while a
/// function of a driver uses the bus, the interrupt only leaves a note, and that function does its work at the end.
/// Can is a context with the members Spi, SpiCtx, Bus and User.
#ifndef CO_DRIVERS_SPI_HPP_
#define CO_DRIVERS_SPI_HPP_

#include <cstdint>

#include "atomic.hpp"
#include "co_can_spi.h"

namespace co::spi {
/// \cond internal

using atomic::load;
using atomic::store;

template <typename Can>
CO_CAN_SPI_BUS& bus_of(Can& can) {
  return can.Bus != nullptr ? *can.Bus : can.User.OwnBus;
}

/// An interrupt may occur at any point, but it ends before this context continues, with the same value of Holds.
inline void hold(CO_CAN_SPI_BUS& bus) { store(bus.Holds, static_cast<std::uint8_t>(bus.Holds + 1)); }

inline void work_off(CO_CAN_SPI_BUS& bus) {
  store(bus.HasNotes, std::uint8_t{0});
  for (CO_CAN_SPI_USER* user = bus.First; user != nullptr; user = user->Next) {
    if (load(user->IsMissed) != 0) {
      store(user->IsMissed, std::uint8_t{0});
      user->Service(user->Can);
    }
  }
}

/// Does the work of the interrupts that have occurred since hold(), unless this context has interrupted another user.
inline void release(CO_CAN_SPI_BUS& bus) {
  store(bus.Holds, static_cast<std::uint8_t>(bus.Holds - 1));
  while (bus.Holds == 0 && load(bus.HasNotes) != 0) {
    hold(bus);
    work_off(bus);
    store(bus.Holds, static_cast<std::uint8_t>(bus.Holds - 1));
  }
}

/// The interrupt function of a driver.
template <typename Can>
void interrupt(Can& can) {
  CO_CAN_SPI_BUS& bus = bus_of(can);
  store(can.User.IsMissed, std::uint8_t{1});
  store(bus.HasNotes, std::uint8_t{1});
  hold(bus);
  release(bus);
}

/// The use of SPI by a function of a driver: the interrupts do not use it meanwhile.
class Exclusive {
 public:
  template <typename Can>
  explicit Exclusive(Can& can) : bus_(bus_of(can)) {
    hold(bus_);
  }
  ~Exclusive() { release(bus_); }
  Exclusive(const Exclusive&) = delete;
  Exclusive& operator=(const Exclusive&) = delete;

 private:
  CO_CAN_SPI_BUS& bus_;
};

/// Adds a controller to its bus; \a service does the work of its interrupt. May be called again.
template <typename Can>
void add_to_bus(Can& can, void (*service)(void*)) {
  CO_CAN_SPI_BUS& bus = bus_of(can);
  can.User.Service = service;
  can.User.Can = &can;
  for (const CO_CAN_SPI_USER* one = bus.First; one != nullptr; one = one->Next) {
    if (one == &can.User) {
      return;
    }
  }
  can.User.Next = bus.First;
  bus.First = &can.User;
}

/// Transfers bytes while CS is low.
template <typename Can>
void transact(const Can& can, std::uint8_t* bytes, unsigned number) {
  can.Spi->Select(can.SpiCtx, true);
  can.Spi->Transfer(can.SpiCtx, bytes, static_cast<std::uint8_t>(number));
  can.Spi->Select(can.SpiCtx, false);
}

template <typename Can>
bool has_interrupt(const Can& can) {
  return can.Spi->HasInterrupt == nullptr || can.Spi->HasInterrupt(can.SpiCtx);
}

/// \endcond
}  // namespace co::spi

#endif
