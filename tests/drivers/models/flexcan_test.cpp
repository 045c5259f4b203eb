// SPDX-License-Identifier: Apache-2.0
// Modes, registers and error states of the FlexCAN model. Section names are those of the chapter "FlexCAN" of K20 and
// KE1xF reference manuals.
#include <doctest/doctest.h>

#include "flexcan_station.hpp"

using namespace test;
using Station = FlexCanStation;
using Kind = CanDisturbance::Kind;

namespace {

constexpr std::uint32_t notrdy = 1U << 27;
constexpr std::uint32_t frzack = 1U << 24;
constexpr std::uint32_t lpmack = 1U << 20;
constexpr std::uint32_t mdis = 1U << 31;
constexpr std::uint32_t softrst = 1U << 25;
constexpr std::uint32_t status = notrdy | frzack | lpmack;

std::uint32_t in(std::uint32_t offset) { return Station::in(offset); }
void out(std::uint32_t offset, std::uint32_t value) { Station::out(offset, value); }

}  // namespace

TEST_CASE("flexcan: reset values") {
  CanWire wire;
  {
    FlexCan can(wire, Station::base, FlexCan::imx6());
    CHECK(in(flexcan::mcr) == 0x5980000F);
    CHECK(in(flexcan::ctrl1) == 0);
    CHECK(in(flexcan::ecr) == 0);
    CHECK(in(flexcan::esr1) == 0);
    CHECK(in(flexcan::imask1) == 0);
    CHECK(in(flexcan::iflag2) == 0);
    CHECK(in(flexcan::rxmgmask) == 0xFFFFFFFF);
    CHECK(in(flexcan::rxfgmask) == 0xFFFFFFFF);
    CHECK(can.faults().empty());
  }
  FlexCan can(wire, Station::base, FlexCan::kinetis());
  CHECK(in(flexcan::mcr) == 0xD890000F);
  CHECK(can.faults().empty());
}

TEST_CASE("flexcan: Disable mode is left to Freeze mode, and entered from each mode [Module Disable mode]") {
  CanWire wire;
  FlexCan can(wire, Station::base, FlexCan::kinetis());
  out(flexcan::mcr, 0x5080000F);
  CHECK((in(flexcan::mcr)&status) == (notrdy | lpmack));
  wire.advance(1);
  CHECK((in(flexcan::mcr)&status) == (notrdy | frzack));
  out(flexcan::mcr, mdis | 0x5080000F);
  wire.advance(1);
  CHECK((in(flexcan::mcr)&status) == (notrdy | lpmack));
  CHECK(can.faults().empty());
}

TEST_CASE("flexcan: memory and masks are not accessed in Disable mode [Module Disable mode]") {
  CanWire wire;
  FlexCan can(wire, Station::base, FlexCan::kinetis());
  for (const std::uint32_t offset :
       {flexcan::rxmgmask, flexcan::rx15mask, flexcan::rxfgmask, flexcan::mailbox, flexcan::rximr, flexcan::rxfir}) {
    CAPTURE(offset);
    in(offset);
    CHECK(can.faults().size() == 1);
    can.clear_faults();
  }
  in(flexcan::ctrl1);
  in(flexcan::iflag1);
  CHECK(can.faults().empty());
}

TEST_CASE("flexcan: CLKSRC changes in Disable mode only [register CTRL1]") {
  CanWire wire;
  FlexCan can(wire, Station::base, FlexCan::kinetis());
  out(flexcan::ctrl1, 1U << 13);
  CHECK(in(flexcan::ctrl1) == 1U << 13);
  out(flexcan::mcr, 0x5080000F);
  wire.advance(1);
  out(flexcan::ctrl1, 0);
  CHECK(in(flexcan::ctrl1) == 1U << 13);
  CHECK(can.faults().size() == 1);
}

