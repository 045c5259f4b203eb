// SPDX-License-Identifier: Apache-2.0
// Tx buffers, Tx FIFO, Tx queue and Tx event FIFO of the M_CAN model. Values are written as in the M_CAN user's manual.
#include "m_can_station.hpp"

using namespace test;

namespace {

constexpr std::array<MCanLayout, 2> layouts = {MCanLayout::fixed, MCanLayout::configurable};
constexpr std::uint32_t dar = 0x40;
constexpr std::uint32_t queue = 1U << 24;  // MCanStation sets the bit of its layout

std::uint32_t txfqs(unsigned free, unsigned get, unsigned put) { return free | get << 8 | put << 16; }

}  // namespace

TEST_CASE("m_can transmit: a requested buffer is sent") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.start();
    const unsigned first = station.first_fifo_buffer();
    const CanFrame frame = extended_frame(0x1ABCDE12, {1, 2, 3, 4, 5, 6, 7, 8});
    station.request(first, frame);
    CHECK(station.in(R::txbrp) == 1U << first);
    CHECK(station.in(R::txbto) == 0);
    CHECK(station.in(R::txfqs) == txfqs(2, first, first + 1));
    station.wire.advance(frame_bits(frame) - 1);
    CHECK(station.in(R::txbrp) == 1U << first);
    station.wire.advance(1);
    CHECK(station.in(R::txbrp) == 0);
    CHECK(station.in(R::txbto) == 1U << first);
    CHECK(station.in(R::txbcf) == 0);
    CHECK(station.in(R::txfqs) == txfqs(3, first + 1, first + 1));
    REQUIRE(station.peer.received.size() == 1);
    CHECK(station.peer.received[0] == frame);
    CHECK_FALSE(station.has(Flag::tc));  // TXBTIE = 0
    CHECK(station.has(Flag::tfe));
  }
}

TEST_CASE("m_can transmit: TC needs the bit of the buffer in TXBTIE") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.start();
    const unsigned first = station.first_fifo_buffer();
    station.out(R::txbtie, 2U << first);
    station.request(first, standard_frame(1));
    station.wire.advance(100);
    CHECK_FALSE(station.has(Flag::tc));
    station.request(first + 1, standard_frame(1));
    station.wire.advance(100);
    CHECK(station.has(Flag::tc));
  }
}

TEST_CASE("m_can transmit: a new request clears TXBTO and TXBCF of the buffer") {
  MCanStation station(MCanLayout::configurable);
  station.start();
  station.request(0, standard_frame(1));
  station.wire.advance(100);
  CHECK(station.in(R::txbto) == 1);
  station.request(0, standard_frame(1));
  CHECK(station.in(R::txbto) == 0);
}

TEST_CASE("m_can transmit: the Tx FIFO keeps the order of the requests and wraps") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.start();
    const unsigned first = station.first_fifo_buffer();
    station.request(first, standard_frame(0x300));
    station.request(first + 1, standard_frame(0x200));
    station.request(first + 2, standard_frame(0x100));
    CHECK(station.in(R::txfqs) == (1U << 21 | txfqs(0, first, first)));  // TFQF
    station.wire.advance(60);
    CHECK(station.in(R::txfqs) == txfqs(1, first + 1, first));
    station.request(first, standard_frame(0x050));
    station.wire.advance(400);
    REQUIRE(station.peer.received.size() == 4);
    CHECK(station.peer.received[0].id == 0x300);
    CHECK(station.peer.received[1].id == 0x200);
    CHECK(station.peer.received[2].id == 0x100);
    CHECK(station.peer.received[3].id == 0x050);
  }
}

TEST_CASE("m_can transmit: several FIFO elements are requested at once from the put index") {
  MCanStation station(MCanLayout::fixed);
  station.start();
  station.prepare(0, standard_frame(0x300));
  station.prepare(1, standard_frame(0x200));
  station.out(R::txbar, 3);
  CHECK(station.in(R::txfqs) == txfqs(1, 0, 2));
  station.wire.advance(200);
  CHECK(station.peer.received.size() == 2);
}

TEST_CASE("m_can transmit: a FIFO element that is not at the put index is a fault") {
  MCanStation station(MCanLayout::fixed);
  station.start();
  station.request(1, standard_frame(0x300));
  CHECK(station.can.faults().size() == 1);
  CHECK(station.in(R::txbrp) == 0);
  station.can.clear_faults();
}

TEST_CASE("m_can transmit: the Tx queue sends the lowest identifier first, then the lowest buffer") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout, 0, queue);
    const unsigned first = station.first_fifo_buffer();
    station.start();
    station.wire.advance(1);
    station.receive(standard_frame(0x7FF));
    station.peer.send(standard_frame(0x000));  // occupies the bus
    station.wire.advance(2);
    CHECK(station.in(R::txfqs) == txfqs(0, 0, first));
    station.request(first, standard_frame(0x300, {0}));
    CHECK(station.in(R::txfqs) == txfqs(0, 0, first + 1));
    station.request(first + 1, standard_frame(0x200, {1}));
    station.request(first + 2, standard_frame(0x200, {2}));
    CHECK((station.in(R::txfqs)&1U << 21) != 0);
    station.wire.advance(500);
    REQUIRE(station.peer.received.size() == 3);
    CHECK(station.peer.received[0].data[0] == 1);
    CHECK(station.peer.received[1].data[0] == 2);
    CHECK(station.peer.received[2].data[0] == 0);
  }
}

