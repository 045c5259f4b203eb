// SPDX-License-Identifier: Apache-2.0
// Chapters are those of the family reference manual DS20005678 of MCP2517FD and MCP2518FD.
#include "mcp251xfd.hpp"

#include <doctest/doctest.h>

using namespace test;
using Bytes = std::vector<std::uint8_t>;

namespace {

// C1CON.REQOP
constexpr unsigned normal = 0;
constexpr unsigned internal_loopback = 2;
constexpr unsigned listen_only = 3;
constexpr unsigned configuration = 4;
constexpr unsigned external_loopback = 5;
constexpr unsigned classic = 6;
constexpr unsigned restricted = 7;

constexpr std::uint32_t extended = 1U << 30;  // EXIDE, MIDE

constexpr std::uint16_t fifocon(unsigned fifo) { return static_cast<std::uint16_t>(0x050 + 12 * fifo); }
constexpr std::uint16_t fifosta(unsigned fifo) { return static_cast<std::uint16_t>(0x054 + 12 * fifo); }
constexpr std::uint16_t fifoua(unsigned fifo) { return static_cast<std::uint16_t>(0x058 + 12 * fifo); }

std::uint8_t byte_of(std::uint32_t value, unsigned number) {
  return static_cast<std::uint8_t>(value >> 8 * number & 0xFF);
}

// A controller in Configuration mode with a peer: no events, a transmit queue of 4 messages, FIFO 1 receives 4 messages
// of any kind by filter 0, FIFO 2 transmits 4 messages. 1 Mbit/s at 20 MHz.
struct Station {
  CanWire wire;
  Mcp251xfd can;
  CanPeer peer;

  explicit Station(const Mcp251xfd::Options& options = {}, FdMode fd = FdMode::classic)
      : can(wire, options), peer(wire, fd) {
    write(0x000, 0x04100760);  // TXQEN
    write(0x004, 0x000E0303);  // 15 + 4 + 1 quanta
    write(0x050, 0x03600000);
    write(fifocon(1), 0x03000009);  // RXOVIE, TFNRFNIE
    write(fifocon(2), 0x03600080);  // TXEN
    write(0x1F0, 0);
    write(0x1F4, 0);
    write_byte(0x1D0, 0x81);
  }
  ~Station() { CHECK_MESSAGE(can.faults().empty(), can.fault_text()); }

  // Performs a transaction. Returns the received bytes.
  Bytes spi(const Bytes& sent) {
    Bytes received;
    can.select();
    for (const std::uint8_t one : sent) {
      received.push_back(can.transfer(one));
    }
    can.deselect();
    return received;
  }
  void write(unsigned address, std::uint32_t value) {
    spi({static_cast<std::uint8_t>(0x20 | address >> 8), byte_of(address, 0), byte_of(value, 0), byte_of(value, 1),
         byte_of(value, 2), byte_of(value, 3)});
  }
  void write_byte(unsigned address, std::uint8_t value) {
    spi({static_cast<std::uint8_t>(0x20 | address >> 8), byte_of(address, 0), value});
  }
  std::uint32_t read(unsigned address) {
    const Bytes in = spi({static_cast<std::uint8_t>(0x30 | address >> 8), byte_of(address, 0), 0, 0, 0, 0});
    return in[2] | std::uint32_t{in[3]} << 8 | std::uint32_t{in[4]} << 16 | std::uint32_t{in[5]} << 24;
  }
  std::size_t faults() {
    const std::size_t number = can.faults().size();
    can.clear_faults();
    return number;
  }
  unsigned mode() { return read(0x000) >> 21 & 7; }
  void start(unsigned mode_number = normal) {
    write_byte(0x003, static_cast<std::uint8_t>(mode_number));
    wire.advance(14);
    REQUIRE(mode() == mode_number);
    write_byte(0x01C, 0);  // MODIF
  }
  // Writes a message to the next object of a FIFO, or of the transmit queue (0), without UINC.
  void load(unsigned fifo, const CanFrame& frame) {
    const std::uint32_t address = 0x400 + read(fifoua(fifo));
    write(address, frame.is_extended ? frame.id >> 18 | (frame.id & 0x3FFFF) << 11 : frame.id);
    write(address + 4, frame.dlc | (frame.is_extended ? 0x10U : 0) | (frame.is_remote ? 0x20U : 0));
    for (unsigned i = 0; i < frame.bytes(); i += 4) {
      write(address + 8 + i, frame.data[i] | std::uint32_t{frame.data[i + 1]} << 8 |
                                 std::uint32_t{frame.data[i + 2]} << 16 | std::uint32_t{frame.data[i + 3]} << 24);
    }
  }
  void queue(unsigned fifo, const CanFrame& frame) {
    load(fifo, frame);
    write_byte(fifocon(fifo) + 1U, read(fifocon(fifo)) >> 8 & 2 ? 3 : 1);  // UINC, with TXREQ unchanged
  }
  void send(unsigned fifo, const CanFrame& frame) {
    load(fifo, frame);
    write_byte(fifocon(fifo) + 1U, 3);  // UINC, TXREQ
  }
  bool is_requested(unsigned fifo) { return (read(fifocon(fifo)) & 0x200) != 0; }
  void receive(const CanFrame& frame) {
    const std::size_t before = wire.sent();
    peer.send(frame);
    REQUIRE(wire.advance_until([&] { return wire.sent() > before; }, 1000));
    wire.advance(3);
  }
  // Returns whether the frame is stored in FIFO 1, and removes it.
  bool accepts(const CanFrame& frame) {
    receive(frame);
    const bool is_stored = (read(fifosta(1)) & 1) != 0;
    if (is_stored) {
      write_byte(fifocon(1) + 1U, 1);
    }
    return is_stored;
  }
  bool disable_bus(unsigned bits) {  // sets the error counter such that the next error leads to bus-off
    can.node().set_counters(248, 0);
    wire.disturb_frames(1, 25);
    return wire.advance_until([&] { return can.node().is_bus_off(); }, bits);
  }
};

}  // namespace