TEST_CASE("flexcan: leaving Freeze mode needs 11 recessive bits [Freeze mode]") {
  Station station;
  station.wire.hold(dominant);
  out(flexcan::mcr, station.modes);
  station.wire.advance(100);
  CHECK((in(flexcan::esr1)&1U << 18) == 0);  // SYNCH
  station.wire.release();
  station.wire.advance(10);
  CHECK((in(flexcan::esr1)&1U << 18) == 0);
  station.wire.advance(1);
  CHECK((in(flexcan::esr1) & (1U << 18 | 0x80)) == (1U << 18 | 0x80));  // SYNCH, IDLE
}

TEST_CASE("flexcan: FRZ and HALT are needed for Freeze mode [Freeze mode]") {
  Station station;
  station.start();
  out(flexcan::mcr, 1U << 28 | station.modes);
  station.wire.advance(20);
  CHECK((in(flexcan::mcr)&status) == 0);
  out(flexcan::mcr, 1U << 30 | station.modes);
  station.wire.advance(20);
  CHECK((in(flexcan::mcr)&status) == 0);
  station.stop();
}

TEST_CASE("flexcan: Freeze mode waits until the frame on the bus is complete [Freeze mode]") {
  Station station;
  station.listen(8, standard_frame(0x123));
  station.start();
  station.peer.send(standard_frame(0x123, {1, 2, 3}));
  station.wire.advance(20);
  CHECK((in(flexcan::esr1)&0xC8) == 0x08);  // RX
  out(flexcan::mcr, Station::freeze | station.modes);
  station.wire.advance(20);
  CHECK((in(flexcan::mcr)&status) == 0);
  station.wire.advance(100);
  CHECK((in(flexcan::mcr)&status) == (notrdy | frzack));
  CHECK(station.flags() == 0x100);
}

TEST_CASE("flexcan: a pending mailbox is kept in Freeze mode") {
  Station station;
  station.start();
  station.stop();
  station.send(8, standard_frame(1));
  station.wire.advance(100);
  CHECK(station.wire.sent() == 0);
  out(flexcan::mcr, station.modes);
  REQUIRE(station.wire.advance_until([] { return (in(flexcan::esr1)&0x80) != 0; }, 30));  // IDLE
  out(flexcan::mcr, Station::freeze | station.modes);                                     // before the start of frame
  station.wire.advance(100);
  CHECK(station.wire.sent() == 0);
  station.start();
  station.wire.advance(100);
  CHECK(station.wire.sent() == 1);
}

TEST_CASE("flexcan: no write before Freeze mode is acknowledged [Freeze mode]") {
  Station station;
  station.start();
  out(flexcan::mcr, Station::freeze | station.modes);
  out(flexcan::ctrl1, Station::timing);
  CHECK(station.faults() == 1);
  station.wire.advance(2);
  out(flexcan::ctrl1, Station::timing);
  CHECK(station.faults() == 0);
}

TEST_CASE("flexcan: protected fields change in Freeze mode only [MCR, CTRL1, CTRL2]") {
  Station station;
  station.start();
  for (const std::uint32_t field :
       {1U << 29, 1U << 23, 1U << 21, 1U << 17, 1U << 16, 1U << 13, 1U << 12, 1U << 8, 1U}) {
    CAPTURE(field);
    out(flexcan::mcr, station.modes ^ field);
    CHECK(station.faults() == 1);
    CHECK((in(flexcan::mcr)&0x20A1337F) == (station.modes & 0x20A1337F));
  }
  for (const std::uint32_t field :
       {1U << 24, 1U << 22, 1U << 19, 1U << 16, 1U << 12, 1U << 7, 1U << 5, 1U << 4, 1U << 3, 1U}) {
    CAPTURE(field);
    out(flexcan::ctrl1, Station::timing ^ field);
    CHECK(station.faults() == 1);
    CHECK(in(flexcan::ctrl1) == Station::timing);
  }
  for (const std::uint32_t field : {1U << 24, 1U << 19, 1U << 18, 1U << 17, 1U << 16}) {
    CAPTURE(field);
    out(flexcan::ctrl2, field);
    CHECK(station.faults() == 1);
    CHECK(in(flexcan::ctrl2) == 0);
  }
  for (const std::uint32_t offset : {flexcan::rxmgmask, flexcan::rx14mask, flexcan::rx15mask, flexcan::rxfgmask,
                                     flexcan::rximr, flexcan::ecr, flexcan::gfwr}) {
    CAPTURE(offset);
    out(offset, 0);
    CHECK(station.faults() == 1);
  }
  out(flexcan::ctrl1, Station::timing | 0xC040);  // BOFFMSK, ERRMSK, BOFFREC
  CHECK(in(flexcan::ctrl1) == (Station::timing | 0xC040));
}

