// SPDX-License-Identifier: Apache-2.0
// Registers, modes and errors of the M_CAN model. Values are written as in the M_CAN user's manual.
#include "m_can_station.hpp"

using namespace test;
using Kind = CanDisturbance::Kind;

namespace {

constexpr std::array<MCanLayout, 2> layouts = {MCanLayout::fixed, MCanLayout::configurable};

// CCCR
constexpr std::uint32_t init = 1;
constexpr std::uint32_t cce = 2;
constexpr std::uint32_t csa = 8;
constexpr std::uint32_t csr = 0x10;
constexpr std::uint32_t mon = 0x20;
constexpr std::uint32_t test_enable = 0x80;
constexpr std::uint32_t fdoe = 0x100;
constexpr std::uint32_t pxhd = 0x1000;

// A controller without configuration.
struct Plain {
  explicit Plain(MCanLayout which)
      : layout(which),
        ram(MCanStation::ram_address(which), MCanStation::ram_words(which)),
        can(wire, MCanStation::can_address(which), ram, MCanStation::options(which)) {}
  std::uint32_t in(R which) { return lexican_model_read(can.address() + MCan::offset_of(layout, which)); }
  void out(R which, std::uint32_t value) { lexican_model_write(can.address() + MCan::offset_of(layout, which), value); }
  std::size_t faults() {
    const std::size_t count = can.faults().size();
    can.clear_faults();
    return count;
  }
  void enable_configuration() {
    out(R::cccr, init);
    wire.advance(1);
    out(R::cccr, init | cce);
  }

  MCanLayout layout;
  CanWire wire;
  MessageRam ram;
  MCan can;
};

}  // namespace

TEST_CASE("m_can: offsets and reset values of the fixed layout") {
  Plain plain(MCanLayout::fixed);
  const auto at = [&](std::uint32_t offset) { return lexican_model_read(plain.can.address() + offset); };
  CHECK(at(0x00) == 0x32141218);
  CHECK(at(0x04) == 0x87654321);
  CHECK(at(0x0C) == 0x00000A33);
  CHECK(at(0x18) == 0x00000001);
  CHECK(at(0x1C) == 0x06000A03);
  CHECK(at(0x28) == 0xFFFF0000);
  CHECK(at(0x2C) == 0x0000FFFF);
  CHECK(at(0x44) == 0x00000707);
  CHECK(at(0x80) == 0);           // RXGFC
  CHECK(at(0x84) == 0x1FFFFFFF);  // XIDAM
  CHECK(at(0x90) == 0);           // RXF0S
  CHECK(at(0xC4) == 0x00000003);  // TXFQS
  CHECK(at(0xE4) == 0);           // TXEFS
  CHECK(at(0x100) == 0);          // CKDIV
  CHECK(plain.faults() == 0);
  at(0xA4);  // RXF0S of the configurable layout
  CHECK(plain.faults() == 1);
}

TEST_CASE("m_can: offsets and reset values of the configurable layout") {
  Plain plain(MCanLayout::configurable);
  const auto at = [&](std::uint32_t offset) { return lexican_model_read(plain.can.address() + offset); };
  CHECK(at(0x04) == 0x87654321);
  CHECK(at(0x18) == 0x00000001);
  CHECK(at(0x1C) == 0x06000A03);
  CHECK(at(0x84) == 0);           // SIDFC
  CHECK(at(0x90) == 0x1FFFFFFF);  // XIDAM
  CHECK(at(0xA4) == 0);           // RXF0S
  CHECK(at(0xBC) == 0);           // RXESC
  CHECK(at(0xC4) == 0);           // TXFQS
  CHECK(at(0xF4) == 0);           // TXEFS
  CHECK(plain.faults() == 0);
  at(0x8C);
  CHECK(plain.faults() == 1);
}

TEST_CASE("m_can: access to a reserved offset sets ARA") {
  for (const MCanLayout layout : layouts) {
    Plain plain(layout);
    lexican_model_write(plain.can.address() + 0x08, 0);
    CHECK(plain.faults() == 1);
    CHECK(plain.in(R::ir) == (layout == MCanLayout::fixed ? 1U << 23 : 1U << 29));
    plain.out(R::ir, 0xFFFFFFFF);
    CHECK(plain.in(R::ir) == 0);
  }
}