// ---- SPI and registers

TEST_CASE("mcp251xfd: RESET sets the default values and Configuration mode, and keeps the RAM") {
  Station station;
  station.write(0x500, 0x12345678);
  station.spi({0x00, 0x00});
  struct Case {
    unsigned address;
    std::uint32_t value;
  };
  for (const Case& one :
       {Case{0x000, 0x04980760}, Case{0x004, 0x003E0F0F}, Case{0x008, 0x000E0303}, Case{0x00C, 0x00021000},
        Case{0x014, 0},          Case{0x018, 0x40400040}, Case{0x01C, 0},          Case{0x020, 0},
        Case{0x024, 0},          Case{0x030, 0},          Case{0x034, 0x00200000}, Case{0x038, 0},
        Case{0x03C, 0},          Case{0x040, 0x00000400}, Case{0x044, 0},          Case{0x050, 0x00600480},
        Case{0x054, 5},          Case{0x05C, 0x00600400}, Case{0x060, 0},          Case{0x1D0, 0},
        Case{0x1F4, 0},          Case{0xE00, 0x00000460}, Case{0xE04, 0x03000003}, Case{0x500, 0x12345678}}) {
    CAPTURE(one.address);
    CHECK(station.read(one.address) == one.value);
    CHECK(station.can.peek(static_cast<std::uint16_t>(one.address)) == one.value);
  }
}

TEST_CASE("mcp251xfd: READ and WRITE advance the address, which wraps in registers and in the RAM") {
  Station station;
  station.spi({0x21, 0xF0, 1, 2, 3, 4, 5});  // filter 0 is enabled
  CHECK(station.faults() == 2);
  station.spi({0x21, 0xF8, 1, 2, 3, 4, 5});
  CHECK(station.spi({0x31, 0xF9, 0, 0, 0, 0, 0}) == Bytes{0xA5, 0xA5, 2, 3, 4, 5, 0});
  station.spi({0x2B, 0xFC, 1, 2, 3, 4, 5, 6, 7, 8});
  CHECK(station.read(0xBFC) == 0x04030201);
  CHECK(station.read(0x400) == 0x08070605);
}

TEST_CASE("mcp251xfd: the RAM is accessed by words; addresses without a register are faults") {
  Station station;
  station.write(0x400, 0x11223344);
  for (const Bytes& one : {Bytes{0x24, 0x00, 1, 2, 3}, Bytes{0x24, 0x02, 1, 2, 3, 4}, Bytes{0x34, 0x00, 0, 0},
                           Bytes{0x34, 0x01, 0, 0, 0, 0}, Bytes{0x3C, 0x00, 0}, Bytes{0x22, 0xF0, 0}}) {
    CAPTURE(one[1]);
    station.spi(one);
    CHECK(station.faults() == 1);
  }
  station.write(0x400, 0x11223344);
  station.spi({0x24, 0x00, 1, 2, 3});
  CHECK(station.faults() == 1);
  CHECK(station.read(0x400) == 0x11223344);
}

TEST_CASE("mcp251xfd: each transaction needs CS, an instruction and its bytes") {
  Station station;
  station.can.transfer(0x30);  // CS is high
  station.can.deselect();
  CHECK(station.faults() == 2);
  for (const Bytes& one : {Bytes{}, Bytes{0x30}, Bytes{0x30, 0x00}, Bytes{0x20, 0x00}, Bytes{0x00},
                           Bytes{0x00, 0x00, 0}, Bytes{0xB0, 0x00, 0}, Bytes{0x10, 0x00, 0}}) {
    CAPTURE(one.size());
    station.spi(one);
    CHECK(station.faults() == 1);
  }
  unsigned calls = 0;
  station.can.on_transfer = [&] { ++calls; };
  station.wire.accesses_per_bit = 1;
  station.can.clear_transactions();
  const std::uint64_t begin = station.wire.now();
  station.read(0xE00);
  CHECK(station.wire.now() == begin + 6);
  CHECK(calls == 6);
  CHECK(station.can.bytes() == 6);
  CHECK(station.can.transactions()[0].received == Bytes{0xA5, 0xA5, 0x60, 0x04, 0, 0});
}

TEST_CASE("mcp251xfd: OSC is ready after some reads; a write before is a fault") {
  Mcp251xfd::Options options;
  options.start_up_reads = 2;
  Station station(options);  // writes at once
  CHECK(station.faults() != 0);
  station.spi({0x00, 0x00});
  CHECK(station.read(0xE00) == 0x60);
  CHECK(station.read(0xE00) == 0x60);
  CHECK(station.read(0xE00) == 0x460);
  station.spi({0x00, 0x00});
  station.write_byte(0x003, 4);  // C1CON and OSC may be written
  station.write(0x004, 0);
  CHECK(station.faults() == 1);
  station.read(0xE00);
  station.read(0xE00);
  station.write(0xE00, 0x11);
  CHECK(station.read(0xE00) == (0x11 | 0x100 | 0x400 | 0x1000));
}