TEST_CASE("flexcan: reserved offsets and bits, and functions that are not modelled, are faults") {
  Station station;
  for (const std::uint32_t offset : {0x00CU, 0x03CU, flexcan::cbt, 0x058U, 0x480U, 0x980U, flexcan::mecr, 0xC00U}) {
    CAPTURE(offset);
    in(offset);
    out(offset, 0);
    CHECK(station.faults() == 2);
  }
  for (const std::uint32_t bit : {1U << 26, 1U << 22, 1U << 18, 1U << 15, 1U << 11, 1U << 7}) {
    CAPTURE(bit);
    out(flexcan::mcr, Station::freeze | station.modes | bit);
    CHECK(station.faults() == 1);
  }
  out(flexcan::ctrl1, Station::timing | 1U << 8);
  out(flexcan::ctrl2, 1);
  in(flexcan::esr2);
  in(flexcan::crcr);
  lexican_model_read(Station::base + 2);
  CHECK(station.faults() == 5);
}

TEST_CASE("flexcan: 16 mailboxes have one flag register") {
  Station station(Station::srxdis | Station::irmq | 15, 0, 0, FlexCan::kinetis());
  in(flexcan::iflag2);
  out(flexcan::imask2, 1);
  in(flexcan::mailbox + 16 * 16);
  out(flexcan::rximr + 4 * 16, 0);
  CHECK(station.faults() == 4);
  out(flexcan::mcr, Station::freeze | 16);
  CHECK(station.faults() == 1);  // MAXMB
  out(flexcan::mcr, Station::freeze | station.modes);
}

TEST_CASE("flexcan: SOFTRST resets the status and keeps configuration and mailboxes [MCR, field SOFTRST]") {
  Station station;
  out(flexcan::rxmgmask, 0x12345678);
  station.listen(8, standard_frame(5));
  station.start();
  station.receive(standard_frame(5));
  out(flexcan::imask1, 0x100);
  station.can.node().set_counters(130, 50);
  CHECK(station.can.interrupt());
  out(flexcan::mcr, softrst | station.modes);
  CHECK((in(flexcan::mcr)&softrst) == softrst);
  in(flexcan::esr1);
  CHECK(station.faults() == 1);  // access before the reset is complete
  station.wire.advance(1);
  CHECK(in(flexcan::mcr) == 0x5980000F);
  CHECK(in(flexcan::ecr) == 0);
  CHECK(in(flexcan::esr1) == 0);
  CHECK(in(flexcan::imask1) == 0);
  CHECK(in(flexcan::iflag1) == 0);
  CHECK_FALSE(station.can.interrupt());
  CHECK(in(flexcan::ctrl1) == Station::timing);
  CHECK(in(flexcan::rxmgmask) == 0x12345678);
  CHECK(in(flexcan::rximr) == 0xFFFFFFFF);
  CHECK(station.code(8) == Station::full);
}

TEST_CASE("flexcan: SOFTRST ends bus-off, and is a fault in Disable mode [MCR, field SOFTRST]") {
  Station station;
  station.start();
  station.send(8, standard_frame(1, {0x55}));
  station.enter_bus_off();
  out(flexcan::mcr, softrst | station.modes);
  station.wire.advance(1);
  CHECK((in(flexcan::esr1)&0x30) == 0);
  out(flexcan::mcr, mdis | Station::freeze | station.modes);
  station.wire.advance(1);
  out(flexcan::mcr, softrst | Station::freeze | station.modes);
  CHECK(station.faults() == 1);
}

