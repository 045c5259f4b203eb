// SPDX-License-Identifier: Apache-2.0
// Acceptance filters, Rx FIFOs and Rx buffers of the M_CAN model. Values are written as in the M_CAN user's manual.
#include "m_can_station.hpp"

using namespace test;

namespace {

constexpr std::array<MCanLayout, 2> layouts = {MCanLayout::fixed, MCanLayout::configurable};

constexpr std::uint32_t reject_all = 0x3C;  // GFC: ANFS, ANFE

std::uint32_t standard_filter(unsigned type, unsigned configuration, std::uint32_t one, std::uint32_t two) {
  return type << 30 | configuration << 27 | one << 16 | two;
}

void set_extended_filter(MCanStation& station, unsigned index, unsigned type, unsigned configuration, std::uint32_t one,
                         std::uint32_t two) {
  station.set_word(station.extended_filter(index), configuration << 29 | one);
  station.set_word(station.extended_filter(index) + 1, type << 30 | two);
}

// Returns the FIFO in which the frame is stored, or -1; the element is released.
int fifo_of(MCanStation& station, const CanFrame& frame) {
  station.receive(frame);
  for (unsigned fifo = 0; fifo < 2; ++fifo) {
    const std::uint32_t status = station.in(fifo == 0 ? R::rxf0s : R::rxf1s);
    if ((status & 0x7F) != 0) {
      station.out(fifo == 0 ? R::rxf0a : R::rxf1a, status >> 8 & 0x3F);
      return static_cast<int>(fifo);
    }
  }
  return -1;
}

}  // namespace

TEST_CASE("m_can receive: a frame without a filter is stored in FIFO 0") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.start();
    station.receive(extended_frame(0x12345678, {1, 2, 3, 4, 5}));
    CHECK(station.in(R::rxf0s) == (1U | 1U << 16));
    CHECK(station.has(Flag::rf0n));
    const unsigned element = station.fifo_element(0, 0);
    CHECK(station.word(element) == (0x12345678 | 1U << 30));
    CHECK(station.word(element + 1) == (0x80000000 | 5U << 16));  // ANMF, no timestamp
    CHECK(station.word(element + 2) == 0x04030201);
    CHECK((station.word(element + 3) & 0xFF) == 5);
    station.receive(remote_frame(standard_frame(0x701), 3));
    CHECK(station.word(station.fifo_element(0, 1)) == (0x701U << 18 | 1U << 29));
    CHECK(((station.word(station.fifo_element(0, 1) + 1) >> 16) & 15) == 3);
  }
}

TEST_CASE("m_can receive: frames without a match go to a FIFO or are rejected") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.filters(0, 0, 1U << 4 | 2U << 2);  // ANFS: FIFO 1; ANFE: reject
    station.start();
    CHECK(fifo_of(station, standard_frame(1)) == 1);
    CHECK(fifo_of(station, extended_frame(1)) == -1);
  }
}

TEST_CASE("m_can receive: remote frames are rejected with RRFS and RRFE") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.filters(0, 0, 2);  // RRFS
    station.start();
    CHECK(fifo_of(station, remote_frame(standard_frame(1))) == -1);
    CHECK(fifo_of(station, remote_frame(extended_frame(1))) == 0);
    MCanStation other(layout == MCanLayout::fixed ? MCanLayout::configurable : MCanLayout::fixed);
    other.filters(0, 0, 1);  // RRFE
    other.start();
    CHECK(fifo_of(other, remote_frame(standard_frame(1))) == 0);
    CHECK(fifo_of(other, remote_frame(extended_frame(1))) == -1);
  }
}

TEST_CASE("m_can receive: types of standard filters") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.filters(4, 0, reject_all);
    station.set_word(0, standard_filter(0, 1, 0x100, 0x10F));  // range
    station.set_word(1, standard_filter(1, 2, 0x200, 0x300));  // dual
    station.set_word(2, standard_filter(2, 1, 0x400, 0x7F0));  // classic
    station.set_word(3, standard_filter(3, 1, 0x000, 0x7FF));  // disabled
    station.start();
    CHECK(fifo_of(station, standard_frame(0x0FF)) == -1);
    CHECK(fifo_of(station, standard_frame(0x100)) == 0);
    CHECK(fifo_of(station, standard_frame(0x10F)) == 0);
    CHECK(fifo_of(station, standard_frame(0x110)) == -1);
    CHECK(fifo_of(station, standard_frame(0x200)) == 1);
    CHECK(fifo_of(station, standard_frame(0x300)) == 1);
    CHECK(fifo_of(station, standard_frame(0x250)) == -1);
    CHECK(fifo_of(station, standard_frame(0x40F)) == 0);
    CHECK(fifo_of(station, standard_frame(0x410)) == -1);
    CHECK(fifo_of(station, extended_frame(0x100)) == -1);
  }
}

