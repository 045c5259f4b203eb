// SPDX-License-Identifier: Apache-2.0
/// \file sja1000.hpp
/// The port of controller::Driver for SJA1000 and TWAI. Variant is a class with the context, the access to registers
/// and the differences of the controllers: see co_can_sja1000.cpp, co_can_twai.cpp.
#ifndef CO_DRIVERS_SJA1000_HPP_
#define CO_DRIVERS_SJA1000_HPP_

#include <cstdint>

#include "../controller.hpp"
#include "co_can_sja1000.h"
#include "sja1000_filters.hpp"
#include "sja1000_registers.h"

namespace co::sja1000 {
/// \cond internal

// Limits of loops. The frame on the wire has to end before the controller goes off the bus.
inline constexpr unsigned status_reads = 20000;
inline constexpr unsigned mode_reads = 1000;
inline constexpr unsigned fifo_reads = 64;

inline constexpr std::uint32_t warning_limit = 96;
inline constexpr std::uint8_t passive_limit = 127;

// Values of CO_SJA1000_STATE.IsHeld.
inline constexpr std::uint8_t not_held = 0;
inline constexpr std::uint8_t held = 1;             // the interrupt only receives
inline constexpr std::uint8_t held_completely = 2;  // the interrupt has no effect

enum class BusOff : std::uint8_t {
  no,
  lasts,      // the controller is in reset mode
  recovering  // the recovery has begun
};

template <typename Variant>
class Port {
 public:
  using Can = typename Variant::Context;

 private:
  using State = report::State;

  static constexpr std::uint32_t bus_interrupts =
      CO_SJA1000_IR_RI | CO_SJA1000_IR_TI | CO_SJA1000_IR_EI | CO_SJA1000_IR_EPI;

  static std::uint32_t read(const Can& can, std::uint8_t address) { return Variant::read(can, address); }
  static void write(const Can& can, std::uint8_t address, std::uint32_t value) { Variant::write(can, address, value); }

  static std::uint32_t status_of(const Can& can) { return read(can, CO_SJA1000_SR); }
  static BusOff bus_off_of(const Can& can) { return static_cast<BusOff>(can.State.BusOff); }
  static void set_bus_off(Can& can, BusOff state) { can.State.BusOff = static_cast<std::uint8_t>(state); }
  static bool is_in_reset_mode(const Can& can) { return (read(can, CO_SJA1000_MOD) & CO_SJA1000_MOD_RM) != 0; }

  // Writes a command. The read access ensures the distance to the next one.
  static void command(const Can& can, std::uint32_t bits) {
    write(can, CO_SJA1000_CMR, bits);
    static_cast<void>(status_of(can));
  }

  static bool is_receiver(std::uint32_t status) {
    return (status & (CO_SJA1000_SR_RS | CO_SJA1000_SR_TS)) == CO_SJA1000_SR_RS;
  }

  // Transmitting ------------------------------------------------------------------------------------------------------

  // The transmit buffer of a controller, for transmit.hpp.
  class Buffer {
   public:
    explicit Buffer(Can& can) : can_(can) {}

    transmit::Completed take_completed(unsigned used) {
      const std::uint32_t status = status_of(can_);
      if (used == 0 || (status & (CO_SJA1000_SR_TBS | CO_SJA1000_SR_BS)) != CO_SJA1000_SR_TBS) {
        return {};
      }
      const bool is_sent = (status & CO_SJA1000_SR_TCS) != 0 && can_.State.IsAborted == 0;
      return {1, is_sent ? 1U : 0U};
    }

    unsigned free_mailbox(unsigned used, const CO_IF_FRM& /*frame*/) {
      const bool is_free = (status_of(can_) & (CO_SJA1000_SR_TBS | CO_SJA1000_SR_BS)) == CO_SJA1000_SR_TBS;
      return used == 0 && is_free ? 0 : 1;
    }

    void request(unsigned /*n*/, const CO_IF_FRM& frame) {
      can_.State.IsAborted = 0;
      write_frame(can_, frame);
      command(can_, can_.Loopback ? CO_SJA1000_CMR_SRR : CO_SJA1000_CMR_TR);
    }

    // Where an abort sets TCS, too, only a frame is aborted that is not on the wire: another node is transmitting
    // before and after the abort.
    void abort(unsigned /*mailboxes*/) {
      if (!Variant::abort_sets_complete) {
        command(can_, CO_SJA1000_CMR_AT);
      } else if (is_receiver(status_of(can_))) {
        command(can_, CO_SJA1000_CMR_AT);
        const std::uint32_t status = status_of(can_);
        can_.State.IsAborted = (status & CO_SJA1000_SR_TBS) != 0 && is_receiver(status) ? 1 : 0;
      } else {
        can_.Transmit.Aborting = 0;  // request_overtaking() tries again
      }
    }

