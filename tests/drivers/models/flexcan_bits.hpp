// SPDX-License-Identifier: Apache-2.0
/// \file flexcan_bits.hpp
/// Bits of the registers of FlexCAN and codes of its mailboxes, for the sources of the model.
#pragma once

#include <cstdint>

namespace test {
namespace flexcan {

// MCR
constexpr std::uint32_t mdis = 1U << 31;
constexpr std::uint32_t frz = 1U << 30;
constexpr std::uint32_t rfen = 1U << 29;
constexpr std::uint32_t halt = 1U << 28;
constexpr std::uint32_t notrdy = 1U << 27;
constexpr std::uint32_t softrst = 1U << 25;
constexpr std::uint32_t frzack = 1U << 24;
constexpr std::uint32_t supv = 1U << 23;
constexpr std::uint32_t wrnen = 1U << 21;
constexpr std::uint32_t lpmack = 1U << 20;
constexpr std::uint32_t srxdis = 1U << 17;
constexpr std::uint32_t irmq = 1U << 16;
constexpr std::uint32_t lprioen = 1U << 13;
constexpr std::uint32_t aen = 1U << 12;
constexpr std::uint32_t idam = 3U << 8;
constexpr std::uint32_t maxmb = 0x7F;
constexpr std::uint32_t mcr_status = notrdy | frzack | lpmack;
constexpr std::uint32_t mcr_freeze_only = rfen | supv | wrnen | srxdis | irmq | lprioen | aen | idam | maxmb;
constexpr std::uint32_t mcr_bits = mcr_freeze_only | mdis | frz | halt | softrst | mcr_status;
constexpr std::uint32_t mcr_reserved = 1U << 10 | 1U << 7;

// CTRL1
constexpr std::uint32_t boffmsk = 1U << 15;
constexpr std::uint32_t errmsk = 1U << 14;
constexpr std::uint32_t clksrc = 1U << 13;
constexpr std::uint32_t lpb = 1U << 12;
constexpr std::uint32_t twrnmsk = 1U << 11;
constexpr std::uint32_t rwrnmsk = 1U << 10;
constexpr std::uint32_t smp = 1U << 7;
constexpr std::uint32_t boffrec = 1U << 6;
constexpr std::uint32_t tsyn = 1U << 5;
constexpr std::uint32_t lbuf = 1U << 4;
constexpr std::uint32_t lom = 1U << 3;
constexpr std::uint32_t ctrl1_freeze_only = 0xFFFF0000 | lpb | smp | tsyn | lbuf | lom | 7;
constexpr std::uint32_t ctrl1_bits = ctrl1_freeze_only | boffmsk | errmsk | twrnmsk | rwrnmsk | boffrec;

// CTRL2
constexpr std::uint32_t boffdonemsk = 1U << 30;
constexpr std::uint32_t ecrwre = 1U << 29;
constexpr std::uint32_t wrmfrz = 1U << 28;
constexpr std::uint32_t mrp = 1U << 18;
constexpr std::uint32_t rrs = 1U << 17;
constexpr std::uint32_t eacen = 1U << 16;
constexpr std::uint32_t prexcen = 1U << 14;
constexpr std::uint32_t edfltdis = 1U << 11;
constexpr std::uint32_t ctrl2_freeze_only = 0x1FFF0000;
constexpr std::uint32_t ctrl2_freeze_only_3 = prexcen | edfltdis;

// ESR1
constexpr std::uint32_t errovr = 1U << 21;
constexpr std::uint32_t boffdoneint = 1U << 19;
constexpr std::uint32_t synch = 1U << 18;
constexpr std::uint32_t twrnint = 1U << 17;
constexpr std::uint32_t rwrnint = 1U << 16;
constexpr std::uint32_t txwrn = 1U << 9;
constexpr std::uint32_t rxwrn = 1U << 8;
constexpr std::uint32_t idle = 1U << 7;
constexpr std::uint32_t tx = 1U << 6;
constexpr std::uint32_t fltconf_passive = 1U << 4;
constexpr std::uint32_t fltconf_bus_off = 2U << 4;
constexpr std::uint32_t rx = 1U << 3;
constexpr std::uint32_t boffint = 1U << 2;
constexpr std::uint32_t errint = 1U << 1;

// IFLAG1 with the Rx FIFO
constexpr std::uint32_t fifo_clear = 1U << 0;
constexpr std::uint32_t fifo_available = 1U << 5;
constexpr std::uint32_t fifo_warning = 1U << 6;
constexpr std::uint32_t fifo_overflow = 1U << 7;

// CBT
constexpr std::uint32_t btf = 1U << 31;

// MECR
constexpr std::uint32_t ecrwrdis = 1U << 31;
constexpr std::uint32_t eccdis = 1U << 8;

// Message buffers: C/S word
constexpr std::uint32_t srr = 1U << 22;
constexpr std::uint32_t ide = 1U << 21;
constexpr std::uint32_t rtr = 1U << 20;

// Message buffers: CODE
constexpr std::uint32_t rx_inactive = 0;
constexpr std::uint32_t rx_full = 2;
constexpr std::uint32_t rx_empty = 4;
constexpr std::uint32_t rx_overrun = 6;
constexpr std::uint32_t tx_inactive = 8;
constexpr std::uint32_t tx_abort = 9;
constexpr std::uint32_t rx_answer = 10;
constexpr std::uint32_t tx_data = 12;
constexpr std::uint32_t tx_answer = 14;

constexpr bool is_tx_active(std::uint32_t code) { return code == tx_data || code == tx_answer; }
constexpr bool is_rx_full(std::uint32_t code) { return code == rx_full || code == rx_overrun; }
constexpr bool is_rx_active(std::uint32_t code) { return code == rx_empty || is_rx_full(code); }
constexpr bool is_active(std::uint32_t code) { return is_tx_active(code) || is_rx_active(code) || code == rx_answer; }

}  // namespace flexcan
}  // namespace test