TEST_CASE("mcp251xfd: only MCP2518FD has OSC.LPMEN") {
  for (const bool is_2517 : {false, true}) {
    Mcp251xfd::Options options;
    options.is_2517 = is_2517;
    Station station(options);
    station.write(0xE00, 0x68);
    CHECK(station.read(0xE00) == (is_2517 ? 0x460 : 0x468));
  }
}

TEST_CASE("mcp251xfd: read-only registers, and functions that are not modelled, are faults") {
  Station station;
  for (const unsigned address : {0x018U, 0x020U, 0x024U, 0x028U, 0x02CU, 0x034U, 0x048U, 0x058U, 0x064U, 0xE14U}) {
    CAPTURE(address);
    station.write(address, 0);
    CHECK(station.faults() == 1);
  }
  station.write(0x014, 0x00010000);  // TBCEN
  station.write_byte(0x003, 1);      // Sleep mode
  station.write_byte(0x003, 7);      // Restricted Operation mode
  station.write_byte(0x000, 0x61);   // DNCNT
  station.write(0xE04, 0);           // INT0, INT1
  station.write(fifocon(2), 0x03600040);
  station.write_byte(0x1D0, 0x80);  // filter to the transmit queue
  CHECK(station.faults() == 7);
  station.write_byte(0x003, 4);
  station.write_byte(0x000, 0x60);
  station.wire.advance(20);
  CHECK(station.mode() == configuration);
}

// ---- Modes [2, 3]

TEST_CASE("mcp251xfd: configuration is written in Configuration mode only [2]") {
  Station station;
  station.start();
  struct Case {
    unsigned address;
    std::uint32_t value;
  };
  for (const Case& one :
       {Case{0x000, 0x00000760}, Case{0x000, 0x00180760}, Case{0x000, 0x00100660}, Case{0x004, 0x010E0303},
        Case{0x008, 0}, Case{0x00C, 0}, Case{0x050, 0x04600000}, Case{fifocon(1), 0x03000089},
        Case{fifocon(1), 0x03000029}, Case{fifocon(2), 0x23600080}, Case{0x040, 0x01000000}, Case{0xE00, 0x70}}) {
    CAPTURE(one.address);
    const std::uint32_t before = station.read(one.address);
    station.write(one.address, one.value);
    CHECK(station.faults() == 1);
    CHECK(station.read(one.address) == before);
  }
  station.write(fifocon(2), 0x03250081);  // TXAT, TXPRI and interrupts
  CHECK(station.read(fifocon(2)) == 0x03250081);
  station.spi({0x00, 0x00});
  CHECK(station.faults() == 1);  // RESET outside of Configuration mode
}

TEST_CASE("mcp251xfd: OPMOD follows REQOP after 11 recessive bits; MODIF [2, 10]") {
  Station station;
  station.write(0x01C, 0x00080000);
  station.peer.send(standard_frame(0x123));
  station.wire.advance(20);
  station.write_byte(0x003, normal);
  CHECK(station.read(0x000) == (0x00100760 | 4 << 21));
  station.wire.advance(12);
  CHECK(station.mode() == configuration);
  CHECK_FALSE(station.can.interrupt());
  REQUIRE(station.wire.advance_until([&] { return station.can.peek(0) >> 21 == normal; }, 100));
  CHECK(station.can.interrupt());
  CHECK(station.read(0x01C) == 0x00080008);
  station.write_byte(0x01C, 0);
  CHECK_FALSE(station.can.interrupt());
  CHECK(station.read(0x050) == 0x03600080);  // FRESET is 0
  station.wire.advance(100);
  station.write_byte(0x003, configuration);
  station.wire.advance(1);
  CHECK(station.mode() == configuration);
  CHECK(station.read(0x050) == 0x03600480);
}

TEST_CASE("mcp251xfd: Configuration mode begins when the frame on the bus ends, and resets all FIFOs [2]") {
  Station station;
  station.start();
  station.receive(standard_frame(0x123, {1}));
  station.send(0, standard_frame(0x100, {1}));
  station.send(0, standard_frame(0x101, {2}));
  station.wire.advance(30);
  station.write_byte(0x003, configuration);
  CHECK(station.mode() == normal);
  station.wire.advance(40);
  CHECK(station.mode() == configuration);
  CHECK(station.peer.received.size() == 1);
  CHECK(station.read(0x030) == 0);
  CHECK(station.read(fifosta(1)) == 0);
  CHECK(station.read(0x054) == 5);
  station.start();
  station.wire.advance(200);
  CHECK(station.peer.received.size() == 1);
  station.write_byte(0x003, listen_only);
  CHECK(station.faults() == 1);
}

TEST_CASE("mcp251xfd: the loopback modes receive own frames; the external one sends them [2]") {
  for (const unsigned mode : {internal_loopback, external_loopback}) {
    Station station;
    station.start(mode);
    station.send(0, standard_frame(0x123, {1}));
    station.wire.advance(100);
    CHECK((station.read(fifosta(1)) & 1) == 1);
    CHECK(station.peer.received.size() == (mode == external_loopback ? 1 : 0));
  }
}

