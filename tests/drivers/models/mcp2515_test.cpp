// SPDX-License-Identifier: Apache-2.0
// Sections, figures and registers are those of the data sheet DS20001801J of MCP2515.
#include "mcp2515.hpp"

#include <doctest/doctest.h>

using namespace test;
using Bytes = std::vector<std::uint8_t>;

namespace {

// CANCTRL.REQOP
constexpr std::uint8_t normal = 0x00;
constexpr std::uint8_t sleep_mode = 0x20;
constexpr std::uint8_t loopback = 0x40;
constexpr std::uint8_t listen_only = 0x60;
constexpr std::uint8_t configuration = 0x80;
constexpr std::uint8_t abat = 0x10;
constexpr std::uint8_t osm = 0x08;
// Registers
constexpr std::uint8_t canctrl = 0x0F;
constexpr std::uint8_t caninte = 0x2B;
constexpr std::uint8_t canintf = 0x2C;
constexpr std::uint8_t eflg = 0x2D;
constexpr std::uint8_t rxb0ctrl = 0x60;
constexpr std::uint8_t rxb1ctrl = 0x70;

// A controller in Configuration mode with a peer: 16 quanta, both buffers receive all frames.
struct Station {
  CanWire wire;
  Mcp2515 can;
  CanPeer peer{wire};

