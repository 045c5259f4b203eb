// SPDX-License-Identifier: Apache-2.0
// Mailboxes and Rx FIFO of the FlexCAN model. Section names are those of the chapter "FlexCAN" of K20 and KE1xF
// reference manuals.
#include <doctest/doctest.h>

#include "flexcan_station.hpp"

using namespace test;
using Station = FlexCanStation;

namespace {

constexpr std::uint32_t mrp = 1U << 18;
constexpr std::uint32_t rrs = 1U << 17;
constexpr std::uint32_t eacen = 1U << 16;
constexpr std::uint32_t available = 1U << 5;
constexpr std::uint32_t warning = 1U << 6;
constexpr std::uint32_t overflow = 1U << 7;

std::uint32_t in(std::uint32_t offset) { return Station::in(offset); }
void out(std::uint32_t offset, std::uint32_t value) { Station::out(offset, value); }
void clear(std::uint32_t flags) { out(flexcan::iflag1, flags); }

// A controller whose Rx FIFO has 8 equal filter elements; mailboxes begin with 8.
struct FifoStation : Station {
  explicit FifoStation(std::uint32_t element, std::uint32_t idam = 0, std::uint32_t ctrl2 = 0,
                       std::uint32_t more = irmq, const FlexCan::Options& options = FlexCan::imx6())
      : Station(rfen | srxdis | aen | 15 | idam << 8 | more, 0, ctrl2, options) {
    for (unsigned i = 0; i < 8; ++i) {
      set_filter(i, element);
    }
  }
  static void set_filter(unsigned index, std::uint32_t element) { out(flexcan::filters + 4 * index, element); }

  // Returns whether the frame is stored in the Rx FIFO, and removes it.
  bool accepts(const CanFrame& frame) {
    receive(frame);
    const bool is_stored = (flags() & available) != 0;
    clear(available);
    return is_stored;
  }
};

}  // namespace

// ---- Transmission

TEST_CASE("flexcan mailbox: a data frame is sent, stamped and reported [Transmit process]") {
  Station station;
  station.start();
  out(flexcan::timer, 0x1000);
  station.send(8, extended_frame(0x12345678, {1, 2, 3, 4, 5, 6, 7, 8}));
  out(flexcan::imask1, 0x100);
  CHECK_FALSE(station.can.interrupt());
  station.wire.advance(160);
  REQUIRE(station.peer.received.size() == 1);
  CHECK(station.peer.received[0] == extended_frame(0x12345678, {1, 2, 3, 4, 5, 6, 7, 8}));
  CHECK(station.word(8, 0) == (0x08680000 | 0x1002));
  CHECK(station.flags() == 0x100);
  CHECK(station.can.mailbox_interrupt());
  clear(0x100);
  CHECK_FALSE(station.can.interrupt());
}

TEST_CASE("flexcan mailbox: flags of mailboxes 32 to 63 are in IFLAG2") {
  Station station(Station::srxdis | Station::irmq | 63);
  station.start();
  station.send(63, standard_frame(1));
  out(flexcan::imask2, 1U << 31);
  station.wire.advance(100);
  CHECK(station.flags() == 0);
  CHECK(in(flexcan::iflag2) == 1U << 31);
  CHECK(station.can.interrupt());
  out(flexcan::iflag2, 1U << 31);
  CHECK(in(flexcan::iflag2) == 0);
}

TEST_CASE("flexcan mailbox: mailboxes beyond MAXMB do not take part [MCR, field MAXMB]") {
  Station station;
  station.start();
  station.send(16, standard_frame(1));
  station.listen(17, standard_frame(2));
  station.receive(standard_frame(2));
  CHECK(station.wire.sent() == 1);
  CHECK(station.code(17) == Station::empty);
}

TEST_CASE("flexcan mailbox: a DLC above 8 sends 8 bytes [Arbitration process]") {
  Station station;
  station.start();
  CanFrame frame = standard_frame(1, {1, 2, 3, 4, 5, 6, 7, 8});
  frame.dlc = 12;
  station.send(8, frame);
  station.wire.advance(160);
  REQUIRE(station.peer.received.size() == 1);
  CHECK(station.peer.received[0] == frame);
}

