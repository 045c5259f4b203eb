// SPDX-License-Identifier: Apache-2.0
#include "can_wire.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <random>

using namespace test;
using Kind = CanDisturbance::Kind;

namespace {

constexpr std::uint64_t integration = 11;  // bits until a node that was started takes part
constexpr unsigned crc_delimiter_to_ack = 1;

// The distance of the CRC delimiter from the start of frame.
unsigned crc_delimiter(const CanFrame& frame) { return frame_bits(frame) - 10; }

// Returns a bit whose inversion leaves the frame complete, with a wrong CRC.
unsigned bit_without_stuff_error(const CanFrame& frame) {
  const std::vector<CanBit> bits = encode(frame);
  for (unsigned at = 20; at < bits.size(); ++at) {
    CanDecoder decoder;
    CanDecoder::Result result = CanDecoder::Result::more;
    for (unsigned i = 0; i < bits.size() && result == CanDecoder::Result::more; ++i) {
      result = decoder.add(i == at ? !bits[i].level : bits[i].level);
      if (result == CanDecoder::Result::complete && i + 1 == bits.size() && !decoder.crc_is_right()) {
        return at;
      }
    }
  }
  return 0;
}

struct Bus {
  CanWire wire;
  CanPeer one{wire, FdMode::classic, "one"};
  CanPeer two{wire, FdMode::classic, "two"};
  Bus() { wire.advance(integration); }
};

}  // namespace

TEST_CASE("can wire: a node takes part after 11 recessive bits") {
  CanWire wire;
  CanPeer peer(wire);
  wire.hold(dominant);
  wire.advance(20);
  wire.release();
  wire.advance(10);
  CHECK_FALSE(peer.node().is_on_bus());
  wire.advance(1);
  CHECK(peer.node().is_on_bus());
}

TEST_CASE("can wire: a frame takes its exact number of bits") {
  Bus bus;
  const CanFrame frame = standard_frame(0x181, {0, 0, 0, 0xFF});
  bus.one.send(frame);
  const std::uint64_t begin = bus.wire.now();
  bus.wire.advance(frame_bits(frame) - 2);
  CHECK(bus.two.received.empty());
  bus.wire.advance(1);  // the last but one bit of the end of frame
  CHECK(bus.two.received.size() == 1);
  CHECK(bus.one.queued() == 1);
  bus.wire.advance(1);
  CHECK(bus.one.queued() == 0);
  REQUIRE(bus.wire.records().size() == 1);
  CHECK(bus.wire.records()[0].begin == begin);
  CHECK(bus.wire.records()[0].end == begin + frame_bits(frame));
  CHECK(bus.two.received[0] == frame);
}

TEST_CASE("can wire: queued frames follow each other after three bits of intermission") {
  Bus bus;
  bus.one.send(standard_frame(1));
  bus.one.send(standard_frame(2));
  bus.wire.advance(500);
  REQUIRE(bus.wire.records().size() == 2);
  CHECK(bus.wire.records()[1].begin == bus.wire.records()[0].end + 3);
}

TEST_CASE("can wire: the lower identifier wins, the loser receives and repeats") {
  Bus bus;
  bus.one.send(standard_frame(0x182));
  bus.two.send(standard_frame(0x181));
  bus.wire.advance(300);
  REQUIRE(bus.wire.sent() == 2);
  CHECK(bus.wire.sent_frames()[0].id == 0x181);
  CHECK(bus.wire.sent_frames()[1].id == 0x182);
  CHECK(bus.one.arbitrations_lost == 1);
  CHECK(bus.one.received.size() == 1);
  CHECK(bus.two.received.size() == 1);
  CHECK(bus.wire.errors(CanError::bit1) == 0);
}

