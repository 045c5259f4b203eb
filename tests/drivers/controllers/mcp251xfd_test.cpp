// SPDX-License-Identifier: Apache-2.0
// Behaviour that only the driver for MCP251xFD has, and its use of SPI.
#include "mcp251xfd.hpp"

#include <algorithm>
#include <bitset>
#include <iterator>

#include "bench.hpp"
#include "co_can_mcp2515.h"
#include "co_can_mcp251xfd.h"
#include "mcp251xfd_rates.hpp"
#include "support/notation.hpp"

namespace {

using namespace test;
using Texts = std::vector<std::string>;

// Bytes on SPI in a bit time: 10 MHz and 500 kbit/s, with pauses.
constexpr unsigned usual_speed = 2;

CO_CAN_MCP251XFD& context_of(Controller& can) { return *static_cast<CO_CAN_MCP251XFD*>(can.context()); }

Texts texts_of(std::uint32_t id, unsigned number) {
  Texts texts;
  for (unsigned n = 0; n < number; ++n) {
    texts.push_back(notation(to_driver(standard_frame(id, {static_cast<std::uint8_t>(n)}))));
  }
  return texts;
}

void queue_frames(Bench& bench, unsigned number, std::uint32_t id) {
  for (unsigned n = 0; n < number; ++n) {
    bench.peer.send(standard_frame(id, {static_cast<std::uint8_t>(n)}));
  }
}

// Disturbs a frame, so that the controller is in bus-off.
void drive_to_bus_off(Bench& bench, Controller& can) {
  can.node().set_counters(250, 0);
  bench.wire.disturb_frames(1, 20, CanDisturbance::Kind::set_dominant, 12);
  REQUIRE(can.takes("7FF#0102"));
  REQUIRE(bench.run_until([&] { return can.is_off_bus(); }));
  bench.run(3);
}

// Clock ---------------------------------------------------------------------------------------------------------------

TEST_CASE("MCP251xFD: SYSCLK is the crystal, ten times it, or half of that") {
  struct Row {
    std::uint32_t crystal;
    unsigned clock;
    std::uint32_t sysclk;
  };
  for (const Row& row : {Row{40'000'000, 0, 40'000'000}, Row{4'000'000, CO_CAN_MCP251XFD_PLL, 40'000'000},
                         Row{40'000'000, CO_CAN_MCP251XFD_HALF | CO_CAN_MCP251XFD_OUTPUT(3U), 20'000'000}}) {
    CAPTURE(row.sysclk);
    Bench bench;
    ControllerOptions options;
    options.clock = row.crystal;
    options.starts = false;
    Controller& can = bench.add(Kind::mcp251xfd, options);
    context_of(can).Clock = static_cast<std::uint8_t>(row.clock);
    const co::BitTiming timing = co::find_bit_timing(row.sysclk, Bench::baud, co::mcp251xfd_limits);
    can.set_timing(Bench::baud, co::mcp251xfd_rate(Bench::baud, timing).Timing);
    can.init();
    can.enable(Bench::baud);
    bench.run(20);
    CHECK(can.bit_rate() == Bench::baud);
    CHECK((mcp251xfd_of(can).peek(0xE00) & 0x7F) == row.clock);
    CHECK(can.takes("123#01"));
    bench.run(100);
    CHECK(bench.sent_by(can) == Texts{"123#01"});
  }
}

TEST_CASE("MCP251xFD: usual crystals have all bit rates of CiA 301") {
  for (const std::uint32_t clock : {8'000'000U, 20'000'000U, 40'000'000U}) {
    for (const std::uint32_t baud : co::cia_bit_rates) {
      CAPTURE(clock);
      CAPTURE(baud);
      CHECK(co::find_bit_timing(clock, baud, co::mcp251xfd_limits).prescaler != 0);
    }
  }
}

TEST_CASE("MCP251xFD: DataTiming is written if it is not 0") {
  for (const std::uint32_t timing : {0U, CO_CAN_MCP251XFD_TIMING(1, 7, 2, 2)}) {
    Bench bench;
    ControllerOptions options;
    options.starts = false;
    Controller& can = bench.add(Kind::mcp251xfd, options);
    context_of(can).DataTiming = timing;
    can.init();
    can.enable(Bench::baud);
    CHECK(mcp251xfd_of(can).peek(0x008) == (timing == 0 ? 0x000E0303 : timing));
  }
}

// Receiving and sending -----------------------------------------------------------------------------------------------

TEST_CASE("MCP251xFD: exactly 31 identifiers pass; more pass with few others") {
  for (const unsigned number : {31U, 40U}) {
    CAPTURE(number);
    Bench bench;
    Controller& can = bench.add(Kind::mcp251xfd);
    std::vector<std::uint32_t> ids;
    for (std::uint32_t n = 0; ids.size() < number; ++n) {
      const std::uint32_t id = 0x181 + 2 * n;  // even parity: two differ in at least two bits
      if (std::bitset<11>(id).count() % 2 == 0) {
        ids.push_back(id);
      }
    }
    can.filter(ids);
    unsigned others = 0;
    for (std::uint32_t id = 0; id < 0x800; ++id) {
      bench.receive(standard_frame(id));
      const bool passes = !can.read_all().empty();
      const bool is_wanted = std::count(ids.begin(), ids.end(), id) != 0;
      CHECK((passes || !is_wanted));
      others += passes && !is_wanted ? 1U : 0;
    }
    CHECK(others <= (number == 31 ? 0U : 100U));
  }
}

TEST_CASE("MCP251xFD: receives a full bus without a loss, with SPI as fast as usual") {
  for (const bool has_pin : {true, false}) {
    CAPTURE(has_pin);
    Bench bench;
    ControllerOptions options;
    options.frames = 400;
    options.has_interrupt_pin = has_pin;
    Controller& can = bench.add(Kind::mcp251xfd, options);
    bench.wire.accesses_per_bit = usual_speed;
    queue_frames(bench, 256, 0x123);
    CHECK(bench.run_until([&] { return bench.peer.queued() == 0; }, 40'000));
    bench.run(60);
    CHECK(can.lost() == 0);
    CHECK(can.read_all() == texts_of(0x123, 256));
  }
}

TEST_CASE("MCP251xFD: works without interrupts, with and without the level of INT") {
  for (const bool has_pin : {true, false}) {
    for (const bool keeps : {true, false}) {
      CAPTURE(has_pin);
      CAPTURE(keeps);
      Bench bench;
      bench.wire.accesses_per_bit = usual_speed;
      bench.are_interrupts_enabled = false;
      ControllerOptions options;
      options.has_interrupt_pin = has_pin;
      options.keeps_messages_in_bus_off = keeps;
      options.flags_begin_of_bus_off = has_pin != keeps;
      options.recovery = CO_CAN_RECOVERY_AUTOMATIC;
      Controller& can = bench.add(Kind::mcp251xfd, options);
      Texts heard;
      unsigned sent = 0;
      queue_frames(bench, 20, 0x123);
      for (unsigned n = 0; n < 200; ++n) {
        bench.run(20);
        const Texts more = can.read_all();
        heard.insert(heard.end(), more.begin(), more.end());
        sent += sent < 20 && can.takes("321#01") ? 1U : 0U;
      }
      CHECK(heard == texts_of(0x123, 20));
      CHECK(bench.sent_by(can) == Texts(20, "321#01"));
      CHECK(can.lost() == 0);
      drive_to_bus_off(bench, can);
      CHECK(can.read_all().back().substr(5, 3) == "240");
      CHECK(can.send("321#") == -1);
      CHECK(bench.run_until([&] { return !can.is_off_bus(); }));
      CHECK(can.read_all() == Texts{"20000300#0000000000000000"});
      bench.run(200);
      CHECK(bench.sent_by(can).back() == "7FF#0102");
      CHECK(bench.sent_by(can).size() == 21);
      drive_to_bus_off(bench, can);  // and recovery between two calls of Read
      CHECK(bench.run_until([&] { return !can.is_off_bus(); }));
      CHECK(can.read_all() == Texts{"20000240#0000000000000000", "20000300#0000000000000000"});
      bench.run(200);
      CHECK(bench.sent_by(can).size() == 22);
      bench.receive(standard_frame(0x124));
      CHECK(can.read_all() == Texts{"124#"});
      can.node().set_counters(130, 0);  // a further event reports no bus-off again
      bench.run(20);
      CHECK(can.read_all() == Texts{"20000204#0030000000008200"});
      drive_to_bus_off(bench, can);  // and Reset after the recovery: the bus-off is forgotten
      CHECK(bench.run_until([&] { return !can.is_off_bus(); }));
      can.reset();
      bench.run(20);
      can.node().set_counters(0, 0);
      bench.run(20);
      can.node().set_counters(130, 0);
      bench.run(20);
      for (const std::string& text : can.read_all()) {
        CHECK(text.substr(5, 3) != "240");
      }
    }
  }
}

TEST_CASE("MCP251xFD: six frames wait in the controller at most, and are sent in the order of their identifiers") {
  Bench bench;
  bench.wire.accesses_per_bit = usual_speed;
  Controller& can = bench.add(Kind::mcp251xfd);
  can.filter({});
  bench.run(20);
  for (unsigned n = 0; n < 20; ++n) {
    bench.peer.send(standard_frame(0x001, {1, 2, 3, 4, 5, 6, 7, 8}));
  }
  bench.run(3);
  CHECK(can.takes("7FF#"));
  CHECK(bench.run_until([&] { return bench.peer.queued() == 18; }));
  bench.run(20);
  spi_of(can).clear_transactions();
  CHECK(can.takes("400#"));
  CHECK(spi_of(can).bytes() == 37);  // 10 more than the first frame
  Texts accepted = {"7FF#", "400#"};
  for (const char* text : {"700#", "00000300#", "500#", "600#", "100#"}) {
    if (can.takes(text)) {
      accepted.push_back(text);
    }
  }
  CHECK(accepted == Texts{"7FF#", "400#", "700#", "00000300#", "500#", "600#"});
  bench.are_interrupts_enabled = false;  // the driver reads six events at once, and sends no frame again
  bench.run(5000);
  CHECK(can.read() == "0");
  bench.run(1000);
  CHECK(bench.sent_by(can) == Texts{"00000300#", "400#", "500#", "600#", "700#", "7FF#"});
  CHECK(can.takes("321#"));
  CHECK(can.send("123#") == 0);  // nothing delays the frame before it
}

TEST_CASE("MCP251xFD: a remote frame has no data of the frame that was in its place before") {
  Bench bench;
  Controller& can = bench.add(Kind::mcp251xfd);
  for (unsigned n = 0; n < 32; ++n) {
    bench.receive(standard_frame(0x123, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}));
  }
  CHECK(can.read_all().size() == 32);
  CanFrame remote = remote_frame(standard_frame(0x123));
  remote.dlc = 8;
  bench.receive(remote);
  CO_IF_FRM frame{};
  REQUIRE(can.driver->Read(can.context(), &frame) == sizeof frame);
  CHECK(frame.Identifier == (0x123 | CO_IF_FRM_RTR));
  CHECK(std::all_of(std::begin(frame.Data), std::end(frame.Data), [](std::uint8_t byte) { return byte == 0; }));
}

// Bus-off -------------------------------------------------------------------------------------------------------------

TEST_CASE("MCP251xFD: bus-off by application is left by Reset, automatic recovery is not shortened by it or Enable") {
  for (const CO_CAN_RECOVERY recovery : {CO_CAN_RECOVERY_BY_APPLICATION, CO_CAN_RECOVERY_AUTOMATIC}) {
    for (const bool keeps : {true, false}) {
      CAPTURE(int(recovery));
      CAPTURE(keeps);
      Bench bench;
      ControllerOptions options;
      options.recovery = recovery;
      options.keeps_messages_in_bus_off = keeps;
      Controller& can = bench.add(Kind::mcp251xfd, options);
      drive_to_bus_off(bench, can);
      const bool is_automatic = recovery == CO_CAN_RECOVERY_AUTOMATIC;
      bench.run(200);
      CHECK((mcp251xfd_of(can).peek(0x000) >> 21 & 7) == (is_automatic ? 0 : 4));  // OPMOD
      can.reset();
      bench.run(100);
      if (is_automatic) {
        can.enable(Bench::baud);
        bench.run(100);
      }
      CHECK(can.is_off_bus() == is_automatic);
      CHECK(can.send("123#") == (is_automatic ? -1 : 16));
      CHECK(bench.run_until([&] { return !can.is_off_bus(); }));
      bench.run(300);
      CHECK(bench.sent_by(can) == (is_automatic ? Texts{} : Texts{"123#"}));
      CHECK(can.takes("124#"));
      bench.run(100);
      CHECK(bench.sent_by(can).back() == "124#");
    }
  }
}

TEST_CASE("MCP251xFD: sends and receives again after it has entered Restricted mode because of an underflow") {
  for (const bool has_interrupt : {true, false}) {
    for (const bool loopback : {true, false}) {
      CAPTURE(has_interrupt);
      CAPTURE(loopback);
      Bench bench;
      bench.are_interrupts_enabled = has_interrupt;
      ControllerOptions options;
      options.loopback = loopback;
      Controller& can = bench.add(Kind::mcp251xfd, options);
      bench.run(20);
      mcp251xfd_of(can).underflow_next();
      CHECK(can.takes("123#01"));
      bench.run(3);
      CHECK(can.read_all() == Texts{});
      bench.run(200);
      CHECK((mcp251xfd_of(can).peek(0x000) >> 21 & 7) == (loopback ? 2 : 0));  // OPMOD
      CHECK(can.read_all() == (loopback ? Texts{"123#01"} : Texts{}));
      CHECK(can.takes("124#02"));
      bench.run(200);
      CHECK(bench.sent_by(can) == Texts{"123#01", "124#02"});
    }
  }
}

// SPI -----------------------------------------------------------------------------------------------------------------

// The numbers are those of docs/drivers/mcp251xfd.md.
TEST_CASE("MCP251xFD: a frame costs as many transactions and bytes on SPI as the documentation says") {
  Bench bench;
  Controller& can = bench.add(Kind::mcp251xfd);
  const CanFrame frame = standard_frame(0x123, {1, 2, 3, 4, 5, 6, 7, 8});
  CHECK(can.takes("001#"));
  bench.run(100);
  SpiModel& spi = spi_of(can);
  spi.clear_transactions();
  bench.receive(frame);
  CHECK(spi.transactions().size() == 5);
  CHECK(spi.bytes() == 47);
  spi.clear_transactions();
  CHECK(can.takes(to_driver(frame)));
  CHECK(spi.transactions().size() == 3);
  CHECK(spi.bytes() == 35);
  bench.run(200);
  CHECK(spi.transactions().size() == 9);
  CHECK(spi.bytes() == 88);
  spi.clear_transactions();
  CHECK(can.takes("123#R8"));
  CHECK(spi.bytes() == 27);
  spi.clear_transactions();
  CHECK(can.send("124#") == 0);
  CHECK(spi.bytes() == 24);
}

TEST_CASE("MCP251xFD: shares an SPI bus with MCP2515, and neither loses a frame") {
  for (const unsigned speed : {2U, 5U}) {
    CAPTURE(speed);
    Bench bench;
    bench.wire.accesses_per_bit = speed;
    CO_CAN_SPI_BUS bus{};
    ControllerOptions options;
    options.spi_bus = &bus;
    Controller& one = bench.add(Kind::mcp251xfd, options);
    Controller& two = bench.add(Kind::mcp2515, options);
    one.filter({0x123, 0x201});
    two.filter({0x124, 0x101});
    bench.interrupt_everywhere();
    const auto check = [&](Controller& can, Controller& other) {
      can.on_access([&] {
        CHECK(!spi_of(other).is_selected());
        bench.process_interrupts();
      });
    };
    check(one, two);
    check(two, one);
    bench.run(20);
    Texts heard;
    for (unsigned n = 0; n < 30; ++n) {
      bench.peer.send(standard_frame(n % 2 == 0 ? 0x123 : 0x124, {static_cast<std::uint8_t>(n)}));
      bench.run(160 + n % 7);
      CHECK((one.takes("101#") && two.takes("201#")));
      bench.run(200);
      for (Controller* can : {&one, &two}) {
        const Texts more = can->read_all();
        heard.insert(heard.end(), more.begin(), more.end());
      }
    }
    CHECK(bench.sent_by(one).size() == 30);
    CHECK(bench.sent_by(two).size() == 30);
    CHECK(heard.size() == 90);
    CHECK(one.lost() + two.lost() == 0);
    CHECK(bus.Holds == 0);
  }
}

TEST_CASE("MCP251xFD: while the application holds SPI the interrupt does not use it, and its work is done afterwards") {
  Bench bench;
  CO_CAN_SPI_BUS bus{};
  ControllerOptions options;
  options.spi_bus = &bus;
  Controller& can = bench.add(Kind::mcp251xfd, options);
  bench.run(20);
  spi_of(can).clear_transactions();
  COCanMcp251xfdHold(&bus);
  bench.receive(standard_frame(0x123, {1}));
  bench.receive(standard_frame(0x123, {2}));
  CHECK(spi_of(can).transactions().empty());
  CHECK(!can.has_frames());
  COCanMcp251xfdRelease(&bus);
  CHECK(can.has_frames());
  CHECK(can.read_all() == Texts{"123#01", "123#02"});
}

TEST_CASE("MCP251xFD: a controller that does not answer refuses frames and receives none") {
  for (const std::uint8_t answer : {std::uint8_t{0x00}, std::uint8_t{0xFF}}) {
    CAPTURE(unsigned{answer});
    static std::uint8_t level;
    level = answer;
    constexpr CO_CAN_SPI dead = {
        [](void* /*ctx*/, bool /*is_selected*/) {},
        [](void* /*ctx*/, std::uint8_t* bytes, std::uint8_t number) { std::fill(bytes, bytes + number, level); },
        nullptr};
    Bench bench;
    ControllerOptions options;
    options.starts = false;
    Controller& can = bench.add(Kind::mcp251xfd, options);
    const CO_CAN_SPI* const spi = context_of(can).Spi;
    context_of(can).Spi = &dead;
    can.init();
    can.filter({0x123});
    can.enable(Bench::baud);
    CHECK(can.send("123#") == -1);
    can.call_interrupt();
    CHECK(can.read() == "0");
    can.reset();
    context_of(can).Spi = spi;
    can.init();
    can.enable(Bench::baud);
    bench.run(20);
    CHECK(can.takes("123#"));
    context_of(can).Spi = &dead;  // it stops to answer on the bus
    for (unsigned n = 0; n < 5; ++n) {
      CHECK(can.send("123#") == 0);
      CHECK(can.read() == "0");
      can.call_interrupt();
    }
    if (answer == 0xFF) {
      context_of(can).Spi = spi;  // it answers again
      bench.run(100);
      CHECK(bench.sent_by(can) == Texts{"123#"});
      CHECK(can.takes("124#"));
      bench.run(100);
      CHECK(bench.sent_by(can) == Texts{"123#", "124#"});
      context_of(can).Spi = &dead;
    }
    can.close();
    CHECK(can.send("123#") == -1);
  }
}

}  // namespace
