// SPDX-License-Identifier: Apache-2.0
// Behaviour that only one of the drivers for bxCAN, M_CAN and FlexCAN has, on the models of the controllers.
#include <algorithm>

#include "bench.hpp"
#include "bxcan.hpp"
#include "support/notation.hpp"

namespace {

using namespace test;
using Texts = std::vector<std::string>;

constexpr Kind m_can_kinds[] = {Kind::fdcan, Kind::mcan};

// bxCAN ---------------------------------------------------------------------------------------------------------------

// ABRQ of an empty mailbox has no effect according to the reference manual; some devices clear its RQCP and TXOK.
TEST_CASE("bxCAN: an abort at the end of the frame on the wire neither loses nor repeats a frame") {
  for (const bool clears_flags : {false, true}) {
    for (unsigned bits = 0; bits < 60; ++bits) {
      CAPTURE(clears_flags);
      CAPTURE(bits);
      Bench bench;
      ControllerOptions options;
      options.bxcan.late_abort_clears_flags = clears_flags;
      Controller& can = bench.add(Kind::bxcan, options);
      bench.peer.send(standard_frame(0x001));
      bench.peer.send(standard_frame(0x002));
      bench.run(6);
      CHECK(can.takes("701#"));  // loses the arbitration against 002h
      CHECK(bench.run_until([&] { return bench.peer.queued() == 0; }));
      bench.wire.accesses_per_bit = 2;
      CHECK(can.takes("700#"));  // requested after 701h has begun
      bench.wire.accesses_per_bit = 20;
      bench.run(10);
      CHECK(can.takes("6FF#"));
      bench.run(bits);
      bench.wire.accesses_per_bit = 2;
      Texts expected = {"6FF#", "700#", "701#"};
      for (const char* text : {"500#", "400#"}) {
        if (can.takes(text)) {
          expected.push_back(text);
        }
      }
      bench.wire.accesses_per_bit = 20;
      bench.run(1000);
      Texts sent = bench.sent_by(can);
      std::sort(sent.begin(), sent.end());
      std::sort(expected.begin(), expected.end());
      CHECK(sent == expected);
      CHECK(can.takes("123#"));
      bench.run(100);
      CHECK(bench.sent_by(can).back() == "123#");
    }
  }
}

TEST_CASE("bxCAN: a late abort by Reset leaves all mailboxes usable") {
  for (const bool clears_flags : {false, true}) {
    for (unsigned bits = 30; bits < 60; ++bits) {
      CAPTURE(clears_flags);
      CAPTURE(bits);
      Bench bench;
      ControllerOptions options;
      options.bxcan.late_abort_clears_flags = clears_flags;
      Controller& can = bench.add(Kind::bxcan, options);
      CHECK(can.takes("123#"));
      bench.run(bits);
      bench.are_interrupts_enabled = false;
      bench.wire.accesses_per_bit = 1;
      can.reset();
      bench.wire.accesses_per_bit = 20;
      bench.are_interrupts_enabled = true;
      bench.run(200);
      bench.wire.clear_records();
      for (unsigned n = 0; n < 2; ++n) {
        bench.peer.send(standard_frame(0x001, {1, 2, 3, 4, 5, 6, 7, 8}));
      }
      bench.run(12);
      for (const char* text : {"700#", "600#", "500#"}) {
        CHECK(can.takes(text));
        bench.run(10);
      }
      bench.run(500);
      CHECK(bench.sent_by(can) == Texts{"500#", "600#", "700#"});
    }
  }
}

TEST_CASE("bxCAN: waits until the controller has released a frame of the FIFO") {
  for (const unsigned accesses : {1U, 2U, 5U, 20U}) {
    CAPTURE(accesses);
    Bench bench;
    ControllerOptions options;
    options.bxcan.release_accesses = accesses;
    Controller& can = bench.add(Kind::bxcan, options);
    for (std::uint8_t n = 0; n < 9; ++n) {
      bench.are_interrupts_enabled = n % 3 == 2;
      bench.receive(standard_frame(0x123, {n}));
    }
    Texts expected;
    for (std::uint8_t n = 0; n < 9; ++n) {
      expected.push_back(notation(to_driver(standard_frame(0x123, {n}))));
    }
    CHECK(can.read_all() == expected);
    CHECK(can.lost() == 0);
  }
}

TEST_CASE("bxCAN: two controllers divide 28 filter banks, whichever is initialised first") {
  for (const bool slave_first : {false, true}) {
    CAPTURE(slave_first);
    Bench bench;
    ControllerOptions options;
    options.starts = false;
    options.bxcan = {28, 0, 20, 0, false};
    Controller& one = bench.add(Kind::bxcan, options);
    options.number = 1;
    options.bxcan = {28, 20, 8, 0, false};
    Controller& two = bench.add(Kind::bxcan, options);
    for (Controller* can : slave_first ? std::vector<Controller*>{&two, &one} : std::vector<Controller*>{&one, &two}) {
      can->init();
    }
    std::vector<std::uint32_t> ids;
    for (std::uint32_t n = 0; n < 38; ++n) {  // 19 banks of two filters
      ids.push_back(0x100 + 5 * n);
    }
    one.filter(ids);
    two.filter({0x100, 0x7FF});
    one.enable(Bench::baud);
    two.enable(Bench::baud);
    bench.run(20);
    for (std::uint32_t id = 0x100; id < 0x100 + 5 * 38; ++id) {
      bench.receive(standard_frame(id));
      static_cast<void>(two.read());
    }
    bench.receive(standard_frame(0x7FF));
    CHECK(one.read_all().size() == 38);
    CHECK(two.read_all() == Texts{"7FF#"});
  }
}

// M_CAN ---------------------------------------------------------------------------------------------------------------

TEST_CASE(
    "M_CAN, MCP251xFD: CAN FD frames of other nodes are acknowledged and discarded, bxCAN and FlexCAN destroy them") {
  for (const Kind kind : mailbox_kinds) {
    CAPTURE(name_of(kind));
    Bench bench;
    Controller& can = bench.add(kind);
    CanPeer fd(bench.wire, FdMode::enabled, "fd");
    CanPeer other(bench.wire, FdMode::enabled, "other");
    bench.peer.node().stop();
    fd.send(fd_frame(0x123, 15));
    fd.send(fd_frame(0x124, 8));
    fd.send(standard_frame(0x125, {1}));
    bench.run(2000);
    if (kind == Kind::bxcan || is_flexcan(kind)) {
      CHECK(fd.failures > 0);
      continue;
    }
    CHECK(fd.failures == 0);
    CHECK(fd.queued() == 0);
    CHECK(can.read_all() == Texts{"125#01"});
    CHECK(can.lost() == 0);
    CHECK(can.takes("126#02"));
    bench.run(200);
    CHECK(!other.received.back().is_fd);
    CHECK(bench.sent_by(can) == Texts{"126#02"});
  }
}

TEST_CASE("M_CAN: with WaitForIdle a first frame is accepted only while no frame is received") {
  for (const Kind kind : m_can_kinds) {
    CAPTURE(name_of(kind));
    Bench bench;
    ControllerOptions options;
    options.wait_for_idle = true;
    Controller& can = bench.add(kind, options);
    bench.peer.send(standard_frame(0x001, {1, 2}));
    bench.run(10);
    CHECK(can.send("123#") == 0);
    CHECK(bench.run_until([&] { return bench.peer.queued() == 0; }));
    bench.run(10);
    CHECK(can.takes("123#"));
    bench.run(100);
    CHECK(bench.sent_by(can) == Texts{"123#"});
    bench.wire.accesses_per_bit = 0;
    bench.peer.send(standard_frame(0x001, {1, 2}));
    CHECK(can.takes("700#"));  // pending before the frame of the peer begins
    bench.run(10);
    CHECK(can.takes("500#"));
    bench.run(300);
    CHECK(bench.sent_by(can) == Texts{"123#", "500#", "700#"});
  }
}

TEST_CASE("M_CAN: the receive FIFO of the configurable memory has the places that the context says") {
  for (const std::uint8_t places : {std::uint8_t{1}, std::uint8_t{16}, std::uint8_t{64}}) {
    CAPTURE(unsigned{places});
    Bench bench;
    ControllerOptions options;
    options.fifo = places;
    options.frames = 128;
    Controller& can = bench.add(Kind::mcan, options);
    for (unsigned round = 0; round < 2; ++round) {
      bench.are_interrupts_enabled = false;
      for (unsigned n = 0; n < places; ++n) {
        bench.receive(standard_frame(0x123, {static_cast<std::uint8_t>(n)}));
      }
      bench.are_interrupts_enabled = true;
      bench.process_interrupts();
      CHECK(can.read_all().size() == places);
      CHECK(can.lost() == 0);
    }
  }
}

}  // namespace