TEST_CASE("flexcan: the memory must be initialised before Freeze mode is left") {
  CanWire wire;
  FlexCan can(wire, Station::base, FlexCan::imx6());
  out(flexcan::ctrl1, Station::timing);
  out(flexcan::mcr, Station::freeze | 2);
  out(flexcan::mailbox, 0);
  out(flexcan::mailbox + 16, 0);
  out(flexcan::mcr, 2);
  wire.advance(1);
  CHECK(can.fault_text() == "mailbox 2 was not initialised\n");
}

TEST_CASE("flexcan: memory with error correction must be initialised as a whole [CTRL2, field WRMFRZ]") {
  for (const bool is_disabled : {false, true}) {
    CAPTURE(is_disabled);
    CanWire wire;
    FlexCan can(wire, Station::base, FlexCan::imx8mp());
    out(flexcan::mcr, Station::freeze | 0x0080000F);
    wire.advance(1);
    out(flexcan::mcr, Station::freeze | 2);
    out(flexcan::ctrl1, Station::timing);
    out(0xA80, 0);
    CHECK(can.faults().size() == 1);  // reserved memory without WRMFRZ
    in(flexcan::mailbox);
    CHECK(can.faults().size() == 2);  // never written
    can.clear_faults();
    out(flexcan::ctrl2, 1U << 28);
    if (is_disabled) {
      out(flexcan::mecr, 0);
      CHECK(can.faults().size() == 1);  // ECRWRE
      out(flexcan::ctrl2, 3U << 28);
      out(flexcan::mecr, 0);
      CHECK(can.faults().size() == 2);  // fields before ECRWRDIS
      out(flexcan::mecr, 0x000C0080);
      out(flexcan::mecr, 0x000C0180);  // ECCDIS
      can.clear_faults();
    }
    for (std::uint32_t offset = 0x80; offset < (is_disabled ? 0xB0U : 0xADCU); offset += 4) {
      out(offset, 0);
    }
    out(flexcan::ctrl2, 0);
    out(flexcan::mcr, 2);
    wire.advance(1);
    CHECK(can.faults().size() == (is_disabled ? 0 : 1));  // the last word
  }
}