TEST_CASE("m_can transmit: free queue buffers are filled from the lowest") {
  MCanStation station(MCanLayout::fixed, 0, queue);
  station.start();
  station.request(0, standard_frame(0x100));
  station.request(1, standard_frame(0x300));
  station.wire.advance(60);
  CHECK(station.in(R::txbrp) == 2);
  CHECK(station.in(R::txfqs) == txfqs(0, 0, 0));
}

TEST_CASE("m_can transmit: dedicated buffers compete with the oldest FIFO element") {
  MCanStation station(MCanLayout::configurable);
  station.start();
  station.peer.send(standard_frame(0x000));
  station.wire.advance(2);
  station.request(0, standard_frame(0x250));
  station.request(1, standard_frame(0x150));
  station.request(2, standard_frame(0x200));
  station.request(3, standard_frame(0x100));
  station.wire.advance(600);
  const std::vector<CanFrame>& frames = station.peer.received;
  REQUIRE(frames.size() == 4);
  CHECK(frames[0].id == 0x150);
  CHECK(frames[1].id == 0x200);
  CHECK(frames[2].id == 0x100);
  CHECK(frames[3].id == 0x250);
}

TEST_CASE("m_can transmit: requests of buffers that are not configured, or with CCE, are faults") {
  MCanStation station(MCanLayout::fixed);
  station.out(R::txbar, 1);  // CCE is set
  CHECK(station.can.faults().size() == 1);
  station.out(R::txbcr, 1);
  CHECK(station.can.faults().size() == 2);
  station.start();
  station.out(R::txbar, 8);
  CHECK(station.can.faults().size() == 3);
  CHECK(station.in(R::txbrp) == 0);
  station.can.clear_faults();
}

TEST_CASE("m_can transmit: a waiting buffer is cancelled at once") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout, 0, queue);
    station.start();
    const unsigned first = station.first_fifo_buffer();
    station.out(R::txbcie, 7U << first);
    station.peer.send(standard_frame(0x000));
    station.wire.advance(2);
    station.request(first, standard_frame(1));
    station.out(R::txbcr, 1U << first);
    CHECK(station.in(R::txbrp) == 0);
    CHECK(station.in(R::txbcf) == 1U << first);
    CHECK(station.in(R::txbto) == 0);
    CHECK(station.has(Flag::tcf));
    station.wire.advance(200);
    CHECK(station.peer.received.empty());
  }
}

TEST_CASE("m_can transmit: TCF needs the bit of the buffer in TXBCIE") {
  MCanStation station(MCanLayout::fixed, 0, queue);
  station.start();
  station.peer.send(standard_frame(0x000));
  station.wire.advance(2);
  station.request(0, standard_frame(1));
  station.out(R::txbcr, 1);
  CHECK(station.in(R::txbcf) == 1);
  CHECK_FALSE(station.has(Flag::tcf));
}

TEST_CASE("m_can transmit: a cancelled transmission on the bus is completed, or not repeated after an error") {
  for (const bool has_error : {false, true}) {
    CAPTURE(has_error);
    MCanStation station(MCanLayout::configurable);
    station.start();
    if (has_error) {
      station.wire.disturb_frames(1, 30);
    }
    station.request(0, standard_frame(0x155, {0x55, 0x55}));
    station.wire.advance(10);
    station.out(R::txbcr, 1);
    CHECK(station.in(R::txbcr) == 1);
    CHECK(station.in(R::txbrp) == 1);
    station.wire.advance(300);
    CHECK(station.in(R::txbcr) == 0);
    CHECK(station.in(R::txbrp) == 0);
    CHECK(station.in(R::txbto) == (has_error ? 0 : 1));
    CHECK(station.in(R::txbcf) == 1);
    CHECK(station.peer.received.size() == (has_error ? 0 : 1));
  }
}

TEST_CASE("m_can transmit: INIT completes the cancellation of a transmission on the bus") {
  MCanStation station(MCanLayout::configurable);
  station.start();
  station.request(0, standard_frame(0x155, {0x55, 0x55}));
  station.wire.advance(10);
  station.out(R::txbcr, 1);
  station.out(R::cccr, 1);
  station.wire.advance(1);
  CHECK(station.in(R::txbcr) == 0);
  CHECK(station.in(R::txbrp) == 0);
  CHECK(station.in(R::txbcf) == 1);
}

