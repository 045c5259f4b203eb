// SPDX-License-Identifier: Apache-2.0
// Behaviour that only the driver for MCP2515 has: SPI, masks and filters, two receive buffers, polling.
#include "mcp2515.hpp"

#include <algorithm>
#include <random>

#include "bench.hpp"
#include "mcp2515_filters.hpp"
#include "mcp2515_rates.hpp"
#include "support/notation.hpp"

namespace {

using namespace test;
using Texts = std::vector<std::string>;
using Ids = std::vector<std::uint32_t>;

// Bytes on SPI in a bit time: 10 MHz and 500 kbit/s, or 20 MHz and 1 Mbit/s, with pauses.
constexpr unsigned usual_speed = 2;

constexpr std::uint8_t canctrl = 0x0F;
constexpr std::uint8_t caninte = 0x2B;
constexpr std::uint8_t canintf = 0x2C;
constexpr std::uint8_t eflg = 0x2D;

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

// Disturbs each frame until the controller is in bus-off, without interrupts.
void drive_to_bus_off(Bench& bench, Controller& can) {
  can.node().set_counters(250, 0);
  bench.wire.disturb_frames(1, 20, CanDisturbance::Kind::set_dominant, 12);
  REQUIRE(can.takes("7FF#0102"));
  REQUIRE(bench.run_until([&] { return can.is_off_bus(); }));
  bench.run(3);
}

// Bit timing ----------------------------------------------------------------------------------------------------------

TEST_CASE("MCP2515: usual crystals have the bit rates that the documentation lists") {
  struct Crystal {
    std::uint32_t clock;
    std::vector<std::uint32_t> rates;
  };
  const Crystal crystals[] = {{8'000'000, {10000, 20000, 50000, 125000, 250000}},
                              {10'000'000, {10000, 50000, 125000, 250000}},
                              {16'000'000, {10000, 20000, 50000, 125000, 250000, 500000, 800000, 1000000}},
                              {20'000'000, {10000, 20000, 50000, 125000, 250000, 500000, 1000000}}};
  for (const Crystal& crystal : crystals) {
    for (const std::uint32_t baud : co::cia_bit_rates) {
      CAPTURE(crystal.clock);
      CAPTURE(baud);
      const co::BitTiming timing = co::find_bit_timing(crystal.clock / 2, baud, co::mcp2515_limits);
      const bool is_listed = std::count(crystal.rates.begin(), crystal.rates.end(), baud) != 0;
      CHECK((timing.prescaler != 0) == is_listed);
      if (!is_listed) {
        continue;
      }
      Bench bench;
      bench.wire.bit_rate = baud;
      ControllerOptions options;
      options.clock = crystal.clock;
      options.starts = false;
      Controller& can = bench.add(Kind::mcp2515, options);
      can.set_timing(baud, co::mcp2515_rate(baud, timing).Timing);
      can.init();
      can.enable(baud);
      bench.run(20);
      CHECK(can.bit_rate() == baud);
      CHECK(can.takes("123#01"));
      bench.run(100);
      CHECK(bench.sent_by(can) == Texts{"123#01"});
    }
  }
}

// Filters -------------------------------------------------------------------------------------------------------------

unsigned number_that_pass(const Ids& ids) {
  const co::mcp2515::Filters filters = co::mcp2515::filters_of(ids.data(), static_cast<unsigned>(ids.size()));
  CHECK(co::mcp2515::all_pass(filters, ids.data(), static_cast<unsigned>(ids.size())));
  unsigned number = 0;
  for (std::uint32_t id = 0; id < 0x800; ++id) {
    number += co::mcp2515::all_pass(filters, &id, 1) ? 1U : 0U;
  }
  return number;
}

TEST_CASE("MCP2515: six identifiers pass exactly, those of usual nodes with few others") {
  CHECK(number_that_pass({0x000, 0x080, 0x205, 0x305, 0x605, 0x7E5}) == 6);
  CHECK(number_that_pass({0x000}) == 1);
  CHECK(number_that_pass({}) == 0);
  CHECK(number_that_pass({0x000, 0x080, 0x100, 0x205, 0x305, 0x405, 0x505, 0x605, 0x7E5}) <= 18);
  CHECK(number_that_pass({0x000, 0x080, 0x205, 0x305, 0x405, 0x505, 0x605, 0x705, 0x7E5}) <= 18);
  Ids master = {0x000};
  for (std::uint32_t node = 1; node <= 16; ++node) {
    master.push_back(0x080 + node);
    master.push_back(0x180 + node);
    master.push_back(0x580 + node);
    master.push_back(0x700 + node);
  }
  std::sort(master.begin(), master.end());
  CHECK(number_that_pass(master) <= 400);
}

TEST_CASE("MCP2515: any identifiers pass the filters that are computed from them") {
  std::mt19937 random(1);
  for (unsigned round = 0; round < 300; ++round) {
    Ids ids;
    for (unsigned n = static_cast<unsigned>(random()) % 40; n != 0; --n) {
      const bool is_extended = random() % 4 == 0 && round % 2 == 0;
      ids.push_back(is_extended ? CO_IF_FRM_EXT | (static_cast<std::uint32_t>(random()) & 0x1FFFFFFF)
                                : static_cast<std::uint32_t>(random()) % 0x800);
    }
    std::sort(ids.begin(), ids.end());
    static_cast<void>(number_that_pass(ids));
  }
}

TEST_CASE("MCP2515: the controller receives what the filters pass and nothing else, whatever the data are") {
  for (const Ids& ids : {Ids{0x000, 0x080, 0x205, 0x305, 0x605, 0x7E5}, Ids{0x123}, Ids{},
                         Ids{0x081, 0x205, 0x305, 0x405, 0x505, 0x605, 0x701, 0x702, 0x7E5},
                         Ids{0x123, 0x124, 0x1ABCDE00 | CO_IF_FRM_EXT},
                         Ids{0x00000123 | CO_IF_FRM_EXT, 0x1ABCDE00 | CO_IF_FRM_EXT, 0x1ABCDE01 | CO_IF_FRM_EXT}}) {
    CAPTURE(ids);
    Bench bench;
    ControllerOptions options;
    options.starts = false;
    Controller& can = bench.add(Kind::mcp2515, options);
    can.init();
    can.filter(ids);
    can.enable(Bench::baud);
    bench.run(20);
    const co::mcp2515::Filters filters = co::mcp2515::filters_of(ids.data(), static_cast<unsigned>(ids.size()));
    Ids all;
    for (const std::uint32_t id : ids) {
      for (unsigned bit = 0; bit < ((id & CO_IF_FRM_EXT) != 0 ? 29U : 11U); ++bit) {
        all.push_back(id ^ (1U << bit));
      }
      all.push_back(id);
    }
    all.insert(all.end(), {0x000, 0x7FF, CO_IF_FRM_EXT, CO_IF_FRM_EXT | 0x123, CO_IF_FRM_EXT | 0x04980000});
    std::uint8_t data = 0;
    for (const std::uint32_t id : all) {
      CAPTURE(id);
      CanFrame frame = standard_frame(id & CO_IF_FRM_ID, {++data, static_cast<std::uint8_t>(data * 7)});
      frame.is_extended = (id & CO_IF_FRM_EXT) != 0;
      bench.receive(frame);
      const bool passes = co::mcp2515::all_pass(filters, &id, 1);
      CHECK(can.read_all() == (passes ? Texts{notation(to_driver(frame))} : Texts{}));
      bench.receive(remote_frame(frame));
      CHECK(can.read_all().size() == (passes ? 1 : 0));
    }
  }
}

TEST_CASE("MCP2515: a change of the filter on the bus loses no frame that was received or accepted before") {
  for (unsigned bits = 0; bits < 140; bits += 3) {
    CAPTURE(bits);
    Bench bench;
    bench.wire.accesses_per_bit = usual_speed;
    Controller& can = bench.add(Kind::mcp2515);
    can.filter({0x100});
    bench.run(20);
    bench.receive(standard_frame(0x100, {1}));
    CanPeer other(bench.wire, FdMode::classic, "other");  // acknowledges while the controller is off the bus
    bench.peer.send(standard_frame(0x101, {1, 2, 3, 4, 5, 6, 7, 8}));
    bench.run(bits);
    CHECK(can.takes("123#55"));
    can.filter({0x100, 0x6FF});
    bench.run(400);
    CHECK(can.read_all() == Texts{"100#01"});
    CHECK(bench.sent_by(can) == Texts{"123#55"});
    bench.receive(standard_frame(0x6FF));
    CHECK(can.read_all() == Texts{"6FF#"});
  }
}

TEST_CASE("MCP2515: a change of the filter that adds no identifier does not leave the bus") {
  Bench bench;
  Controller& can = bench.add(Kind::mcp2515);
  can.filter({0x100, 0x101, 0x201});
  bench.run(20);
  bench.peer.send(standard_frame(0x101, {1}));
  bench.run(20);
  mcp2515_of(can).clear_transactions();
  can.filter({0x101, 0x201});
  CHECK(mcp2515_of(can).transactions().empty());
  CHECK(can.node().is_busy());
  bench.run(100);
  CHECK(can.read_all() == Texts{"101#01"});
}

TEST_CASE("MCP2515: a controller that does not enter Configuration mode is reset, and accepted frames are sent later") {
  Bench bench;
  Controller& can = bench.add(Kind::mcp2515);
  can.filter({0x100});
  bench.run(20);
  CHECK(can.takes("123#55"));
  bench.run(20);
  bench.wire.accesses_per_bit = 0;  // no time passes while the driver waits
  can.filter({0x100, 0x6FF});
  bench.wire.accesses_per_bit = usual_speed;
  bench.run(300);
  CHECK(bench.sent_by(can) == Texts{"123#55"});
  bench.receive(standard_frame(0x6FF));
  CHECK(can.read_all() == Texts{"6FF#"});
}

// Receiving -----------------------------------------------------------------------------------------------------------

TEST_CASE("MCP2515: receives a full bus without a loss, with the interrupt and SPI as fast as the bus") {
  for (const bool has_pin : {true, false}) {
    CAPTURE(has_pin);
    Bench bench;
    ControllerOptions options;
    options.frames = 400;
    options.has_interrupt_pin = has_pin;
    Controller& can = bench.add(Kind::mcp2515, options);
    bench.wire.accesses_per_bit = 1;  // 8 MHz at 1 Mbit/s, 4 MHz at 500 kbit/s
    queue_frames(bench, 256, 0x123);  // 62 bits each
    for (unsigned n = 0; n < 44; ++n) {
      bench.peer.send(standard_frame(0x001));
    }
    CHECK(bench.run_until([&] { return bench.peer.queued() == 0; }, 40'000));
    bench.run(60);
    CHECK(can.lost() == 0);
    Texts expected = texts_of(0x123, 256);
    expected.insert(expected.end(), 44, "001#");
    CHECK(can.read_all() == expected);
  }
}

TEST_CASE("MCP2515: frames of one identifier keep their order, however late the interrupt is") {
  for (unsigned late = 0; late < 130; ++late) {
    CAPTURE(late);
    Bench bench;
    Controller& can = bench.add(Kind::mcp2515);
    bench.wire.accesses_per_bit = usual_speed;
    queue_frames(bench, 12, 0x123);
    for (unsigned n = 0; n < 12; ++n) {
      bench.are_interrupts_enabled = false;
      bench.run(late);
      bench.are_interrupts_enabled = true;
      bench.run(20);
    }
    bench.run(800);
    CHECK(bench.peer.queued() == 0);
    const Texts all = data_frames(can.read_all());
    CHECK(std::is_sorted(all.begin(), all.end()));
    CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
    CHECK(all.size() + can.lost() <= 12);
    CHECK((can.lost() != 0 || all.size() == 12));
  }
}

TEST_CASE("MCP2515: overflows of both receive buffers are counted, the flags cleared") {
  Bench bench;
  Controller& can = bench.add(Kind::mcp2515);
  can.filter({0x101, 0x102, 0x203, 0x204, 0x205, 0x206});
  bench.run(20);
  bench.are_interrupts_enabled = false;
  for (const std::uint32_t id : {0x101U, 0x102U, 0x203U, 0x204U, 0x205U, 0x206U}) {
    queue_frames(bench, 4, id);
  }
  CHECK(bench.run_until([&] { return bench.peer.queued() == 0; }));
  bench.run(4);
  const std::uint8_t flags = mcp2515_of(can).peek(eflg);
  const unsigned overflows = ((flags & 0x80) != 0 ? 1U : 0U) + ((flags & 0x40) != 0 ? 1U : 0U);
  CHECK(overflows >= 1);
  bench.are_interrupts_enabled = true;
  bench.run(5);
  CHECK(can.lost() == overflows);
  CHECK(mcp2515_of(can).peek(eflg) == 0);
  CHECK(!mcp2515_of(can).interrupt());
  CHECK(error_frames(can.read_all()) == Texts{"20000204#0001000000000000"});
  CHECK(error_frames(can.read_all()) == Texts{});
}

// Polling -------------------------------------------------------------------------------------------------------------

TEST_CASE("MCP2515: works without interrupts, with and without the level of INT") {
  for (const bool has_pin : {true, false}) {
    CAPTURE(has_pin);
    Bench bench;
    bench.wire.accesses_per_bit = usual_speed;
    bench.are_interrupts_enabled = false;
    ControllerOptions options;
    options.has_interrupt_pin = has_pin;
    options.recovery = CO_CAN_RECOVERY_AUTOMATIC;
    Controller& can = bench.add(Kind::mcp2515, options);
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
    bench.run(200);
    CHECK(can.read_all() == Texts{"20000300#0000000000000000"});
    CHECK(bench.sent_by(can).back() == "7FF#0102");
    bench.receive(standard_frame(0x124));
    CHECK(can.read_all() == Texts{"124#"});
  }
}

TEST_CASE("MCP2515: Read does not use SPI while INT is high and the controller has no errors") {
  Bench bench;
  bench.are_interrupts_enabled = false;
  Controller& can = bench.add(Kind::mcp2515);
  CHECK(can.read_all() == Texts{});
  mcp2515_of(can).clear_transactions();
  for (unsigned n = 0; n < 10; ++n) {
    CHECK(can.read() == "0");
  }
  CHECK(mcp2515_of(can).transactions().empty());
  bench.receive(standard_frame(0x123));
  CHECK(can.read() == "123#");
}

// Cost ----------------------------------------------------------------------------------------------------------------

struct Cost {
  std::size_t transactions;
  std::size_t bytes;
};

Cost cost_of(Controller& can) { return {mcp2515_of(can).transactions().size(), mcp2515_of(can).bytes()}; }

// The numbers are those of docs/drivers/mcp2515.md.
TEST_CASE("MCP2515: a frame costs as many transactions and bytes on SPI as the documentation says") {
  struct Row {
    bool has_pin;
    std::uint8_t length;
    Cost in;
    Cost out;
  };
  for (const Row& row : {Row{true, 0, {3, 12}, {5, 19}}, Row{true, 8, {3, 20}, {5, 27}},
                         Row{false, 0, {4, 16}, {6, 23}}, Row{false, 8, {4, 24}, {6, 31}}}) {
    CAPTURE(row.has_pin);
    CAPTURE(unsigned{row.length});
    Bench bench;
    ControllerOptions options;
    options.has_interrupt_pin = row.has_pin;
    Controller& can = bench.add(Kind::mcp2515, options);
    CanFrame frame = standard_frame(0x123);
    frame.dlc = row.length;
    bench.run(20);
    mcp2515_of(can).clear_transactions();
    bench.receive(frame);
    CHECK(cost_of(can).transactions == row.in.transactions);
    CHECK(cost_of(can).bytes == row.in.bytes);
    mcp2515_of(can).clear_transactions();
    CHECK(can.takes(to_driver(frame)));
    CHECK(cost_of(can).transactions == 2);
    bench.run(200);
    CHECK(cost_of(can).transactions == row.out.transactions);
    CHECK(cost_of(can).bytes == row.out.bytes);
  }
}

// SPI that is shared --------------------------------------------------------------------------------------------------

// The interrupt of one controller occurs between any two bytes of the other one.
TEST_CASE("MCP2515: two controllers on one SPI bus are never selected at the same time, and lose nothing") {
  for (const unsigned speed : {1U, 2U, 5U}) {
    CAPTURE(speed);
    Bench bench;
    bench.wire.accesses_per_bit = speed;
    CO_CAN_SPI_BUS bus{};
    ControllerOptions options;
    options.spi_bus = &bus;
    Controller& one = bench.add(Kind::mcp2515, options);
    options.number = 1;
    Controller& two = bench.add(Kind::mcp2515, options);
    one.filter({0x123, 0x201});
    two.filter({0x124, 0x101});
    bench.interrupt_everywhere();
    const auto check = [&](Controller& can, Controller& other) {
      can.on_access([&] {
        CHECK(!mcp2515_of(other).is_selected());
        bench.process_interrupts();
      });
    };
    check(one, two);
    check(two, one);
    bench.run(20);
    Texts heard_by_one;
    Texts heard_by_two;
    const auto read = [&] {
      const Texts first = one.read_all();
      const Texts second = two.read_all();
      heard_by_one.insert(heard_by_one.end(), first.begin(), first.end());
      heard_by_two.insert(heard_by_two.end(), second.begin(), second.end());
    };
    unsigned sent = 0;
    for (unsigned n = 0; n < 30; ++n) {
      bench.peer.send(standard_frame(n % 2 == 0 ? 0x123 : 0x124, {static_cast<std::uint8_t>(n)}));
      bench.run(160 + n % 7);
      sent += one.takes("101#") && two.takes("201#") ? 1U : 0U;
      bench.run(30);
      read();
    }
    bench.run(400);
    read();
    CHECK(sent == 30);
    CHECK(bench.sent_by(one).size() == 30);
    CHECK(bench.sent_by(two).size() == 30);
    CHECK(heard_by_one.size() == 45);
    CHECK(heard_by_two.size() == 45);
    CHECK(one.lost() + two.lost() == 0);
    CHECK(bus.Holds == 0);
  }
}

TEST_CASE("MCP2515: while the application holds SPI the interrupt does not use it, and its work is done afterwards") {
  Bench bench;
  CO_CAN_SPI_BUS bus{};
  ControllerOptions options;
  options.spi_bus = &bus;
  Controller& can = bench.add(Kind::mcp2515, options);
  bench.run(20);
  mcp2515_of(can).clear_transactions();
  COCanMcp2515Hold(&bus);
  COCanMcp2515Hold(&bus);
  bench.receive(standard_frame(0x123, {1}));
  bench.receive(standard_frame(0x123, {2}));
  COCanMcp2515Release(&bus);
  CHECK(mcp2515_of(can).transactions().empty());
  CHECK(!can.has_frames());
  COCanMcp2515Release(&bus);
  CHECK(can.has_frames());
  CHECK(can.read_all() == Texts{"123#01", "123#02"});
}

TEST_CASE("MCP2515: initialising a controller again, and an interrupt before that, change nothing on the SPI bus") {
  Bench bench;
  CO_CAN_SPI_BUS bus{};
  ControllerOptions options;
  options.spi_bus = &bus;
  options.starts = false;
  Controller& one = bench.add(Kind::mcp2515, options);
  Controller& two = bench.add(Kind::mcp2515, options);
  one.call_interrupt();
  CHECK(mcp2515_of(one).transactions().empty());
  for (unsigned n = 0; n < 3; ++n) {
    one.init();
    two.init();
    one.enable(Bench::baud);
    two.enable(Bench::baud);
    bench.run(20);
    bench.receive(standard_frame(0x123));
    CHECK(one.read_all() == Texts{"123#"});
    CHECK(two.read_all() == Texts{"123#"});
  }
}

// Controllers that do not answer --------------------------------------------------------------------------------------

TEST_CASE("MCP2515: a controller that does not answer refuses frames and receives none") {
  for (const std::uint8_t answer : {std::uint8_t{0x00}, std::uint8_t{0xFF}}) {
    CAPTURE(unsigned{answer});
    static std::uint8_t level;
    level = answer;
    constexpr CO_CAN_SPI dead = {
        [](void* /*ctx*/, bool /*is_selected*/) {},
        [](void* /*ctx*/, std::uint8_t* bytes, std::uint8_t number) { std::fill(bytes, bytes + number, level); },
        nullptr};
    const CO_CAN_MCP2515_RATE rates[] = {CO_CAN_MCP2515_RATE_OF(16000000U, 500000U, 16U)};
    CO_IF_FRM frames[4];
    CO_CAN_MCP2515 can{};
    can.Spi = &dead;
    can.Rates = rates;
    can.RateNum = 1;
    can.Frames = frames;
    can.FrameNum = 4;
    const std::uint32_t id = 0x123;
    CO_IF_FRM frame{id, {}, 0};
    Mcp2515CanDriver.Init(&can);
    Mcp2515CanDriver.Filter(&can, &id, 1);
    Mcp2515CanDriver.Enable(&can, 500000);
    CHECK(Mcp2515CanDriver.Send(&can, &frame) == -1);
    COCanMcp2515Interrupt(&can);
    CHECK(Mcp2515CanDriver.Read(&can, &frame) == 0);
    Mcp2515CanDriver.Reset(&can);
    Mcp2515CanDriver.Close(&can);
    CHECK(!COCanMcp2515HasFrames(&can));
  }
}

TEST_CASE("MCP2515: a controller that stops answering on the bus blocks neither Read nor Send") {
  static Mcp2515* model;
  static bool is_dead;
  is_dead = false;
  constexpr CO_CAN_SPI spi = {
      [](void* /*ctx*/, bool is_selected) { is_selected ? model->select() : model->deselect(); },
      [](void* /*ctx*/, std::uint8_t* bytes, std::uint8_t number) {
        for (unsigned n = 0; n < number; ++n) {
          bytes[n] = is_dead ? 0xFF : model->transfer(bytes[n]);
        }
      },
      nullptr};
  CanWire wire;
  wire.accesses_per_bit = usual_speed;
  Mcp2515 chip(wire);
  model = &chip;
  const CO_CAN_MCP2515_RATE rates[] = {CO_CAN_MCP2515_RATE_OF(16000000U, 500000U, 16U)};
  CO_IF_FRM frames[4];
  CO_CAN_MCP2515 can{};
  can.Spi = &spi;
  can.Rates = rates;
  can.RateNum = 1;
  can.Frames = frames;
  can.FrameNum = 4;
  CO_IF_FRM frame{0x123, {}, 0};
  Mcp2515CanDriver.Init(&can);
  Mcp2515CanDriver.Enable(&can, 500000);
  CHECK(Mcp2515CanDriver.Send(&can, &frame) == sizeof frame);
  is_dead = true;
  for (unsigned n = 0; n < 5; ++n) {
    CHECK(Mcp2515CanDriver.Send(&can, &frame) == 0);
    CHECK(Mcp2515CanDriver.Read(&can, &frame) == 0);
    COCanMcp2515Interrupt(&can);
  }
}

// Errors --------------------------------------------------------------------------------------------------------------

// Section 7.7 of the data sheet can be read so that ERRIF stays set while a flag of EFLG is set.
TEST_CASE("MCP2515: an error interrupt that persists is disabled until the flags are cleared") {
  Bench bench;
  ControllerOptions options;
  options.is_error_flag_sticky = true;
  Controller& can = bench.add(Kind::mcp2515, options);
  can.node().set_counters(100, 0);
  bench.run(5);
  CHECK(!mcp2515_of(can).interrupt());
  CHECK((mcp2515_of(can).peek(caninte) & 0x20) == 0);
  CHECK(can.read_all() == Texts{});
  bench.receive(standard_frame(0x123));
  CHECK(can.read_all() == Texts{"123#"});
  can.node().set_counters(130, 0);
  bench.run(5);
  CHECK(can.read_all() == Texts{"20000204#0030000000008200"});
  can.node().set_counters(20, 0);
  bench.run(5);
  CHECK(can.read_all() == Texts{"20000204#0040000000001400"});
  CHECK((mcp2515_of(can).peek(caninte) & 0x20) != 0);
  can.node().set_counters(130, 0);
  bench.run(5);
  CHECK(!mcp2515_of(can).interrupt());
  CHECK(can.read_all().size() == 1);
}

TEST_CASE("MCP2515: bus-off by application is left by Reset, automatic recovery is not shortened by it or Enable") {
  for (const CO_CAN_RECOVERY recovery : {CO_CAN_RECOVERY_BY_APPLICATION, CO_CAN_RECOVERY_AUTOMATIC}) {
    CAPTURE(int(recovery));
    Bench bench;
    ControllerOptions options;
    options.recovery = recovery;
    Controller& can = bench.add(Kind::mcp2515, options);
    drive_to_bus_off(bench, can);
    const bool is_automatic = recovery == CO_CAN_RECOVERY_AUTOMATIC;
    CHECK((mcp2515_of(can).peek(0x0E) & 0xE0) == (is_automatic ? 0x00 : 0x80));  // OPMOD
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

TEST_CASE("MCP2515: filters that change in bus-off are written after the recovery") {
  Bench bench;
  ControllerOptions options;
  options.recovery = CO_CAN_RECOVERY_AUTOMATIC;
  Controller& can = bench.add(Kind::mcp2515, options);
  can.filter({0x100});
  bench.run(20);
  drive_to_bus_off(bench, can);
  can.filter({0x200});
  CHECK(can.node().is_bus_off());
  CHECK(bench.run_until([&] { return !can.is_off_bus(); }));
  CHECK(can.read_all() == Texts{"20000240#0000000000000000", "20000300#0000000000000000"});
  bench.run(200);
  bench.receive(standard_frame(0x100));
  bench.receive(standard_frame(0x200));
  CHECK(can.read_all() == Texts{"200#"});
}

// Sending -------------------------------------------------------------------------------------------------------------

TEST_CASE("MCP2515: after Reset and displaced frames no abort is pending, and no flag is left") {
  for (unsigned bits = 0; bits < 140; ++bits) {
    CAPTURE(bits);
    Bench bench;
    bench.wire.accesses_per_bit = usual_speed;
    Controller& can = bench.add(Kind::mcp2515);
    CHECK(can.takes("123#0102"));
    bench.run(bits);
    can.reset();
    bench.run(150);
    static_cast<void>(can.read());
    CHECK((mcp2515_of(can).peek(canctrl) & 0x10) == 0);
    CHECK(mcp2515_of(can).peek(canintf) == 0);
    CHECK(can.takes("124#"));
    bench.run(100);
    CHECK(bench.sent_by(can).back() == "124#");
  }
}

TEST_CASE("MCP2515: seven frames wait in the driver at most, and none of them is lost") {
  Bench bench;
  bench.wire.accesses_per_bit = usual_speed;
  Controller& can = bench.add(Kind::mcp2515);
  can.filter({});
  bench.run(20);
  for (unsigned n = 0; n < 20; ++n) {
    bench.peer.send(standard_frame(0x001, {1, 2, 3, 4, 5, 6, 7, 8}));
  }
  bench.run(3);
  CHECK(can.takes("7FF#"));
  CHECK(bench.run_until([&] { return bench.peer.queued() == 18; }));
  Texts accepted = {"7FF#"};
  for (std::uint32_t id = 0x700; id > 0x100; id -= 0x40) {
    const CanFrame frame = standard_frame(id);
    bench.run(50);
    if (can.takes(to_driver(frame))) {
      accepted.insert(accepted.begin(), notation(to_driver(frame)));
    }
  }
  CHECK(accepted.size() == 7);
  bench.run(5000);
  CHECK(bench.sent_by(can) == accepted);
}

TEST_CASE("MCP2515: the output of the clock is as the board requires") {
  for (const std::uint8_t output : {std::uint8_t{0}, std::uint8_t{6}}) {
    CAPTURE(unsigned{output});
    Bench bench;
    Controller& can = bench.add(Kind::mcp2515);
    static_cast<CO_CAN_MCP2515*>(can.context())->ClockOutput = output;
    can.init();
    can.enable(Bench::baud);
    bench.run(20);
    CHECK((mcp2515_of(can).peek(canctrl) & 0x07) == output);
    CHECK(can.takes("123#"));
    can.reset();
    bench.run(100);
    CHECK((mcp2515_of(can).peek(canctrl) & 0x07) == output);
  }
}

}  // namespace
