// SPDX-License-Identifier: Apache-2.0
// Register values are written as in the reference manuals RM0008 and RM0090, chapter bxCAN.
#include "bxcan.hpp"

#include <doctest/doctest.h>

using namespace test;
using Kind = CanDisturbance::Kind;

namespace {

constexpr std::uintptr_t can1 = 0x40006400;
constexpr std::uintptr_t can2 = 0x40006800;

// CAN_MCR, CAN_MSR
constexpr std::uint32_t inrq = 0x01;
constexpr std::uint32_t sleep_request = 0x02;
constexpr std::uint32_t txfp = 0x04;
constexpr std::uint32_t rflm = 0x08;
constexpr std::uint32_t nart = 0x10;
constexpr std::uint32_t awum = 0x20;
constexpr std::uint32_t abom = 0x40;
constexpr std::uint32_t ttcm = 0x80;
constexpr std::uint32_t inak = 0x01;
constexpr std::uint32_t slak = 0x02;
constexpr std::uint32_t erri = 0x04;
constexpr std::uint32_t wkui = 0x08;
constexpr std::uint32_t slaki = 0x10;

std::uint32_t in(std::uint32_t offset, std::uintptr_t base = can1) { return lexican_model_read(base + offset); }
void out(std::uint32_t offset, std::uint32_t value, std::uintptr_t base = can1) {
  lexican_model_write(base + offset, value);
}

void initialize(CanWire& wire, std::uintptr_t base = can1) {
  out(bxcan::mcr, inrq, base);
  wire.advance(2);
  REQUIRE((in(bxcan::msr, base) & (inak | slak)) == inak);
}

void run(CanWire& wire, std::uint32_t mcr = 0, std::uintptr_t base = can1) {
  out(bxcan::mcr, mcr, base);
  wire.advance(13);
  REQUIRE((in(bxcan::msr, base) & inak) == 0);
}

// Bank 0 accepts all frames to FIFO 0.
void accept_all() {
  out(bxcan::fs1r, 1);
  out(bxcan::f0r1, 0);
  out(bxcan::f0r1 + 4, 0);
  out(bxcan::fa1r, 1);
  out(bxcan::fmr, 0x2A1C0E00);
}

void request(unsigned mailbox, const CanFrame& frame, std::uint32_t tdtr = 0, std::uintptr_t base = can1) {
  const std::uint32_t at = bxcan::ti0r + 16 * mailbox;
  const auto word = [&](unsigned first) {
    return frame.data[first] | std::uint32_t{frame.data[first + 1]} << 8 | std::uint32_t{frame.data[first + 2]} << 16 |
           std::uint32_t{frame.data[first + 3]} << 24;
  };
  out(at + 4, tdtr | frame.dlc, base);
  out(at + 8, word(0), base);
  out(at + 12, word(4), base);
  const std::uint32_t id = frame.is_extended ? frame.id << 3 | 4 : frame.id << 21;
  out(at, id | (frame.is_remote ? 2U : 0U) | 1U, base);
}

// One controller in normal mode with a peer.
struct Station {
  CanWire wire;
  BxCan can{wire, can1};
  CanPeer peer{wire};
  explicit Station(std::uint32_t mcr = 0, std::uint32_t btr = 0) {
    initialize(wire);
    out(bxcan::btr, btr);
    accept_all();
    run(wire, mcr);
  }
  ~Station() { CHECK_MESSAGE(can.faults().empty(), can.fault_text()); }

  void receive(const CanFrame& frame) {
    const std::size_t before = wire.sent();
    peer.send(frame);
    wire.advance_until([&] { return wire.sent() > before; }, 400);
    wire.advance(3);
  }
  unsigned filling() const { return in(bxcan::rf0r)&3; }
};

}  // namespace

TEST_CASE("bxcan: reset values") {
  CanWire wire;
  BxCan can(wire, can1);
  CHECK(in(bxcan::mcr) == 0x00010002);
  CHECK(in(bxcan::msr) == 0x00000C02);
  CHECK(in(bxcan::tsr) == 0x1C000000);
  CHECK(in(bxcan::rf0r) == 0);
  CHECK(in(bxcan::rf1r) == 0);
  CHECK(in(bxcan::ier) == 0);
  CHECK(in(bxcan::esr) == 0);
  CHECK(in(bxcan::btr) == 0x01230000);
  CHECK(in(bxcan::fmr) == 0x2A1C0E01);
  CHECK(in(bxcan::fm1r) == 0);
  CHECK(in(bxcan::fa1r) == 0);
  CHECK(can.faults().empty());
}

TEST_CASE("bxcan: initialization is acknowledged, from sleep mode only without SLEEP") {
  CanWire wire;
  BxCan can(wire, can1);
  out(bxcan::mcr, inrq | sleep_request);
  wire.advance(50);
  CHECK((in(bxcan::msr) & (inak | slak)) == slak);
  out(bxcan::mcr, inrq);
  CHECK((in(bxcan::msr)&inak) == 0);  // the handshake takes time
  wire.advance(2);
  CHECK((in(bxcan::msr) & (inak | slak)) == inak);
}

TEST_CASE("bxcan: normal mode needs 11 recessive bits") {
  CanWire wire;
  BxCan can(wire, can1);
  initialize(wire);
  wire.hold(dominant);
  out(bxcan::mcr, 0);
  wire.advance(100);
  CHECK((in(bxcan::msr)&inak) == inak);
  wire.release();
  wire.advance(10);
  CHECK((in(bxcan::msr)&inak) == inak);
  wire.advance(1);
  CHECK((in(bxcan::msr)&inak) == 0);
}