TEST_CASE("m_can: INIT is accepted after a delay, CCE only after INIT") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.start();
    station.out(R::cccr, init);
    CHECK(station.in(R::cccr) == 0);
    station.out(R::cccr, init | cce);
    CHECK(station.can.faults().size() == 1);
    station.can.clear_faults();
    unsigned reads = 0;
    while ((station.in(R::cccr)&init) == 0) {
      REQUIRE(++reads < 10);
    }
    CHECK(station.in(R::cccr) == init);
    station.out(R::cccr, init | cce);
    CHECK(station.in(R::cccr) == (init | cce));
    station.out(R::cccr, 0);
    station.wire.advance(1);
    CHECK(station.in(R::cccr) == 0);  // CCE is reset with INIT
  }
}

TEST_CASE("m_can: a new value of INIT before the previous one is accepted is a fault") {
  MCanStation station(MCanLayout::fixed);
  station.out(R::cccr, 0);
  station.out(R::cccr, init);
  CHECK(station.can.faults().size() == 1);
  station.can.clear_faults();
}

TEST_CASE("m_can: protected registers need INIT and CCE") {
  for (const MCanLayout layout : layouts) {
    Plain plain(layout);
    std::vector<R> registers = {R::dbtp, R::nbtp, R::tscc, R::tocc, R::tdcr, R::gfc, R::xidam, R::txbc, R::rwd};
    if (layout == MCanLayout::configurable) {
      registers.insert(registers.end(),
                       {R::sidfc, R::xidfc, R::rxf0c, R::rxf1c, R::rxbc, R::rxesc, R::txesc, R::txefc});
    }
    for (const R which : registers) {
      const std::uint32_t before = plain.in(which);
      plain.out(which, 0);
      CHECK(plain.faults() == 1);
      CHECK(plain.in(which) == before);
    }
    plain.enable_configuration();
    for (const R which : registers) {
      plain.out(which, 0);
      CHECK(plain.faults() == 0);
      CHECK(plain.in(which) == 0);
    }
  }
}

TEST_CASE("m_can: interrupt enables, line selections and Tx interrupt enables are not protected") {
  for (const MCanLayout layout : layouts) {
    Plain plain(layout);
    for (const R which : {R::ie, R::ils, R::ile, R::txbtie, R::txbcie}) {
      plain.out(which, 1);
      CHECK(plain.in(which) == 1);
    }
    CHECK(plain.faults() == 0);
  }
}

TEST_CASE("m_can: writes of read-only registers and of reserved bits are faults") {
  for (const MCanLayout layout : layouts) {
    Plain plain(layout);
    for (const R which : {R::crel, R::ecr, R::psr, R::rxf0s, R::txfqs, R::txbrp, R::txbto, R::txbcf, R::hpms}) {
      plain.out(which, 0);
      CHECK(plain.faults() == 1);
    }
    plain.out(R::cccr, init | 1U << 10);
    CHECK(plain.faults() == 1);
    plain.out(R::ile, 4);
    CHECK(plain.faults() == 1);
  }
}

TEST_CASE("m_can: mode bits of CCCR need INIT and CCE, MON and TEST can be reset at any time") {
  MCanStation station(MCanLayout::fixed);
  station.start();
  for (const std::uint32_t bit : {0x20U, 0x40U, 0x80U, 0x100U, 0x200U, 0x1000U, 0x4000U}) {
    station.out(R::cccr, bit);
    CHECK(station.can.faults().size() == 1);
    CHECK(station.in(R::cccr) == 0);
    station.can.clear_faults();
  }
  MCanStation other(MCanLayout::configurable, mon | test_enable);
  other.start();
  other.out(R::cccr, 0);
  CHECK(other.in(R::cccr) == 0);
}

TEST_CASE("m_can: functions that are not modelled are faults") {
  Plain plain(MCanLayout::fixed);
  plain.enable_configuration();
  plain.out(R::cccr, init | cce | 4);  // ASM
  CHECK(plain.faults() == 1);
  plain.out(R::cccr, init | cce | 0x8000);  // NISO
  CHECK(plain.faults() == 1);
  plain.out(R::tscc, 2);
  CHECK(plain.faults() == 1);
}