TEST_CASE("flexcan mailbox: the order of transmission [Arbitration process]") {
  struct Case {
    const char* name;
    std::uint32_t mcr;
    std::uint32_t ctrl1;
    std::vector<std::uint32_t> order;
  };
  const std::vector<Case> cases{
      {"identifier, then mailbox", 0, 0, {0x100, 0x100, 0x200, 0x300}},
      {"LPRIOEN", Station::lprioen, 0, {0x300, 0x100, 0x200, 0x100}},
      {"LBUF", 0, 0x10, {0x300, 0x200, 0x100, 0x100}},
      {"LBUF overrides LPRIOEN", Station::lprioen, 0x10, {0x300, 0x200, 0x100, 0x100}},
  };
  for (const Case& one : cases) {
    CAPTURE(one.name);
    Station station(15 | Station::srxdis | one.mcr, one.ctrl1);
    station.start();
    station.peer.send(standard_frame(0));  // occupies the bus
    station.wire.advance(5);
    station.send(8, standard_frame(0x300), 0);
    station.send(9, standard_frame(0x200), 2);
    station.send(10, standard_frame(0x100, {10}), 1);
    station.send(11, standard_frame(0x100, {11}), 3);
    station.wire.advance(500);
    std::vector<std::uint32_t> order;
    std::vector<unsigned> numbers;  // of the mailboxes with equal identifiers
    for (const CanFrame& frame : station.peer.received) {
      order.push_back(frame.id);
      if (frame.id == 0x100) {
        numbers.push_back(frame.data[0]);
      }
    }
    CHECK(order == one.order);
    CHECK(numbers == std::vector<unsigned>{10, 11});
  }
}

TEST_CASE("flexcan mailbox: a lost arbitration or an error is repeated [Arbitration process]") {
  Station station;
  station.start();
  station.peer.send(standard_frame(0x10));
  station.wire.advance(5);
  station.peer.send(standard_frame(0x11));
  station.send(8, standard_frame(0x100));
  station.wire.disturb_frames(1, 30);
  station.wire.advance(400);
  CHECK(station.wire.sent() == 3);
  CHECK(station.code(8) == Station::inactive);
}

TEST_CASE("flexcan mailbox: a waiting mailbox is aborted at once [Transmission abort mechanism]") {
  Station station;
  station.start();
  station.peer.send(standard_frame(0x10));
  station.wire.advance(5);
  station.send(8, standard_frame(0x100));
  station.set_word(8, 0, Station::abort << 24);
  CHECK(station.code(8) == Station::abort);
  CHECK(station.flags() == 0x100);
  station.wire.advance(200);
  CHECK(station.wire.sent() == 1);
  clear(0x100);
  station.send(8, standard_frame(0x101));
  station.wire.advance(100);
  CHECK(station.wire.sent() == 2);
}

TEST_CASE("flexcan mailbox: an abort during the transmission is pending [Transmission abort mechanism]") {
  for (const bool is_disturbed : {false, true}) {
    CAPTURE(is_disturbed);
    Station station;
    station.start();
    if (is_disturbed) {
      station.wire.disturb_frames(1, 30);
    }
    station.send(8, standard_frame(0x100, {1}));
    station.wire.advance(10);
    station.set_word(8, 0, Station::abort << 24);
    CHECK(station.code(8) == Station::data);
    CHECK(station.flags() == 0);
    station.wire.advance(300);
    CHECK(station.code(8) == (is_disturbed ? Station::abort : Station::inactive));
    CHECK(station.flags() == 0x100);
    CHECK(station.wire.sent() == (is_disturbed ? 0 : 1));
  }
}

TEST_CASE("flexcan mailbox: a lost arbitration completes a pending abort [Transmission abort mechanism]") {
  Station station;
  station.start();
  station.peer.send(standard_frame(0x10));
  station.send(8, standard_frame(0x100));
  station.wire.advance(2);
  station.set_word(8, 0, Station::abort << 24);
  station.wire.advance(200);
  CHECK(station.code(8) == Station::abort);
  CHECK(station.wire.sent() == 1);
}

