// SPDX-License-Identifier: Apache-2.0
/// \file flexcan_station.hpp
/// Fixture of the tests of the FlexCAN model: a controller with a peer. Values are written as in the manuals; each
/// access is one of a driver.
#pragma once

#include <doctest/doctest.h>

#include "flexcan.hpp"

namespace test {

struct FlexCanStation {
  static constexpr std::uintptr_t base = 0x02090000;
  // MCR
  static constexpr std::uint32_t freeze = 0x50000000;  // FRZ, HALT
  static constexpr std::uint32_t rfen = 1U << 29;
  static constexpr std::uint32_t wrnen = 1U << 21;
  static constexpr std::uint32_t srxdis = 1U << 17;
  static constexpr std::uint32_t irmq = 1U << 16;
  static constexpr std::uint32_t lprioen = 1U << 13;
  static constexpr std::uint32_t aen = 1U << 12;
  // CTRL1: 16 quanta, 1 + 4 + 8, 3
  static constexpr std::uint32_t timing = 0x00BA0003;
  // CODE
  static constexpr std::uint32_t empty = 4;
  static constexpr std::uint32_t full = 2;
  static constexpr std::uint32_t overrun = 6;
  static constexpr std::uint32_t inactive = 8;
  static constexpr std::uint32_t abort = 9;
  static constexpr std::uint32_t ranswer = 10;
  static constexpr std::uint32_t data = 12;

  // Leaves the controller in Freeze mode, with all mailboxes inactive and RXIMR at FFFFFFFFh.
  explicit FlexCanStation(std::uint32_t mcr = srxdis | irmq | aen | 15, std::uint32_t ctrl1 = 0,
                          std::uint32_t ctrl2 = 0, const FlexCan::Options& options = FlexCan::imx6())
      : can(wire, base, options), modes(mcr) {
    out(flexcan::mcr, freeze | 0x0080000F);  // SUPV and MAXMB are protected
    wire.advance(2);
    REQUIRE((in(flexcan::mcr)&0x0B100000) == 0x09000000);  // NOTRDY, FRZACK, not LPMACK
    out(flexcan::ctrl1, timing | (ctrl1 & ~0xC00U));
    out(flexcan::ctrl2, ctrl2);
    for (unsigned i = 0; i < options.mailboxes; ++i) {
      for (unsigned word = 0; word < 4; ++word) {
        out(flexcan::mailbox + 16 * i + 4 * word, 0);
      }
      out(flexcan::rximr + 4 * i, 0xFFFFFFFF);
    }
    out(flexcan::mcr, freeze | modes);
    out(flexcan::ctrl1, timing | ctrl1);
  }
  ~FlexCanStation() { CHECK_MESSAGE(can.faults().empty(), can.fault_text()); }

  static std::uint32_t in(std::uint32_t offset) { return lexican_model_read(base + offset); }
  static void out(std::uint32_t offset, std::uint32_t value) { lexican_model_write(base + offset, value); }
  static std::uint32_t word(unsigned mailbox, unsigned which) {
    return in(flexcan::mailbox + 16 * mailbox + 4 * which);
  }
  static void set_word(unsigned mailbox, unsigned which, std::uint32_t value) {
    out(flexcan::mailbox + 16 * mailbox + 4 * which, value);
  }
  static std::uint32_t code(unsigned mailbox) { return word(mailbox, 0) >> 24 & 15; }
  static std::uint32_t flags() { return in(flexcan::iflag1); }

  // Returns the number of faults since the last call.
  std::size_t faults() {
    const std::size_t number = can.faults().size();
    can.clear_faults();
    return number;
  }

  void start() {
    out(flexcan::mcr, modes);
    wire.advance(14);
    REQUIRE((in(flexcan::mcr)&0x09000000) == 0);
  }
  void stop() {
    out(flexcan::mcr, freeze | modes);
    REQUIRE(wire.advance_until([&] { return (in(flexcan::mcr)&0x01000000) != 0; }, 300));
  }

  static std::uint32_t id_word(const CanFrame& frame) { return frame.is_extended ? frame.id : frame.id << 18; }
  static std::uint32_t control(const CanFrame& frame, std::uint32_t code) {
    const std::uint32_t format = frame.is_extended ? 0x600000U : 0U;
    return code << 24 | format | (frame.is_remote ? 0x100000U : 0U) | std::uint32_t{frame.dlc} << 16;
  }
  static void send(unsigned mailbox, const CanFrame& frame, std::uint32_t priority = 0, std::uint32_t code = data) {
    set_word(mailbox, 1, id_word(frame) | priority << 29);
    for (unsigned i = 0; i < 2; ++i) {
      set_word(mailbox, 2 + i,
               std::uint32_t{frame.data[4 * i]} << 24 | std::uint32_t{frame.data[4 * i + 1]} << 16 |
                   std::uint32_t{frame.data[4 * i + 2]} << 8 | frame.data[4 * i + 3]);
    }
    set_word(mailbox, 0, control(frame, code));
  }
  static void listen(unsigned mailbox, const CanFrame& frame) {
    set_word(mailbox, 1, id_word(frame));
    set_word(mailbox, 0, control(frame, empty));
  }
  void receive(const CanFrame& frame) {
    const std::size_t before = wire.sent();
    peer.send(frame);
    REQUIRE(wire.advance_until([&] { return wire.sent() > before; }, 1000));
    wire.advance(3);
  }
  // Enters bus-off, and returns after the error flag.
  void enter_bus_off() {
    can.node().set_counters(248, 0);
    wire.disturb_frames(1, 25);
    REQUIRE(wire.advance_until([&] { return can.node().is_bus_off(); }, 300));
  }

  CanWire wire;
  FlexCan can;
  CanPeer peer{wire};
  std::uint32_t modes;
};

}  // namespace test