TEST_CASE("m_can: CCE resets the status registers") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.start();
    const unsigned first = station.first_fifo_buffer();
    station.receive(standard_frame(1));
    station.request(first, standard_frame(2), 1U << 23);
    station.wire.advance(100);
    station.request(first + 1, standard_frame(3));
    station.out(R::cccr, init);
    station.wire.advance(1);
    CHECK(station.filling(0) == 1);
    CHECK(station.in(R::txbto) == 1U << first);
    CHECK(station.in(R::txbrp) == 2U << first);
    CHECK((station.in(R::txefs)&0x3F) == 1);
    station.out(R::cccr, init | cce);
    CHECK(station.filling(0) == 0);
    CHECK(station.in(R::txbto) == 0);
    CHECK(station.in(R::txbrp) == 0);
    CHECK(station.in(R::txefs) == 0);
    CHECK(station.in(R::txfqs) == (3U | first << 8 | first << 16));
  }
}

TEST_CASE("m_can: INIT stops a transmission, which is repeated afterwards") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.start();
    const unsigned first = station.first_fifo_buffer();
    station.request(first, standard_frame(2, {1, 2, 3, 4}));
    station.wire.advance(30);
    station.out(R::cccr, init);
    station.wire.advance(200);
    CHECK(station.wire.sent() == 0);
    CHECK(station.in(R::txbrp) == 1U << first);
    station.out(R::cccr, 0);
    station.wire.advance(200);
    CHECK(station.wire.sent() == 1);
  }
}

TEST_CASE("m_can: the controller takes part after 11 recessive bits") {
  MCanStation station(MCanLayout::fixed);
  station.out(R::cccr, 0);
  station.wire.advance(1);
  station.wire.advance(10);
  CHECK(((station.in(R::psr) >> 3) & 3) == 0);  // synchronizing
  station.wire.advance(1);
  CHECK(((station.in(R::psr) >> 3) & 3) == 1);  // idle
  station.peer.send(standard_frame(1));
  station.wire.advance(20);
  CHECK(((station.in(R::psr) >> 3) & 3) == 2);  // receiver
  station.wire.advance(100);
  station.request(0, standard_frame(2));
  station.wire.advance(20);
  CHECK(((station.in(R::psr) >> 3) & 3) == 3);  // transmitter
}