    bool is_delayed(unsigned /*n*/) { return !can_.Loopback && is_receiver(status_of(can_)); }

   private:
    Can& can_;
  };

  static void write_frame(const Can& can, const CO_IF_FRM& frame) {
    const std::uint32_t id = frame.Identifier & CO_IF_FRM_ID;
    const bool is_extended = transmit::is_extended(frame.Identifier);
    const std::uint32_t word = is_extended ? id << 3 : id << 21;
    const std::uint8_t length = transmit::length_of(frame);
    const std::uint32_t remote = (frame.Identifier & CO_IF_FRM_RTR) != 0 ? CO_SJA1000_FRAME_RTR : 0;
    std::uint8_t address = CO_SJA1000_FRAME;
    write(can, address++, (is_extended ? CO_SJA1000_FRAME_FF : 0) | remote | length);
    const unsigned id_bytes = is_extended ? 4 : 2;
    for (unsigned n = 0; n < id_bytes; ++n) {
      write(can, address++, (word >> (24 - 8 * n)) & 0xFF);
    }
    for (unsigned n = 0; n < length && remote == 0; ++n) {
      write(can, address++, frame.Data[n]);
    }
  }

  // Requests the frames that wait.
  static void request_waiting(Can& can) {
    CO_SJA1000_TRANSMIT& box = can.Transmit;
    if ((box.Used | box.DisplacedNum) != 0 && bus_off_of(can) == BusOff::no) {
      Buffer buffer(can);
      transmit::finish(box, buffer);
    }
  }

  // Exchanges the frame in the buffer for a displaced one of higher priority, if it was not aborted for that one.
  static void request_overtaking(Can& can) {
    CO_SJA1000_TRANSMIT& box = can.Transmit;
    if (Variant::abort_sets_complete && box.Aborting == 0 && transmit::is_overtaken(box)) {
      Buffer(can).abort(1);
      request_waiting(can);
    }
  }

  // Calls a function of the loop that uses the transmit buffer or changes the mode. The interrupt does neither
  // meanwhile; what it has missed is done afterwards.
  template <typename Function>
  static void run_exclusively(Can& can, Function function) {
    report::store(can.State.IsHeld, held);
    function();
    report::store(can.State.IsHeld, not_held);
    while (report::load(can.State.IsMissed) != 0) {
      report::store(can.State.IsHeld, held);
      report::store(can.State.IsMissed, std::uint8_t{0});
      update_controller(can);
      report::store(can.State.IsHeld, not_held);
    }
  }

  // Receiving ---------------------------------------------------------------------------------------------------------

  static CO_IF_FRM read_frame(const Can& can) {
    CO_IF_FRM frame{};
    std::uint8_t address = CO_SJA1000_FRAME;
    const std::uint32_t information = read(can, address++);
    const bool is_extended = (information & CO_SJA1000_FRAME_FF) != 0;
    const bool is_remote = (information & CO_SJA1000_FRAME_RTR) != 0;
    std::uint32_t word = 0;
    const unsigned id_bytes = is_extended ? 4 : 2;
    for (unsigned n = 0; n < id_bytes; ++n) {
      word |= (read(can, address++) & 0xFF) << (24 - 8 * n);
    }
    frame.Identifier = (is_extended ? (word >> 3) | CO_IF_FRM_EXT : word >> 21) | (is_remote ? CO_IF_FRM_RTR : 0);
    frame.DLC = transmit::length_of(information & CO_SJA1000_FRAME_DLC);
    for (unsigned n = 0; n < frame.DLC && !is_remote; ++n) {
      frame.Data[n] = static_cast<std::uint8_t>(read(can, address++));
    }
    return frame;
  }

  // Reads the frame in the receive buffer and releases it. In reset mode, which the controller enters at bus-off, the
  // addresses of the receive buffer are those of the filters: returns false, because no frame was read then.
  static bool take_frame(const Can& can, CO_IF_FRM& frame) {
    frame = read_frame(can);
    if (is_in_reset_mode(can)) {
      return false;
    }
    command(can, CO_SJA1000_CMR_RRB);
    return true;
  }