TEST_CASE("mcp251xfd: Listen Only mode receives without acknowledgement and without transmission [2]") {
  Station station;
  station.start(listen_only);
  station.peer.send(standard_frame(0x123));
  station.wire.advance(100);
  CHECK(station.wire.sent() == 0);
  CHECK(station.wire.errors(CanError::ack) != 0);
  station.peer.cancel();
  CanPeer other(station.wire);
  station.wire.advance(200);
  station.send(0, standard_frame(0x100));
  station.wire.advance(200);
  CHECK(station.is_requested(0));
  CHECK(station.peer.received.empty());
  station.receive(standard_frame(0x123));
  CHECK((station.read(fifosta(1)) & 1) == 1);
  CHECK((station.read(0x034) & 0xFFFF) == 0);
}

TEST_CASE("mcp251xfd: an underflow leads to Restricted or Listen Only mode until REQOP is written; frames are kept") {
  for (const bool is_silent : {false, true}) {
    CAPTURE(is_silent);
    Station station;
    station.write(0x000, is_silent ? 0x04140760 : 0x04100760);  // SERR2LOM
    station.start();
    station.can.underflow_next();
    station.send(0, standard_frame(0x100));
    station.wire.advance(200);
    CHECK(station.peer.received.empty());
    CHECK(station.mode() == (is_silent ? listen_only : restricted));
    CHECK((station.read(0x01C) & 0x1008) == 0x1008);  // SERRIF, MODIF
    station.peer.send(standard_frame(0x123));
    station.wire.advance(100);
    CHECK(station.wire.sent() == (is_silent ? 0 : 1));
    station.peer.cancel();
    station.write_byte(0x01D, 0);
    station.start();
    station.wire.advance(200);
    CHECK(station.peer.received.size() == 1);
  }
}