TEST_CASE("flexcan mailbox: with AEN a mailbox is blocked while its flag is set [Transmit process]") {
  Station station;
  station.start();
  station.send(8, standard_frame(0x100));
  station.wire.advance(100);
  const std::uint32_t before = station.word(8, 0);
  station.set_word(8, 0, Station::abort << 24);  // an abort that is late
  CHECK(station.faults() == 0);
  station.set_word(8, 0, Station::data << 24);
  station.set_word(8, 1, 0);
  CHECK(station.faults() == 2);
  CHECK(station.word(8, 0) == before);
  station.wire.advance(100);
  CHECK(station.wire.sent() == 1);
}

TEST_CASE("flexcan mailbox: with AEN an active mailbox must be aborted [Transmission abort mechanism]") {
  Station station;
  station.start();
  station.peer.send(standard_frame(0x10));
  station.wire.advance(5);
  station.send(8, standard_frame(0x100));
  station.set_word(8, 0, Station::inactive << 24);
  station.set_word(8, 0, Station::data << 24);
  station.set_word(8, 1, 0);
  station.set_word(8, 2, 0);
  CHECK(station.faults() == 4);
  station.wire.advance(200);
  CHECK(station.wire.sent_frames().back() == standard_frame(0x100));
}

TEST_CASE("flexcan mailbox: without AEN an inactivated frame may be sent without notice [Mailbox inactivation]") {
  Station station(15 | Station::srxdis);
  station.start();
  station.send(8, standard_frame(0x100));
  station.wire.advance(10);
  station.set_word(8, 0, Station::inactive << 24);
  station.wire.advance(200);
  CHECK(station.wire.sent() == 1);
  CHECK(station.flags() == 0);
  CHECK(station.code(8) == Station::inactive);
  station.set_word(8, 0, Station::abort << 24);
  CHECK(station.faults() == 1);  // ABORT without AEN
}

TEST_CASE(
    "flexcan mailbox: a C/S word with a wrong code, reserved bits, or without SRR is a fault [Message buffer "
    "structure]") {
  Station station;
  station.start();
  station.set_word(8, 0, Station::full << 24);
  station.set_word(8, 0, 5U << 24);
  station.set_word(8, 0, 1U << 31);
  station.set_word(8, 0, 1U << 23);
  station.set_word(8, 0, Station::data << 24 | 1U << 21);
  CHECK(station.faults() == 5);
}

// ---- Remote frames

TEST_CASE("flexcan mailbox: a sent remote frame makes the mailbox empty [Remote frames]") {
  Station station;
  station.start();
  station.send(8, remote_frame(standard_frame(0x123), 2));
  station.wire.advance(100);
  CHECK(station.wire.sent_frames().back().is_remote);
  CHECK(station.code(8) == Station::empty);
  CHECK(station.flags() == 0x100);
  clear(0x100);
  station.receive(standard_frame(0x123, {7, 8}));
  CHECK(station.code(8) == Station::full);
}

TEST_CASE("flexcan mailbox: RANSWER answers remote frames with its exact identifier [Remote frames]") {
  Station station;
  out(flexcan::rximr + 4 * 8, 0);
  station.send(8, standard_frame(0x123, {1, 2}), 0, Station::ranswer);
  station.listen(9, standard_frame(0x124));
  station.start();
  station.receive(remote_frame(standard_frame(0x122)));
  station.receive(remote_frame(extended_frame(0x123 << 18)));
  CHECK(station.code(8) == Station::ranswer);
  station.receive(remote_frame(standard_frame(0x124)));
  CHECK(station.code(9) == Station::empty);  // remote frames are not stored without RRS
  station.receive(remote_frame(standard_frame(0x123)));
  CHECK(station.code(8) == 14);
  station.wire.advance(100);
  CHECK(station.wire.sent_frames().back() == standard_frame(0x123, {1, 2}));
  CHECK(station.code(8) == Station::ranswer);
  CHECK(station.flags() == 0x100);
}

TEST_CASE("flexcan mailbox: RRS stores remote frames [CTRL2, field RRS]") {
  Station station(15 | Station::srxdis | Station::irmq, 0, rrs);
  station.send(8, standard_frame(0x123, {1, 2}), 0, Station::ranswer);
  station.listen(9, standard_frame(0x123));
  station.start();
  station.receive(remote_frame(standard_frame(0x123), 3));
  CHECK((station.word(9, 0) & 0xFFFF0000) == (Station::full << 24 | 0x00130000));
  station.wire.advance(200);
  CHECK(station.wire.sent() == 1);
}