  // Moves all frames of the FIFO into the queue. Frames that are lost meanwhile count as one overrun.
  static void receive(Can& can) {
    bool is_counted = false;
    const auto count_once = [&can, &is_counted] {
      if (!is_counted) {
        report::count_overflow(can.Report);
      }
      is_counted = true;
    };
    CO_IF_FRM frame{};
    std::uint32_t status = status_of(can);
    for (unsigned n = 0; n < fifo_reads; ++n, status = status_of(can)) {
      const bool is_incomplete = Variant::is_incomplete(can, status);
      if (is_incomplete || (status & CO_SJA1000_SR_DOS) != 0) {
        count_once();
        command(can, CO_SJA1000_CMR_CDO);
      }
      if ((status & CO_SJA1000_SR_RBS) == 0) {
        return;
      }
      if (Variant::is_fifo_broken(can)) {
        count_once();
        can.State.NeedsRestart = 1;
        return;
      }
      if (!take_frame(can, frame)) {
        return;
      }
      if (!is_incomplete) {
        static_cast<void>(CORingPut(&can.Received, &frame));
      }
    }
  }

  // Empties the queue and forgets what was reported. Called while the interrupts of the controller are disabled.
  static void empty_queue(Can& can) {
    static_cast<void>(CORingInit(&can.Received, can.Frames, can.FrameNum));
    report::restart(can.Report);
  }

  // Filters -----------------------------------------------------------------------------------------------------------

  static Filters filters(const Can& can) {
    const CO_SJA1000_STATE& state = can.State;
    return {{{state.FilterWord[0], state.FilterMask[0]}, {state.FilterWord[1], state.FilterMask[1]}}};
  }

  static void store_filters(Can& can, const Filters& filters) {
    for (unsigned n = 0; n < 2; ++n) {
      can.State.FilterWord[n] = filters.filter[n].word;
      can.State.FilterMask[n] = filters.filter[n].mask;
    }
  }

  // Writes the filters. The controller is in reset mode.
  static void write_filters(const Can& can) {
    for (unsigned n = 0; n < 2; ++n) {
      const unsigned code = unsigned{can.State.FilterWord[n]} << CO_SJA1000_FILTER_ID_SHIFT;
      const unsigned compared = unsigned{can.State.FilterMask[n]} << CO_SJA1000_FILTER_ID_SHIFT;
      const auto first = static_cast<std::uint8_t>(2 * n);
      write(can, CO_SJA1000_ACR + first, code >> 8);
      write(can, CO_SJA1000_ACR + first + 1, code & 0xFF);
      write(can, CO_SJA1000_AMR + first, ~compared >> 8 & 0xFF);
      write(can, CO_SJA1000_AMR + first + 1, (~compared & 0xFF) | CO_SJA1000_FILTER_OTHERS);
    }
  }

  // Replaces the filters on the bus, while it is idle.
  static void change_filters(Can& can) {
    run_exclusively(can, [&can] {
      if (bus_off_of(can) == BusOff::lasts) {
        return;  // they are written when the recovery begins
      }
      disable_interrupts(can);
      if (bus_off_of(can) == BusOff::no) {
        static_cast<void>(await_bits(can, CO_SJA1000_SR, CO_SJA1000_SR_RS | CO_SJA1000_SR_TS, 0, status_reads));
      }
      receive(can);
      enter_reset_mode(can);
      transmit::take_back(can.Transmit);
      write_filters(can);
      enable_interrupts(can);
      leave_reset_mode(can);
      update_controller(can);
    });
  }

  // Modes -------------------------------------------------------------------------------------------------------------

  // Waits until bits of a register have a value. Returns false if they do not get it.
  static bool await_bits(const Can& can, std::uint8_t address, std::uint32_t bits, std::uint32_t value,
                         unsigned reads) {
    while (reads != 0 && (read(can, address) & bits) != value) {
      --reads;
    }
    return reads != 0;
  }

  // Disables and clears the interrupts; the read access ensures that the write has reached the controller. An interrupt
  // of another device that shares the line has no effect then. Called in run_exclusively(), before update_controller().
  static void disable_interrupts(Can& can) {
    write(can, CO_SJA1000_IER, 0);
    static_cast<void>(read(can, CO_SJA1000_IR));
    report::store(can.State.IsHeld, held_completely);
  }

  static void enable_interrupts(Can& can) {
    report::store(can.State.IsHeld, held);
    write_interrupt_enable(can);
  }

  static void write_interrupt_enable(const Can& can) {
    write(can, CO_SJA1000_IER, bus_interrupts | Variant::interrupts(can));
  }