TEST_CASE("m_can: bit rate and sample point of NBTP") {
  CanWire wire;
  wire.bit_rate = 500'000;
  MessageRam ram(0x4000A400, MCan::fixed_words);
  MCan::Options options;
  options.clock = 170'000'000;
  MCan can(wire, 0x40006400, ram, options);
  lexican_model_write(0x40006418, init | cce);
  lexican_model_write(0x4000641C, 3U << 25 | 16U << 16 | 15U << 8 | 3U);  // prescaler 17, 1 + 16 + 4 quanta
  CHECK(can.bit_rate() == 476'190);
  CHECK(can.sample_point() == 809);
  lexican_model_write(0x40006418, 0);
  wire.advance(50);
  CHECK(can.faults().size() == 1);
  CHECK_FALSE(can.node().is_on_bus());
  can.clear_faults();
  lexican_model_write(0x40006418, init);
  wire.advance(1);
  lexican_model_write(0x40006418, init | cce);
  lexican_model_write(0x4000641C, 3U << 25 | 16U << 16 | 14U << 8 | 3U);
  CHECK(can.bit_rate() == 500'000);
  lexican_model_write(0x40006418, 0);
  wire.advance(50);
  CHECK(can.node().is_on_bus());
  CHECK_MESSAGE(can.faults().empty(), can.fault_text());
}

TEST_CASE("m_can: CKDIV divides the clock of the fixed layout") {
  CanWire wire;
  MessageRam ram(0x4000A400, MCan::fixed_words);
  MCan::Options options;
  options.clock = 80'000'000;
  MCan can(wire, 0x40006400, ram, options);
  lexican_model_write(0x40006418, init | cce);
  lexican_model_write(0x4000641C, 0U << 16 | 13U << 8 | 4U);  // 20 quanta
  CHECK(can.bit_rate() == 4'000'000);
  lexican_model_write(0x40006500, 2);  // divided by 4
  CHECK(can.bit_rate() == 1'000'000);
}

TEST_CASE("m_can: a clock stop request is acknowledged when the pending requests are complete") {
  MCanStation station(MCanLayout::fixed);
  station.start();
  station.request(0, standard_frame(5));
  station.out(R::cccr, csr);
  station.wire.advance(20);
  CHECK(station.in(R::cccr) == csr);
  station.wire.advance(100);
  CHECK(station.wire.sent() == 1);
  CHECK(station.in(R::cccr) == (init | csr | csa));
  station.out(R::cccr, init);
  CHECK(station.in(R::cccr) == init);
  station.out(R::cccr, 0);
  station.wire.advance(20);
  CHECK(((station.in(R::psr) >> 3) & 3) == 1);
}

TEST_CASE("m_can: the timestamp counter counts bit times and is captured with a frame") {
  MCanStation station(MCanLayout::fixed);
  station.out(R::tscc, 1U | 1U << 16);  // internal, two bit times
  station.start();
  station.out(R::tscv, 0);
  CHECK(station.in(R::tscv) == 0);
  station.wire.advance(200);
  CHECK(station.in(R::tscv) == 100);
  station.receive(standard_frame(1));
  CHECK((station.word(station.fifo_element(0, 0) + 1) & 0xFFFF) == 100);
  CHECK_FALSE(station.has(Flag::tsw));
  station.wire.advance(2 * 65536);
  CHECK(station.has(Flag::tsw));
}

TEST_CASE("m_can: the timeout counter is stored, CCE presets its value") {
  Plain plain(MCanLayout::configurable);
  plain.enable_configuration();
  plain.out(R::tocc, 0x12340000);
  CHECK(plain.in(R::tocc) == 0x12340000);
  plain.out(R::cccr, init);
  plain.out(R::cccr, init | cce);
  CHECK(plain.in(R::tocv) == 0x1234);
}

// ---- Interrupt lines

TEST_CASE("m_can: flags of the configurable layout select their line each") {
  MCanStation station(MCanLayout::configurable);
  station.start();
  station.receive(standard_frame(1));
  CHECK(station.in(R::ir) == 1);  // RF0N
  CHECK_FALSE(station.can.interrupt(0));
  station.out(R::ie, 1);
  CHECK_FALSE(station.can.interrupt(0));
  station.out(R::ile, 3);
  CHECK(station.can.interrupt(0));
  CHECK_FALSE(station.can.interrupt(1));
  station.out(R::ils, 1);
  CHECK_FALSE(station.can.interrupt(0));
  CHECK(station.can.interrupt(1));
  station.out(R::ir, 1);
  CHECK_FALSE(station.can.interrupt(1));
  CHECK(station.filling(0) == 1);
}

TEST_CASE("m_can: flags of the fixed layout select their line in groups") {
  MCanStation station(MCanLayout::fixed);
  station.start();
  station.out(R::ie, 0xFFFFFF);
  station.out(R::ile, 3);
  station.out(R::txbtie, 7);
  station.receive(standard_frame(1));
  CHECK(station.can.interrupt(0));
  station.out(R::ils, 1);  // RXFIFO0
  CHECK_FALSE(station.can.interrupt(0));
  CHECK(station.can.interrupt(1));
  station.out(R::ir, 7);
  CHECK_FALSE(station.can.interrupt(1));
  station.request(0, standard_frame(2));
  station.wire.advance(100);
  CHECK(station.in(R::ir) == (1U << 7 | 1U << 9));  // TC, TFE
  station.out(R::ir, 1U << 9);
  CHECK(station.can.interrupt(0));
  station.out(R::ils, 4);  // SMSG
  CHECK_FALSE(station.can.interrupt(0));
  CHECK(station.can.interrupt(1));
  station.out(R::ir, 1U << 7);
  station.can.node().set_counters(100, 0);
  CHECK(station.in(R::ir) == 1U << 18);  // EW
  station.out(R::ils, 0x20);             // BERR: EP, ELO
  CHECK(station.can.interrupt(0));
  station.out(R::ils, 0x40);  // PERR
  CHECK(station.can.interrupt(1));
}

// ---- Errors

TEST_CASE("m_can: reading PSR sets LEC to 7") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.start();
    CHECK((station.in(R::psr)&7) == 7);
    station.receive(standard_frame(1));
    CHECK((station.in(R::psr)&7) == 0);
    CHECK((station.in(R::psr)&7) == 7);
    const CanFrame frame = standard_frame(0x155);
    station.wire.disturb_frames(1, frame_bits(frame) - 9, Kind::set_recessive);
    station.request(station.first_fifo_buffer(), frame);
    station.wire.advance(60);
    CHECK((station.in(R::psr)&7) == 3);
    CHECK(station.has(Flag::pea));
    station.wire.advance(100);
    CHECK((station.in(R::psr)&7) == 0);
  }
}