// ---- Reception

TEST_CASE("flexcan mailbox: a frame is stored with its time stamp [Receive process]") {
  Station station;
  out(flexcan::rximr + 4 * 8, 0x1C000000);
  station.set_word(8, 1, 0x10000000);
  station.set_word(8, 0, Station::empty << 24 | 1U << 21);
  station.start();
  out(flexcan::timer, 0);
  station.receive(extended_frame(0x12345678, {1, 2, 3, 4, 5}));
  CHECK(station.flags() == 0x100);
  CHECK(station.word(8, 0) == (Station::full << 24 | 0x00650002));
  CHECK(station.word(8, 1) == 0x12345678);
  CHECK(station.word(8, 2) == 0x01020304);
  CHECK((station.word(8, 3) >> 24) == 5);
}

TEST_CASE("flexcan mailbox: IRMQ selects individual masks, or RXMGMASK, RX14MASK and RX15MASK [MCR, field IRMQ]") {
  for (const bool is_individual : {false, true}) {
    CAPTURE(is_individual);
    Station station(15 | Station::srxdis | (is_individual ? Station::irmq : 0));
    out(flexcan::rxmgmask, 0x1FC00000);
    out(flexcan::rx14mask, 0x1F000000);
    out(flexcan::rx15mask, 0);
    station.set_word(13, 1, 0x100 << 18 | 0x3FFFF);  // standard frames do not use the low bits
    station.set_word(13, 0, Station::empty << 24);
    station.listen(14, standard_frame(0x200));
    station.listen(15, standard_frame(0x300));
    station.start();
    station.receive(standard_frame(0x10F));
    station.receive(standard_frame(0x23F));
    station.receive(standard_frame(0x7FF));
    CHECK(station.flags() == (is_individual ? 0 : 0xE000));
    station.receive(standard_frame(0x100));
    CHECK((station.flags() & 0x2000) == 0x2000);
    clear(0xE000);
    station.receive(extended_frame(0x100 << 18));  // IDE is compared without a mask
    CHECK(station.flags() == 0);
  }
}

TEST_CASE("flexcan mailbox: EACEN compares RTR and lets masks disable IDE [CTRL2, field EACEN]") {
  for (const bool is_on : {false, true}) {
    CAPTURE(is_on);
    Station station(15 | Station::srxdis | Station::irmq, 0, rrs | (is_on ? eacen : 0));
    out(flexcan::rximr + 4 * 8, 0xDFFFFFFF & ~(1U << 30));
    station.listen(8, standard_frame(0x123));
    station.listen(9, remote_frame(standard_frame(0x124)));
    station.start();
    station.receive(extended_frame(0x123 << 18));
    CHECK(((station.flags() & 0x100) != 0) == is_on);
    station.receive(standard_frame(0x124));
    CHECK(((station.flags() & 0x200) != 0) == !is_on);
  }
}

TEST_CASE(
    "flexcan mailbox: FULL becomes OVERRUN unless the mailbox was read and unlocked [Message buffer code for Rx "
    "buffers]") {
  Station station;
  station.listen(8, standard_frame(0x123));
  station.start();
  station.receive(standard_frame(0x123, {1}));
  station.receive(standard_frame(0x123, {2}));
  CHECK(station.code(8) == Station::overrun);  // locks
  in(flexcan::timer);                          // unlocks
  station.receive(standard_frame(0x123, {3}));
  CHECK(station.code(8) == Station::full);
  CHECK((station.word(8, 2) >> 24) == 3);
  in(flexcan::timer);
  station.receive(standard_frame(0x123, {4}));
  CHECK(station.code(8) == Station::full);
  in(flexcan::timer);
  station.receive(standard_frame(0x123, {5}));
  station.receive(standard_frame(0x123, {6}));
  station.receive(standard_frame(0x123, {7}));
  CHECK(station.code(8) == Station::overrun);
}