  explicit Station(const Mcp2515::Options& options = {}) : can(wire, options) {
    spi({0xC0});
    write(0x28, 0x03);  // CNF3: PHSEG2 3
    write(0x29, 0xA5);  // CNF2: BTLMODE, PHSEG1 4, PRSEG 5
    write(0x2A, 0x00);
    write(rxb0ctrl, 0x60);
    write(rxb1ctrl, 0x60);
    for (std::uint8_t i = 0x20; i < 0x28; ++i) {
      write(i, 0xFF);
    }
    for (std::uint8_t i = 0; i < 0x1C; ++i) {
      if (i < 0x0C || i >= 0x10) {
        write(i, 0);
      }
    }
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
  void write(std::uint8_t address, std::uint8_t value) { spi({0x02, address, value}); }
  std::uint8_t read(std::uint8_t address) { return spi({0x03, address, 0})[2]; }
  void modify(std::uint8_t address, std::uint8_t mask, std::uint8_t value) { spi({0x05, address, mask, value}); }
  std::size_t faults() {
    const std::size_t number = can.faults().size();
    can.clear_faults();
    return number;
  }
  std::uint8_t mode() { return read(0x0E) & 0xE0; }
  void start(std::uint8_t control = normal) {
    write(canctrl, control);
    wire.advance(14);
    REQUIRE(mode() == (control & 0xE0));
  }
  void load(unsigned buffer, const CanFrame& frame) {
    Bytes bytes{static_cast<std::uint8_t>(0x40 | buffer << 1)};
    const std::uint32_t standard = frame.is_extended ? frame.id >> 18 : frame.id;
    bytes.push_back(static_cast<std::uint8_t>(standard >> 3));
    bytes.push_back(
        static_cast<std::uint8_t>((standard & 7) << 5 | (frame.is_extended ? 8 | (frame.id >> 16 & 3) : 0)));
    bytes.push_back(static_cast<std::uint8_t>(frame.is_extended ? frame.id >> 8 & 0xFF : 0));
    bytes.push_back(static_cast<std::uint8_t>(frame.is_extended ? frame.id & 0xFF : 0));
    bytes.push_back(static_cast<std::uint8_t>(frame.dlc | (frame.is_remote ? 0x40 : 0)));
    bytes.insert(bytes.end(), frame.data.begin(), frame.data.begin() + frame.bytes());
    spi(bytes);
  }
  void send(unsigned buffer, const CanFrame& frame) {
    load(buffer, frame);
    spi({static_cast<std::uint8_t>(0x80 | 1U << buffer)});
  }
  void receive(const CanFrame& frame) {
    const std::size_t before = wire.sent();
    peer.send(frame);
    REQUIRE(wire.advance_until([&] { return wire.sent() > before; }, 1000));
    wire.advance(3);
  }
  // Returns whether the frame is stored in one of the buffers, and empties both.
  bool accepts(const CanFrame& frame) {
    receive(frame);
    const bool is_stored = (read(canintf) & 3) != 0;
    modify(canintf, 3, 0);
    return is_stored;
  }
};

}  // namespace

// ---- SPI [12.0]

TEST_CASE("mcp2515: RESET sets the default values and Configuration mode [12.2, Table 11-2]") {
  Station station;
  station.start();
  station.write(caninte, 0xFF);
  station.spi({0xC0});
  CHECK(station.read(canctrl) == 0x87);
  CHECK(station.read(0x0E) == 0x80);
  CHECK(station.read(caninte) == 0);
  CHECK(station.read(canintf) == 0);
  CHECK(station.read(0x29) == 0);
  CHECK(station.read(rxb0ctrl) == 0);
  CHECK(station.read(0x30) == 0);
}

TEST_CASE("mcp2515: READ and WRITE advance the address [12.3, 12.5]") {
  Station station;
  station.spi({0x02, 0x04, 1, 0xE3, 3, 4});
  CHECK(station.spi({0x03, 0x04, 0, 0, 0, 0}) == Bytes{0xA5, 0xA5, 1, 0xE3, 3, 4});
  CHECK(station.read(0x3F) == station.read(canctrl));
  CHECK(station.read(0x5E) == 0x80);
}

TEST_CASE("mcp2515: each transaction needs CS, an instruction and its bytes [12.1]") {
  Station station;
  station.can.transfer(0x03);  // CS is high
  station.can.deselect();
  CHECK(station.faults() == 2);
  station.can.select();
  station.can.select();
  station.can.transfer(0xA0);
  station.can.transfer(0);
  station.can.deselect();
  CHECK(station.faults() == 1);
  for (const Bytes& one : {Bytes{}, Bytes{0x03}, Bytes{0x03, 0x0F}, Bytes{0x02, 0x2B}, Bytes{0x05, 0x2B, 1},
                           Bytes{0x90}, Bytes{0x40}, Bytes{0xA0}, Bytes{0xB0}, Bytes{0x81, 0},
                           Bytes{0x05, 0x2B, 1, 1, 0}, Bytes{0x07}, Bytes{0x46}, Bytes{0x03, 0x80, 0}}) {
    CAPTURE(one.size());
    station.spi(one);
    CHECK(station.faults() == 1);
  }
}

TEST_CASE("mcp2515: transactions and bytes are counted") {
  Station station;
  station.can.clear_transactions();
  station.read(0x0E);
  station.spi({0xA0, 0});
  REQUIRE(station.can.transactions().size() == 2);
  CHECK(station.can.bytes() == 5);
  CHECK(station.can.transactions()[0].sent == Bytes{0x03, 0x0E, 0});
  CHECK(station.can.transactions()[0].received == Bytes{0xA5, 0xA5, 0x80});
}

TEST_CASE("mcp2515: bytes take time on the wire, and call on_transfer") {
  Station station;
  unsigned calls = 0;
  station.can.on_transfer = [&] { ++calls; };
  station.wire.accesses_per_bit = 1;
  const std::uint64_t begin = station.wire.now();
  station.read(0x0E);
  CHECK(station.wire.now() == begin + 3);
  CHECK(calls == 3);
}

TEST_CASE("mcp2515: BIT MODIFY changes the bits of the mask; without bit access the mask is FFh [12.10]") {
  Station station;
  station.write(caninte, 0x0F);
  station.modify(caninte, 0x3C, 0x30);
  CHECK(station.read(caninte) == 0x33);
  CHECK(station.faults() == 0);
  station.write(0x04, 0xFF);
  station.modify(0x04, 0x0F, 0);
  CHECK(station.read(0x04) == 0);
  CHECK(station.faults() == 1);
}

TEST_CASE("mcp2515: READ RX BUFFER reads from identifier or data, and clears the flag when CS is raised [12.4]") {
  Station station;
  station.modify(rxb0ctrl, 4, 4);
  station.start();
  station.receive(extended_frame(0x12345678, {1, 2, 3}));
  station.receive(standard_frame(0x123, {4}));
  CHECK(station.read(canintf) == 3);
  const Bytes first = station.spi({0x90, 0, 0, 0, 0, 0, 0, 0, 0});
  CHECK(first == Bytes{0xA5, 0x91, 0xA8 | 0x00, 0x56, 0x78, 3, 1, 2, 3});
  CHECK(station.read(canintf) == 2);
  station.can.select();
  station.can.transfer(0x96);
  CHECK(station.can.transfer(0) == 4);
  CHECK(station.can.peek(canintf) == 2);
  station.can.deselect();
  CHECK(station.read(canintf) == 0);
  CHECK(station.spi({0x94, 0, 0})[1] == 0x123 >> 3);
  CHECK(station.spi({0x92, 0})[1] == 1);
}

TEST_CASE("mcp2515: LOAD TX BUFFER and RTS [12.6, 12.7]") {
  Station station;
  station.start();
  for (unsigned i = 0; i < 3; ++i) {
    station.load(i, standard_frame(0x100 + i, {1, 2}));
    station.spi({static_cast<std::uint8_t>(0x41 | i << 1), static_cast<std::uint8_t>(7 + i)});
  }
  station.spi({0x80});  // ignored
  station.wire.advance(200);
  CHECK(station.wire.sent() == 0);
  station.spi({0x87});
  station.wire.advance(400);
  REQUIRE(station.peer.received.size() == 3);
  for (unsigned i = 0; i < 3; ++i) {
    CHECK(station.peer.received[i] == standard_frame(0x102 - i, {static_cast<std::uint8_t>(9 - i), 2}));
  }
}

TEST_CASE("mcp2515: READ STATUS [Figure 12-8]") {
  Station station;
  CHECK(station.spi({0xA0, 0, 0}) == Bytes{0xA5, 0, 0});
  station.spi({0x85});
  CHECK(station.spi({0xA0, 0})[1] == 0x44);
  station.write(canintf, 0x1F);
  CHECK(station.spi({0xA0, 0})[1] == 0xEF);
}

TEST_CASE("mcp2515: RX STATUS [Figure 12-9]") {
  Station station;
  station.write(rxb0ctrl, 0x04);  // BUKT, filters
  station.write(rxb1ctrl, 0x00);
  station.write(0x04, 0x24);  // RXF1: 123h
  station.write(0x05, 0x60);
  station.write(0x14, 0x40);  // RXF4: extended 200h << 18
  station.write(0x15, 0x08);
  station.start();
  CHECK(station.spi({0xB0, 0, 0}) == Bytes{0xA5, 0, 0});
  station.receive(remote_frame(extended_frame(0x200 << 18)));
  CHECK(station.spi({0xB0, 0})[1] == (0x80 | 0x18 | 4));
  station.modify(canintf, 2, 0);
  station.receive(standard_frame(0x123, {0, 0}));
  CHECK(station.spi({0xB0, 0})[1] == (0x40 | 1));
  station.receive(standard_frame(0x123, {0, 0}));
  CHECK(station.spi({0xB0, 0})[1] == (0xC0 | 1));
  station.modify(canintf, 1, 0);
  CHECK(station.spi({0xB0, 0})[1] == (0x80 | 7));  // rollover
  station.receive(remote_frame(standard_frame(0)));
  CHECK(station.spi({0xB0, 0})[1] == (0xC0 | 0x08));
}

// ---- Registers and modes [10.0, 11.0]

TEST_CASE("mcp2515: read-only registers, receive buffers and reserved values are faults") {
  Station station;
  station.write(0x0E, 0);
  station.write(0x1C, 0);
  station.write(0x61, 0);
  station.write(rxb0ctrl, 0x20);
  station.write(canctrl, 0xA0);
  station.write(0x0D, 1);
  CHECK(station.faults() == 6);
  station.write(rxb0ctrl, 0xFF);
  CHECK(station.read(rxb0ctrl) == 0x66);  // BUKT has a copy
  station.write(rxb1ctrl, 0xFF);
  CHECK(station.read(rxb1ctrl) == 0x60);
  station.write(eflg, 0xFF);
  CHECK(station.read(eflg) == 0xC0);
}

TEST_CASE("mcp2515: filters, masks and bit timing are written in Configuration mode only [10.1]") {
  Station station;
  station.start();
  for (const std::uint8_t address : Bytes{0x00, 0x13, 0x20, 0x28, 0x29, 0x2A, 0x0D}) {
    CAPTURE(address);
    const std::uint8_t before = station.read(address);
    station.write(address, 0x18);
    CHECK(station.read(address) == before);
    CHECK(station.faults() == 1);
  }
}

TEST_CASE("mcp2515: a mode changes when pending transmissions are complete [10.0]") {
  Station station;
  station.start();
  station.send(0, standard_frame(1));
  station.modify(canctrl, 0xE0, configuration);
  station.wire.advance(30);
  CHECK(station.mode() == normal);
  station.wire.advance(60);
  CHECK(station.mode() == configuration);
  CHECK(station.wire.sent() == 1);
}

TEST_CASE("mcp2515: ABAT lets the mode change without acknowledgement on the bus [3.6, 10.0]") {
  Station station;
  station.peer.node().stop();
  station.start();
  station.send(0, standard_frame(1));
  station.modify(canctrl, 0xE0, configuration);
  station.wire.advance(1000);
  CHECK(station.mode() == normal);
  station.modify(canctrl, abat, abat);
  station.wire.advance(100);
  CHECK(station.mode() == configuration);
  CHECK(station.read(0x1C) == 0);  // the counters are cleared [10.1]
}

TEST_CASE("mcp2515: Loopback mode receives own frames and does not touch the bus [10.4]") {
  Station station;
  station.start(loopback);
  station.send(1, standard_frame(0x123, {1}));
  station.wire.advance(100);
  CHECK(station.read(canintf) == 0x09);
  CHECK(station.peer.received.empty());
}

TEST_CASE("mcp2515: Listen-Only mode receives without acknowledgement and without counting [10.3]") {
  Station station;
  station.start(listen_only);
  station.send(0, standard_frame(1));
  station.peer.send(standard_frame(0x123));
  station.wire.advance(100);
  CHECK(station.wire.sent() == 0);
  CHECK(station.read(0x1D) == 0);
  CanPeer other(station.wire);
  station.wire.advance(300);
  CHECK(station.wire.sent() == 1);
  CHECK((station.read(canintf) & 1) == 1);
}

TEST_CASE("mcp2515: Sleep mode ends with activity on the bus in Listen-Only mode, if WAKIE is set [10.2]") {
  for (const bool is_enabled : {false, true}) {
    CAPTURE(is_enabled);
    Station station;
    CanPeer other(station.wire);
    station.write(caninte, is_enabled ? 0x40 : 0);
    station.start(sleep_mode);
    station.receive(standard_frame(1));
    station.wire.advance(20);
    CHECK(station.mode() == (is_enabled ? listen_only : sleep_mode));
    CHECK(station.read(canintf) == (is_enabled ? 0x40 : 0));  // the frame is lost
    CHECK(station.can.interrupt() == is_enabled);
  }
}

TEST_CASE("mcp2515: setting WAKIF ends Sleep mode [10.2]") {
  Station station;
  station.write(caninte, 0x40);
  station.start(sleep_mode);
  station.modify(canintf, 0x40, 0x40);
  CHECK(station.mode() == listen_only);
}

TEST_CASE("mcp2515: bit rate, sample point and requirements of bit timing [5.0]") {
  Mcp2515::Options options;
  options.oscillator = 16'000'000;
  Station station(options);
  CHECK(station.can.bit_rate() == 500'000);
  CHECK(station.can.sample_point() == 750);
  station.write(0x2A, 0x41);
  CHECK(station.can.bit_rate() == 250'000);
  station.write(0x29, 0x25);  // BTLMODE 0: PHSEG2 equals PHSEG1
  CHECK(station.can.sample_point() == 1000 * 12 / 17);
  station.write(0x29, 0x80);  // 1 + 1 + 1 + 4
  station.start();
  CHECK(station.faults() == 1);
  station.start(configuration);
  station.write(0x29, 0xA5);
  station.write(0x2A, 0xC0);  // SJW 4 is not less than PHSEG2
  station.start();
  CHECK(station.faults() == 1);
}

TEST_CASE("mcp2515: a controller with another bit rate than the bus does not take part") {
  Mcp2515::Options options;
  options.oscillator = 8'000'000;
  Station station(options);
  station.wire.bit_rate = 500'000;
  station.start();
  station.send(0, standard_frame(1));
  station.wire.advance(200);
  CHECK(station.wire.sent() == 0);
  CHECK(station.faults() == 1);
}

// ---- Transmission [3.0]

TEST_CASE("mcp2515: a sent frame clears TXREQ and sets TXnIF [3.3, 7.2]") {
  Station station;
  station.write(caninte, 0x08);
  station.start();
  station.send(1, extended_frame(0x12345678, {1, 2, 3, 4, 5, 6, 7, 8}));
  CHECK(station.read(0x40) == 0x08);
  CHECK_FALSE(station.can.interrupt());
  station.wire.advance(160);
  CHECK(station.peer.received.at(0) == extended_frame(0x12345678, {1, 2, 3, 4, 5, 6, 7, 8}));
  CHECK(station.read(0x40) == 0);
  CHECK(station.read(canintf) == 0x08);
  CHECK(station.can.interrupt());
  CHECK((station.read(0x0E) & 0x0E) == 4 << 1);  // ICOD
  station.modify(canintf, 0x08, 0);
  CHECK_FALSE(station.can.interrupt());
}

TEST_CASE("mcp2515: remote frames are sent [Register 3-7]") {
  Station station;
  station.start();
  station.send(0, remote_frame(standard_frame(0x123), 2));
  station.wire.advance(100);
  CHECK(station.peer.received.at(0) == remote_frame(standard_frame(0x123), 2));
}

TEST_CASE("mcp2515: the highest TXP is sent first, then the highest buffer [3.2]") {
  Station station;
  for (unsigned i = 0; i < 3; ++i) {
    station.load(i, standard_frame(0x100 + i));
  }
  station.modify(0x40, 3, 2);  // TXP of buffer 1
  station.spi({0x87});
  station.start();
  station.wire.advance(400);
  REQUIRE(station.peer.received.size() == 3);
  CHECK(station.peer.received[0].id == 0x101);
  CHECK(station.peer.received[1].id == 0x102);
  CHECK(station.peer.received[2].id == 0x100);
}

TEST_CASE("mcp2515: a transmit buffer is not written while its message is pending [3.0]") {
  Station station;
  station.start();
  station.send(0, standard_frame(1));
  station.write(0x36, 1);
  CHECK(station.faults() == 1);
  station.wire.advance(10);
  station.modify(0x30, 8, 0);  // still on the bus
  station.write(0x36, 1);
  station.spi({0x81});
  CHECK(station.faults() == 2);
}

TEST_CASE("mcp2515: a lost arbitration or an error is repeated, or ends with ABTF in One-Shot mode [3.4, 3.6]") {
  for (const bool is_one_shot : {false, true}) {
    for (const bool is_error : {false, true}) {
      CAPTURE(is_one_shot);
      CAPTURE(is_error);
      Station station;
      station.start(is_one_shot ? osm : normal);
      if (is_error) {
        station.wire.disturb_frames(1, 25);
      } else {
        station.peer.send(standard_frame(0));
      }
      station.send(0, standard_frame(0x100));
      station.wire.advance(40);
      const std::uint8_t cause = is_error ? 0x10 : 0x20;
      CHECK(station.read(0x30) == (is_one_shot ? 0x40 | cause : 0x08 | cause));
      CHECK(((station.read(canintf) & 0x80) != 0) == is_error);  // MERRF
      station.wire.advance(300);
      CHECK((station.read(canintf) & 4) == (is_one_shot ? 0 : 4));
      station.send(0, standard_frame(0x101));
      CHECK(station.read(0x30) == 0x08);  // TXREQ clears the flags
      station.wire.advance(100);
    }
  }
}

TEST_CASE("mcp2515: ABAT aborts with ABTF, clearing TXREQ without; a message on the bus is completed [3.6]") {
  for (const bool by_abat : {false, true}) {
    CAPTURE(by_abat);
    Station station;
    station.start();
    station.send(0, standard_frame(1));
    station.load(1, standard_frame(2));
    station.wire.advance(10);
    station.spi({0x82});
    if (by_abat) {
      station.modify(canctrl, abat, abat);
      CHECK(station.read(0x30) == 0x08);
    } else {
      station.modify(0x30, 8, 0);
      station.modify(0x40, 8, 0);
    }
    CHECK(station.read(0x40) == (by_abat ? 0x40 : 0));
    station.wire.advance(200);
    CHECK(station.wire.sent() == 1);
    CHECK(station.read(canintf) == 0x04);
    CHECK(station.read(0x30) == 0);
    station.spi({0x82});
    station.wire.advance(200);
    CHECK(station.wire.sent() == (by_abat ? 1 : 2));  // ABAT must be reset to continue
    station.modify(canctrl, abat, 0);
    station.spi({0x82});
    station.wire.advance(200);
    CHECK(station.wire.sent() == (by_abat ? 2 : 3));
  }
}

TEST_CASE("mcp2515: an aborted message on the bus is not repeated after an error [3.6]") {
  for (const bool by_abat : {false, true}) {
    CAPTURE(by_abat);
    Station station;
    station.start();
    station.wire.disturb_frames(1, 30);
    station.send(0, standard_frame(1));
    station.wire.advance(10);
    if (by_abat) {
      station.modify(canctrl, abat, abat);
    } else {
      station.modify(0x30, 8, 0);
    }
    station.wire.advance(200);
    CHECK(station.wire.sent() == 0);
    CHECK(station.read(0x30) == (by_abat ? 0x50 : 0x10));
  }
}

// ---- Reception [4.0]

TEST_CASE("mcp2515: layout of received messages [Registers 4-4 to 4-9]") {
  Station station;
  station.start();
  station.receive(remote_frame(standard_frame(0x123), 3));
  Bytes bytes = station.spi({0x03, 0x60, 0, 0, 0, 0, 0, 0});
  CHECK((bytes[2] & 0x08) == 0x08);  // RXRTR
  CHECK(bytes[3] == 0x24);
  CHECK(bytes[4] == 0x70);  // SRR
  CHECK(bytes[7] == 3);
  station.modify(canintf, 1, 0);
  station.receive(remote_frame(extended_frame(0x1FFFFFFF), 2));
  bytes = station.spi({0x03, 0x60, 0, 0, 0, 0, 0, 0});
  CHECK(bytes[4] == 0xEB);
  CHECK(bytes[7] == 0x42);
  station.modify(canintf, 1, 0);
  station.receive(standard_frame(0x123, {9}));
  bytes = station.spi({0x03, 0x60, 0, 0, 0, 0, 0, 0, 0});
  CHECK((bytes[2] & 0x08) == 0);
  CHECK(bytes[4] == 0x60);
  CHECK(bytes[8] == 9);
}

TEST_CASE("mcp2515: filters 0 and 1 with mask 0 lead to RXB0, the others with mask 1 to RXB1 [4.2, 4.5]") {
  Station station;
  station.write(rxb0ctrl, 0);
  station.write(rxb1ctrl, 0);
  for (std::uint8_t i = 0; i < 6; ++i) {
    station.write(static_cast<std::uint8_t>(4 * i + (i >= 3 ? 4 : 0)), static_cast<std::uint8_t>(0x10 + i));
  }
  station.start();
  for (std::uint8_t i = 0; i < 6; ++i) {
    CAPTURE(i);
    station.receive(standard_frame((0x10U + i) << 3));
    const bool is_first = i < 2;
    CHECK(station.read(canintf) == (is_first ? 1 : 2));
    CHECK((station.read(is_first ? rxb0ctrl : rxb1ctrl) & (is_first ? 1 : 7)) == i);
    station.modify(canintf, 3, 0);
  }
  CHECK_FALSE(station.accepts(standard_frame(0x16 << 3)));
  CHECK_FALSE(station.accepts(standard_frame(0x10 << 3 | 1)));
  CHECK_FALSE(station.accepts(extended_frame(0x10 << 21)));
  CHECK(station.peer.received.empty());
}

TEST_CASE("mcp2515: masks, EXIDE, and two data bytes with standard frames [4.5.1, Register 4-1]") {
  Station station;
  station.write(rxb0ctrl, 0);
  station.write(rxb1ctrl, 0);
  station.spi({0x02, 0x00, 0x24, 0x60, 0x11, 0x22});  // RXF0: 123h, data 11h 22h
  station.spi({0x02, 0x04, 0x91, 0xA8, 0x56, 0x78});  // RXF1: extended 12345678h & …
  station.spi({0x02, 0x20, 0xFF, 0xE3, 0xFF, 0xF0});  // RXM0
  for (std::uint8_t i = 8; i < 0x1C; i = static_cast<std::uint8_t>(i == 8 ? 0x10 : i + 4)) {
    station.write(i, 0xFF);
  }
  station.start();
  CHECK(station.accepts(standard_frame(0x123, {0x11, 0x22})));
  CHECK(station.accepts(standard_frame(0x123, {0x11, 0x2F})));
  CHECK_FALSE(station.accepts(standard_frame(0x123, {0x11, 0x32})));
  CHECK_FALSE(station.accepts(standard_frame(0x123, {0x12, 0x22})));
  CHECK_FALSE(station.accepts(standard_frame(0x122, {0x11, 0x22})));
  CHECK(station.accepts(extended_frame(0x12345678)));
  CHECK(station.accepts(extended_frame(0x12345670)));
  CHECK_FALSE(station.accepts(extended_frame(0x12345778)));
  CHECK_FALSE(station.accepts(extended_frame(0x12355678)));
}

TEST_CASE("mcp2515: a full buffer overflows, or rolls over with BUKT [Figure 4-3, 7.6.1]") {
  for (const bool rolls_over : {false, true}) {
    CAPTURE(rolls_over);
    Station station;
    station.modify(rxb0ctrl, 4, rolls_over ? 4 : 0);
    station.write(caninte, 0x20);
    station.start();
    station.receive(standard_frame(0x101, {1}));
    CHECK(station.read(eflg) == 0);
    station.receive(standard_frame(0x102, {2}));
    CHECK(station.read(canintf) == (rolls_over ? 0x03 : 0x21));
    CHECK(station.read(eflg) == (rolls_over ? 0 : 0x40));
    station.receive(standard_frame(0x103, {3}));
    CHECK(station.read(eflg) == (rolls_over ? 0x80 : 0x40));
    CHECK(station.can.interrupt());
    CHECK(station.spi({0x92, 0})[1] == 1);  // the first message is kept
    station.modify(eflg, 0xC0, 0);
    CHECK(station.read(eflg) == 0);
    station.modify(canintf, 0x20, 0);
    CHECK_FALSE(station.can.interrupt());
  }
}

TEST_CASE("mcp2515: RXB1 overflows with its own filters [Figure 4-3]") {
  Station station;
  station.write(rxb0ctrl, 0);
  station.start();
  station.receive(standard_frame(0x101));
  station.receive(standard_frame(0x102));
  CHECK(station.read(canintf) == 0x22);
  CHECK(station.read(eflg) == 0x80);
}

// ---- Errors [6.0, 7.0]

TEST_CASE("mcp2515: warning, error passive and bus-off set EFLG and ERRIF [Register 6-3, 7.6]") {
  struct Case {
    unsigned tec;
    unsigned rec;
    std::uint8_t flags;
  };
  for (const Case& one : {Case{95, 95, 0}, Case{96, 0, 0x05}, Case{0, 96, 0x03}, Case{127, 127, 0x07},
                          Case{128, 0, 0x15}, Case{0, 128, 0x0B}}) {
    CAPTURE(one.tec);
    CAPTURE(one.rec);
    Station station;
    station.write(caninte, 0x20);
    station.start();
    station.can.node().set_counters(one.tec, one.rec);
    CHECK(station.read(0x1C) == one.tec);
    CHECK(station.read(0x1D) == one.rec);
    CHECK(station.read(eflg) == one.flags);
    CHECK(station.can.interrupt() == (one.flags != 0));
    station.can.node().set_counters(0, 0);
    CHECK(station.read(eflg) == 0);
  }
}

TEST_CASE("mcp2515: ERRIF is set by each new flag, or stays set while a flag is set [7.7]") {
  for (const bool is_sticky : {false, true}) {
    CAPTURE(is_sticky);
    Mcp2515::Options options;
    options.is_error_flag_sticky = is_sticky;
    Station station(options);
    station.start();
    station.can.node().set_counters(96, 0);
    station.modify(canintf, 0x20, 0);
    CHECK(station.read(canintf) == (is_sticky ? 0x20 : 0));
    station.can.node().set_counters(97, 0);
    CHECK(station.read(canintf) == (is_sticky ? 0x20 : 0));
    station.can.node().set_counters(128, 0);
    CHECK(station.read(canintf) == 0x20);
    station.can.node().set_counters(0, 0);
    station.modify(canintf, 0x20, 0);
    CHECK(station.read(canintf) == 0);
  }
}

TEST_CASE("mcp2515: bus-off ends after 128 sequences of 11 recessive bits [Figure 6-1]") {
  Station station;
  station.start();
  station.can.node().set_counters(248, 0);
  station.wire.disturb_frames(1, 25);
  station.send(0, standard_frame(1, {0x55}));
  REQUIRE(station.wire.advance_until([&] { return station.can.node().is_bus_off(); }, 300));
  CHECK((station.read(eflg) & 0x20) == 0x20);
  CHECK((station.read(canintf) & 0x20) == 0x20);
  station.wire.advance(128 * 11);
  CHECK((station.read(eflg) & 0x20) == 0x20);
  station.wire.advance(30);
  CHECK(station.read(eflg) == 0);
  station.wire.advance(100);
  CHECK(station.wire.sent() == 1);
}

TEST_CASE("mcp2515: Configuration mode ends bus-off after an abort [10.1]") {
  Station station;
  station.start();
  station.can.node().set_counters(248, 0);
  station.wire.disturb_frames(1, 25);
  station.send(0, standard_frame(1, {0x55}));
  REQUIRE(station.wire.advance_until([&] { return station.can.node().is_bus_off(); }, 300));
  station.write(canctrl, configuration | abat);
  station.wire.advance(1);
  CHECK(station.mode() == configuration);
  CHECK(station.read(eflg) == 0);
  CHECK(station.read(0x30) == 0x50);
}

TEST_CASE("mcp2515: ICOD has the enabled interrupt of highest priority [7.1, Table 7-1]") {
  Station station;
  station.write(canintf, 0x7F);
  const std::uint8_t order[] = {0x20, 0x40, 0x04, 0x08, 0x10, 0x01, 0x02};
  std::uint8_t enabled = 0x7F;
  for (std::uint8_t i = 0; i < 7; ++i) {
    station.write(caninte, enabled);
    CHECK((station.read(0x0E) & 0x0E) == 2 * (i + 1));
    enabled = static_cast<std::uint8_t>(enabled & ~order[i]);
  }
  station.write(caninte, 0);
  CHECK((station.read(0x0E) & 0x0E) == 0);
  CHECK_FALSE(station.can.interrupt());
}
