// SPDX-License-Identifier: Apache-2.0
// Paced virtual bus: exact lengths of frames in bits, and times at which frames begin and arrive. Lengths include the
// intermission, as in tables of bus loads.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "frame_bits.hpp"
#include "support/notation.hpp"
#include "support/stride.hpp"
#include "virtual_bus.hpp"

namespace {

using namespace std::chrono_literals;
using co::VirtualBus;
using Fault = VirtualBus::Fault;
using Time = VirtualBus::Time;
using Texts = std::vector<std::string>;

constexpr std::int16_t taken = sizeof(CO_IF_FRM);

struct Length {
  const char* frame;
  unsigned bits;
};

unsigned bits_of(const char* text) { return co::frame_bits(test::frame(text)) + co::intermission_bits; }

void check_lengths(const std::vector<Length>& vectors) {
  for (const Length& vector : vectors) {
    CAPTURE(vector.frame);
    CHECK(bits_of(vector.frame) == vector.bits);
  }
}

std::int16_t send(VirtualBus::Port& port, const char* text) { return port.send(test::frame(text)); }

// A paced bus with three ports, a time that the test sets, and a trace of the frames that have arrived: "µs frame".
struct Bench {
  explicit Bench(std::uint32_t bit_rate = 1000000) {
    bus.set_time([this] { return time; });
    bus.set_trace([this](const VirtualBus::Traffic& traffic) {
      trace.push_back(std::to_string(traffic.time.count()) + " " + test::notation(traffic.frame));
      dropped += traffic.dropped;
    });
    bus.pace(bit_rate);
    for (VirtualBus::Port* port : {&a, &b, &c}) {
      port->enable();
    }
  }

  // Runs the bus until \a end, stopping at each arrival of a frame.
  void run_until(Time end) {
    while (bus.next_due() <= end) {
      time = bus.next_due();
      bus.poll();
    }
    time = end;
  }

  Texts arrived_until(Time end) {
    run_until(end);
    return std::exchange(trace, {});
  }

  VirtualBus bus;
  Time time{0};
  Texts trace;
  int dropped = 0;
  VirtualBus::Port& a = bus.attach({"a"});
  VirtualBus::Port& b = bus.attach({"b"});
  VirtualBus::Port& c = bus.attach({"c"});
};

std::string at(std::uint64_t micros, const char* text) { return std::to_string(micros) + " " + text; }

}  // namespace

TEST_CASE("frame bits: data frames with 11-bit identifiers, 0 to 8 bytes [ISO 11898-1]") {
  check_lengths({{"080#", 51},
                 {"705#05", 59},
                 {"000#0100", 68},
                 {"605#4000100000000000", 124},
                 {"123#0000000000000000", 125},
                 {"123#FFFFFFFFFFFFFFFF", 124},
                 {"555#5555555555555555", 112},
                 {"181#11223344", 82}});
  check_lengths({{"000#", 53},
                 {"000#00", 59},
                 {"000#0000", 69},
                 {"000#000000", 79},
                 {"000#00000000", 89},
                 {"000#0000000000", 98},
                 {"000#000000000000", 107},
                 {"000#00000000000000", 117},
                 {"000#0000000000000000", 127}});
}

TEST_CASE("frame bits: data frames with 29-bit identifiers [ISO 11898-1]") {
  check_lengths({{"00000000#", 74},
                 {"1FFFFFFF#", 74},
                 {"00000000#0000000000000000", 150},
                 {"1FFFFFFF#FFFFFFFFFFFFFFFF", 149},
                 {"15555555#5555555555555555", 131},
                 {"18FF5601#0102030405060708", 143}});
}

TEST_CASE("frame bits: a remote frame has a length but no data [ISO 11898-1]") {
  check_lengths({{"000#R", 50},
                 {"000#R8", 52},
                 {"123#R", 48},
                 {"123#R8", 48},
                 {"7FF#R8", 50},
                 {"12345678#R", 69},
                 {"12345678#R8", 67}});
}

TEST_CASE("frame bits: five equal bits at the end of the CRC are followed by a stuff bit [ISO 11898-1]") {
  check_lengths({{"009#", 52}, {"017#", 50}, {"0E6#", 49}});
}

TEST_CASE("frame bits: DLC 9 to 15 mean 8 bytes [ISO 11898-1]") {
  check_lengths({{"123#1122334455667788", 112}, {"123#1122334455667788_9", 111}, {"123#1122334455667788_F", 111}});
}