TEST_CASE("flexcan mailbox: a locked mailbox receives when it is unlocked [Mailbox lock mechanism]") {
  for (const bool is_other : {false, true}) {
    CAPTURE(is_other);
    Station station;
    station.listen(8, standard_frame(0x123));
    station.start();
    station.receive(standard_frame(0x123, {1}));
    clear(0x100);
    CHECK(station.code(8) == Station::full);
    station.receive(standard_frame(0x123, {2}));
    station.receive(standard_frame(0x123, {3}));  // replaces the message that waits
    CHECK(station.flags() == 0);
    CHECK((station.word(8, 2) >> 24) == 1);
    CHECK(station.can.lost_frames() == 1);
    if (is_other) {
      station.word(9, 0);
    } else {
      in(flexcan::timer);
    }
    CHECK(station.flags() == 0x100);
    CHECK(station.code(8) == Station::full);
    CHECK((station.word(8, 2) >> 24) == 3);
    clear(0x100);
    in(flexcan::timer);
    CHECK(station.flags() == 0);
  }
}

TEST_CASE("flexcan mailbox: inactivation drops the message that waits for a locked mailbox [Mailbox lock mechanism]") {
  Station station;
  station.listen(8, standard_frame(0x123));
  station.start();
  station.receive(standard_frame(0x123, {1}));
  station.word(8, 0);
  station.receive(standard_frame(0x123, {2}));
  station.set_word(8, 0, 0);
  in(flexcan::timer);
  CHECK(station.code(8) == 0);
  CHECK(station.can.lost_frames() == 1);
}

TEST_CASE("flexcan mailbox: an empty mailbox is locked without IRMQ only [MCR, field IRMQ]") {
  for (const bool is_queue : {false, true}) {
    CAPTURE(is_queue);
    Station station(15 | Station::srxdis | (is_queue ? Station::irmq : 0));
    station.listen(8, standard_frame(0x123));
    station.start();
    station.word(8, 0);
    station.receive(standard_frame(0x123, {1}));
    CHECK((station.flags() == 0x100) == is_queue);
    in(flexcan::timer);
    CHECK(station.flags() == 0x100);
    CHECK(station.code(8) == Station::full);
  }
}

TEST_CASE("flexcan mailbox: data is read after the C/S word [Receive process]") {
  Station station;
  station.listen(8, standard_frame(0x123));
  station.start();
  station.receive(standard_frame(0x123, {1}));
  station.word(8, 2);
  CHECK(station.faults() == 1);
  station.word(8, 0);
  station.word(8, 2);
  CHECK(station.faults() == 0);
}

TEST_CASE("flexcan mailbox: ID and data of an active mailbox are not written [Receive process]") {
  Station station;
  station.listen(8, standard_frame(0x123));
  station.start();
  station.set_word(8, 1, 0);
  CHECK(station.faults() == 1);
  station.set_word(8, 0, 0);
  station.set_word(8, 1, 0);
  CHECK(station.faults() == 0);
}

TEST_CASE("flexcan mailbox: a frame is lost if the C/S word is written during the reception [Mailbox inactivation]") {
  Station station;
  station.listen(8, standard_frame(0x123));
  station.start();
  station.peer.send(standard_frame(0x123, {1}));
  station.wire.advance(30);
  station.set_word(8, 0, Station::empty << 24);
  station.wire.advance(100);
  CHECK(station.flags() == 0);
  CHECK(station.can.lost_frames() == 1);
  station.receive(standard_frame(0x123, {2}));
  CHECK(station.flags() == 0x100);
}

TEST_CASE("flexcan mailbox: IRMQ makes mailboxes with equal filters a queue [Matching process]") {
  for (const bool is_queue : {false, true}) {
    CAPTURE(is_queue);
    Station station(15 | Station::srxdis | (is_queue ? Station::irmq : 0));
    station.listen(8, standard_frame(0x123));
    station.listen(9, standard_frame(0x123));
    station.start();
    station.receive(standard_frame(0x123, {1}));
    station.receive(standard_frame(0x123, {2}));
    CHECK(station.flags() == (is_queue ? 0x300U : 0x100U));
    station.receive(standard_frame(0x123, {3}));
    CHECK(station.code(8) == (is_queue ? Station::full : Station::overrun));
    CHECK(station.code(9) == (is_queue ? Station::overrun : Station::empty));
    in(flexcan::timer);
    station.receive(standard_frame(0x123, {4}));  // mailbox 8 was serviced
    CHECK(station.code(8) == Station::full);
    CHECK((station.word(8, 2) >> 24) == 4);
  }
}