TEST_CASE("m_can: ECR has both counters, and a log that a read resets") {
  MCanStation station(MCanLayout::fixed);
  station.start();
  station.wire.disturb_frames(3, 25);
  station.request(0, standard_frame(1, {0x55}));
  station.wire.advance_until([&] { return station.can.node().tec() == 24; }, 1000);
  CHECK(station.in(R::ecr) == (3U << 16 | 24));
  CHECK(station.in(R::ecr) == 24);
  station.can.node().set_counters(5, 127);
  CHECK(station.in(R::ecr) == (127U << 8 | 5));
  station.can.node().set_counters(5, 200);
  CHECK(station.in(R::ecr) == (1U << 15 | 127U << 8 | 5));  // RP, REC has 7 bits
}

TEST_CASE("m_can: the error log stops at 255, the next error sets ELO") {
  MCanStation station(MCanLayout::fixed);
  station.peer.node().stop();  // nothing is acknowledged
  station.start();
  station.request(0, standard_frame(1));
  station.wire.advance_until([&] { return station.wire.errors(CanError::ack) == 255; });
  CHECK_FALSE(station.has(Flag::elo));
  station.wire.advance(100);
  CHECK(station.has(Flag::elo));
  CHECK((station.in(R::ecr) >> 16) == 255);
}

TEST_CASE("m_can: EW, EP and BO are raised by each change") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.start();
    const auto changes = [&](unsigned tec, unsigned rec) {
      station.can.node().set_counters(tec, rec);
      const std::uint32_t flags = station.in(R::ir);
      station.out(R::ir, flags);
      return flags;
    };
    CHECK(changes(95, 0) == 0);
    CHECK(changes(96, 0) == station.flag(Flag::ew));
    CHECK((station.in(R::psr)&0xE0) == 0x40);
    CHECK(changes(0, 128) == station.flag(Flag::ep));
    CHECK((station.in(R::psr)&0xE0) == 0x60);
    CHECK(changes(0, 0) == (station.flag(Flag::ep) | station.flag(Flag::ew)));
    CHECK(changes(256, 0) == (station.flag(Flag::ep) | station.flag(Flag::ew) | station.flag(Flag::bo)));
    CHECK((station.in(R::psr)&0xE0) == 0xE0);
  }
}

TEST_CASE("m_can: bus-off sets INIT; the recovery takes 129 sequences after INIT is cleared") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.start();
    const unsigned first = station.first_fifo_buffer();
    station.wire.disturb_frames(32, 25);
    station.request(first, standard_frame(1, {0x55}));
    REQUIRE(station.wire.advance_until([&] { return station.can.node().is_bus_off(); }));
    CHECK((station.in(R::cccr)&init) == init);
    station.wire.advance(5000);
    CHECK((station.in(R::psr)&0x80) == 0x80);
    station.out(R::ir, 0xFFFFFFFF);
    station.out(R::cccr, 0);
    station.wire.advance(1);
    station.wire.advance(11 * 20);
    const std::uint32_t psr = station.in(R::psr);
    CHECK((psr & 0x87) == 0x85);  // Bit0Error for each sequence
    CHECK((station.in(R::psr)&7) == 7);
    CHECK(((station.in(R::ecr) >> 8) & 0x7F) == 20);
    station.wire.advance(11 * 109 - 1);
    CHECK((station.in(R::psr)&0x80) == 0x80);
    station.wire.advance(1);
    CHECK((station.in(R::psr)&0xE0) == 0);
    CHECK((station.in(R::ecr)&0xFFFF) == 0);
    CHECK(station.has(Flag::bo));
    station.wire.advance(200);
    CHECK(station.peer.received.size() == 1);  // the request was pending
  }
}