TEST_CASE("mcp251xfd: bit rate and sample point of C1NBTCFG and OSC [3]") {
  Mcp251xfd::Options options;
  options.oscillator = 20'000'000;
  Station station(options);
  CHECK(station.can.bit_rate() == 1'000'000);
  CHECK(station.can.sample_point() == 800);
  station.write(0x004, 0x011E0707);
  CHECK(station.can.bit_rate() == 250'000);
  station.write(0xE00, 0x70);  // SCLKDIV
  CHECK(station.can.bit_rate() == 125'000);
  station.write(0x004, 0x00030304);  // SJW above TSEG2
  station.start();
  CHECK(station.faults() == 1);
}

TEST_CASE("mcp251xfd: a controller with another bit rate than the bus does not take part") {
  Mcp251xfd::Options options;
  options.oscillator = 40'000'000;
  Station station(options);
  station.wire.bit_rate = 1'000'000;
  station.start();
  CHECK(station.faults() == 1);
  station.send(0, standard_frame(0x123));
  station.wire.advance(200);
  CHECK(station.wire.records().empty());
}

// ---- FIFOs and the RAM [3, 8]

TEST_CASE("mcp251xfd: the RAM is assigned to events, transmit queue and FIFO 1 to 31 in order [3]") {
  Station station;
  station.read(0x058);  // user addresses are not valid in Configuration mode
  station.read(0x064);
  CHECK(station.faults() == 2);
  station.write(0x000, 0x04180760);       // STEF
  station.write(0x040, 0x02000020);       // 3 events of 12 bytes
  station.write(fifocon(1), 0x23000029);  // 4 messages of 12 data bytes with a time stamp
  station.write(fifocon(2), 0x036000A0);  // a transmit FIFO has no time stamp
  station.start();
  CHECK(station.read(0x048) == 0);
  CHECK(station.read(fifoua(0)) == 36);
  CHECK(station.read(fifoua(1)) == 36 + 64);
  CHECK(station.read(fifoua(2)) == 36 + 64 + 96);
  CHECK(station.read(fifoua(3)) == 36 + 64 + 96 + 64);
  CHECK(station.read(fifoua(31)) == 36 + 64 + 96 + 64 + 28 * 16);
  station.receive(standard_frame(0x123, {0x11, 0x22, 0x33, 0x44, 0x55}));
  CHECK(station.read(0x400 + 100 + 12) == 0x44332211);
}

TEST_CASE("mcp251xfd: FIFOs in use that exceed 2 KB are a fault [3]") {
  Station station;
  station.write(fifocon(3), 0xFF000000);  // 32 messages of 64 bytes
  station.start();
  CHECK(station.faults() == 0);
  station.write_byte(0x1D1, 0x83);
  CHECK(station.faults() == 1);
  station.write_byte(0x1D1, 0x03);
  station.write_byte(0x003, configuration);
  station.wire.advance(1);
  station.write(fifocon(3), 0xFF000080);
  station.start();
  CHECK(station.faults() == 1);
}

TEST_CASE("mcp251xfd: UINC of an empty receive FIFO or a full transmit FIFO, and queued messages in the RAM [8]") {
  Station station;
  station.write_byte(fifocon(2) + 1U, 1);
  CHECK(station.faults() == 1);  // Configuration mode
  station.start();
  station.write_byte(fifocon(1) + 1U, 1);
  CHECK(station.faults() == 1);
  const std::uint32_t first = 0x400 + station.read(fifoua(2));
  for (unsigned i = 0; i < 4; ++i) {
    station.queue(2, standard_frame(0x100 + i));
  }
  CHECK(station.faults() == 0);
  CHECK(station.read(fifosta(2)) == 0);
  station.write_byte(fifocon(2) + 1U, 1);
  CHECK(station.faults() == 1);
  station.write(first, 0);
  CHECK(station.faults() == 1);
  station.write(0x440, 0);  // receive FIFO
  CHECK(station.faults() == 1);
  station.write_byte(fifocon(2) + 1U, 4);  // FRESET
  CHECK(station.read(fifosta(2)) == 7);
  station.write_byte(fifocon(1) + 1U, 2);
  CHECK(station.faults() == 1);  // TXREQ of a receive FIFO
}

// ---- Transmission [4, 5]

TEST_CASE("mcp251xfd: TXREQ sends the messages of a FIFO in order, and is cleared with the last one [4]") {
  Station station;
  station.start();
  station.queue(2, standard_frame(0x200, {1, 2, 3, 4, 5, 6, 7, 8}));
  station.queue(2, extended_frame(0x12345678, {9}));
  station.queue(2, remote_frame(standard_frame(0x100), 3));
  station.wire.advance(200);
  CHECK(station.wire.sent() == 0);
  CHECK(station.read(fifosta(2)) == 1);
  station.write(0x030, 0x00000004);
  station.write(0x030, 0);  // no effect
  CHECK(station.read(0x030) == 4);
  station.wire.advance(140);
  CHECK(station.read(fifosta(2)) == 0x103);
  CHECK(station.is_requested(2));
  station.wire.advance(300);
  CHECK_FALSE(station.is_requested(2));
  CHECK(station.read(fifosta(2)) == 0x307);
  REQUIRE(station.peer.received.size() == 3);
  CHECK(station.peer.received[0] == standard_frame(0x200, {1, 2, 3, 4, 5, 6, 7, 8}));
  CHECK(station.peer.received[1] == extended_frame(0x12345678, {9}));
  CHECK(station.peer.received[2] == remote_frame(standard_frame(0x100), 3));
}

TEST_CASE("mcp251xfd: the transmit queue sends the lowest identifier first [4]") {
  Station station;
  station.start();
  for (const unsigned id : {0x300U, 0x100U, 0x200U}) {
    station.queue(0, standard_frame(id));
  }
  station.queue(0, extended_frame(0x100 << 18));
  CHECK(station.read(0x054) == 0x100);
  station.write_byte(0x051, 2);
  station.wire.advance(600);
  REQUIRE(station.peer.received.size() == 4);
  CHECK(station.peer.received[0] == standard_frame(0x100));
  CHECK(station.peer.received[1] == extended_frame(0x100 << 18));
  CHECK(station.peer.received[2] == standard_frame(0x200));
  CHECK(station.peer.received[3] == standard_frame(0x300));
  CHECK((station.read(0x054) & 5) == 5);
}

TEST_CASE("mcp251xfd: the highest TXPRI is sent first, then the transmit queue, then the highest FIFO [4]") {
  Station station;
  station.write(fifocon(3), 0x00610080);  // TXPRI 1
  station.write(fifocon(4), 0x00600080);
  station.start();
  for (const unsigned fifo : {4U, 2U, 0U, 3U}) {
    station.queue(fifo, standard_frame(0x100 + fifo));
  }
  station.write(0x030, 0x1D);
  station.wire.advance(400);
  REQUIRE(station.peer.received.size() == 4);
  for (const unsigned fifo : {3U, 0U, 4U, 2U}) {
    CHECK(station.peer.received.front().id == 0x100 + fifo);
    station.peer.received.erase(station.peer.received.begin());
  }
}

TEST_CASE("mcp251xfd: TXLARB and TXERR; the message is sent again [4]") {
  Station station;
  station.start();
  station.peer.send(standard_frame(0x100));
  station.send(2, standard_frame(0x101, {1}));
  station.wire.advance(60);
  CHECK((station.read(fifosta(2)) & 0xE0) == 0x40);
  station.wire.advance(80);
  CHECK(station.wire.sent() == 2);
  station.wire.disturb_frames(1, 25);
  station.send(2, standard_frame(0x101, {1}));
  CHECK((station.read(fifosta(2)) & 0xE0) == 0);
  station.wire.advance(40);
  CHECK((station.read(fifosta(2)) & 0xE0) == 0x20);
  CHECK((station.read(0x034) & 0xFF00) == 0x0800);
  CHECK((station.read(0x01C) & 0x8000) == 0x8000);  // IVMIF
  CHECK(station.read(0x038) == 0x0100);
  CHECK((station.read(0x03C) & 0x00FF0000) != 0);
  station.wire.advance(100);
  CHECK(station.wire.sent() == 3);
  CHECK((station.read(0x034) & 0xFF00) == 0x0700);
}

TEST_CASE("mcp251xfd: TXREQ = 0 aborts before the start of frame, with TXABT; the message stays in the FIFO [4]") {
  Station station;
  station.start();
  station.wire.hold(dominant);
  station.wire.advance(1);  // start of frame of another node
  station.send(2, standard_frame(0x101));
  station.write_byte(fifocon(2) + 1U, 0);
  CHECK_FALSE(station.is_requested(2));
  CHECK(station.read(fifosta(2)) == 0x083);
  station.wire.release();
  station.wire.advance(100);
  CHECK(station.wire.sent() == 0);
  CHECK(station.read(fifosta(2)) == 0x083);
  station.write_byte(fifocon(2) + 1U, 2);
  CHECK((station.read(fifosta(2)) & 0x80) == 0);
  station.wire.advance(100);
  CHECK(station.wire.sent() == 1);
}

TEST_CASE("mcp251xfd: an abort while the message is on the bus takes effect after the frame, or after an error [4]") {
  for (const bool has_error : {false, true}) {
    CAPTURE(has_error);
    Station station;
    station.start();
    station.send(2, standard_frame(0x101, {1}));
    station.send(2, standard_frame(0x102, {1}));
    if (has_error) {
      station.wire.disturb_frames(1, 25);
    }
    station.wire.advance(20);
    station.write_byte(fifocon(2) + 1U, 0);
    CHECK(station.is_requested(2));
    station.wire.advance(200);
    CHECK_FALSE(station.is_requested(2));
    CHECK(station.wire.sent() == (has_error ? 0 : 1));
    CHECK(station.read(fifosta(2)) == (has_error ? 0x0A3 : 0x183));
  }
}

TEST_CASE("mcp251xfd: ABAT aborts all, also new requests, until it is cleared [4]") {
  Station station;
  station.start();
  station.wire.hold(dominant);
  station.wire.advance(1);
  station.send(0, standard_frame(0x100));
  station.send(2, standard_frame(0x101));
  station.write_byte(0x003, 0x08);
  CHECK(station.read(0x030) == 0);
  CHECK((station.read(0x054) & 0x80) == 0x80);
  CHECK((station.read(fifosta(2)) & 0x80) == 0x80);
  station.wire.release();
  station.wire.advance(50);
  station.write_byte(0x051, 2);
  CHECK(station.read(0x030) == 0);
  station.write_byte(0x003, 0);
  station.write_byte(0x051, 2);
  station.wire.advance(100);
  CHECK(station.wire.sent() == 1);
}

TEST_CASE("mcp251xfd: FRESET of a FIFO whose message is on the bus is complete after the frame [8]") {
  Station station;
  station.start();
  station.send(2, standard_frame(0x101, {1}));
  station.queue(2, standard_frame(0x102, {1}));
  station.wire.advance(20);
  station.write_byte(fifocon(2) + 1U, 4);
  CHECK((station.read(fifocon(2)) & 0x400) == 0x400);
  station.wire.advance(200);
  CHECK(station.wire.sent() == 1);
  CHECK((station.read(fifocon(2)) & 0x700) == 0);
  CHECK(station.read(fifosta(2)) == 7);
}

TEST_CASE("mcp251xfd: with RTXAT, TXAT limits the attempts, and TXATIF is set [4]") {
  for (const unsigned limit : {0U, 1U, 2U}) {
    CAPTURE(limit);
    Station station;
    station.write(0x000, 0x04110760);  // RTXAT
    station.write(fifocon(2), 0x03000090 | limit << 21);
    station.start();
    station.write(0x01C, 0x04000000);
    station.wire.disturb_frames(8, 25);
    station.send(2, standard_frame(0x101, {1}));
    station.wire.advance(600);
    CHECK(station.wire.sent() == (limit == 2 ? 1 : 0));
    CHECK((station.read(0x034) >> 8 & 0xFF) == (limit == 2 ? 63 : limit == 1 ? 32 : 8));
    CHECK_FALSE(station.is_requested(2));
    CHECK(station.can.interrupt() == (limit != 2));
    CHECK(station.read(0x02C) == (limit != 2 ? 4 : 0));
    CHECK((station.read(0x01C) & 0x0400) == (limit != 2 ? 0x0400 : 0));
    station.write_byte(fifosta(2), 0);
    CHECK_FALSE(station.can.interrupt());
  }
}

TEST_CASE("mcp251xfd: transmit interrupts follow the FIFO; C1VEC [10]") {
  Station station;
  station.write(0x050, 0x03600004);       // TXQEIE
  station.write(fifocon(2), 0x01600085);  // 2 messages; TFERFFIE, TFNRFNIE
  station.start();
  station.write(0x01C, 0x00010000);
  CHECK(station.can.interrupt());
  CHECK(station.read(0x024) == 5);
  CHECK(station.read(0x018) == 0x40020002);
  station.write_byte(0x01E, 0);
  CHECK(station.read(0x018) == 0x40020040);
  station.write_byte(0x01E, 1);
  station.write_byte(0x050, 0);
  station.queue(2, standard_frame(0x101));
  CHECK(station.read(0x024) == 4);
  station.queue(2, standard_frame(0x102));
  CHECK_FALSE(station.can.interrupt());
  CHECK(station.read(0x018) == 0x40400040);
  station.write_byte(fifocon(2) + 1U, 2);
  station.wire.advance(60);
  CHECK(station.can.interrupt());
}

TEST_CASE("mcp251xfd: the transmit event FIFO has identifier, control and sequence number [5]") {
  Station station;
  station.write(0x000, 0x04180760);
  station.write(0x040, 0x01000009);  // 2 events; TEFOVIE, TEFNEIE
  station.start();
  station.write(0x01C, 0x00100000);
  station.load(2, standard_frame(0x101, {1}));
  station.write(0x400 + station.read(fifoua(2)) + 4, 0x00000A01);  // SEQ 5
  station.write_byte(fifocon(2) + 1U, 3);
  station.wire.advance(80);
  CHECK(station.can.interrupt());
  CHECK(station.read(0x044) == 0x3);
  CHECK(station.read(0x400) == 0x101);
  CHECK(station.read(0x404) == 0x0A01);
  station.write_byte(0x041, 1);
  CHECK_FALSE(station.can.interrupt());
  CHECK(station.read(0x048) == 8);
  for (unsigned i = 0; i < 3; ++i) {
    station.send(2, standard_frame(0x101));
  }
  station.wire.advance(300);
  CHECK(station.read(0x044) == 0xF);
}

TEST_CASE("mcp251xfd: a transmit request of an FD frame is a fault") {
  Station station;
  station.start();
  station.load(2, standard_frame(0x101));
  station.write(0x400 + station.read(fifoua(2)) + 4, 0x80);
  station.write_byte(fifocon(2) + 1U, 1);
  CHECK(station.faults() == 1);
}

// ---- Reception [6, 7]

TEST_CASE("mcp251xfd: layout of received messages; interrupt until UINC [7, 10]") {
  Station station;
  station.write_byte(0x1D0, 0x01);
  station.write_byte(0x1E6, 0x81);  // filter 22
  station.write(0x1F0 + 8 * 22, 0);
  CHECK(station.faults() == 1);
  station.start();
  station.write(0x01C, 0x00020000);
  const std::uint32_t first = 0x400 + station.read(fifoua(1));
  station.receive(standard_frame(0x123, {1, 2, 3, 4, 5}));
  station.receive(remote_frame(extended_frame(0x12345678), 8));
  CHECK(station.can.interrupt());
  CHECK(station.read(0x020) == 2);
  CHECK(station.read(0x018) == 0x01400001);
  CHECK(station.read(fifosta(1)) == 0x203);
  CHECK((station.read(first) & 0x7FF) == 0x123);
  CHECK(station.read(first + 4) == (5 | 22 << 11));
  CHECK(station.read(first + 8) == 0x04030201);
  CHECK((station.read(first + 12) & 0xFF) == 5);
  station.write_byte(fifocon(1) + 1U, 1);
  CHECK(station.can.interrupt());
  CHECK(station.read(fifoua(1)) + 0x400 == first + 16);
  CHECK(station.read(first + 16) == (0x12345678 >> 18 | (0x12345678 & 0x3FFFF) << 11));
  CHECK(station.read(first + 20) == (8 | 0x10 | 0x20 | 22 << 11));
  station.write_byte(fifocon(1) + 1U, 1);
  CHECK_FALSE(station.can.interrupt());
  CHECK(station.read(0x03C) == 2);  // frames without errors
}

TEST_CASE("mcp251xfd: filters with masks, EXIDE and MIDE; the filter is disabled for a change [6]") {
  Station station;
  station.write_byte(0x1D0, 0x01);
  station.write(0x1F0, 0x123);
  station.write(0x1F4, 0x7FF | extended);
  station.write_byte(0x1D0, 0x81);
  station.write_byte(0x1EF, 0x81);  // filter 31
  CHECK(station.faults() == 0);
  station.write_byte(0x1EF, 0x82);  // FnBP
  CHECK(station.faults() == 1);
  station.write_byte(0x1EF, 0x01);
  station.write(0x1F0 + 8 * 31, (0x12345678 >> 18) | (0x12345678 & 0x3FFF0) << 11 | extended);
  station.write(0x1F4 + 8 * 31, 0x7FF | 0x3FFF0 << 11 | extended);
  station.start();
  station.write_byte(0x1EF, 0x81);  // also outside of Configuration mode
  CHECK(station.accepts(standard_frame(0x123)));
  CHECK(station.accepts(remote_frame(standard_frame(0x123))));
  CHECK_FALSE(station.accepts(standard_frame(0x122)));
  CHECK_FALSE(station.accepts(extended_frame(0x123 << 18)));
  CHECK(station.accepts(extended_frame(0x12345678)));
  CHECK(station.accepts(extended_frame(0x1234567F)));
  CHECK_FALSE(station.accepts(extended_frame(0x12345668)));
  CHECK_FALSE(station.accepts(standard_frame(0x12345678 >> 18)));
  station.write_byte(0x1D0, 0x01);
  CHECK_FALSE(station.accepts(standard_frame(0x123)));
  station.write(0x1F4, 0x7FF);  // without MIDE
  station.write_byte(0x1D0, 0x81);
  CHECK(station.accepts(extended_frame(0x123 << 18)));
  station.write_byte(0x1D0, 0x01);
  station.write(0x1F0, 0x123 | 5 << 11);  // EID is not compared with a standard frame
  station.write(0x1F4, 0x1FFFFFFF);
  station.write_byte(0x1D0, 0x81);
  CHECK(station.accepts(standard_frame(0x123)));
  CHECK(station.accepts(extended_frame(0x123 << 18 | 5)));
  station.write_byte(0x1D0, 0x01);
  station.write_byte(0x1D0, 0x82);  // transmit FIFO: the message is discarded
  station.write(0x1F8, 0);
  station.write(0x1FC, 0);
  station.write_byte(0x1D1, 0x81);
  CHECK_FALSE(station.accepts(standard_frame(0x123)));
  CHECK(station.accepts(standard_frame(0x124)));
  CHECK((station.read(fifosta(2)) & 4) == 4);
}

TEST_CASE("mcp251xfd: a full FIFO has an overflow, or the next filter stores the message [6]") {
  Station station;
  station.write(fifocon(3), 0x00000000);
  station.start();
  station.write(0x01C, 0x08000000);
  for (unsigned i = 0; i < 4; ++i) {
    station.receive(standard_frame(0x100 + i));
  }
  CHECK(station.read(fifosta(1)) == 0x007);
  station.write_byte(0x1D1, 0x83);
  station.receive(standard_frame(0x104));
  CHECK(station.read(fifosta(1)) == 0x007);
  CHECK(station.read(fifosta(3)) == 0x007);
  CHECK_FALSE(station.can.interrupt());
  station.receive(standard_frame(0x105));
  CHECK(station.read(fifosta(1)) == 0x00F);
  CHECK(station.read(fifosta(3)) == 0x007);
  CHECK(station.can.interrupt());
  CHECK(station.read(0x028) == 2);
  CHECK((station.read(0x01C) & 0x0800) == 0x0800);
  station.write_byte(fifosta(1), 0);
  CHECK_FALSE(station.can.interrupt());
  CHECK((station.read(0x400 + station.read(fifoua(1))) & 0x7FF) == 0x100);  // the oldest message is kept
}

TEST_CASE("mcp251xfd: an FD frame is received in mode 0, and destroyed in mode 6 [2, 7]") {
  for (const unsigned mode : {normal, classic}) {
    CAPTURE(mode);
    Station station({}, FdMode::enabled);
    station.start(mode);
    station.peer.retransmits = false;
    station.peer.send(fd_frame(0x123, 9));  // 12 bytes
    station.wire.advance(300);
    CHECK(station.wire.sent() == (mode == normal ? 1 : 0));
    CHECK((station.read(fifosta(1)) & 1) == (mode == normal ? 1 : 0));
    CHECK((station.read(0x01C) & 0x8000) == 0x8000);  // IVMIF: form error, or more bytes than PLSIZE
    CHECK(((station.read(0x034) & 0xFF) == 0) == (mode == normal));
    if (mode == normal) {
      CHECK(station.read(0x444) == (9 | 0x80));
      CHECK(station.read(0x44C) == 0x07060504);
      CHECK((station.read(0x03C) & 0x80000000) == 0x80000000);  // DLCMM
    }
    station.receive(standard_frame(0x100));
  }
}

// ---- Errors [10, 11]

TEST_CASE("mcp251xfd: C1TREC, and CERRIF at the changes of the error state [10]") {
  struct Case {
    unsigned tec;
    unsigned rec;
    std::uint32_t flags;
    bool is_event;
  };
  Station station;
  station.start();
  station.write(0x01C, 0x20000000);
  for (const Case& one :
       {Case{95, 95, 0, false}, Case{96, 0, 0x05, true}, Case{97, 0, 0x05, false}, Case{128, 0, 0x10, true},
        Case{129, 0, 0x10, false}, Case{127, 0, 0x05, true}, Case{0, 0, 0, false}, Case{0, 96, 0x03, true},
        Case{0, 128, 0x08, true}, Case{0, 120, 0x03, true}, Case{0, 0, 0, false}}) {
    CAPTURE(one.tec);
    CAPTURE(one.rec);
    station.can.node().set_counters(one.tec, one.rec);
    CHECK(station.read(0x034) == (one.flags << 16 | one.tec << 8 | one.rec));
    CHECK(station.can.interrupt() == one.is_event);
    station.write_byte(0x01D, 0);
  }
}

TEST_CASE("mcp251xfd: bus-off resets the transmit FIFOs, and ends after 128 sequences without a request [11]") {
  for (const bool keeps : {false, true}) {
    CAPTURE(keeps);
    Mcp251xfd::Options options;
    options.keeps_messages_in_bus_off = keeps;
    Station station(options);
    station.start();
    station.write(0x01C, 0x20000000);
    station.send(2, standard_frame(1, {0x55}));
    station.queue(0, standard_frame(2));
    REQUIRE(station.disable_bus(300));
    CHECK((station.read(0x034) & 0x00200000) == 0x00200000);
    CHECK(station.can.interrupt());
    CHECK(station.is_requested(2) == keeps);
    CHECK(station.read(0x054) == (keeps ? 1 : 5));
    station.write(0x01C, 0x20000000);
    CHECK_FALSE(station.can.interrupt());
    station.send(2, standard_frame(3));
    station.wire.advance(128 * 11);
    CHECK((station.read(0x034) & 0x00200000) == 0x00200000);
    station.wire.advance(30);
    CHECK(station.read(0x034) == 0);
    CHECK(station.can.interrupt());
    CHECK((station.read(0x03C) & 0x00800000) == 0x00800000);  // TXBOERR
    CHECK(station.mode() == normal);
    station.wire.advance(150);
    CHECK(station.wire.sent() == (keeps ? 2 : 1));
  }
}

TEST_CASE("mcp251xfd: Configuration mode ends bus-off; TXBO is set in Configuration mode [2, 11]") {
  Station station;
  station.start();
  station.send(2, standard_frame(1, {0x55}));
  REQUIRE(station.disable_bus(300));
  station.write_byte(0x003, configuration);
  station.wire.advance(1);
  CHECK(station.mode() == configuration);
  CHECK(station.read(0x034) == 0x00200000);
  station.wire.advance(20);
  station.start();
  CHECK(station.read(0x034) == 0);
  station.send(2, standard_frame(1));
  station.wire.advance(100);
  CHECK(station.wire.sent() == 1);
}