TEST_CASE("flexcan mailbox: TSYN resets the timer with the first mailbox [CTRL1, field TSYN]") {
  Station station(15 | Station::srxdis | Station::irmq, 0x20);
  station.listen(0, standard_frame(0x123));
  station.listen(1, standard_frame(0x124));
  station.start();
  out(flexcan::timer, 0x4000);
  station.receive(standard_frame(0x124));
  CHECK(in(flexcan::timer) > 0x4000);
  station.receive(standard_frame(0x123));
  CHECK(in(flexcan::timer) < 10);
}

// ---- Rx FIFO

TEST_CASE("flexcan FIFO: messages are read in order; clearing BUF5I releases one [Rx FIFO]") {
  for (const unsigned version : {2U, 3U}) {
    CAPTURE(version);
    FlexCan::Options options = FlexCan::imx6();
    options.version = version;
    FifoStation station(0, 0, 0, Station::irmq, options);
    for (unsigned i = 0; i < 8; ++i) {
      station.set_filter(i, (0x100 + i) << 19);
    }
    station.start();
    out(flexcan::imask1, available);
    station.receive(standard_frame(0x103, {1, 2, 3, 4, 5, 6, 7, 8}));
    station.receive(standard_frame(0x105, {9}));
    station.receive(standard_frame(0x108));
    CHECK(station.flags() == available);
    CHECK(station.can.interrupt());
    CHECK((station.word(0, 0) & 0xFFFF0000) == (0x00080000 | (version == 3 ? 3U << 23 : 0)));
    CHECK(station.word(0, 1) == 0x103 << 18);
    CHECK(station.word(0, 2) == 0x01020304);
    CHECK(station.word(0, 3) == 0x05060708);
    CHECK(in(flexcan::rxfir) == 3);
    clear(available);
    CHECK(station.flags() == available);
    CHECK(in(flexcan::rxfir) == 5);
    CHECK((station.word(0, 2) >> 24) == 9);
    clear(available);
    CHECK(station.flags() == 0);
    CHECK_FALSE(station.can.interrupt());
    in(flexcan::rxfir);
    station.word(0, 0);
    CHECK(station.faults() == 2);  // nothing is available
  }
}

TEST_CASE("flexcan FIFO: the fifth message warns, the seventh overflows [register IFLAG1]") {
  FifoStation station(0x123 << 19);
  station.start();
  for (std::uint8_t i = 1; i <= 4; ++i) {
    station.receive(standard_frame(0x123, {i}));
  }
  CHECK(station.flags() == available);
  station.receive(standard_frame(0x123, {5}));
  CHECK(station.flags() == (available | warning));
  clear(warning);
  station.receive(standard_frame(0x123, {6}));
  CHECK(station.flags() == available);
  station.receive(standard_frame(0x123, {7}));
  CHECK(station.flags() == (available | overflow));
  clear(overflow);
  for (std::uint32_t i = 1; i <= 6; ++i) {
    CHECK((station.word(0, 2) >> 24) == i);
    clear(available);
  }
  CHECK(station.flags() == 0);
}

TEST_CASE("flexcan FIFO: format A compares RTR, IDE and the identifier [Rx FIFO structure]") {
  FifoStation station(0x123 << 19 | 0x7FFFE);  // standard frames do not use the low bits
  station.set_filter(1, 1U << 30 | 0x12345678 << 1);
  station.set_filter(2, 1U << 31 | 0x124 << 19);
  station.start();
  CHECK(station.accepts(standard_frame(0x123)));
  CHECK_FALSE(station.accepts(standard_frame(0x122)));
  CHECK_FALSE(station.accepts(remote_frame(standard_frame(0x123))));
  CHECK_FALSE(station.accepts(extended_frame(0x123 << 18)));
  CHECK(station.accepts(extended_frame(0x12345678)));
  CHECK_FALSE(station.accepts(extended_frame(0x12345679)));
  CHECK_FALSE(station.accepts(standard_frame(0x124)));
  CHECK(station.accepts(remote_frame(standard_frame(0x124))));
}