TEST_CASE("bxcan: initialization waits until the frame on the bus is complete") {
  Station station;
  station.peer.send(standard_frame(0x123, {1, 2, 3}));
  station.wire.advance(20);
  out(bxcan::mcr, inrq);
  station.wire.advance(20);
  CHECK((in(bxcan::msr)&inak) == 0);
  CHECK((in(bxcan::msr)&0x200) == 0x200);  // RXM
  station.wire.advance(100);
  CHECK((in(bxcan::msr)&inak) == inak);
  CHECK(station.wire.sent() == 1);
  CHECK(station.filling() == 1);
}

TEST_CASE("bxcan: a pending mailbox waits during initialization") {
  Station station;
  out(bxcan::mcr, inrq);
  request(0, standard_frame(1));
  station.wire.advance(100);
  CHECK(station.wire.sent() == 0);
  run(station.wire);
  station.wire.advance(100);
  CHECK(station.wire.sent() == 1);
}

TEST_CASE("bxcan: sleep mode is entered on request and left by software") {
  Station station;
  out(bxcan::ier, 0x20000);  // SLKIE
  out(bxcan::mcr, sleep_request);
  station.wire.advance(2);
  CHECK((in(bxcan::msr) & (slak | slaki)) == (slak | slaki));
  CHECK(station.can.status_interrupt());
  out(bxcan::msr, slaki);
  CHECK_FALSE(station.can.status_interrupt());
  out(bxcan::mcr, 0);
  station.wire.advance(10);
  CHECK((in(bxcan::msr)&slak) == slak);
  station.wire.advance(2);
  CHECK((in(bxcan::msr)&slak) == 0);
}

TEST_CASE("bxcan: SLAKI is not set without SLKIE") {
  Station station;
  out(bxcan::mcr, sleep_request);
  station.wire.advance(2);
  CHECK((in(bxcan::msr) & (slak | slaki)) == slak);
}

TEST_CASE("bxcan: activity on the bus sets WKUI, and clears SLEEP with AWUM only") {
  for (const bool is_automatic : {false, true}) {
    CAPTURE(is_automatic);
    Station station;
    CanPeer other(station.wire);
    out(bxcan::ier, 0x10000);  // WKUIE
    out(bxcan::mcr, sleep_request | (is_automatic ? awum : 0));
    station.wire.advance(15);
    station.receive(standard_frame(5));
    CHECK((in(bxcan::msr)&wkui) == wkui);
    CHECK(station.can.status_interrupt());
    CHECK(((in(bxcan::mcr)&sleep_request) == 0) == is_automatic);
    station.wire.advance(15);
    CHECK(((in(bxcan::msr)&slak) == 0) == is_automatic);
    CHECK(station.filling() == 0);  // the frame that wakes the controller is lost
    out(bxcan::msr, wkui);
    CHECK_FALSE(station.can.status_interrupt());
  }
}

TEST_CASE("bxcan: the RESET bit returns to sleep mode and empties the FIFOs") {
  Station station(nart);
  station.receive(standard_frame(1));
  out(bxcan::ier, 0x8800);  // ERRIE, LECIE
  station.can.node().set_counters(100, 0);
  station.wire.disturb_frames(1, 25);
  request(0, standard_frame(1, {0x55}));
  station.wire.advance(60);
  request(1, standard_frame(2));
  station.wire.advance(10);
  CHECK(station.can.status_interrupt());
  out(bxcan::mcr, 0x8000);
  CHECK(in(bxcan::mcr) == 0x00010002);
  CHECK((in(bxcan::msr)&0x1F) == slak);
  CHECK(in(bxcan::tsr) == 0x1C000000);
  CHECK(in(bxcan::esr) == 0);
  CHECK(in(bxcan::ier) == 0);
  CHECK(station.filling() == 0);
  CHECK_FALSE(station.can.interrupt());
  station.wire.advance(60);  // the peer signals an error in the frame that was cut off
  initialize(station.wire);
  run(station.wire);
  request(1, standard_frame(2));
  station.wire.advance(2);
  out(bxcan::tsr, 0x8000);  // ABRQ1 of the mailbox that is transmitted
  CHECK((in(bxcan::tsr)&0xFFFF) == 0x8000);
  station.wire.advance(100);
  CHECK((in(bxcan::tsr)&0xFFFF) == 0x0300);
}

TEST_CASE("bxcan: BTR is writable in initialization mode only") {
  CanWire wire;
  BxCan can(wire, can1);
  out(bxcan::btr, 0x001C0003);
  CHECK(can.faults().size() == 1);
  CHECK(in(bxcan::btr) == 0x01230000);
  initialize(wire);
  out(bxcan::btr, 0x001C0003);
  CHECK(in(bxcan::btr) == 0x001C0003);
  CHECK(can.faults().size() == 1);
}