// ---- CAN FD

TEST_CASE("m_can: an FD frame is destroyed without FDOE") {
  MCanStation station(MCanLayout::fixed);
  station.start();
  station.peer.retransmits = false;
  station.peer.send(fd_frame(0x123, 15));
  station.wire.advance(1000);
  CHECK(station.wire.sent() == 0);
  CHECK(station.can.node().rec() != 0);
  CHECK(station.filling(0) == 0);
}

TEST_CASE("m_can: an FD frame is received with FDOE") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout, fdoe);
    station.start();
    station.receive(fd_frame(0x123, 15));
    CHECK(station.wire.sent() == 1);
    CHECK(station.filling(0) == 1);
    const unsigned element = station.fifo_element(0, 0);
    CHECK((station.word(element + 1) & 0x803F0000) == (0x80000000 | 1U << 21 | 15U << 16));
    CHECK(station.word(element + 3) == 0x07060504);
    const unsigned beyond = station.fifo_element(0, 0) + 4;
    if (layout == MCanLayout::fixed) {
      CHECK(station.word(beyond) == 0x0B0A0908);
    } else {
      CHECK(station.word(beyond) != 0x0B0A0908);  // the element has 8 bytes
    }
    CHECK((station.in(R::psr)&0x2000) == 0x2000);  // RFDF
    CHECK((station.in(R::psr)&0x2000) == 0);
  }
}

TEST_CASE("m_can: a recessive bit after FDF is a protocol exception, or a form error with PXHD") {
  for (const bool is_error : {false, true}) {
    CAPTURE(is_error);
    MCanStation station(MCanLayout::fixed, fdoe | (is_error ? pxhd : 0));
    station.start();
    station.peer.retransmits = false;
    station.wire.disturb_frames(1, 15, Kind::set_recessive, 1, &station.can.node());
    station.peer.send(fd_frame(0x2AA, 8));
    station.wire.advance(17);
    CHECK((station.in(R::psr)&0x4000) == 0x4000);
    CHECK((station.in(R::psr)&0x4000) == 0);
    CHECK(station.can.node().rec() == (is_error ? 1 : 0));
  }
}

TEST_CASE("m_can: FDF and BRS of a Tx buffer need FDOE and BRSE") {
  for (const std::uint32_t modes : {0U, fdoe, fdoe | 0x200U}) {
    MCanStation station(MCanLayout::fixed, modes);
    station.start();
    station.request(0, standard_frame(0x100, {1, 2}), 3U << 20);
    station.wire.advance(200);
    REQUIRE(station.peer.received.size() == 1);
    CHECK(station.peer.received[0].is_fd == (modes != 0));
    CHECK(station.peer.received[0].has_brs == (modes > fdoe));
  }
}

// ---- Test modes

TEST_CASE("m_can: TEST needs CCCR.TEST") {
  MCanStation station(MCanLayout::fixed);
  station.out(R::test, 0x10);
  CHECK(station.can.faults().size() == 1);
  station.can.clear_faults();
  station.out(R::cccr, init | cce | test_enable);
  station.out(R::test, 0x10);
  CHECK(station.in(R::test) == 0x90);  // the receive pin is recessive
  station.out(R::cccr, init | cce);
  CHECK(station.in(R::test) == 0x80);
  station.out(R::cccr, init | cce | test_enable);
  station.out(R::test, 0x20);  // control of the transmit pin
  CHECK(station.can.faults().size() == 1);
  station.can.clear_faults();
}

TEST_CASE("m_can: external loopback receives own frames and drives the bus") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout, test_enable);
    station.out(R::test, 0x10);
    station.start();
    station.request(station.first_fifo_buffer(), standard_frame(0x111, {7}));
    station.wire.advance(100);
    CHECK(station.filling(0) == 1);
    CHECK(station.in(R::txbto) != 0);
    CHECK(station.peer.received.size() == 1);
  }
}