TEST_CASE("m_can receive: types of extended filters, with XIDAM") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.filters(0, 4, reject_all);
    station.out(R::xidam, 0x1FFFFF00);
    set_extended_filter(station, 0, 0, 1, 0x100, 0x200);            // range of masked identifiers
    set_extended_filter(station, 1, 1, 2, 0x1000, 0x2000);          // dual
    set_extended_filter(station, 2, 2, 1, 0x30000, 0x1FFF0000);     // classic
    set_extended_filter(station, 3, 3, 2, 0x1F000010, 0x1F000020);  // range without XIDAM
    station.start();
    CHECK(fifo_of(station, extended_frame(0x0FF)) == -1);
    CHECK(fifo_of(station, extended_frame(0x2FF)) == 0);
    CHECK(fifo_of(station, extended_frame(0x300)) == -1);
    CHECK(fifo_of(station, extended_frame(0x10AB)) == 1);
    CHECK(fifo_of(station, extended_frame(0x3ABCD)) == 0);
    CHECK(fifo_of(station, extended_frame(0x1F000010)) == 1);
    CHECK(fifo_of(station, extended_frame(0x1F000021)) == -1);
    CHECK(fifo_of(station, standard_frame(0x100)) == -1);
  }
}

TEST_CASE("m_can receive: the first matching enabled element decides") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.filters(4, 0, 0);
    station.set_word(0, standard_filter(2, 0, 0x100, 0x7FF));  // disabled
    station.set_word(1, standard_filter(2, 3, 0x101, 0x7FF));  // reject
    station.set_word(2, standard_filter(2, 2, 0x100, 0x7FE));
    station.set_word(3, standard_filter(2, 1, 0x100, 0x7FF));
    station.start();
    CHECK(fifo_of(station, standard_frame(0x101)) == -1);
    CHECK(fifo_of(station, standard_frame(0x100)) == 1);
    CHECK((station.word(station.fifo_element(1, 0) + 1) >> 24) == 2);  // FIDX without ANMF
    CHECK(fifo_of(station, standard_frame(0x102)) == 0);
  }
}

TEST_CASE("m_can receive: elements beyond the list size are not used") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.filters(1, 1, reject_all);
    station.set_word(0, standard_filter(2, 1, 0x100, 0x7FF));
    station.set_word(1, standard_filter(2, 1, 0x200, 0x7FF));
    set_extended_filter(station, 0, 2, 1, 0x100, 0x1FFFFFFF);
    set_extended_filter(station, 1, 2, 1, 0x200, 0x1FFFFFFF);
    station.start();
    CHECK(fifo_of(station, standard_frame(0x100)) == 0);
    CHECK(fifo_of(station, standard_frame(0x200)) == -1);
    CHECK(fifo_of(station, extended_frame(0x100)) == 0);
    CHECK(fifo_of(station, extended_frame(0x200)) == -1);
  }
}

TEST_CASE("m_can receive: the fixed layout has at most 28 and 8 filters") {
  MCanStation station(MCanLayout::fixed);
  station.filters(31, 15, reject_all);
  for (unsigned i = 0; i < 28; ++i) {
    station.set_word(i, 0);
  }
  for (unsigned i = 0; i < 8; ++i) {
    set_extended_filter(station, i, 0, 0, 0, 0);
  }
  station.set_word(27, standard_filter(2, 1, 0x127, 0x7FF));
  set_extended_filter(station, 7, 2, 2, 0x107, 0x1FFFFFFF);
  station.start();
  CHECK(fifo_of(station, standard_frame(0x127)) == 0);
  CHECK(fifo_of(station, extended_frame(0x107)) == 1);
  CHECK(fifo_of(station, standard_frame(0x128)) == -1);
}

TEST_CASE("m_can receive: a priority filter sets HPM and HPMS") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.filters(3, 1, reject_all);
    station.set_word(0, standard_filter(2, 4, 0x080, 0x7FF));  // without storage
    station.set_word(1, standard_filter(2, 5, 0x081, 0x7FF));  // FIFO 0
    station.set_word(2, standard_filter(2, 1, 0x100, 0x7FF));
    set_extended_filter(station, 0, 2, 6, 0x81, 0x1FFFFFFF);  // FIFO 1
    station.start();
    station.receive(standard_frame(0x100));
    CHECK_FALSE(station.has(Flag::hpm));
    station.receive(standard_frame(0x080));
    CHECK(station.has(Flag::hpm));
    CHECK(station.in(R::hpms) == 0);
    CHECK(station.filling(0) == 1);
    station.receive(standard_frame(0x081));
    CHECK(station.in(R::hpms) == (1U << 8 | 2U << 6 | 1));
    station.receive(extended_frame(0x81));
    CHECK(station.in(R::hpms) == (1U << 15 | 3U << 6));
    CHECK(station.filling(1) == 1);
  }
}