TEST_CASE("can wire: data frame, remote frame and extended frame with equal first bits") {
  CanWire wire;
  CanPeer data(wire);
  CanPeer remote(wire);
  CanPeer extended(wire);
  wire.advance(integration);
  extended.send(extended_frame(0x123U << 18));
  remote.send(remote_frame(standard_frame(0x123)));
  data.send(standard_frame(0x123));
  wire.advance(500);
  const std::vector<CanFrame> frames = wire.sent_frames();
  REQUIRE(frames.size() == 3);
  CHECK((!frames[0].is_remote && !frames[0].is_extended));
  CHECK((frames[1].is_remote && !frames[1].is_extended));
  CHECK(frames[2].is_extended);
}

TEST_CASE("can wire: equal identifiers with different data are a bit error") {
  Bus bus;
  bus.one.send(standard_frame(0x100, {0x00}));
  bus.two.send(standard_frame(0x100, {0x80}));
  bus.one.retransmits = false;
  bus.two.retransmits = false;
  bus.wire.advance(200);
  REQUIRE_FALSE(bus.wire.records().empty());
  CHECK(bus.wire.records()[0].error == CanError::bit1);
  CHECK(bus.wire.records()[0].node == &bus.two.node());
  CHECK(bus.wire.sent() == 0);
}