TEST_CASE("bxcan: bit rate and sample point of BTR") {
  CanWire wire;
  BxCan::Options options;
  options.clock = 36'000'000;
  BxCan can(wire, can1, options);
  initialize(wire);
  out(bxcan::btr, 0x001E0003);  // BRP 4, TS1 15, TS2 2: 18 quanta
  CHECK(can.bit_rate() == 500'000);
  CHECK(can.sample_point() == 888);
}

TEST_CASE("bxcan: a controller with another bit rate than the bus does not take part") {
  CanWire wire;
  wire.bit_rate = 250'000;
  BxCan::Options options;
  options.clock = 36'000'000;
  BxCan can(wire, can1, options);
  initialize(wire);
  out(bxcan::btr, 0x001E0003);
  out(bxcan::mcr, 0);
  wire.advance(50);
  CHECK((in(bxcan::msr)&inak) == inak);
  CHECK(can.faults().size() == 1);
}

TEST_CASE("bxcan: reserved offsets, receive mailboxes and reserved bits are faults") {
  CanWire wire;
  BxCan can(wire, can1);
  const auto has_fault = [&] {
    const bool one = can.faults().size() == 1;
    can.clear_faults();
    return one;
  };
  in(0x20);
  CHECK(has_fault());
  out(0x17C, 0);
  CHECK(has_fault());
  in(0x208);
  CHECK(has_fault());
  in(bxcan::f0r1 + 8 * 14);  // bank 14 of 14
  CHECK(has_fault());
  out(bxcan::ri0r, 0);
  CHECK(has_fault());
  out(bxcan::mcr, 0x00020002);
  CHECK(has_fault());
  out(bxcan::ier, 0x80);
  CHECK(has_fault());
  out(bxcan::fmr, 1);
  CHECK(has_fault());
  lexican_model_read(can1 + 2);
  CHECK(has_fault());
}

TEST_CASE("bxcan: an address of no model is recorded") {
  unmatched_accesses().clear();
  CHECK(lexican_model_read(0x40000000) == 0);
  lexican_model_write(0x40000004, 7);
  REQUIRE(unmatched_accesses().size() == 2);
  CHECK(unmatched_accesses()[1].is_write);
  CHECK(unmatched_accesses()[1].value == 7);
  unmatched_accesses().clear();
}

// ---- Transmission

TEST_CASE("bxcan: a transmit request sends the frame and completes") {
  Station station;
  const CanFrame frame = extended_frame(0x1ABCDE12, {1, 2, 3, 4, 5, 6, 7, 8});
  out(bxcan::ier, 1);  // TMEIE
  request(1, frame);
  CHECK(in(bxcan::tsr) == 0x14000000);  // mailbox 1 is not empty, the next free one is 0
  station.wire.advance(frame_bits(frame) - 1);
  CHECK_FALSE(station.can.transmit_interrupt());
  CHECK((in(bxcan::msr)&0x100) == 0x100);  // TXM
  station.wire.advance(1);
  CHECK(in(bxcan::tsr) == (0x1C000000 | 0x300));  // RQCP1, TXOK1
  CHECK((in(bxcan::ti0r + 16) & 1) == 0);
  CHECK(station.can.transmit_interrupt());
  REQUIRE(station.peer.received.size() == 1);
  CHECK(station.peer.received[0] == frame);
  out(bxcan::tsr, 0x100);
  CHECK(in(bxcan::tsr) == 0x1C000000);  // RQCP clears the other flags
  CHECK_FALSE(station.can.transmit_interrupt());
}

TEST_CASE("bxcan: TXOK, ALST and TERR are cleared one by one") {
  Station station(nart);
  request(2, standard_frame(1));
  station.wire.advance(100);
  CHECK((in(bxcan::tsr)&0xFF0000) == 0x030000);
  out(bxcan::tsr, 0x020000);
  CHECK((in(bxcan::tsr)&0xFF0000) == 0x010000);
}

TEST_CASE("bxcan: remote frames are sent") {
  Station station;
  request(0, remote_frame(standard_frame(0x701), 1));
  station.wire.advance(100);
  REQUIRE(station.peer.received.size() == 1);
  CHECK(station.peer.received[0] == remote_frame(standard_frame(0x701), 1));
}

TEST_CASE("bxcan: a new request clears the flags of the mailbox") {
  Station station;
  request(0, standard_frame(1));
  station.wire.advance(100);
  CHECK((in(bxcan::tsr)&3) == 3);
  request(0, standard_frame(2));
  CHECK((in(bxcan::tsr)&0xF) == 0);
}

TEST_CASE("bxcan: a mailbox is write-protected while it is not empty") {
  Station station;
  request(0, standard_frame(1, {1}));
  out(bxcan::ti0r + 8, 0x99);
  CHECK(station.can.faults().size() == 1);
  station.can.clear_faults();
  station.wire.advance(100);
  CHECK(station.peer.received[0].data[0] == 1);
}

TEST_CASE("bxcan: the lowest identifier is sent first, then the lowest mailbox") {
  Station station;
  station.wire.hold(recessive);  // no transmission before all are requested
  out(bxcan::mcr, inrq);
  station.wire.release();
  station.wire.advance(2);
  request(0, standard_frame(0x300, {0}));
  request(1, standard_frame(0x200, {1}));
  request(2, standard_frame(0x200, {2}));
  CHECK((in(bxcan::tsr) >> 24) == 0x20);  // LOW0, CODE 0: mailbox 0 has the lowest priority
  run(station.wire);
  station.wire.advance(400);
  REQUIRE(station.peer.received.size() == 3);
  CHECK(station.peer.received[0].data[0] == 1);
  CHECK(station.peer.received[1].data[0] == 2);
  CHECK(station.peer.received[2].data[0] == 0);
}

TEST_CASE("bxcan: with TXFP the order is that of the requests") {
  Station station;
  out(bxcan::mcr, inrq);
  station.wire.advance(2);
  out(bxcan::mcr, inrq | txfp);
  request(2, standard_frame(0x300));
  request(0, standard_frame(0x200));
  request(1, standard_frame(0x100));
  CHECK((in(bxcan::tsr) >> 24) == 0x41);  // LOW1, CODE 1: the latest request
  run(station.wire, txfp);
  station.wire.advance(400);
  REQUIRE(station.peer.received.size() == 3);
  CHECK(station.peer.received[0].id == 0x300);
  CHECK(station.peer.received[1].id == 0x200);
  CHECK(station.peer.received[2].id == 0x100);
}

TEST_CASE("bxcan: LOW is 0 while one mailbox is pending") {
  Station station;
  request(2, standard_frame(0x300));
  CHECK((in(bxcan::tsr) >> 29) == 0);
  request(1, standard_frame(0x301));
  CHECK((in(bxcan::tsr) >> 29) == 2);
}

TEST_CASE("bxcan: a lost arbitration is repeated, or ends the request with NART") {
  for (const bool is_repeated : {true, false}) {
    CAPTURE(is_repeated);
    Station station(is_repeated ? 0 : nart);
    request(0, standard_frame(0x200));
    station.peer.send(standard_frame(0x100));
    station.wire.advance(30);
    CHECK((in(bxcan::tsr)&0xF) == (is_repeated ? 0x4 : 0x5));  // ALST, RQCP
    CHECK(((in(bxcan::tsr) >> 26) & 1) == (is_repeated ? 0 : 1));
    station.wire.advance(200);
    CHECK(station.peer.received.size() == (is_repeated ? 1 : 0));
  }
}

TEST_CASE("bxcan: a transmission error is repeated, or ends the request with NART") {
  for (const bool is_repeated : {true, false}) {
    CAPTURE(is_repeated);
    Station station(is_repeated ? 0 : nart);
    station.wire.disturb_frames(1, 25);
    request(0, standard_frame(0x200, {0x55}));
    station.wire.advance(40);
    CHECK((in(bxcan::tsr)&0xF) == (is_repeated ? 0x8 : 0x9));  // TERR, RQCP
    CHECK(((in(bxcan::esr) >> 16) & 0xFF) == 8);
    station.wire.advance(200);
    CHECK(station.peer.received.size() == (is_repeated ? 1 : 0));
    CHECK((in(bxcan::tsr)&0xF) == (is_repeated ? 0x3 : 0x9));
  }
}

TEST_CASE("bxcan: a waiting mailbox is aborted at once") {
  Station station;
  out(bxcan::mcr, inrq);
  station.wire.advance(2);
  request(0, standard_frame(0x200));
  out(bxcan::tsr, 0x80);
  CHECK(in(bxcan::tsr) == 0x1C000001);  // RQCP0 without TXOK0
  run(station.wire);
  station.wire.advance(100);
  CHECK(station.wire.sent() == 0);
}

TEST_CASE("bxcan: an abort during the transmission takes effect at its end") {
  Station station;
  request(0, standard_frame(0x200));
  station.wire.advance(10);
  out(bxcan::tsr, 0x80);
  CHECK((in(bxcan::tsr)&0x81) == 0x80);
  station.wire.advance(60);
  CHECK((in(bxcan::tsr)&0x83) == 0x03);  // sent in spite of the request
  CHECK(station.peer.received.size() == 1);
  station.wire.disturb_frames(1, 20);
  request(0, standard_frame(0x200, {0x55}));
  station.wire.advance(10);
  out(bxcan::tsr, 0x80);
  station.wire.advance(200);
  CHECK((in(bxcan::tsr)&0x8B) == 0x09);  // not repeated after the error
  CHECK(station.peer.received.size() == 1);
}

TEST_CASE("bxcan: an abort of an empty mailbox has no effect") {
  Station station;
  out(bxcan::tsr, 0x808080);
  CHECK(in(bxcan::tsr) == 0x1C000000);
  for (const bool clears : {false, true}) {
    station.can.late_abort_clears_flags = clears;
    request(0, standard_frame(1));
    station.wire.advance(100);
    out(bxcan::tsr, 0x80);
    CHECK((in(bxcan::tsr)&0xFF) == (clears ? 0 : 3));
  }
}

// ---- Reception

TEST_CASE("bxcan: received frames are in the output mailbox until they are released") {
  Station station;
  out(bxcan::ier, 2);  // FMPIE0
  station.receive(standard_frame(0x123, {1, 2, 3, 4, 5}));
  CHECK(station.can.receive_interrupt(0));
  CHECK_FALSE(station.can.receive_interrupt(1));
  station.receive(extended_frame(0x01234567, {9}));
  CHECK(in(bxcan::rf0r) == 2);
  CHECK(in(bxcan::ri0r) == 0x123U << 21);
  CHECK((in(bxcan::ri0r + 4) & 0xFFFF) == 5);
  CHECK(in(bxcan::ri0r + 8) == 0x04030201);
  CHECK((in(bxcan::ri0r + 12) & 0xFF) == 5);
  out(bxcan::rf0r, 0x20);
  CHECK(in(bxcan::rf0r) == 1);
  CHECK(in(bxcan::ri0r) == ((0x01234567U << 3) | 4));
  CHECK((in(bxcan::ri0r + 8) & 0xFF) == 9);
  out(bxcan::rf0r, 0x20);
  CHECK(in(bxcan::rf0r) == 0);
  CHECK_FALSE(station.can.receive_interrupt(0));
  out(bxcan::rf0r, 0x20);  // no effect on an empty FIFO
  CHECK(in(bxcan::rf0r) == 0);
}

TEST_CASE("bxcan: RFOM stays set until the mailbox is released") {
  Station station;
  station.can.release_accesses = 1;
  station.receive(standard_frame(1));
  out(bxcan::rf0r, 0x20);
  CHECK(in(bxcan::rf0r) == 0x21);
  CHECK(in(bxcan::rf0r) == 0);
}

TEST_CASE("bxcan: a remote frame is received with RTR") {
  Station station;
  station.receive(remote_frame(standard_frame(0x701)));
  CHECK(in(bxcan::ri0r) == (0x701U << 21 | 2));
}

TEST_CASE("bxcan: a frame without a matching filter is acknowledged and discarded") {
  Station station;
  out(bxcan::fa1r, 0);
  station.receive(standard_frame(1));
  CHECK(station.wire.sent() == 1);
  CHECK(in(bxcan::rf0r) == 0);
}

TEST_CASE("bxcan: FINIT disables the reception") {
  Station station;
  out(bxcan::fmr, 0x2A1C0E01);
  station.receive(standard_frame(1));
  CHECK(in(bxcan::rf0r) == 0);
}

TEST_CASE("bxcan: an overrun overwrites the last message, or is discarded with RFLM") {
  for (const bool is_locked : {false, true}) {
    CAPTURE(is_locked);
    Station station(is_locked ? rflm : 0);
    out(bxcan::ier, 0x0C);  // FFIE0, FOVIE0
    station.receive(standard_frame(1));
    station.receive(standard_frame(2));
    CHECK_FALSE(station.can.receive_interrupt(0));
    station.receive(standard_frame(3));
    CHECK(in(bxcan::rf0r) == 0x0B);  // FULL0, 3 messages
    CHECK(station.can.receive_interrupt(0));
    out(bxcan::rf0r, 0x08);
    CHECK(in(bxcan::rf0r) == 0x03);
    CHECK_FALSE(station.can.receive_interrupt(0));
    station.receive(standard_frame(4));
    CHECK((in(bxcan::rf0r)&0x13) == 0x13);  // FOVR0
    CHECK(station.can.receive_interrupt(0));
    out(bxcan::rf0r, 0x18);
    CHECK(in(bxcan::rf0r) == 0x03);
    out(bxcan::rf0r, 0x20);
    out(bxcan::rf0r, 0x20);
    CHECK((in(bxcan::ri0r) >> 21) == (is_locked ? 3 : 4));
  }
}

// ---- Filters

namespace {

// A station whose filters are empty and in initialization mode.
struct Filters : Station {
  Filters() {
    out(bxcan::fmr, 0x2A1C0E01);
    out(bxcan::fa1r, 0);
    out(bxcan::fs1r, 0);
  }
  static void bank(unsigned number, bool is_long, bool is_list, unsigned fifo, std::uint32_t one, std::uint32_t two) {
    const auto put = [&](std::uint32_t offset, bool value) {
      const std::uint32_t bit = 1U << number;
      out(offset, value ? in(offset) | bit : in(offset) & ~bit);
    };
    put(bxcan::fs1r, is_long);
    put(bxcan::fm1r, is_list);
    put(bxcan::ffa1r, fifo != 0);
    out(bxcan::f0r1 + 8 * number, one);
    out(bxcan::f0r1 + 8 * number + 4, two);
    put(bxcan::fa1r, true);
  }
  static void begin() { out(bxcan::fmr, 0x2A1C0E00); }
  // Returns the filter match index, +100 for FIFO 1, or -1 if the frame was not received.
  int index(const CanFrame& frame) {
    receive(frame);
    for (unsigned fifo = 0; fifo < 2; ++fifo) {
      const std::uint32_t status = bxcan::rf0r + 4 * fifo;
      if ((in(status)&3) != 0) {
        const int match = static_cast<int>(in(bxcan::ri0r + 16 * fifo + 4) >> 8 & 0xFF);
        out(status, 0x20);
        return match + (fifo == 0 ? 0 : 100);
      }
    }
    return -1;
  }
};

}  // namespace

TEST_CASE("bxcan: 32-bit mask filter") {
  Filters filters;
  Filters::bank(0, true, false, 0, 0x12345678U << 3 | 4, 0x1FFFFF00U << 3 | 4);
  Filters::begin();
  CHECK(filters.index(extended_frame(0x12345678)) == 0);
  CHECK(filters.index(extended_frame(0x123456FF)) == 0);
  CHECK(filters.index(remote_frame(extended_frame(0x12345600))) == 0);  // RTR is not in the mask
  CHECK(filters.index(extended_frame(0x12345778)) == -1);
  CHECK(filters.index(standard_frame(0x12345678 >> 18)) == -1);  // IDE is in the mask
}

TEST_CASE("bxcan: 32-bit list filters") {
  Filters filters;
  Filters::bank(0, true, true, 0, 0x123U << 21, 0x01234567U << 3 | 4 | 2);
  Filters::begin();
  CHECK(filters.index(standard_frame(0x123)) == 0);
  CHECK(filters.index(remote_frame(standard_frame(0x123))) == -1);
  CHECK(filters.index(remote_frame(extended_frame(0x01234567))) == 1);
  CHECK(filters.index(extended_frame(0x01234567)) == -1);
}

TEST_CASE("bxcan: 16-bit mask filters") {
  Filters filters;
  // Identifier in the lower half, mask in the upper half: STID[10:0] RTR IDE EXID[17:15]
  Filters::bank(0, false, false, 1, 0x181U << 5 | (0x7F8U << 5 | 0x18U) << 16, (0x10U << 5 | 8U | 5U) | 0xFFFFU << 16);
  Filters::begin();
  CHECK(filters.index(standard_frame(0x187)) == 100);
  CHECK(filters.index(standard_frame(0x188)) == -1);
  CHECK(filters.index(remote_frame(standard_frame(0x181))) == -1);
  CHECK(filters.index(extended_frame(0x10U << 18 | 5U << 15 | 0x7FFF)) == 101);  // the lower 15 bits are not compared
  CHECK(filters.index(extended_frame(0x10U << 18 | 4U << 15)) == -1);
}

TEST_CASE("bxcan: 16-bit list filters") {
  Filters filters;
  Filters::bank(0, false, true, 0, 0x101U << 5 | (0x102U << 5) << 16, 0x103U << 5 | (0x104U << 5 | 0x10U) << 16);
  Filters::begin();
  CHECK(filters.index(standard_frame(0x101)) == 0);
  CHECK(filters.index(standard_frame(0x102)) == 1);
  CHECK(filters.index(standard_frame(0x103)) == 2);
  CHECK(filters.index(standard_frame(0x104)) == -1);
  CHECK(filters.index(remote_frame(standard_frame(0x104))) == 3);
}

TEST_CASE("bxcan: filter numbers of the example of the manual") {
  // RM0402, figure "Example of filter numbering"; banks 5, 7, 10 are deactivated.
  Filters filters;
  const auto list = [](unsigned id) { return id << 21; };
  const auto halves = [](unsigned low, unsigned high) { return low << 5 | high << 21; };
  Filters::bank(0, true, true, 0, list(0x10), list(0x11));
  Filters::bank(1, true, false, 0, list(0x12), 0xFFFFFFFE);
  Filters::bank(2, false, false, 1, 0x20 << 5 | 0xFFFF0000, 0x21 << 5 | 0xFFFF0000);
  Filters::bank(3, false, true, 0, halves(0x13, 0x14), halves(0x15, 0x16));
  Filters::bank(4, true, true, 1, list(0x22), list(0x23));
  Filters::bank(5, true, true, 0, list(0x17), list(0x18));
  Filters::bank(6, false, false, 0, 0x19 << 5 | 0xFFFF0000, 0x1A << 5 | 0xFFFF0000);
  Filters::bank(7, false, false, 1, 0x24 << 5 | 0xFFFF0000, 0x25 << 5 | 0xFFFF0000);
  Filters::bank(8, false, false, 1, 0x26 << 5 | 0xFFFF0000, 0x27 << 5 | 0xFFFF0000);
  Filters::bank(9, true, true, 0, list(0x1B), list(0x1C));
  Filters::bank(10, false, true, 1, halves(0x28, 0x29), halves(0x2A, 0x2B));
  Filters::bank(11, true, true, 1, list(0x2C), list(0x2D));
  Filters::bank(12, true, false, 1, list(0x2E), 0xFFFFFFFE);
  Filters::bank(13, true, false, 0, list(0x1D), 0xFFFFFFFE);
  out(bxcan::fa1r, in(bxcan::fa1r) & ~(1U << 5 | 1U << 7 | 1U << 10));
  Filters::begin();
  for (unsigned id = 0x10; id <= 0x1D; ++id) {
    const bool is_inactive = id == 0x17 || id == 0x18;
    CHECK(filters.index(standard_frame(id)) == (is_inactive ? -1 : static_cast<int>(id) - 0x10));
  }
  for (unsigned id = 0x20; id <= 0x2E; ++id) {
    const bool is_inactive = id == 0x24 || id == 0x25 || (id >= 0x28 && id <= 0x2B);
    CHECK(filters.index(standard_frame(id)) == (is_inactive ? -1 : 100 + static_cast<int>(id) - 0x20));
  }
}

TEST_CASE("bxcan: a matching filter of 32 bits precedes one of 16 bits then a list a mask then the lower number") {
  Filters filters;
  Filters::bank(0, false, false, 0, 0, 0);                                    // accepts all: 0, 1
  Filters::bank(1, false, true, 0, 0x101U << 5 | 0x102U << 21, 0x103U << 5);  // 2…5
  Filters::bank(2, true, false, 0, 0x102U << 21, 0xFFFFFFFF);                 // 6
  Filters::bank(3, true, true, 0, 0x103U << 21, 0x103U << 21);                // 7, 8
  Filters::bank(4, true, false, 0, 0x103U << 21, 0xFFFFFFFF);                 // 9
  Filters::begin();
  CHECK(filters.index(standard_frame(0x100)) == 0);
  CHECK(filters.index(standard_frame(0x101)) == 2);
  CHECK(filters.index(standard_frame(0x102)) == 6);
  CHECK(filters.index(standard_frame(0x103)) == 7);
}

TEST_CASE("bxcan: filter registers are protected") {
  Station station;  // FINIT = 0, bank 0 is active
  const auto faults = [&] {
    const std::size_t count = station.can.faults().size();
    station.can.clear_faults();
    return count;
  };
  out(bxcan::fm1r, 2);
  out(bxcan::fs1r, 3);
  out(bxcan::ffa1r, 1);
  CHECK(faults() == 3);
  CHECK(in(bxcan::fs1r) == 1);
  out(bxcan::f0r1, 5);
  CHECK(faults() == 1);
  CHECK(in(bxcan::f0r1) == 0);
  out(bxcan::f0r1 + 8, 5);  // an inactive bank
  CHECK(faults() == 0);
  CHECK(in(bxcan::f0r1 + 8) == 5);
  out(bxcan::fa1r, 0);
  out(bxcan::f0r1, 5);
  CHECK(faults() == 0);
  CHECK(in(bxcan::f0r1) == 5);
  out(bxcan::fa1r, 1U << 14);  // 14 banks
  CHECK(faults() == 1);
}

TEST_CASE("bxcan: master and slave share 28 banks") {
  CanWire wire;
  BxCan::Options options;
  options.filter_banks = 28;
  BxCan master(wire, can1, options);
  options.master = &master;
  BxCan slave(wire, can2, options);
  CanPeer peer(wire);
  initialize(wire, can1);
  initialize(wire, can2);
  out(bxcan::fmr, 0x2A1C0001 | 20U << 8);  // CAN2SB = 20
  out(bxcan::fs1r, 1U << 19 | 1U << 20);
  out(bxcan::fm1r, 1U << 19 | 1U << 20);
  out(bxcan::f0r1 + 8 * 19, 0x119U << 21);
  out(bxcan::f0r1 + 8 * 20, 0x120U << 21);
  out(bxcan::fa1r, 1U << 19 | 1U << 20);
  out(bxcan::fmr, 0x2A1C0000 | 20U << 8);
  run(wire, 0, can1);
  run(wire, 0, can2);
  peer.send(standard_frame(0x119));
  wire.advance(100);
  CHECK(in(bxcan::rf0r, can1) == 1);
  CHECK(in(bxcan::rf0r, can2) == 0);
  peer.send(standard_frame(0x120));
  wire.advance(100);
  CHECK(in(bxcan::rf0r, can1) == 1);
  CHECK(in(bxcan::rf0r, can2) == 1);
  CHECK((in(bxcan::ri0r + 4, can2) >> 8 & 0xFF) == 0);
  CHECK(master.faults().empty());
  CHECK(slave.faults().empty());
  in(bxcan::fmr, can2);
  CHECK(slave.faults().size() == 1);
}

// ---- Errors

TEST_CASE("bxcan: the last error code of each kind of error") {
  Station station;
  const auto lec = [] { return in(bxcan::esr) >> 4 & 7; };
  CHECK(lec() == 0);
  out(bxcan::esr, 0x70);
  CHECK(lec() == 7);
  request(0, standard_frame(0x155));
  station.wire.advance(100);
  CHECK(lec() == 0);
  station.wire.disturb_frames(1, frame_bits(standard_frame(0x155)) - 9, Kind::set_recessive);  // ACK slot
  request(0, standard_frame(0x155));
  station.wire.advance(50);
  CHECK(lec() == 3);
  station.wire.advance(100);
  const CanFrame frame = standard_frame(0x100, {0x00, 0xFF});
  station.wire.disturb_frames(1, 20, Kind::set_recessive);
  request(0, frame);
  station.wire.advance(23);
  CHECK(lec() == 5);  // bit dominant error: dominant was sent
  station.wire.advance(200);
  station.wire.disturb_frames(1, 32, Kind::set_dominant);
  request(0, frame);
  station.wire.advance(34);
  CHECK(lec() == 4);  // bit recessive error
  station.wire.advance(200);
  station.wire.disturb_frames(1, 20, Kind::set_dominant, 6, &station.can.node());
  station.peer.send(standard_frame(0x155, {0x55}));
  station.wire.advance(30);
  CHECK(lec() == 1);
}

TEST_CASE("bxcan: ERRI is set when an enabled error flag is set and not by its persistence") {
  Station station;
  out(bxcan::ier, 0x8000 | 0x100 | 0x200 | 0x400);  // ERRIE, EWGIE, EPVIE, BOFIE
  CHECK_FALSE(station.can.status_interrupt());
  station.can.node().set_counters(95, 0);
  CHECK(in(bxcan::esr) == 95U << 16);
  station.can.node().set_counters(96, 3);
  CHECK(in(bxcan::esr) == (3U << 24 | 96U << 16 | 1));
  CHECK((in(bxcan::msr)&erri) == erri);
  CHECK(station.can.status_interrupt());
  out(bxcan::msr, erri);
  CHECK_FALSE(station.can.status_interrupt());  // ERRI is set by events: the warning persists
  CHECK((in(bxcan::esr)&7) == 1);
  station.can.node().set_counters(0, 128);
  CHECK((in(bxcan::esr)&7) == 3);
  CHECK(station.can.status_interrupt());
  out(bxcan::msr, erri);
  station.can.node().set_counters(256, 0);
  CHECK((in(bxcan::esr)&7) == 7);
  CHECK(station.can.status_interrupt());
}

TEST_CASE("bxcan: ERRI needs the enable bit of the cause, the line needs ERRIE") {
  Station station;
  station.can.node().set_counters(100, 0);
  CHECK((in(bxcan::msr)&erri) == 0);
  out(bxcan::ier, 0x800);  // LECIE without ERRIE
  station.wire.disturb_frames(1, 25);
  request(0, standard_frame(1, {0x55}));
  station.wire.advance(30);
  CHECK((in(bxcan::msr)&erri) == erri);
  CHECK_FALSE(station.can.status_interrupt());
  out(bxcan::ier, 0x8800);
  CHECK(station.can.status_interrupt());
}

TEST_CASE("bxcan: without another node the controller becomes error passive and repeats") {
  CanWire wire;
  BxCan can(wire, can1);
  initialize(wire);
  out(bxcan::btr, 0);
  run(wire);
  request(0, standard_frame(1));
  wire.advance(20'000);
  CHECK(in(bxcan::esr) == (128U << 16 | 3U << 4 | 3));  // ACK error, EPVF, EWGF
  CHECK((in(bxcan::tsr)&0xF) == 8);                     // TERR0
  CanPeer peer(wire);
  wire.advance(200);
  CHECK(peer.received.size() == 1);
  CHECK((in(bxcan::tsr)&3) == 3);
  CHECK(can.faults().empty());
}

TEST_CASE("bxcan: bus-off lasts without ABOM until software enters and leaves initialization mode") {
  Station station;
  station.wire.disturb_frames(32, 25);
  request(0, standard_frame(1, {0x55}));
  REQUIRE(station.wire.advance_until([&] { return (in(bxcan::esr)&4) != 0; }));
  CHECK((in(bxcan::tsr)&0x04000000) == 0);  // the request is pending
  station.wire.advance(5000);
  CHECK((in(bxcan::esr)&4) == 4);
  out(bxcan::mcr, inrq);
  station.wire.advance(2);
  CHECK((in(bxcan::msr)&inak) == inak);
  out(bxcan::mcr, 0);
  station.wire.advance(13);
  CHECK((in(bxcan::msr)&inak) == 0);
  station.wire.advance(128 * 11 - 20);
  CHECK((in(bxcan::esr)&4) == 4);
  station.wire.advance(30);
  CHECK((in(bxcan::esr)&0xFFFF0007) == 0);
  station.wire.advance(200);
  CHECK(station.peer.received.size() == 1);
}

TEST_CASE("bxcan: with ABOM the recovery begins with bus-off") {
  Station station(abom);
  station.can.node().set_counters(256, 0);
  CHECK((in(bxcan::esr)&4) == 4);
  station.wire.advance(128 * 11 - 1);
  CHECK((in(bxcan::esr)&4) == 4);
  station.wire.advance(3);
  CHECK((in(bxcan::esr)&0xFFFF0007) == 0);
}

// ---- Test modes, time-triggered mode

TEST_CASE("bxcan: loopback receives own frames without acknowledgement, and drives the bus") {
  CanWire wire;
  BxCan can(wire, can1);
  CanPeer peer(wire);
  initialize(wire);
  out(bxcan::btr, 0x40000000);  // LBKM
  accept_all();
  run(wire);
  peer.send(standard_frame(0x7));
  wire.advance(100);
  CHECK(in(bxcan::rf0r) == 0);  // the receive pin is disregarded
  peer.cancel();
  wire.advance(100);
  request(0, standard_frame(0x5, {7}));
  wire.advance(100);
  CHECK((in(bxcan::tsr)&3) == 3);
  CHECK(in(bxcan::rf0r) == 1);
  CHECK(peer.received.size() == 1);
}

TEST_CASE("bxcan: loopback with silent mode does not touch the bus") {
  Station station(0, 0xC0000000);  // SILM, LBKM
  request(0, standard_frame(0x5, {7}));
  station.wire.advance(100);
  CHECK((in(bxcan::tsr)&3) == 3);
  CHECK(station.filling() == 1);
  CHECK(station.peer.received.empty());
  CHECK(station.peer.node().rec() == 0);
}

TEST_CASE("bxcan: silent mode receives, does not acknowledge, does not transmit") {
  Station station(0, 0x80000000);  // SILM
  CanPeer other(station.wire);
  station.wire.advance(11);
  request(0, standard_frame(0x5));
  station.receive(standard_frame(0x6));
  CHECK(station.filling() == 1);
  CHECK(station.wire.sent() == 1);
  CHECK((in(bxcan::tsr)&0x04000000) == 0);
}

TEST_CASE("bxcan: time stamps exist in time-triggered mode only") {
  Station station;
  station.wire.advance(1000);
  station.receive(standard_frame(1));
  CHECK((in(bxcan::ri0r + 4) >> 16) == 0);
  out(bxcan::rf0r, 0x20);
  out(bxcan::mcr, ttcm);
  station.wire.advance(1000);
  station.peer.send(standard_frame(1));
  station.wire.advance(1);
  station.wire.advance(100);
  CHECK((in(bxcan::ri0r + 4) >> 16) == 1000);
  request(0, standard_frame(2, {1, 2, 3, 4, 5, 6, 7, 8}), 0x100);  // TGT
  station.wire.advance(200);
  REQUIRE(station.peer.received.size() == 1);
  const CanFrame& frame = station.peer.received[0];
  const std::uint32_t time = in(bxcan::ti0r + 4) >> 16;
  CHECK(time == 1101);
  CHECK((frame.data[6] == 1101 >> 8 && frame.data[7] == (1101 & 0xFF)));
  CHECK(frame.data[5] == 6);
}

TEST_CASE("bxcan: an FD frame on the bus is destroyed") {
  Station station;
  CanPeer sender(station.wire, FdMode::enabled);
  station.wire.advance(11);
  sender.retransmits = false;
  sender.send(fd_frame(0x123, 15));
  station.wire.advance(1000);
  CHECK(station.wire.sent() == 0);
  CHECK(station.filling() == 0);
  CHECK((in(bxcan::esr) >> 24) != 0);
}

TEST_CASE("bxcan: register accesses take time on the wire if the test asks for it") {
  CanWire wire;
  BxCan can(wire, can1);
  wire.accesses_per_bit = 2;
  out(bxcan::mcr, inrq);
  unsigned reads = 0;
  while ((in(bxcan::msr)&inak) == 0) {
    REQUIRE(++reads < 10);
  }
  CHECK(wire.now() >= 1);
}