TEST_CASE("m_can transmit: the get index skips cancelled FIFO elements") {
  MCanStation station(MCanLayout::fixed);
  station.start();
  station.peer.send(standard_frame(0x000));
  station.wire.advance(2);
  station.request(0, standard_frame(1));
  station.request(1, standard_frame(2));
  station.request(2, standard_frame(3));
  station.out(R::txbcr, 2);
  CHECK(station.in(R::txfqs) == (1U << 21 | txfqs(0, 0, 0)));  // a cancellation behind the get index frees nothing
  station.out(R::txbcr, 1);
  CHECK(station.in(R::txfqs) == txfqs(2, 2, 0));
  station.wire.advance(200);
  REQUIRE(station.peer.received.size() == 1);
  CHECK(station.peer.received[0].id == 3);
}

TEST_CASE("m_can transmit: a lost arbitration or an error is repeated, or cancelled with DAR") {
  for (const bool is_repeated : {true, false}) {
    CAPTURE(is_repeated);
    MCanStation station(MCanLayout::fixed, is_repeated ? 0 : dar);
    station.start();
    station.request(0, standard_frame(0x200));
    station.peer.send(standard_frame(0x100));
    station.wire.advance(200);
    CHECK(station.in(R::txbto) == (is_repeated ? 1 : 0));
    CHECK(station.in(R::txbcf) == (is_repeated ? 0 : 1));
    station.wire.disturb_frames(1, 25);
    station.request(1, standard_frame(0x200, {0x55}));
    station.wire.advance(200);
    CHECK(station.in(R::txbto) == (is_repeated ? 3 : 0));
    CHECK(station.in(R::txbcf) == (is_repeated ? 0 : 3));
    station.request(2, standard_frame(0x200));
    station.wire.advance(100);
    CHECK((station.in(R::txbto)&4) == 4);
    CHECK((station.in(R::txbcf)&4) == 0);  // successful
  }
}

TEST_CASE("m_can transmit: elements without room for the data are padded with CCh") {
  MCanStation station(MCanLayout::configurable, 0x100);
  station.start();
  station.request(0, standard_frame(1, {1, 2, 3, 4, 5, 6, 7, 8}), 1U << 21 | 9U << 16);  // FDF, 12 bytes
  station.wire.advance(400);
  REQUIRE(station.peer.received.size() == 1);
  CHECK(station.peer.received[0].bytes() == 12);
  CHECK(station.peer.received[0].data[7] == 8);
  CHECK(station.peer.received[0].data[8] == 0xCC);
}

TEST_CASE("m_can transmit: sent frames with EFC are stored in the Tx event FIFO") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.start();
    const unsigned first = station.first_fifo_buffer();
    station.request(first, standard_frame(0x123, {1}));
    station.wire.advance(100);
    CHECK(station.in(R::txefs) == 0);
    station.request(first + 1, standard_frame(0x123, {1}), 0x42U << 24 | 1U << 23);
    station.wire.advance(100);
    CHECK(station.in(R::txefs) == txfqs(1, 0, 1));
    CHECK(station.has(Flag::tefn));
    CHECK(station.word(station.event(0)) == 0x123U << 18);
    CHECK(station.word(station.event(0) + 1) == (0x42U << 24 | 1U << 22 | 1U << 16));
    station.out(R::txefa, 0);
    CHECK(station.in(R::txefs) == txfqs(0, 1, 1));
    station.out(R::txefa, 1);
    CHECK(station.can.faults().size() == 1);
    station.can.clear_faults();
  }
}

TEST_CASE("m_can transmit: a full Tx event FIFO loses events") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.start();
    const unsigned first = station.first_fifo_buffer();
    for (unsigned i = 0; i < 3; ++i) {
      station.request(first + i, standard_frame(i), 1U << 23);
      station.wire.advance(100);
    }
    CHECK(station.has(Flag::teff));
    CHECK_FALSE(station.has(Flag::tefl));
    station.request(first, standard_frame(9), 1U << 23);
    station.wire.advance(100);
    CHECK(station.has(Flag::tefl));
    CHECK(station.in(R::txefs) == (3U | 3U << 24));
    CHECK(station.word(station.event(0)) == 0);
  }
}

TEST_CASE("m_can transmit: with DAR the type of an event is transmission in spite of cancellation") {
  MCanStation station(MCanLayout::fixed, dar);
  station.start();
  station.request(0, standard_frame(0x123), 1U << 23);
  station.wire.advance(100);
  CHECK(((station.word(station.event(0) + 1) >> 22) & 3) == 2);
}

TEST_CASE("m_can transmit: TXP lets another node send between two frames") {
  MCanStation station(MCanLayout::fixed, 0x4000);
  station.start();
  station.request(0, standard_frame(0x100));
  station.request(1, standard_frame(0x101));
  station.wire.advance(5);
  station.peer.send(standard_frame(0x700));
  station.wire.advance(400);
  const std::vector<CanFrame> frames = station.wire.sent_frames();
  REQUIRE(frames.size() == 3);
  CHECK(frames[1].id == 0x700);
}
