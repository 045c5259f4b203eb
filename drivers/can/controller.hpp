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
///
/// A new driver has a C header with the context, a port for Driver, and an interrupt function. Rules:
/// - Driver uses these members of the context: Rates (elements with Baud), RateNum, Rate, Received and Report. Rate is
///   null while the controller is off the bus, also if join_bus() has failed; Send returns -1 then.
/// - Driver calls the port in the loop, without a lock. A member of the port that the interrupt could disturb excludes
///   it: it disables the interrupts in the controller (bxcan), or the interrupt leaves its work to the loop (mcp2515,
///   for SPI). Members of the port call each other.
/// - The interrupt function returns if Rate is null. It calls CORingPut(), count_overflow() and count_bus_off(), and
///   shares other members with the loop by atomic.hpp. The loop calls CORingInit() and restart() while the interrupt is
///   excluded: in join_bus(), discard() and before Received is used the first time.
/// - Init may be called again, in any state of the controller. Each wait ends after a fixed number of reads: a
///   controller that does not answer must not block the node.
/// - Bus-off: is_bus_off() is true until the controller is on the bus again. If no interrupt announces the end,
///   is_bus_off() and poll() read it. A bus-off shorter than a cycle of the loop is reported if it was counted.
///   join_bus() in bus-off with the present rate discards all frames and does not shorten an automatic recovery.
///   accept() refuses a frame if bus-off has begun since is_bus_off().
/// - Filters: identifiers may occur several times. Off the bus the port stores the filters, and join_bus() writes them;
///   in bus-off they may be written after it. A change on the bus loses no frame that was received or accepted before.
/// - Frames: transmit.hpp has is_extended() and length_of(), as a DLC may exceed 8. Remote frames have no data. Frames
///   of CAN FD are discarded. Frames of one identifier keep their order, also if there are several receive FIFOs.
/// - Tests: a model in tests/drivers/models and a Kind in tests/drivers/controllers/bench.hpp, for which the cases
///   of all controllers run. A controller behind SPI has its model behind the functions that access it.
#ifndef CO_DRIVERS_CONTROLLER_HPP_
#define CO_DRIVERS_CONTROLLER_HPP_

#include <cstdint>

#include "atomic.hpp"
#include "co_can_controller.h"
#include "co_ring.h"
#include "transmit.hpp"

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
  if (bus_offs == report.SeenBusOffs) {
    return now;
  }
  report.SeenBusOffs = bus_offs;
  return report.Reported == static_cast<std::uint8_t>(State::bus_off) ? now : State::bus_off;
}

/// Fills an error frame with the changes since the last report. Returns false if there are none; the function errors,
/// which returns the error counters, is not called then.
template <typename Errors>
bool take(CO_CAN_REPORT& report, State state, std::uint32_t lost, Errors errors, CO_IF_FRM& frame) {
  const State before = static_cast<State>(report.Reported);
  if (state == before && lost == report.ReportedLost) {
    return false;
  }
  const CO_CAN_ERROR_COUNTERS counters = errors();
  std::uint32_t classes = CO_IF_FRM_ERROR | class_counters;
  unsigned detail = 0;
  if (state != before && state == State::bus_off) {
    classes |= class_bus_off;
  }
  if (state != before && before == State::bus_off) {
    classes |= class_restarted;
  }
  if (state == State::passive && before != State::passive) {
    detail = detail_passive;
  }
  if (state == State::active && before == State::passive) {
    detail = detail_active;
  }
  if (lost != report.ReportedLost) {
    detail |= detail_overflow;
  }
  frame = {detail != 0 ? classes | class_controller : classes,
           {0, static_cast<std::uint8_t>(detail), 0, 0, 0, 0, counters.Transmit, counters.Receive},
           sizeof frame.Data};
  report.Reported = static_cast<std::uint8_t>(state);
  report.ReportedLost = lost;
  return true;
}

/// \endcond
}  // namespace co::report

namespace co::controller {
/// \cond internal

/// accept() and discard() of ports that can disable interrupts; base class of the port. Port has the other members of
/// Driver's parameter, Mailboxes, the class for transmit.hpp, whose constructor has the parameter Can&, and:
///
///     void receive(Can& can);  // moves received frames into the queue
///     void disable_interrupts(Can& can);
///     void enable_receive_interrupts(Can& can);  // those that do not use the mailboxes
///     void enable_interrupts(Can& can);
///
/// The context has Transmit, Frames and FrameNum, too.
template <typename Port, typename Can>
struct MailboxPort {
  // Discards received frames and counters. Called while the interrupts are disabled.
  static void discard_received(Can& can) {
    static_cast<void>(CORingInit(&can.Received, can.Frames, can.FrameNum));
    Port::receive(can);
    static_cast<void>(CORingInit(&can.Received, can.Frames, can.FrameNum));
    report::restart(can.Report);
  }