  // In reset mode and during the recovery from bus-off, listen-only mode freezes the receive error counter of ESP32.
  // [Errata, 3.13.1]
  static void enter_reset_mode(const Can& can) {
    write(can, CO_SJA1000_MOD, CO_SJA1000_MOD_RM);
    static_cast<void>(await_bits(can, CO_SJA1000_MOD, CO_SJA1000_MOD_RM, CO_SJA1000_MOD_RM, mode_reads));
    if (Variant::has_errata(can)) {
      write(can, CO_SJA1000_MOD, CO_SJA1000_MOD_RM | CO_SJA1000_MOD_LOM);
    }
  }

  static void leave_reset_mode(const Can& can) {
    const bool freezes = Variant::has_errata(can) && bus_off_of(can) == BusOff::recovering;
    const std::uint32_t mode = (freezes ? CO_SJA1000_MOD_LOM : 0) | (can.Loopback ? CO_SJA1000_MOD_STM : 0);
    write(can, CO_SJA1000_MOD, CO_SJA1000_MOD_RM | mode);
    write(can, CO_SJA1000_MOD, mode);
    static_cast<void>(await_bits(can, CO_SJA1000_MOD, CO_SJA1000_MOD_RM, 0, mode_reads));
  }

  // Writes all registers that determine the function of the controller, which is in reset mode.
  static void write_configuration(const Can& can, const CO_CAN_SJA1000_RATE& rate) {
    Variant::write_configuration(can);
    write(can, CO_SJA1000_BTR0, rate.Timing & 0xFFFF);
    write(can, CO_SJA1000_BTR1, rate.Timing >> 16 & 0xFF);
    write(can, CO_SJA1000_EWLR, warning_limit);
    write_filters(can);
  }

  // Bus-off -----------------------------------------------------------------------------------------------------------

  // The filters are written again: a frame that was being written when the controller entered reset mode has changed
  // them.
  static void begin_recovery(Can& can) {
    set_bus_off(can, BusOff::recovering);
    write_filters(can);
    Variant::clear_receive_errors(can);
    leave_reset_mode(can);
  }

  // A frame that ESP32 sends after the recovery may be faulty, unless reset mode was entered. [Errata, 3.13.3]
  static void end_recovery(Can& can) {
    set_bus_off(can, BusOff::no);
    if (Variant::has_errata(can)) {
      enter_reset_mode(can);
      leave_reset_mode(can);
    }
  }

  static void update_bus_off(Can& can) {
    const BusOff before = bus_off_of(can);
    if (!is_bus_off(can)) {
      if (before != BusOff::no) {
        end_recovery(can);
      }
      return;
    }
    if (before == BusOff::no) {
      set_bus_off(can, BusOff::lasts);
      report::count_bus_off(can.Report);
      transmit::take_back(can.Transmit);
      if (can.Recovery == CO_CAN_RECOVERY_AUTOMATIC) {
        begin_recovery(can);
      }
    } else if (before == BusOff::recovering && is_in_reset_mode(can)) {
      leave_reset_mode(can);  // Variant::clear_receive_errors() has caused bus-off again
    }
  }

  // Errata of ESP32 ---------------------------------------------------------------------------------------------------

  // Resets the controller on the bus. The error counters remain, and the frame in the transmit buffer is sent again.
  static void restart_controller(Can& can) {
    can.State.NeedsRestart = 0;
    if (is_bus_off(can)) {
      return;
    }
    const std::uint32_t receive_errors = read(can, CO_SJA1000_RXERR);
    const std::uint32_t transmit_errors = read(can, CO_SJA1000_TXERR);
    enter_reset_mode(can);
    transmit::take_back(can.Transmit);
    Variant::reset_peripheral(can);
    enter_reset_mode(can);
    Variant::select_pelican(can);
    write_configuration(can, *can.Rate);
    write(can, CO_SJA1000_RXERR, receive_errors);
    write(can, CO_SJA1000_TXERR, transmit_errors);
    static_cast<void>(read(can, CO_SJA1000_IR));
    write_interrupt_enable(can);
    leave_reset_mode(can);
  }

  // Does what the loop and the interrupt must not do at the same time.
  static void update_controller(Can& can) {
    update_bus_off(can);
    if (can.State.NeedsRestart != 0) {
      restart_controller(can);
    }
    request_waiting(can);
  }

 public:
  // Members for controller::Driver ------------------------------------------------------------------------------------

  static bool is_bus_off(const Can& can) { return (status_of(can) & CO_SJA1000_SR_BS) != 0; }

