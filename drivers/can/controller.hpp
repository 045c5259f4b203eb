// SPDX-License-Identifier: Apache-2.0
/// \file controller.hpp
/// Functions that the drivers for CAN controllers have in common.
///
/// With LEXICAN_REGISTER_MODEL defined (by a test, for the driver's source and for the test), read() and write() call a
/// model of the controller. Addresses are passed as the driver computes them, so the registers need not be memory.
///
/// Namespace report reports states of a CAN controller and lost frames to the node, as error frames that Read returns,
/// in the coding of SocketCAN. The tables of the drivers contain CONodeCanReport(), which calls CONodeCanEvent() for
/// each of their events.
#ifndef CO_DRIVERS_CONTROLLER_HPP_
#define CO_DRIVERS_CONTROLLER_HPP_

#include <cstdint>

#include "atomic.hpp"
#include "co_can_controller.h"

#ifdef LEXICAN_REGISTER_MODEL
/// Returns the value of a register. Defined by the test.
extern "C" std::uint32_t lexican_model_read(std::uintptr_t address);
/// Writes a register. Defined by the test.
extern "C" void lexican_model_write(std::uintptr_t address, std::uint32_t value);
#endif

namespace co::registers {
/// \cond internal

/// Returns the value of a register or of a word of message memory: one load.
inline std::uint32_t read(const volatile std::uint32_t& reg) {
#ifdef LEXICAN_REGISTER_MODEL
  return lexican_model_read(reinterpret_cast<std::uintptr_t>(&reg));
#else
  return reg;
#endif
}

/// Writes a register or a word of message memory: one store.
inline void write(volatile std::uint32_t& reg, std::uint32_t value) {
#ifdef LEXICAN_REGISTER_MODEL
  lexican_model_write(reinterpret_cast<std::uintptr_t>(&reg), value);
#else
  reg = value;
#endif
}

/// \endcond
}  // namespace co::registers

namespace co::report {
/// \cond internal

enum class State : std::uint8_t { active, passive, bus_off };

/// State of a controller at one moment.
struct Observation {
  State state;
  CO_CAN_ERROR_COUNTERS errors;
  std::uint32_t lost;  ///< frames lost since Enable
};

inline constexpr std::uint32_t class_controller = 0x004;
inline constexpr std::uint32_t class_bus_off = 0x040;
inline constexpr std::uint32_t class_restarted = 0x100;
inline constexpr std::uint32_t class_counters = 0x200;

// Bits of Data[1] in the class class_controller.
inline constexpr std::uint8_t detail_overflow = 0x01;
inline constexpr std::uint8_t detail_passive = 0x30;
inline constexpr std::uint8_t detail_active = 0x40;

using atomic::load;
using atomic::store;

/// Resets the counter of overflows and the reported values. Called while the interrupt is disabled.
inline void restart(CO_CAN_REPORT& report) {
  report.Overflows = 0;
  report.ReportedLost = 0;
  report.SeenBusOffs = report.BusOffs;
}

/// Counts an overflow of the receive FIFO. Called in the interrupt.
inline void count_overflow(CO_CAN_REPORT& report) { store(report.Overflows, report.Overflows + 1); }

/// Counts a bus-off event. Called in the interrupt.
inline void count_bus_off(CO_CAN_REPORT& report) {
  store(report.BusOffs, static_cast<std::uint8_t>(report.BusOffs + 1));
}

/// Returns the state to report: \a now, or bus-off if the controller went to bus-off and back since the last call.
inline State observed(CO_CAN_REPORT& report, State now) {
  const std::uint8_t bus_offs = load(report.BusOffs);
  const bool was_bus_off = bus_offs != report.SeenBusOffs;
  report.SeenBusOffs = bus_offs;
  const bool is_reported = report.Reported == static_cast<std::uint8_t>(State::bus_off);
  return was_bus_off && !is_reported ? State::bus_off : now;
}

/// Fills an error frame with the changes since the last report. Returns false if there are none.
inline bool take(CO_CAN_REPORT& report, const Observation& now, CO_IF_FRM& frame) {
  const State before = static_cast<State>(report.Reported);
  if (now.state == before && now.lost == report.ReportedLost) {
    return false;
  }
  frame = {CO_IF_FRM_ERROR | class_counters, {}, sizeof frame.Data};
  frame.Data[6] = now.errors.Transmit;
  frame.Data[7] = now.errors.Receive;
  if (now.state != before && now.state == State::bus_off) {
    frame.Identifier |= class_bus_off;
  }
  if (now.state != before && before == State::bus_off) {
    frame.Identifier |= class_restarted;
  }
  if (now.state == State::passive && before != State::passive) {
    frame.Identifier |= class_controller;
    frame.Data[1] = detail_passive;
  }
  if (now.state == State::active && before == State::passive) {
    frame.Identifier |= class_controller;
    frame.Data[1] = detail_active;
  }
  if (now.lost != report.ReportedLost) {
    frame.Identifier |= class_controller;
    frame.Data[1] = static_cast<std::uint8_t>(frame.Data[1] | detail_overflow);
  }
  report.Reported = static_cast<std::uint8_t>(now.state);
  report.ReportedLost = now.lost;
  return true;
}

/// \endcond
}  // namespace co::report

#endif