TEST_CASE("frame bits: 8 bytes take 111 to 135 bits, 114 on average") {
  std::mt19937 random(1);
  std::uint64_t all = 0;
  constexpr unsigned frames = 20000 / test::stride(10);
  for (unsigned n = 0; n < frames; ++n) {
    CO_IF_FRM frame{static_cast<std::uint32_t>(random() & 0x7FF), {}, 8};
    std::generate_n(frame.Data, 8, [&] { return static_cast<std::uint8_t>(random()); });
    const unsigned bits = co::frame_bits(frame) + co::intermission_bits;
    REQUIRE(bits >= 111);
    REQUIRE(bits <= 135);
    all += bits;
  }
  CHECK((all + frames / 2) / frames == 114);
}

TEST_CASE("paced bus: a frame is received at its last bit, 3 bits before the bus is free") {
  const std::pair<std::uint32_t, Time> rates[] = {{1000000, 48us}, {500000, 96us}, {250000, 192us}, {125000, 384us}};
  for (const auto& rate : rates) {
    CAPTURE(rate.first);
    const Time arrival = rate.second;
    Bench bench(rate.first);
    CHECK(send(bench.a, "080#") == taken);
    CHECK(bench.bus.next_due() == arrival);
    bench.time = arrival - 1us;
    CHECK_FALSE(bench.b.read());
    bench.time = arrival;
    CHECK(bench.b.read());
    CHECK_FALSE(bench.a.read());
    CHECK(bench.c.waiting() == 1);
    CHECK(bench.bus.next_due() == VirtualBus::never);
  }
}

TEST_CASE("paced bus: a frame on an idle bus starts at once, the next ones without a gap") {
  Bench bench;
  bench.time = 1000us;
  send(bench.a, "080#");
  send(bench.a, "705#05");
  CHECK(bench.arrived_until(1500us) == Texts{at(1000 + 48, "080#"), at(1000 + 51 + 56, "705#05")});
  send(bench.b, "080#");
  CHECK(bench.arrived_until(2000us) == Texts{at(1500 + 48, "080#")});
}

TEST_CASE("paced bus: consecutive frames have no drift at any rate") {
  for (const std::uint64_t rate : {1000000u, 800000u, 500000u, 83333u, 33333u, 10007u}) {
    CAPTURE(rate);
    Bench bench(static_cast<std::uint32_t>(rate));
    send(bench.a, "080#");
    for (std::uint64_t n = 1; n <= 3000 / test::stride(20); ++n) {
      send(bench.a, "080#");
      const std::uint64_t bit_micros = (51 * n - 3) * 1000000;  // time in µs multiplied by the rate
      REQUIRE(bench.bus.next_due() == Time{(bit_micros + rate - 1) / rate});
      bench.run_until(bench.bus.next_due());
      REQUIRE(bench.b.read());
    }
  }
}

TEST_CASE("paced bus: when the bus is free the highest priority is sent, including the latest frames") {
  Bench bench;
  send(bench.a, "080#");
  send(bench.b, "300#");
  send(bench.b, "100#");  // queued behind 300 of the same port
  bench.run_until(20us);
  send(bench.c, "201#");
  bench.run_until(51us);  // the next frame starts at this time
  send(bench.a, "200#");
  CHECK(bench.arrived_until(1ms) == Texts{at(48, "080#"), at(51 + 48, "200#"), at(51 + 51 + 47, "201#"),
                                          at(51 + 51 + 50 + 48, "300#"), at(51 + 51 + 50 + 51 + 48, "100#")});
}

TEST_CASE("paced bus: a frame on the wire is not interrupted by a later one") {
  Bench bench;
  send(bench.b, "300#");
  bench.time = 1us;
  send(bench.a, "080#");
  CHECK(bench.arrived_until(1ms) == Texts{at(48, "300#"), at(51 + 48, "080#")});
}

TEST_CASE("paced bus: simultaneous frames on an idle bus are sent by priority, for any order of calls") {
  Bench bench;
  bench.time = 100us;
  send(bench.b, "300#");
  CHECK(bench.bus.next_due() == 148us);
  bench.bus.poll();
  send(bench.a, "080#");
  CHECK(bench.arrived_until(1ms) == Texts{at(148, "080#"), at(151 + 48, "300#")});
}

TEST_CASE("paced bus: an answer sent at reception takes part in the next arbitration") {
  Bench bench;
  send(bench.a, "080#");
  send(bench.c, "300#");
  bench.run_until(48us);
  REQUIRE(bench.b.read());
  send(bench.b, "201#");
  CHECK(bench.arrived_until(1ms) == Texts{at(48, "080#"), at(51 + 47, "201#"), at(51 + 50 + 48, "300#")});
}