  static CO_CAN_ERROR_COUNTERS errors(const Can& can) {
    return {static_cast<std::uint8_t>(read(can, CO_SJA1000_TXERR)),
            static_cast<std::uint8_t>(read(can, CO_SJA1000_RXERR))};
  }

  // Reads the error counters only if one of them has reached the warning limit.
  static State poll(Can& can) {
    if (can.Transmit.DisplacedNum != 0) {
      run_exclusively(can, [&can] { request_overtaking(can); });
    }
    const std::uint32_t status = status_of(can);
    if (((status & CO_SJA1000_SR_BS) != 0) != (bus_off_of(can) != BusOff::no)) {
      run_exclusively(can,
                      [&can] { update_controller(can); });  // the change occurred while the interrupts were disabled
    }
    if ((status & (CO_SJA1000_SR_ES | CO_SJA1000_SR_BS)) == 0) {
      return State::active;
    }
    if ((status & CO_SJA1000_SR_BS) != 0) {
      return State::bus_off;
    }
    const CO_CAN_ERROR_COUNTERS now = errors(can);
    return now.Transmit > passive_limit || now.Receive > passive_limit ? State::passive : State::active;
  }

  static bool accept(Can& can, const CO_IF_FRM& frame) {
    bool is_accepted = false;
    run_exclusively(can, [&can, &is_accepted, &frame] {
      Buffer buffer(can);
      is_accepted = bus_off_of(can) == BusOff::no && transmit::accept(can.Transmit, buffer, frame);
    });
    return is_accepted;
  }

  static void discard(Can& can) {
    run_exclusively(can, [&can] {
      disable_interrupts(can);
      command(can, CO_SJA1000_CMR_AT);
      can.Transmit.Dropped = can.Transmit.Used;
      can.Transmit.DisplacedNum = 0;
      receive(can);
      empty_queue(can);
      enable_interrupts(can);
      update_controller(can);
    });
  }

  // PeliCAN mode is selected before any register that has another address
  // in the mode of a hardware reset.
  static void leave_bus(Can& can) {
    run_exclusively(can, [&can] {
      if (!is_in_reset_mode(can)) {
        command(can, CO_SJA1000_CMR_AT);
        static_cast<void>(await_bits(can, CO_SJA1000_SR, CO_SJA1000_SR_TBS, CO_SJA1000_SR_TBS, status_reads));
      }
      enter_reset_mode(can);
      Variant::select_pelican(can);
      disable_interrupts(can);
      can.Rate = nullptr;
      transmit::forget(can.Transmit);
      can.State.NeedsRestart = 0;
      report::store(can.State.IsMissed, std::uint8_t{0});
    });
  }

  // In bus-off the controller goes on the bus after the recovery.
  static void join_bus(Can& can, const CO_CAN_SJA1000_RATE& rate) {
    leave_bus(can);
    empty_queue(can);
    write_configuration(can, rate);
    static_cast<void>(read(can, CO_SJA1000_IR));
    const bool recovers = is_bus_off(can);
    set_bus_off(can, recovers ? BusOff::recovering : BusOff::no);
    run_exclusively(can, [&can, &rate, recovers] {
      can.Rate = &rate;
      write_interrupt_enable(can);
      recovers ? begin_recovery(can) : leave_reset_mode(can);
    });
  }

  static void init(Can& can) {
    leave_bus(can);
    empty_queue(can);
    store_filters(can, {});
  }

  static void filter(Can& can, const std::uint32_t* ids, unsigned num) {
    const Filters present = filters(can);
    if (can.Rate != nullptr && !is_open(present) && all_pass(present, ids, num)) {
      return;
    }
    store_filters(can, filters_of(ids, num));
    if (can.Rate != nullptr) {
      change_filters(can);
    }
  }

  static void interrupt(Can& can) {
    if (can.Rate == nullptr || report::load(can.State.IsHeld) == held_completely) {
      return;
    }
    for (unsigned n = 0; n < Variant::interrupt_reads; ++n) {
      const std::uint32_t flags = read(can, CO_SJA1000_IR);
      if (flags == 0 && n != 0) {
        return;
      }
      receive(can);
      if (Variant::spoils_next_frame(can, flags)) {
        can.State.NeedsRestart = 1;
      }
      if (report::load(can.State.IsHeld) != not_held) {
        report::store(can.State.IsMissed, std::uint8_t{1});
      } else {
        update_controller(can);
      }
    }
  }
};

/// \endcond
}  // namespace co::sja1000

#endif