TEST_CASE("m_can receive: a full FIFO in blocking mode loses new messages") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    station.start();
    station.receive(standard_frame(1));
    station.receive(standard_frame(2));
    CHECK_FALSE(station.has(Flag::rf0f));
    station.receive(standard_frame(3));
    CHECK(station.has(Flag::rf0f));
    CHECK(station.in(R::rxf0s) == (3U | 1U << 24));
    CHECK_FALSE(station.has(Flag::rf0l));
    station.receive(standard_frame(4));
    CHECK(station.has(Flag::rf0l));
    CHECK(station.in(R::rxf0s) == (3U | 3U << 24));
    CHECK(station.word(station.fifo_element(0, 0)) == 1U << 18);
    station.out(R::ir, station.flag(Flag::rf0l));
    CHECK(station.in(R::rxf0s) == (3U | 1U << 24));  // RF0L is a copy of the flag
    station.out(R::rxf0a, 0);
    CHECK(station.in(R::rxf0s) == (2U | 1U << 8));
    station.receive(standard_frame(5));
    CHECK(station.word(station.fifo_element(0, 0)) == 5U << 18);
  }
}

TEST_CASE("m_can receive: a full FIFO in overwrite mode loses the oldest message") {
  for (const MCanLayout layout : layouts) {
    MCanStation station(layout);
    if (station.is_fixed()) {
      station.out(R::gfc, 1U << 8 | 1U << 4);  // F1OM, ANFS: FIFO 1
    } else {
      station.out(R::gfc, 1U << 4);
      station.out(R::rxf1c, 56 * 4 | 3U << 16 | 1U << 31);
    }
    station.start();
    for (unsigned id = 1; id <= 4; ++id) {
      station.receive(standard_frame(id));
    }
    CHECK_FALSE(station.has(Flag::rf1l));
    CHECK(station.in(R::rxf1s) == (3U | 1U << 8 | 1U << 16 | 1U << 24));
    CHECK(station.word(station.fifo_element(1, 0)) == 4U << 18);
    CHECK(station.word(station.fifo_element(1, 1)) == 2U << 18);
  }
}

TEST_CASE("m_can receive: an acknowledged index releases all elements up to it") {
  MCanStation station(MCanLayout::fixed);
  station.start();
  station.receive(standard_frame(1));
  station.receive(standard_frame(2));
  station.receive(standard_frame(3));
  station.out(R::rxf0a, 1);
  CHECK(station.in(R::rxf0s) == (1U | 2U << 8));
  station.out(R::rxf0a, 0);  // not in the FIFO
  CHECK(station.can.faults().size() == 1);
  station.out(R::rxf0a, 3);
  CHECK(station.can.faults().size() == 2);
  CHECK(station.in(R::rxf0s) == (1U | 2U << 8));
  station.can.clear_faults();
}

TEST_CASE("m_can receive: a FIFO of size 0 loses all messages") {
  MCanStation station(MCanLayout::configurable);
  station.out(R::rxf0c, 44 * 4);
  station.start();
  station.receive(standard_frame(1));
  CHECK(station.has(Flag::rf0l));
  CHECK_FALSE(station.has(Flag::rf0n));
}

TEST_CASE("m_can receive: the watermark of a FIFO") {
  MCanStation station(MCanLayout::configurable);
  station.out(R::rxf0c, 44 * 4 | 3U << 16 | 2U << 24);
  station.start();
  station.receive(standard_frame(1));
  CHECK_FALSE(station.has(Flag::rf0w));
  station.receive(standard_frame(2));
  CHECK(station.has(Flag::rf0w));
}

TEST_CASE("m_can receive: RXESC sets the size of the elements") {
  MCanStation station(MCanLayout::configurable);
  station.out(R::rxf0c, 200 * 4 | 2U << 16);
  station.out(R::rxesc, 2);  // 16 bytes: elements of 6 words
  station.start();
  station.receive(standard_frame(1));
  station.receive(standard_frame(2, {1, 2, 3, 4, 5, 6, 7, 8}));
  CHECK(station.word(206) == 2U << 18);
  CHECK(station.word(209) == 0x08070605);
}

TEST_CASE("m_can receive: a filter stores in a dedicated Rx buffer until its new data flag is cleared") {
  MCanStation station(MCanLayout::configurable);
  station.filters(2, 1, reject_all);
  station.set_word(0, standard_filter(3, 7, 0x181, 1));  // Rx buffer 1; the type is ignored
  station.set_word(1, standard_filter(2, 2, 0x180, 0x7F0));
  set_extended_filter(station, 0, 0, 7, 0x12345, 3);
  station.start();
  station.receive(standard_frame(0x181, {1}));
  CHECK(station.in(R::ndat1) == 2);
  CHECK(station.has(Flag::drx));
  CHECK(station.word(station.rx_buffer(1)) == 0x181U << 18);
  CHECK((station.word(station.rx_buffer(1) + 2) & 0xFF) == 1);
  station.receive(standard_frame(0x181, {2}));  // the filtering goes on: element 1
  CHECK((station.word(station.rx_buffer(1) + 2) & 0xFF) == 1);
  CHECK(station.filling(1) == 1);
  station.out(R::ndat1, 2);
  CHECK(station.in(R::ndat1) == 0);
  station.receive(standard_frame(0x181, {3}));
  CHECK((station.word(station.rx_buffer(1) + 2) & 0xFF) == 3);
  station.receive(extended_frame(0x12345, {4}));
  CHECK(station.in(R::ndat1) == (2 | 8));
  CHECK((station.word(station.rx_buffer(3) + 2) & 0xFF) == 4);
}