TEST_CASE("flexcan: bit rate and sample point follow CTRL1 or CBT if it is enabled [CTRL1, CBT]") {
  FlexCan::Options options = FlexCan::imx8mp();
  options.clock = 40'000'000;
  CanWire wire;
  FlexCan can(wire, Station::base, options);
  out(flexcan::mcr, Station::freeze | 0x0080000F);
  wire.advance(1);
  out(flexcan::ctrl1, 0x09DB0006);  // PRESDIV 9, RJW 3, PSEG1 3, PSEG2 3, PROPSEG 6
  CHECK(can.bit_rate() == 40'000'000 / 10 / 16);
  CHECK(can.sample_point() == 750);
  out(flexcan::cbt, 1U << 31 | 1U << 21 | 9U << 16 | 46U << 10 | 21U << 5 | 9U);
  CHECK(can.bit_rate() == 250'000);
  CHECK(can.sample_point() == 875);
  CHECK(can.faults().empty());
}

TEST_CASE("flexcan: bit timing outside of the limits of the protocol is a fault [CAN bit time segment settings]") {
  const std::uint32_t few_quanta = 0x00010000;
  const std::uint32_t short_segment_2 = 0x00380007;
  const std::uint32_t long_jump = 0x00F90003;
  for (const std::uint32_t ctrl1 : {few_quanta, short_segment_2, long_jump}) {
    CAPTURE(ctrl1);
    Station station;
    out(flexcan::ctrl1, ctrl1);
    station.start();
    CHECK(station.faults() == 1);
  }
}

TEST_CASE("flexcan: a controller with another bit rate than the bus does not take part") {
  FlexCan::Options options = FlexCan::imx6();
  options.clock = 16'000'000;
  Station station(15, 0, 0, options);
  station.wire.bit_rate = 500'000;
  out(flexcan::mcr, 15);
  station.wire.advance(100);
  CHECK(station.faults() == 1);
  CHECK((in(flexcan::esr1)&1U << 18) == 0);
}

TEST_CASE("flexcan: the timer counts bit times in Normal mode [TIMER]") {
  Station station;
  const std::uint32_t frozen = in(flexcan::timer);
  station.wire.advance(10);
  CHECK(in(flexcan::timer) == frozen);
  station.start();
  const std::uint32_t begin = in(flexcan::timer);
  station.wire.advance(10);
  CHECK(in(flexcan::timer) == begin + 10);
  out(flexcan::timer, 0xFFFF);
  station.wire.advance(2);
  CHECK(in(flexcan::timer) == 1);
}

TEST_CASE("flexcan: each kind of error sets its bit and ERRINT; a read clears the bits [register ESR1]") {
  Station station;
  station.start();
  out(flexcan::ctrl1, Station::timing | 1U << 14);  // ERRMSK
  station.wire.disturb_frames(1, 25);
  station.send(8, standard_frame(1, {0x55}));
  station.wire.advance(60);
  CHECK(station.can.error_interrupt());
  const std::uint32_t errors = in(flexcan::esr1);
  CHECK((errors & 0xFC00) != 0);
  CHECK((errors & 0x3C00) == 0);  // BIT0ERR or BIT1ERR of the transmitter
  CHECK((errors & 2) == 2);
  CHECK((in(flexcan::esr1)&0xFC02) == 2);
  out(flexcan::esr1, 2);
  CHECK(in(flexcan::esr1) % 4 == 0);
  CHECK_FALSE(station.can.error_interrupt());
  station.wire.advance(200);
  CHECK(station.wire.sent() == 1);
  station.peer.node().stop();
  in(flexcan::iflag1);
  out(flexcan::iflag1, 0x100);
  station.send(8, standard_frame(1));
  station.wire.advance(60);
  CHECK((in(flexcan::esr1)&0xFC00) == 1U << 13);  // ACKERR
}

TEST_CASE("flexcan: warnings need WRNEN [MCR, field WRNEN]") {
  for (const bool is_enabled : {false, true}) {
    CAPTURE(is_enabled);
    Station station(15 | Station::srxdis | (is_enabled ? Station::wrnen : 0));
    station.start();
    station.can.node().set_counters(95, 95);
    CHECK((in(flexcan::esr1)&0x30300) == 0);
    station.can.node().set_counters(96, 96);
    CHECK((in(flexcan::esr1)&0x30300) == (is_enabled ? 0x30300U : 0x300U));
    out(flexcan::esr1, 0x30000);
    station.can.node().set_counters(97, 97);
    CHECK((in(flexcan::esr1)&0x30300) == 0x300);
    out(flexcan::ctrl1, Station::timing | 0xC00);
    CHECK(station.faults() == (is_enabled ? 0 : 1));
    CHECK((in(flexcan::ctrl1)&0xC00) == (is_enabled ? 0xC00U : 0U));
    station.can.node().set_counters(0, 0);
    station.can.node().set_counters(96, 0);
    CHECK(station.can.transmit_warning_interrupt() == is_enabled);
    CHECK_FALSE(station.can.receive_warning_interrupt());
    CHECK(station.can.interrupt() == is_enabled);
  }
}

TEST_CASE("flexcan: ECR is writable in Freeze mode; FLTCONF follows it [ECR]") {
  Station station;
  out(flexcan::ecr, 128);
  CHECK((in(flexcan::esr1)&0x30) == 0x10);
  out(flexcan::ecr, 127 << 8 | 127);
  CHECK((in(flexcan::esr1)&0x30) == 0);
  CHECK(in(flexcan::ecr) == (127 << 8 | 127));
}

TEST_CASE("flexcan: bus-off ends after 128 sequences of 11 recessive bits, which TXERRCNT counts [ECR]") {
  Station station;
  station.start();
  out(flexcan::ctrl1, Station::timing | 1U << 15);  // BOFFMSK
  station.send(8, standard_frame(1, {0x55}));
  station.enter_bus_off();
  CHECK((in(flexcan::esr1)&0x24) == 0x24);  // FLTCONF, BOFFINT
  CHECK(station.can.bus_off_interrupt());
  out(flexcan::esr1, 4);
  CHECK_FALSE(station.can.interrupt());
  CHECK((in(flexcan::ecr)&0xFF) == 0);
  station.wire.advance_until([] { return (in(flexcan::ecr)&0xFF) == 1; }, 40);  // after the flags of the peer
  station.wire.advance(126 * 11);
  CHECK((in(flexcan::ecr)&0xFF) == 127);
  CHECK((in(flexcan::esr1)&0x20) == 0x20);
  station.wire.advance(11);
  CHECK(in(flexcan::ecr) == 0);
  CHECK((in(flexcan::esr1)&0x30) == 0);
  station.wire.advance(100);
  CHECK(station.wire.sent() == 1);  // the mailbox has stayed active
}

TEST_CASE("flexcan: with BOFFREC bus-off lasts until it is cleared [CTRL1, field BOFFREC]") {
  constexpr std::uint32_t boffrec = 1U << 6;
  Station station(15 | Station::srxdis, boffrec);
  station.start();
  station.send(8, standard_frame(1, {0x55}));
  station.enter_bus_off();
  station.wire.advance(128 * 11 + 500);
  CHECK((in(flexcan::esr1)&0x20) == 0x20);
  CHECK((in(flexcan::ecr)&0xFF) == 128);
  out(flexcan::ctrl1, Station::timing);
  out(flexcan::ctrl1, Station::timing | boffrec);  // takes effect at the next bus-off only
  station.wire.advance(10);
  CHECK((in(flexcan::esr1)&0x20) == 0x20);
  station.wire.advance(1);
  CHECK((in(flexcan::esr1)&0x30) == 0);
}

TEST_CASE(
    "flexcan: BOFFREC cleared early lets the recovery continue; set late it has no effect [CTRL1, field BOFFREC]") {
  constexpr std::uint32_t boffrec = 1U << 6;
  for (const bool is_manual : {false, true}) {
    CAPTURE(is_manual);
    Station station(15 | Station::srxdis, is_manual ? boffrec : 0);
    station.start();
    station.send(8, standard_frame(1, {0x55}));
    station.enter_bus_off();
    station.wire.advance(60 * 11);
    out(flexcan::ctrl1, Station::timing | (is_manual ? 0 : boffrec));
    const std::uint64_t begin = station.wire.now();
    CHECK(station.wire.advance_until([] { return (in(flexcan::esr1)&0x20) == 0; }, 128 * 11));
    CHECK(station.wire.now() - begin > 65 * 11);
    CHECK(station.wire.now() - begin < 75 * 11);
  }
}

TEST_CASE("flexcan: Freeze mode interrupts the bus-off recovery [Freeze mode]") {
  Station station;
  station.start();
  station.send(8, standard_frame(1, {0x55}));
  station.enter_bus_off();
  station.wire.advance(60 * 11);
  station.stop();
  const std::uint32_t count = in(flexcan::ecr)&0xFF;
  CHECK(count > 50);
  station.wire.advance(1000);
  CHECK((in(flexcan::ecr)&0xFF) == count);
  CHECK((in(flexcan::esr1)&0x20) == 0x20);
  station.start();
  station.wire.advance(80 * 11);
  CHECK((in(flexcan::esr1)&0x20) == 0);
}

TEST_CASE("flexcan: version 3 reports the end of bus-off and repeated errors [register ESR1]") {
  for (const bool is_version_3 : {false, true}) {
    CAPTURE(is_version_3);
    FlexCan::Options options = FlexCan::imx6();
    options.version = is_version_3 ? 3 : 2;
    Station station(15 | Station::srxdis, 0, 0, options);
    station.start();
    if (is_version_3) {
      out(flexcan::ctrl2, 1U << 30);  // BOFFDONEMSK
    }
    station.can.node().set_counters(240, 0);
    station.wire.disturb_frames(2, 25);
    station.send(8, standard_frame(1, {0x55}));
    station.wire.advance_until([&] { return station.can.node().is_bus_off(); }, 300);
    CHECK((in(flexcan::esr1) >> 21 & 1) == (is_version_3 ? 1U : 0U));  // ERROVR
    station.wire.advance(130 * 11);
    CHECK((in(flexcan::esr1) >> 19 & 1) == (is_version_3 ? 1U : 0U));  // BOFFDONEINT
    CHECK(station.can.interrupt() == is_version_3);
    out(flexcan::esr1, 1U << 19 | 1U << 21);
    CHECK((in(flexcan::esr1) >> 19 & 5) == 0);
    CHECK_FALSE(station.can.interrupt());
  }
}

TEST_CASE("flexcan: ERROVR needs an error bit that was not read [register ESR1]") {
  FlexCan::Options options = FlexCan::imx6();
  options.version = 3;
  Station station(15 | Station::srxdis, 0, 0, options);
  station.start();
  station.can.node().set_counters(240, 0);
  station.wire.disturb_frames(1, 25);
  station.send(8, standard_frame(1, {0x55}));
  station.wire.advance(35);
  CHECK((in(flexcan::esr1) & (1U << 21 | 2)) == 2);
}

TEST_CASE(
    "flexcan: loopback receives own frames without acknowledgement, and does not touch the bus [Loop-Back mode]") {
  Station station(15 | Station::irmq | Station::aen, 1U << 12);
  station.listen(9, standard_frame(0x123));
  station.start();
  station.send(8, standard_frame(0x123, {1, 2}));
  station.wire.advance(100);
  CHECK(station.flags() == 0x300);
  CHECK(station.code(8) == Station::inactive);
  CHECK(station.code(9) == Station::full);
  CHECK(station.peer.received.empty());
}

TEST_CASE("flexcan: loopback needs self reception [CTRL1, field LPB]") {
  Station station(15 | Station::srxdis, 1U << 12);
  station.start();
  CHECK(station.faults() == 1);
}

TEST_CASE("flexcan: self reception stores own frames [MCR, field SRXDIS]") {
  for (const bool is_disabled : {false, true}) {
    CAPTURE(is_disabled);
    Station station(15 | (is_disabled ? Station::srxdis : 0));
    station.listen(9, standard_frame(0x123));
    station.start();
    station.send(8, standard_frame(0x123, {1}));
    station.wire.advance(100);
    CHECK(station.flags() == (is_disabled ? 0x100U : 0x300U));
  }
}

TEST_CASE("flexcan: listen-only mode stops the counters and receives acknowledged frames only [Listen-Only mode]") {
  Station station(15 | Station::irmq | Station::srxdis, 1U << 3);
  station.listen(9, standard_frame(0x123));
  station.start();
  CHECK((in(flexcan::esr1)&0x30) == 0x10);  // error passive
  station.send(8, standard_frame(1));
  station.peer.send(standard_frame(0x123));
  station.wire.advance(100);
  CHECK(station.wire.sent() == 0);
  CHECK(station.flags() == 0);
  CHECK((in(flexcan::esr1)&1U << 14) != 0);  // BIT0ERR
  CHECK(in(flexcan::ecr) == 0);
  CanPeer other(station.wire);
  station.wire.advance(300);
  CHECK(station.flags() == 0x200);
  CHECK(station.wire.sent() == 1);
}

TEST_CASE("flexcan: version 3 tolerates FD frames with PREXCEN [CTRL2, field PREXCEN]") {
  for (const bool is_tolerant : {false, true}) {
    CAPTURE(is_tolerant);
    FlexCan::Options options = FlexCan::imx6();
    options.version = 3;
    Station station(15 | Station::srxdis, 0, is_tolerant ? 1U << 14 : 0, options);
    CanPeer one(station.wire, FdMode::enabled);
    CanPeer two(station.wire, FdMode::enabled);
    station.peer.node().stop();
    station.start();
    one.retransmits = false;
    one.send(fd_frame(0x10, 12));
    station.wire.advance(400);
    CHECK((station.wire.sent() == 1) == is_tolerant);
  }
}

TEST_CASE("flexcan: register accesses take time on the wire if the test asks for it") {
  Station station;
  station.wire.accesses_per_bit = 4;
  const std::uint64_t begin = station.wire.now();
  for (int i = 0; i < 40; ++i) {
    in(flexcan::mcr);
  }
  CHECK(station.wire.now() == begin + 10);
}