TEST_CASE("flexcan FIFO: format B has two filters in an element [Rx FIFO structure]") {
  FifoStation station(0x123 << 19 | 0x124 << 3 | 0x00070007, 1);
  station.set_filter(1, 0x40000000 | (0x12345678U >> 15) << 16 | 0x8000 | 0x125 << 3);
  station.start();
  station.receive(standard_frame(0x124));
  CHECK(in(flexcan::rxfir) == 1);
  clear(available);
  station.receive(extended_frame(0x12340000 | 0x5678));
  CHECK(in(flexcan::rxfir) == 2);
  clear(available);
  CHECK(station.accepts(extended_frame(0x12345678 ^ 0x7FFF)));
  CHECK_FALSE(station.accepts(extended_frame(0x12345678 ^ 0x8000)));
  CHECK(station.accepts(standard_frame(0x123)));
  CHECK_FALSE(station.accepts(standard_frame(0x125)));
  CHECK(station.accepts(remote_frame(standard_frame(0x125))));
}

TEST_CASE("flexcan FIFO: format C has four filters of eight bits [Rx FIFO structure]") {
  FifoStation station(0x10203040, 2);
  station.start();
  for (std::uint32_t i = 0; i < 4; ++i) {
    station.receive(standard_frame((0x10 + 0x10 * i) << 3 | 7));
    CHECK(in(flexcan::rxfir) == i);
    clear(available);
  }
  CHECK(station.accepts(extended_frame(0x20 << 21 | 0x1FFFFF)));
  CHECK(station.accepts(remote_frame(standard_frame(0x30 << 3))));
  CHECK_FALSE(station.accepts(standard_frame(0x50 << 3)));
}

TEST_CASE("flexcan FIFO: format D rejects all frames [MCR, field IDAM]") {
  FifoStation station(0, 3);
  for (unsigned i = 0; i < 8; ++i) {
    out(flexcan::rximr + 4 * i, 0);
  }
  station.start();
  CHECK_FALSE(station.accepts(standard_frame(0x123)));
}

TEST_CASE("flexcan FIFO: RXIMR mask the first elements, RXFGMASK the others [CTRL2, field RFFN]") {
  for (const bool is_individual : {false, true}) {
    CAPTURE(is_individual);
    // RFFN 1: 16 elements in mailboxes 6 to 9; RXIMR0…9 belong to elements 0…9
    FifoStation station(0x100 << 19, 0, 1U << 24, is_individual ? Station::irmq : 0);
    for (unsigned i = 8; i < 16; ++i) {
      station.set_filter(i, (i == 9 ? 0x200U : i == 10 ? 0x300U : 0x100U) << 19);
    }
    out(flexcan::rximr + 4 * 9, 0xFF800000);
    out(flexcan::rximr + 4 * 10, 0);
    out(flexcan::rxfgmask, 0xFFC00000);
    station.listen(10, standard_frame(0x7FF));
    station.start();
    CHECK(station.accepts(standard_frame(0x20F)) == is_individual);
    CHECK(station.accepts(standard_frame(0x307)));
    CHECK_FALSE(station.accepts(standard_frame(0x308)));
    CHECK(station.accepts(standard_frame(0x107)) == true);
    CHECK(station.faults() == 0);
  }
}

TEST_CASE("flexcan FIFO: the filter table is within MAXMB [CTRL2, field RFFN]") {
  Station station(Station::rfen | Station::irmq | Station::srxdis | 15, 0, 5U << 24);
  station.start();
  CHECK(station.faults() == 1);
}