TEST_CASE("can wire: without another node the transmitter becomes error passive, not bus-off") {
  CanWire wire;
  CanPeer alone(wire);
  wire.advance(integration);
  alone.send(standard_frame(0x10));
  wire.advance_until([&] { return alone.node().is_error_passive(); });
  CHECK(alone.node().tec() == 128);
  CHECK(wire.errors(CanError::ack) == 16);
  wire.advance(50'000);
  CHECK(alone.node().tec() == 128);
  CHECK_FALSE(alone.node().is_bus_off());
  CHECK(wire.sent() == 0);
  CHECK(wire.errors(CanError::ack) > 100);
}

TEST_CASE("can wire: an error passive transmitter waits 8 further bits") {
  CanWire wire;
  CanPeer alone(wire);
  wire.advance(integration);
  alone.send(standard_frame(0x10));
  alone.node().set_counters(0, 0);
  const auto distance = [&](std::size_t index) { return wire.records()[index + 1].begin - wire.records()[index].end; };
  wire.advance(1000);
  CHECK(distance(0) == 6 + 8 + 3);  // error flag, delimiter, intermission
  wire.clear_records();
  alone.node().set_counters(200, 0);
  wire.advance(1000);
  CHECK(distance(2) == 6 + 8 + 3 + 8);
}

TEST_CASE("can wire: transmit and receive error counters of a bit error") {
  Bus bus;
  bus.one.send(standard_frame(0x100, {0x55}));
  bus.wire.disturb_frames(1, 25);  // in the data field
  bus.wire.advance(60);
  CHECK(bus.one.node().tec() == 8);
  CHECK(bus.two.node().rec() == 1);
  bus.wire.advance(100);
  CHECK(bus.one.node().tec() == 7);
  CHECK(bus.two.node().rec() == 0);
  CHECK(bus.two.received.size() == 1);
}

TEST_CASE("can wire: the receiver that detects an error alone counts 9") {
  // Its error flag is followed by those of the others: the bit after its flag is dominant. [12.1.4.2 a, b]
  CanWire wire;
  CanPeer sender(wire);
  CanPeer disturbed(wire);
  CanPeer other(wire);
  wire.advance(integration);
  const CanFrame frame = standard_frame(0x555, {0x55, 0x55, 0x55, 0x55});
  sender.send(frame);
  // The error is signalled after the ACK delimiter.
  wire.disturb_frames(1, bit_without_stuff_error(frame), Kind::invert, 1, &disturbed.node());
  wire.advance(frame_bits(frame) + 30);
  CHECK(disturbed.node().rec() == 9);
  CHECK(other.node().rec() == 1);
  CHECK(sender.node().tec() == 8);
  CHECK(wire.errors(CanError::crc) == 1);
  wire.advance(200);
  CHECK(disturbed.received.size() == 1);
}

TEST_CASE("can wire: a dominant CRC delimiter is a form error") {
  Bus bus;
  const CanFrame frame = standard_frame(0x321);
  bus.one.send(frame);
  bus.wire.disturb_frames(1, crc_delimiter(frame));
  bus.wire.advance(200);
  CHECK(bus.wire.errors(CanError::form) == 2);
  CHECK(bus.wire.sent() == 1);
}

TEST_CASE("can wire: a missing acknowledgement is an ACK error of the transmitter only") {
  Bus bus;
  const CanFrame frame = standard_frame(0x321);
  bus.one.send(frame);
  bus.wire.disturb_frames(1, crc_delimiter(frame) + crc_delimiter_to_ack, Kind::set_recessive, 1, &bus.one.node());
  bus.wire.advance(200);
  CHECK(bus.wire.errors(CanError::ack) == 1);
  CHECK(bus.wire.errors(CanError::form) == 1);  // the receiver sees the error flag in the ACK delimiter
  CHECK(bus.wire.sent() == 1);
}

TEST_CASE("can wire: six equal bits are a stuff error of the receiver") {
  Bus bus;
  bus.one.send(standard_frame(0x555, {0x55}));
  bus.wire.disturb_frames(1, 20, Kind::set_dominant, 6, &bus.two.node());
  bus.wire.advance(40);
  CHECK(bus.wire.errors(CanError::stuff) == 1);
}

TEST_CASE("can wire: a dominant stuff bit in the arbitration field does not count") {
  // [12.1.4.2 c, exception 2]: five dominant bits, a recessive stuff bit that is monitored dominant.
  Bus bus;
  bus.one.send(standard_frame(0x00F));
  bus.wire.disturb_frames(1, 5, Kind::set_dominant);
  bus.wire.advance(20);
  REQUIRE(bus.wire.records().size() == 2);
  CHECK(bus.wire.records()[0].error == CanError::stuff);
  CHECK(bus.one.node().tec() == 0);
  CHECK(bus.two.node().rec() == 1);
  bus.wire.advance(100);
  CHECK(bus.two.received.size() == 1);
}

TEST_CASE("can wire: an error in the last bit of the frame duplicates the frame") {
  // The receiver accepted the frame at the last but one bit; the transmitter sends it again. [10.4.2.8]
  Bus bus;
  const CanFrame frame = standard_frame(0x700, {5});
  bus.one.send(frame);
  bus.wire.disturb_frames(1, frame_bits(frame) - 1, Kind::set_dominant);
  bus.wire.advance(300);
  CHECK(bus.two.received.size() == 2);
  CHECK(bus.wire.sent() == 1);
  CHECK(bus.two.node().rec() == 0);
}

TEST_CASE("can wire: a dominant bit in the intermission causes an overload frame") {
  Bus bus;
  const CanFrame frame = standard_frame(0x700);
  bus.one.send(frame);
  bus.one.send(frame);
  bus.wire.disturb_frames(1, frame_bits(frame), Kind::set_dominant);
  bus.wire.advance(300);
  REQUIRE(bus.wire.sent() == 2);
  // 1 bit of intermission, 6 bits overload flag, 8 bits delimiter, 3 bits intermission
  CHECK(bus.wire.records()[1].begin == bus.wire.records()[0].end + 1 + 6 + 8 + 3);
  CHECK(bus.one.node().tec() == 0);
}

TEST_CASE("can wire: a dominant third bit of the intermission is a start of frame") {
  Bus bus;
  const CanFrame frame = standard_frame(0x700);
  bus.one.send(frame);
  bus.one.send(standard_frame(0x701));
  bus.wire.disturb_frames(1, frame_bits(frame) + 2, Kind::set_dominant);
  bus.wire.advance(300);
  REQUIRE(bus.wire.sent() == 2);
  CHECK(bus.wire.records()[1].begin == bus.wire.records()[0].end + 2);
  CHECK(bus.two.received.size() == 2);
}

TEST_CASE("can wire: bus-off after 32 errors, back after 128 sequences of 11 recessive bits") {
  Bus bus;
  bus.one.send(standard_frame(0x100, {0x55}));
  bus.wire.disturb_frames(32, 25);
  REQUIRE(bus.wire.advance_until([&] { return bus.one.node().is_bus_off(); }));
  CHECK(bus.one.node().tec() == 256);
  CHECK(bus.wire.errors(CanError::bit0) + bus.wire.errors(CanError::bit1) >= 32);
  const std::uint64_t begin = bus.wire.now();
  REQUIRE(bus.wire.advance_until([&] { return !bus.one.node().is_bus_off(); }));
  CHECK(bus.one.node().tec() == 0);
  CHECK(bus.wire.now() - begin >= 128 * 11);
  CHECK(bus.wire.now() - begin < 128 * 11 + 30);  // the other node ends its error frame
  bus.wire.advance(200);
  CHECK(bus.two.received.size() == 1);
}

TEST_CASE("can wire: frames of others interrupt the recovery from bus-off") {
  Bus bus;
  bus.one.node().set_counters(256, 0);
  CHECK(bus.one.node().is_bus_off());
  bus.wire.advance(128 * 11 - 1);
  CHECK(bus.one.node().is_bus_off());
  bus.wire.disturb({Kind::set_dominant, bus.wire.now(), 1, &bus.one.node()});
  bus.wire.advance(1 + 10);
  CHECK(bus.one.node().is_bus_off());
  bus.wire.advance(1);
  CHECK_FALSE(bus.one.node().is_bus_off());
}

TEST_CASE("can wire: a bus that is stuck at dominant increases the counters by 8 for each 8 bits") {
  Bus bus;
  bus.one.send(standard_frame(0x100, {0x55}));
  bus.wire.advance(24);
  bus.wire.hold(dominant);
  bus.wire.advance(6 + 6 + 1);  // error of the receiver at the latest, flag
  const unsigned tec = bus.one.node().tec();
  bus.wire.advance(80);
  CHECK(bus.one.node().tec() == tec + 80);
}

TEST_CASE("can wire: an interrupted output leads to bus-off") {
  Bus bus;
  bus.one.send(standard_frame(0x100));
  bus.wire.hold(recessive);
  CHECK(bus.wire.advance_until([&] { return bus.one.node().is_bus_off(); }, 1000));
}

TEST_CASE("can wire: the receive error counter is limited and returns to 120") {
  Bus bus;
  bus.two.node().set_counters(0, 255);
  CHECK(bus.two.node().is_error_passive());
  bus.one.send(standard_frame(0x100));
  bus.wire.advance(100);
  CHECK(bus.two.node().rec() == 120);
  CHECK_FALSE(bus.two.node().is_error_passive());
}

TEST_CASE("can wire: an error passive receiver does not destroy the frame of others") {
  Bus bus;
  CanPeer third(bus.wire);
  bus.wire.advance(integration);
  third.node().set_counters(0, 130);
  const CanFrame frame = standard_frame(0x555, {0x55, 0x55});
  bus.one.send(frame);
  bus.wire.disturb_frames(1, 22, Kind::set_dominant, 6, &third.node());
  bus.wire.advance(200);
  CHECK(bus.one.failures == 0);
  CHECK(bus.two.received.size() == 1);
  CHECK(third.received.empty());
  CHECK(third.node().rec() >= 131);
}

TEST_CASE("can wire: a silent node receives and does not acknowledge") {
  CanWire wire;
  CanPeer sender(wire);
  CanPeer silent(wire);
  CanMode mode;
  mode.is_silent = true;
  silent.node().set_mode(mode);
  wire.advance(integration);
  silent.send(standard_frame(1));
  sender.send(standard_frame(2));
  sender.retransmits = false;
  wire.advance(200);
  CHECK(wire.errors(CanError::ack) == 1);
  CHECK(wire.sent() == 0);
}

TEST_CASE("can wire: a node in loopback receives its own frames and disregards the bus") {
  CanWire wire;
  CanPeer alone(wire);
  CanMode mode;
  mode.is_loopback = true;
  alone.node().set_mode(mode);
  wire.hold(dominant);
  wire.advance(integration);
  alone.send(standard_frame(0x77, {1, 2}));
  wire.advance(100);
  CHECK(wire.sent() == 1);
  REQUIRE(alone.received.size() == 1);
  CHECK(alone.received[0] == standard_frame(0x77, {1, 2}));
}

TEST_CASE("can wire: an FD frame is received, tolerated or destroyed") {
  CanWire wire;
  CanPeer sender(wire, FdMode::enabled);
  CanPeer other(wire, FdMode::enabled);
  CanPeer tolerant(wire, FdMode::tolerant);
  wire.advance(integration);
  sender.send(fd_frame(0x123, 15));
  sender.send(standard_frame(0x124));
  wire.advance(1000);
  CHECK(wire.sent() == 2);
  CHECK(other.received.size() == 2);
  CHECK(tolerant.received.size() == 1);
  CHECK(tolerant.node().rec() == 0);
  CanPeer classic(wire, FdMode::classic);
  wire.advance(integration);
  sender.retransmits = false;
  sender.send(fd_frame(0x123, 15));
  wire.advance(1000);
  CHECK(wire.sent() == 2);
  CHECK(classic.node().rec() != 0);
}

TEST_CASE("can wire: a node with transmit pause lets others send between its frames") {
  Bus bus;
  CanMode mode;
  mode.pauses = true;
  bus.one.node().set_mode(mode);
  bus.one.send(standard_frame(1));
  bus.one.send(standard_frame(2));
  bus.wire.advance(1);
  bus.two.send(standard_frame(0x500));
  bus.wire.advance(400);
  const std::vector<CanFrame> frames = bus.wire.sent_frames();
  REQUIRE(frames.size() == 3);
  CHECK(frames[1].id == 0x500);
}

TEST_CASE("can wire: with random bit errors no frame is lost") {
  // Bits that all nodes see inverted do not leave the nodes with different opinions of a frame, but for duplicates.
  constexpr unsigned frames = 150;
  std::mt19937 random(4);
  CanWire wire;
  std::vector<std::unique_ptr<CanPeer>> peers;
  for (unsigned i = 0; i < 4; ++i) {
    peers.push_back(std::make_unique<CanPeer>(wire));
    for (unsigned n = 0; n < frames; ++n) {
      const auto id = static_cast<std::uint32_t>(random());
      CanFrame frame = random() % 2 == 0 ? standard_frame(id & 0x1FF) : extended_frame(id & 0x7FFFFFF);
      frame.id |= i << (frame.is_extended ? 27 : 9);  // unique for each sender
      frame.dlc = static_cast<std::uint8_t>(random() % 9);
      frame.data[0] = static_cast<std::uint8_t>(n);
      peers[i]->send(frame);
    }
  }
  const auto is_done = [&] {
    return std::all_of(peers.begin(), peers.end(), [](const auto& peer) { return peer->queued() == 0; });
  };
  for (unsigned i = 0; i < 4000 && !is_done(); ++i) {
    wire.disturb({Kind::invert, wire.now() + random() % 1000, 1, nullptr});
    wire.advance(1000);
  }
  REQUIRE(is_done());
  CHECK(wire.sent() == 4 * frames);
  wire.advance(2000);
  for (const auto& peer : peers) {
    CHECK_FALSE(peer->node().is_bus_off());
    CHECK(peer->received.size() >= 3 * frames);
    CHECK(peer->node().rec() < 128);
  }
}
