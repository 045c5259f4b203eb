// SPDX-License-Identifier: Apache-2.0
// Behaviour that only the driver for SJA1000 and TWAI has, on the models of the controllers.
#include <algorithm>

#include "bench.hpp"
#include "pelican.hpp"
#include "support/notation.hpp"

namespace {

using namespace test;
using Texts = std::vector<std::string>;

PeliCan& model_of(Controller& can) { return static_cast<PeliCan&>(can.registers()); }

TEST_CASE("SJA1000: receives the identifiers of the filter, and two of them exactly") {
  for (const Kind kind : sja1000_kinds) {
    CAPTURE(name_of(kind));
    Bench bench;
    ControllerOptions options;
    options.starts = false;
    Controller& can = bench.add(kind, options);
    can.init();
    can.filter({0x185, 0x7E5});
    can.enable(Bench::baud);
    bench.run(20);
    for (unsigned bit = 0; bit < 11; ++bit) {
      bench.receive(standard_frame(0x185 ^ (1U << bit), {0xFF, 0xFF}));
      bench.receive(standard_frame(0x7E5 ^ (1U << bit)));
    }
    CHECK(can.read_all() == Texts{});
    bench.receive(standard_frame(0x185, {0xA5}));
    bench.receive(standard_frame(0x7E5, {0x5A}));
    bench.receive(remote_frame(standard_frame(0x185)));
    CHECK(can.read_all() == Texts{"185#A5", "7E5#5A", "185#R"});
    can.close();
    can.filter({0x101, CO_IF_FRM_EXT | 0x1ABCDE00});
    can.enable(Bench::baud);
    bench.run(20);
    bench.receive(extended_frame(0x1ABCDE00, {5}));
    bench.receive(standard_frame(0x101, {6}));
    bench.receive(standard_frame(0x185));
    bench.receive(extended_frame(0x0ABCDE00));
    CHECK(can.read_all() == Texts{"1ABCDE00#05", "101#06"});
  }
}

// The driver leaves the bus for the change while it is idle; frames that are in the FIFO or that wait are not lost.
TEST_CASE("SJA1000: a change of the filter on the bus loses no frame that was received or accepted before") {
  for (const Kind kind : sja1000_kinds) {
    for (unsigned bits = 0; bits < 140; bits += 3) {
      CAPTURE(name_of(kind));
      CAPTURE(bits);
      Bench bench;
      Controller& can = bench.add(kind);
      can.close();
      can.filter({0x100});
      can.enable(Bench::baud);
      bench.run(20);
      bench.peer.send(standard_frame(0x100, {1, 2, 3, 4, 5, 6, 7, 8}));
      bench.run(bits);
      CHECK(can.takes("123#55"));
      can.filter({0x100, 0x6FF});
      bench.run(400);
      CHECK(can.read_all() == Texts{"100#0102030405060708"});
      CHECK(bench.sent_by(can) == Texts{"123#55"});
      bench.receive(standard_frame(0x6FF));
      CHECK(can.read_all() == Texts{"6FF#"});
    }
  }
}

TEST_CASE("SJA1000: a change of the filter that adds no identifier does not leave the bus") {
  for (const Kind kind : sja1000_kinds) {
    CAPTURE(name_of(kind));
    Bench bench;
    Controller& can = bench.add(kind);
    can.close();
    can.filter({0x100, 0x101, 0x201});
    can.enable(Bench::baud);
    bench.run(20);
    bench.peer.send(standard_frame(0x101, {1}));
    bench.run(20);
    can.filter({0x101, 0x201});
    CHECK(can.node().is_on_bus());
    CHECK(can.node().is_busy());
    bench.run(100);
    CHECK(can.read_all() == Texts{"101#01"});
  }
}

TEST_CASE("SJA1000: the filters are written again at the recovery from bus-off") {
  for (const Kind kind : sja1000_kinds) {
    CAPTURE(name_of(kind));
    Bench bench;
    ControllerOptions options;
    options.recovery = CO_CAN_RECOVERY_AUTOMATIC;
    Controller& can = bench.add(kind, options);
    can.filter({0x123});
    // Bus-off while the driver writes a frame: the addresses of the transmit buffer are those of the filters then.
    bool is_done = false;
    unsigned accesses = 0;
    can.registers().on_access = [&] {
      if (!is_done && ++accesses == 10) {
        is_done = true;
        can.node().set_counters(256, 0);
      }
    };
    static_cast<void>(can.takes("7FF#0102030405060708"));
    CHECK(is_done);
    bench.process_interrupts();
    CHECK(bench.run_until([&] { return !can.node().is_bus_off(); }));
    bench.run(300);
    bench.receive(standard_frame(0x123, {1}));
    bench.receive(standard_frame(0x124, {1}));
    CHECK(data_frames(can.read_all()) == Texts{"123#01"});
    CHECK(bench.sent_by(can).size() == 1);
  }
}

TEST_CASE("SJA1000: bus-off while a frame is read from the FIFO passes no wrong frame") {
  for (const Kind kind : sja1000_kinds) {
    for (unsigned number = 1; number < 20; ++number) {
      CAPTURE(name_of(kind));
      CAPTURE(number);
      Bench bench;
      Controller& can = bench.add(kind);
      bench.are_interrupts_enabled = false;
      bench.receive(standard_frame(0x123, {1, 2, 3, 4, 5, 6, 7, 8}));
      unsigned accesses = 0;
      can.registers().on_access = [&] {
        if (++accesses == number) {
          can.node().set_counters(256, 0);
        }
      };
      can.call_interrupt();
      can.registers().on_access = nullptr;
      const Texts all = data_frames(can.read_all());
      CHECK((all.empty() || all == Texts{"123#0102030405060708"}));
    }
  }
}

TEST_CASE("SJA1000: bus-off and recovery are found without an interrupt") {
  for (const Kind kind : sja1000_kinds) {
    CAPTURE(name_of(kind));
    Bench bench;
    ControllerOptions options;
    options.recovery = CO_CAN_RECOVERY_AUTOMATIC;
    Controller& can = bench.add(kind, options);
    bench.are_interrupts_enabled = false;
    can.node().set_counters(256, 0);
    Texts all = can.read_all();
    REQUIRE(all.size() == 1);
    CHECK((to_wire(frame(all[0])).id & 0x40) != 0);
    bool has_recovered = false;
    CHECK(bench.run_until([&] {
      const Texts more = can.read_all();
      has_recovered = has_recovered || (!more.empty() && more[0].substr(0, 8) == "20000300");
      return has_recovered;
    }));
    bench.run(20);
    CHECK(can.takes("123#"));
    bench.run(100);
    CHECK(bench.sent_by(can) == Texts{"123#"});
  }
}

TEST_CASE("SJA1000: in loopback a controller receives its frames, without an acknowledgement") {
  for (const Kind kind : sja1000_kinds) {
    CAPTURE(name_of(kind));
    Bench bench;
    ControllerOptions options;
    options.loopback = true;
    bench.peer.node().stop();
    Controller& can = bench.add(kind, options);
    for (const char* text : {"123#0102", "12345678#11", "7FF#R"}) {
      CHECK(can.takes(text));
      bench.run(200);
      CHECK(can.read_all() == Texts{text});
    }
    CHECK(can.errors().Transmit == 0);
  }
}

// The function is called for each interrupt of a shared line, also while those of the controller are disabled.
TEST_CASE("SJA1000: interrupts of another device on the same line have no effect, wherever they occur") {
  for (const Kind kind : sja1000_kinds) {
    CAPTURE(name_of(kind));
    Bench bench;
    Controller& can = bench.add(kind);
    bench.are_interrupts_enabled = false;
    bool is_inside = false;
    unsigned accesses = 0;
    const auto interrupt = [&] {
      is_inside = true;
      can.call_interrupt();
      is_inside = false;
    };
    can.registers().on_access = [&] {
      if (!is_inside && ++accesses % 13 == 0) {
        interrupt();
      }
    };
    const auto run = [&](unsigned bits) {
      for (; bits != 0; --bits) {
        bench.run(1);
        interrupt();
      }
    };
    for (unsigned round = 0; round < 20; ++round) {
      can.filter({0x100U + round, 0x700U - 3 * round});
      run(20);
      bench.peer.send(standard_frame(0x100 + round, {1}));
      run(100);
      CHECK(can.read_all().size() == 1);
      CHECK(can.takes("123#"));
      run(150);
      can.reset();
      run(20);
    }
    CHECK(bench.sent_by(can).size() == 20);
  }
}

// Errata of ESP32 -----------------------------------------------------------------------------------------------------

TEST_CASE("TWAI of ESP32: an error in received data resets the controller, which keeps its error counters and frames") {
  Bench bench;
  Controller& can = bench.add(Kind::esp32);
  can.node().set_counters(40, 50);
  bench.peer.send(standard_frame(0x123, {0, 0, 0, 0, 0, 0, 0, 0}));
  bench.run(4);
  CHECK(can.takes("555#77"));
  bench.wire.disturb({CanDisturbance::Kind::set_dominant, bench.wire.now() + 40, 8, &can.node()});
  CHECK(bench.run_until([&] { return model_of(can).hardware_resets() == 1; }));
  CHECK(can.errors().Transmit == 40);
  CHECK(can.errors().Receive >= 51);
  CHECK(bench.run_until([&] { return !bench.sent_by(can).empty() && bench.peer.queued() == 0; }));
  CHECK(bench.sent_by(can) == Texts{"555#77"});
  bench.receive(standard_frame(0x124, {5}));
  CHECK(can.read_all().back() == "124#05");
  CHECK(model_of(can).hardware_resets() == 1);
}

TEST_CASE("TWAI of ESP32: 62 frames in the FIFO reset the controller") {
  Bench bench;
  Controller& can = bench.add(Kind::esp32);
  bench.are_interrupts_enabled = false;
  for (unsigned n = 0; n < 63; ++n) {
    bench.receive(standard_frame(0x123));
  }
  bench.are_interrupts_enabled = true;
  bench.run(20);
  CHECK(model_of(can).hardware_resets() == 1);
  CHECK(can.lost() == 1);
  CHECK(can.read_all() == Texts{"20000204#0001000000000000"});
  bench.receive(standard_frame(0x124));
  CHECK(can.read_all() == Texts{"124#"});
}

TEST_CASE("TWAI: incomplete frames of an overrun are discarded") {
  for (const Kind kind : {Kind::esp32, Kind::esp32c3}) {
    CAPTURE(name_of(kind));
    Bench bench;
    Controller& can = bench.add(kind);
    bench.are_interrupts_enabled = false;
    for (std::uint8_t n = 0; n < 8; ++n) {
      bench.receive(standard_frame(0x123, {n, 1, 2, 3, 4, 5, 6, 7}));  // 11 bytes: five frames, and 9 bytes of a sixth
    }
    bench.are_interrupts_enabled = true;
    bench.run(2);
    CHECK(can.lost() == 1);
    CHECK(data_frames(can.read_all()).size() == 5);
    bench.receive(standard_frame(0x124, {9}));
    CHECK(can.read_all() == Texts{"124#09"});
  }
}

}  // namespace