TEST_CASE("flexcan FIFO: matching possibilities [Matching process, table]") {
  enum Mailbox { none, vacant, used };
  enum Result { lost, to_fifo, to_mailbox, overruns };
  struct Case {
    bool is_queue;
    bool is_mailbox_first;
    Mailbox mailbox;
    bool is_full;
    Result result;
  };
  const std::vector<Case> cases{{false, false, used, false, to_fifo},
                                {false, false, none, true, lost},
                                {false, false, vacant, true, to_mailbox},
                                {false, false, used, true, overruns},
                                {false, true, none, false, to_fifo},
                                {false, true, none, true, lost},
                                {false, true, vacant, false, to_mailbox},
                                {false, true, used, false, overruns},
                                {true, false, vacant, false, to_fifo},
                                {true, false, none, true, lost},
                                {true, false, vacant, true, to_mailbox},
                                {true, false, used, true, overruns},
                                {true, true, none, false, to_fifo},
                                {true, true, vacant, true, to_mailbox},
                                {true, true, used, false, to_fifo},
                                {true, true, used, true, overruns},
                                {true, true, none, true, lost}};
  for (const Case& one : cases) {
    CAPTURE(&one - cases.data());
    FifoStation station(0x100 << 19, 0, one.is_mailbox_first ? mrp : 0, one.is_queue ? Station::irmq : 0);
    station.set_filter(1, 0x200 << 19);
    station.listen(8, standard_frame(one.mailbox == none ? 0x7FF : 0x100));
    out(flexcan::rximr + 4 * 8, 0xFFFFFFFF & ~(1U << 18));
    out(flexcan::rx14mask, 0xFFFFFFFF);
    out(flexcan::rxmgmask, 0xFFFFFFFF & ~(1U << 18));
    station.start();
    if (one.mailbox == used) {
      station.receive(standard_frame(0x101));  // matches the mailbox only
    }
    for (int i = 0; i < (one.is_full ? 6 : 0); ++i) {
      station.receive(standard_frame(0x200));
    }
    const std::uint32_t before = station.flags() & ~warning;
    station.receive(standard_frame(0x100));
    const std::uint32_t changed = (station.flags() & ~warning) ^ before;
    const std::uint32_t expected[] = {overflow, available, 0x100, 0};
    CHECK(changed == expected[one.result]);
    CHECK((station.code(8) == Station::overrun) == (one.result == overruns));
  }
}

TEST_CASE("flexcan FIFO: a remote frame that matches a filter is stored, not answered [Remote frames]") {
  FifoStation station(1U << 31 | 0x123 << 19);
  station.send(8, standard_frame(0x123, {1}), 0, Station::ranswer);
  station.send(9, standard_frame(0x124, {1}), 0, Station::ranswer);
  station.start();
  station.receive(remote_frame(standard_frame(0x123)));
  CHECK(station.flags() == available);
  CHECK(station.code(8) == Station::ranswer);
  station.receive(remote_frame(standard_frame(0x124)));
  CHECK(station.code(9) == 14);
}

TEST_CASE("flexcan FIFO: its region is accessed as the manual allows [Rx FIFO structure]") {
  FifoStation station(0x123 << 19);
  station.set_word(0, 0, 0);
  in(flexcan::mailbox + 0x10);
  CHECK(station.faults() == 2);
  station.start();
  station.set_filter(0, 0);
  CHECK(station.faults() == 1);
  CHECK(in(flexcan::filters) == 0x123 << 19);
  station.send(8, standard_frame(1));  // the first mailbox
  CHECK(station.faults() == 0);
}

TEST_CASE("flexcan FIFO: BUF0I clears it in Freeze mode [register IFLAG1]") {
  FifoStation station(0x123 << 19);
  station.start();
  station.receive(standard_frame(0x123));
  station.receive(standard_frame(0x123));
  clear(1);
  CHECK(station.faults() == 1);
  station.stop();
  clear(1);
  CHECK(station.flags() == 0);
}

TEST_CASE("flexcan FIFO: flags of its region are cleared before RFEN changes [register IFLAG1]") {
  Station station;
  station.listen(3, standard_frame(0x123));
  station.start();
  station.receive(standard_frame(0x123));
  station.stop();
  out(flexcan::mcr, Station::freeze | station.modes | Station::rfen);
  CHECK(station.faults() == 1);
  out(flexcan::mcr, Station::freeze | station.modes);
  clear(8);
  out(flexcan::mcr, Station::freeze | station.modes | Station::rfen);
  CHECK(station.faults() == 0);
}

TEST_CASE("flexcan FIFO: the filter table and its masks must be initialised") {
  CanWire wire;
  FlexCan can(wire, Station::base, FlexCan::imx6());
  out(flexcan::ctrl1, Station::timing);
  out(flexcan::mcr, Station::freeze | Station::rfen | Station::irmq | 8);
  out(flexcan::mailbox + 8 * 16, 0);
  out(flexcan::mcr, Station::rfen | Station::irmq | 8);
  wire.advance(1);
  CHECK(can.faults().size() == 2);
}