TEST_CASE("m_can: internal loopback does not touch the bus") {
  MCanStation station(MCanLayout::fixed, test_enable | mon);
  station.out(R::test, 0x10);
  station.start();
  station.request(0, standard_frame(0x111, {7}));
  station.wire.advance(100);
  CHECK(station.filling(0) == 1);
  CHECK(station.peer.received.empty());
}

TEST_CASE("m_can: bus monitoring receives, does not acknowledge, does not transmit") {
  MCanStation station(MCanLayout::fixed, mon);
  CanPeer other(station.wire);
  station.start();
  station.request(0, standard_frame(0x111));
  CHECK(station.in(R::txbrp) == 0);
  station.receive(standard_frame(1));
  CHECK(station.filling(0) == 1);
  CHECK(station.wire.sent() == 1);
  other.node().stop();
  station.peer.retransmits = false;
  station.peer.send(standard_frame(2));
  station.wire.advance(100);
  CHECK(station.wire.errors(CanError::ack) == 1);
}

// ---- Message RAM

TEST_CASE("m_can: a RAM word of no controller is a fault") {
  CanWire wire;
  MessageRam ram(0x4000A400, 3 * MCan::fixed_words);
  MCan::Options options;
  options.ram_offset = MCan::fixed_words;
  MCan can(wire, 0x40006800, ram, options);
  lexican_model_write(0x4000A400 + 0x350, 1);
  lexican_model_read(0x4000A400 + 2 * 0x350 - 4);
  CHECK(ram.faults().empty());
  lexican_model_write(0x4000A400 + 0x350 - 4, 1);
  CHECK(ram.faults().size() == 1);
  lexican_model_read(0x4000A400 + 2 * 0x350);
  CHECK(ram.faults().size() == 2);
}

TEST_CASE("m_can: outside of initialization only configured sections are accessed") {
  MCanStation station(MCanLayout::configurable);
  station.set_word(2000, 0);  // clears the RAM
  station.filters(2, 1);
  station.set_word(0, 0);
  station.set_word(1, 0);
  station.set_word(28, 0);
  station.set_word(29, 0);
  station.start();
  station.word(1);
  station.word(29);
  station.word(station.tx_buffer(4) + 3);
  CHECK(station.ram.faults().empty());
  station.word(2);
  station.word(station.tx_buffer(5));
  CHECK(station.ram.faults().size() == 2);
  station.ram.clear_faults();
}

TEST_CASE("m_can: sections that overlap or exceed the RAM are faults") {
  MCanStation station(MCanLayout::configurable);
  station.out(R::rxf1c, 55 * 4 | 3U << 16);
  station.out(R::cccr, 0);
  station.wire.advance(1);
  CHECK(station.can.faults().size() == 1);
  station.can.clear_faults();
  station.out(R::cccr, init);
  station.wire.advance(1);
  station.out(R::cccr, init | cce);
  station.out(R::rxf1c, 2556 * 4 | 3U << 16);
  station.out(R::cccr, 0);
  station.wire.advance(1);
  CHECK(station.can.faults().size() == 1);
  station.can.clear_faults();
}

TEST_CASE("m_can: sections of two controllers must not overlap") {
  MCanStation station(MCanLayout::configurable);
  station.start();
  MCan::Options options;
  options.layout = MCanLayout::configurable;
  MCan second(station.wire, 0x4000A400, station.ram, options);
  lexican_model_write(0x4000A418, init);
  station.wire.advance(1);
  lexican_model_write(0x4000A418, init | cce);
  lexican_model_write(0x4000A4C0, 93 * 4 | 1U << 16);
  lexican_model_write(0x4000A418, 0);
  station.wire.advance(1);
  CHECK(second.faults().size() == 1);
}

TEST_CASE("m_can: a Tx buffer with a pending request must not be written") {
  MCanStation station(MCanLayout::fixed);
  station.start();
  station.request(0, standard_frame(1));
  station.set_word(station.tx_buffer(0) + 2, 5);
  CHECK(station.ram.faults().size() == 1);
  station.ram.clear_faults();
  station.set_word(station.tx_buffer(1) + 2, 5);
  CHECK(station.ram.faults().empty());
}
