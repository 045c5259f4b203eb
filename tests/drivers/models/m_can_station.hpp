// SPDX-License-Identifier: Apache-2.0
/// \file m_can_station.hpp
/// Fixture of the tests of the M_CAN model: a controller of either layout with a peer. Values are written as in the
/// manuals; each access is one of a driver.
#pragma once

#include <doctest/doctest.h>

#include "m_can.hpp"

namespace test {

using R = MCanRegister;
using Flag = MCanFlag;

struct MCanStation {
  static constexpr std::uint32_t init = 1;
  static constexpr std::uint32_t cce = 2;

  explicit MCanStation(MCanLayout which, std::uint32_t cccr_modes = 0, std::uint32_t txbc_mode = 0)
      : layout(which), ram(ram_address(which), ram_words(which)), can(wire, can_address(which), ram, options(which)) {
    out(R::cccr, init);
    wire.advance(1);
    out(R::cccr, init | cce);
    configure(txbc_mode);
    modes = cccr_modes;
    out(R::cccr, init | cce | modes);
  }
  ~MCanStation() {
    CHECK_MESSAGE(can.faults().empty(), can.fault_text());
    CHECK_MESSAGE(ram.faults().empty(), ram.fault_text());
  }

  static std::uintptr_t can_address(MCanLayout layout) { return layout == MCanLayout::fixed ? 0x40006400 : 0x4000A000; }
  static std::uintptr_t ram_address(MCanLayout layout) { return layout == MCanLayout::fixed ? 0x4000A400 : 0x4000AC00; }
  static unsigned ram_words(MCanLayout layout) {
    return layout == MCanLayout::fixed ? MCan::fixed_words : MCan::configurable_words;
  }
  static MCan::Options options(MCanLayout layout) {
    MCan::Options options;
    options.layout = layout;
    return options;
  }

  bool is_fixed() const { return layout == MCanLayout::fixed; }
  std::uint32_t in(R which) { return lexican_model_read(can.address() + MCan::offset_of(layout, which)); }
  void out(R which, std::uint32_t value) { lexican_model_write(can.address() + MCan::offset_of(layout, which), value); }
  std::uint32_t word(unsigned index) { return lexican_model_read(ram.address() + 4 * index); }
  void set_word(unsigned index, std::uint32_t value) { lexican_model_write(ram.address() + 4 * index, value); }

  // Sections: words of the RAM. Configurable: 28 and 8 filters, FIFOs of 3 elements, 4 Rx buffers, 3 events, 2
  // dedicated Tx buffers and 3 in the Tx FIFO; elements have 8 data bytes.
  unsigned extended_filter(unsigned index) const { return 28 + 2 * index; }
  unsigned fifo_element(unsigned fifo, unsigned index) const {
    return is_fixed() ? 44 + 54 * fifo + 18 * index : 44 + 12 * fifo + 4 * index;
  }
  unsigned rx_buffer(unsigned index) const { return 68 + 4 * index; }
  unsigned event(unsigned index) const { return (is_fixed() ? 152 : 84) + 2 * index; }
  unsigned tx_buffer(unsigned index) const { return is_fixed() ? 158 + 18 * index : 90 + 4 * index; }
  unsigned first_fifo_buffer() const { return is_fixed() ? 0 : 2; }

  void configure(std::uint32_t txbc_mode) {
    if (is_fixed()) {
      out(R::gfc, 0);
      out(R::txbc, txbc_mode);
      return;
    }
    out(R::sidfc, 0);
    out(R::xidfc, 28 * 4);
    out(R::rxf0c, 44 * 4 | 3U << 16);
    out(R::rxf1c, 56 * 4 | 3U << 16);
    out(R::rxbc, 68 * 4);
    out(R::txefc, 84 * 4 | 3U << 16);
    out(R::txbc, 90 * 4 | 2U << 16 | 3U << 24 | (txbc_mode != 0 ? 1U << 30 : 0));
  }

  // Sets the number of filter elements; global is the value of GFC.
  void filters(unsigned standard, unsigned extended, std::uint32_t global = 0) {
    if (is_fixed()) {
      out(R::gfc, global | standard << 16 | extended << 24);
    } else {
      out(R::gfc, global);
      out(R::sidfc, standard << 16);
      out(R::xidfc, 28 * 4 | extended << 16);
    }
  }

  void start() {
    out(R::cccr, modes);
    wire.advance(13);
    REQUIRE((in(R::cccr)&init) == 0);
  }

  std::uint32_t flag(Flag which) const { return MCan::bit_of(layout, which); }
  bool has(Flag which) { return (in(R::ir)&flag(which)) != 0; }

  void prepare(unsigned buffer, const CanFrame& frame, std::uint32_t control = 0) {
    const unsigned at = tx_buffer(buffer);
    set_word(at, (frame.is_extended ? frame.id | 1U << 30 : frame.id << 18) | (frame.is_remote ? 1U << 29 : 0));
    set_word(at + 1, control | std::uint32_t{frame.dlc} << 16);
    for (unsigned i = 0; i < 2; ++i) {
      set_word(at + 2 + i, frame.data[4 * i] | std::uint32_t{frame.data[4 * i + 1]} << 8 |
                               std::uint32_t{frame.data[4 * i + 2]} << 16 | std::uint32_t{frame.data[4 * i + 3]} << 24);
    }
  }
  void request(unsigned buffer, const CanFrame& frame, std::uint32_t control = 0) {
    prepare(buffer, frame, control);
    out(R::txbar, 1U << buffer);
  }

  void receive(const CanFrame& frame) {
    const std::size_t before = wire.sent();
    peer.send(frame);
    wire.advance_until([&] { return wire.sent() > before; }, 1000);
    wire.advance(3);
  }
  unsigned filling(unsigned fifo) { return in(fifo == 0 ? R::rxf0s : R::rxf1s) & 0x7F; }

  MCanLayout layout;
  CanWire wire;
  MessageRam ram;
  MCan can;
  CanPeer peer{wire, FdMode::enabled};
  std::uint32_t modes = 0;
};

}  // namespace test