  static bool accept(Can& can, const CO_IF_FRM& frame) {
    typename Port::Mailboxes mailboxes(can);
    Port::enable_receive_interrupts(can);
    const bool is_accepted = transmit::accept(can.Transmit, mailboxes, frame);
    Port::enable_interrupts(can);
    return is_accepted;
  }

  static void discard(Can& can) {
    Port::disable_interrupts(can);
    typename Port::Mailboxes mailboxes(can);
    transmit::drop(can.Transmit, mailboxes);
    Port::discard_received(can);
    Port::enable_interrupts(can);
  }
};

/// The functions of a driver. Port is a class with these static members:
///
///     using Can = CO_CAN_BXCAN;                             // the context
///     void init(Can& can);                                  // all registers; off the bus, filters pass all frames
///     void leave_bus(Can& can);                             // after the frame on the wire; sets Rate to null
///     void join_bus(Can& can, const CO_CAN_BXCAN_RATE& rate);  // sets Rate; leaves the bus before, and ends bus-off
///     bool is_bus_off(const Can& can);                      // or with Can&, as errors(), to reserve SPI
///     report::State poll(Can& can);                         // work of the loop, called by Read; returns the state
///     CO_CAN_ERROR_COUNTERS errors(const Can& can);
///     bool accept(Can& can, const CO_IF_FRM& frame);        // requests the frame, or refuses it
///     void discard(Can& can);                               // on the bus: discards all frames and counters
///     void filter(Can& can, const std::uint32_t* ids, unsigned num);
template <typename Port>
class Driver {
  using Can = typename Port::Can;

  static Can& controller(void* ctx) { return *static_cast<Can*>(ctx); }

  static auto find_rate(const Can& can, std::uint32_t baud) -> decltype(can.Rates) {
    for (auto rate = can.Rates; rate != can.Rates + can.RateNum; ++rate) {
      if (rate->Baud == baud) {
        return rate;
      }
    }
    return nullptr;
  }

  // Fills an error frame with the changes since the last report. Returns false if there are none.
  static bool report_events(Can& can, CO_IF_FRM& frame) {
    const report::State state = report::observed(can.Report, Port::poll(can));
    return report::take(
        can.Report, state, lost(&can), [&can] { return Port::errors(can); }, frame);
  }

  static void init(void* ctx) { Port::init(controller(ctx)); }

  static void enable(void* ctx, std::uint32_t baud) {
    Can& can = controller(ctx);
    const auto* const rate = find_rate(can, baud);
    can.Report.Reported = static_cast<std::uint8_t>(report::State::active);
    rate == nullptr ? Port::leave_bus(can) : Port::join_bus(can, *rate);
  }

  static std::int16_t read(void* ctx, CO_IF_FRM* frm) {
    Can& can = controller(ctx);
    const bool is_read = can.Rate != nullptr && (report_events(can, *frm) || CORingGet(&can.Received, frm));
    return is_read ? std::int16_t{sizeof(CO_IF_FRM)} : std::int16_t{0};
  }

  static std::int16_t send(void* ctx, const CO_IF_FRM* frm) {
    Can& can = controller(ctx);
    if (can.Rate == nullptr || Port::is_bus_off(can)) {
      return -1;
    }
    return Port::accept(can, *frm) ? std::int16_t{sizeof(CO_IF_FRM)} : std::int16_t{0};
  }

  static void reset(void* ctx) {
    Can& can = controller(ctx);
    if (can.Rate != nullptr) {
      Port::is_bus_off(can) ? Port::join_bus(can, *can.Rate) : Port::discard(can);
    }
  }

  static void close(void* ctx) { Port::leave_bus(controller(ctx)); }

  static void filter(void* ctx, const std::uint32_t* ids, std::uint16_t num) {
    Port::filter(controller(ctx), ids, num);
  }

 public:
  static constexpr CO_IF_CAN_DRV_EX table = {init, enable, read, send, reset, close, filter, CONodeCanReport};

  static bool has_frames(const Can* can) { return can != nullptr && CORingCount(&can->Received) != 0; }

  static std::uint32_t lost(const Can* can) {
    return can == nullptr ? 0 : report::load(can->Report.Overflows) + CORingLost(&can->Received);
  }

  static CO_CAN_ERROR_COUNTERS errors(const Can* can) {
    return can == nullptr ? CO_CAN_ERROR_COUNTERS{} : Port::errors(*can);
  }
};

/// \endcond
}  // namespace co::controller

#endif