TEST_CASE("paced bus: the frame on the wire occupies a slot of the transmit queue until its end") {
  Bench bench;
  VirtualBus::Port& small = bench.bus.attach({"three buffers", 512, 3});
  small.enable();
  for (const char* text : {"080#", "080#", "080#"}) {
    CHECK(send(small, text) == taken);
  }
  CHECK(send(small, "080#") == 0);
  bench.time = 47us;
  CHECK(send(small, "080#") == 0);
  bench.time = 48us;
  CHECK(send(small, "080#") == taken);
  CHECK(send(small, "080#") == 0);
  CHECK(bench.arrived_until(1ms).size() == 4);
}

TEST_CASE("paced bus: frames from outside take their time on the wire") {
  Bench bench;
  bench.bus.inject(test::frame("000#0100"));
  CHECK(bench.arrived_until(64us).empty());
  CHECK(bench.arrived_until(65us) == Texts{at(65, "000#0100")});
  CHECK(bench.a.waiting() == 1);
}

TEST_CASE("paced bus: a started frame is completed although its sender leaves; queued ones are lost") {
  const auto leave_by = [](void (*leave)(VirtualBus::Port&), Time moment) {
    Bench bench;
    send(bench.a, "080#");
    send(bench.a, "300#");
    bench.time = moment;
    leave(bench.a);
    return bench.arrived_until(1ms);
  };
  for (auto* const leave :
       {+[](VirtualBus::Port& port) { port.close(); }, +[](VirtualBus::Port& port) { port.reset(); },
        +[](VirtualBus::Port& port) { port.bus_off(); }}) {
    CHECK(leave_by(leave, 0us).empty());
    CHECK(leave_by(leave, 1us) == Texts{at(48, "080#")});
    CHECK(leave_by(leave, 51us) == Texts{at(51, "080#")});  // the bus was not polled before
    CHECK(leave_by(leave, 52us) == Texts{at(52, "080#"), at(51 + 48, "300#")});
  }
}

TEST_CASE("paced bus: a frame after a pause of its sender starts at once") {
  Bench bench;
  bench.bus.hold();
  send(bench.a, "080#");
  bench.a.reset();
  bench.bus.release();
  bench.time = 500us;
  send(bench.a, "080#");
  CHECK(bench.arrived_until(1ms) == Texts{at(548, "080#")});
}

TEST_CASE("paced bus: between hold and release no frame is received or started") {
  Bench bench;
  send(bench.a, "080#");
  send(bench.a, "705#05");
  bench.time = 10us;
  bench.bus.poll();
  bench.bus.hold();
  CHECK(bench.bus.next_due() == VirtualBus::never);
  bench.time = 500us;
  bench.bus.poll();
  CHECK(bench.trace.empty());
  bench.bus.release();
  CHECK(bench.arrived_until(1ms) == Texts{at(500, "080#"), at(556, "705#05")});
}

TEST_CASE("paced bus: a jump in time loses no frame and keeps the order") {
  Bench bench;
  send(bench.a, "300#");
  send(bench.a, "200#");
  send(bench.b, "080#");
  bench.time = 10ms;
  bench.bus.poll();
  CHECK(bench.trace == Texts{at(10000, "080#"), at(10000, "300#"), at(10000, "200#")});
}

TEST_CASE("paced bus fault: a dropped frame takes its time on the wire") {
  Bench bench;
  bench.bus.add_rule({Fault::drop});
  send(bench.a, "080#");
  send(bench.a, "705#05");
  CHECK(bench.arrived_until(1ms) == Texts{at(48, "080#"), at(51 + 56, "705#05")});
  CHECK(bench.dropped == 1);
  CHECK(bench.b.waiting() == 1);
}

TEST_CASE("paced bus fault: a delay starts at the end of the frame; a second copy takes no time") {
  Bench bench;
  bench.bus.add_rule({Fault::delay, {}, 1, 1, 20us});
  bench.bus.add_rule({Fault::duplicate, {}, 2});
  send(bench.a, "080#");
  send(bench.a, "705#05");
  CHECK(bench.arrived_until(1ms) == Texts{at(48 + 20, "080#"), at(51 + 56, "705#05"), at(51 + 56, "705#05")});
}

TEST_CASE("paced bus: without a bit rate frames take no time") {
  Bench bench;
  bench.bus.pace(0);
  send(bench.a, "080#");
  CHECK(bench.trace == Texts{at(0, "080#")});
  CHECK(bench.bus.next_due() == VirtualBus::never);
}
