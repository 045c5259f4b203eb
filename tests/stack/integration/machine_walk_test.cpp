// SPDX-License-Identifier: Apache-2.0
// Tests the state machines of NMT and SDO by their frames: every event in every state, compared with models that are
// written from the tables of the standard alone. The state reached is inferred from the node's reactions.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "support/network.hpp"
#include "support/notation.hpp"
#include "support/sdo_server_model.hpp"
#include "support/stride.hpp"

namespace {

using namespace std::chrono_literals;
using test::Bytes;
using test::Device;
using test::Line;
using test::SdoBytes;
using test::SdoObject;
using test::SdoServerModel;
using test::Texts;
using test::World;

struct Bench {
  explicit Bench(std::uint16_t heartbeat_ms = 0) : device(world.add_device(line, {5, heartbeat_ms, 14})) {
    line.take();
  }
  Texts ask(const CO_IF_FRM& frame) {
    line.say(frame);
    world.settle();
    return line.take_texts();
  }
  Texts ask(std::string_view notation) { return ask(test::frame(notation)); }
  World world;
  Line& line = world.add_line("walk");
  Device& device;
};

// NMT slave. [301:7.3.2.1 figure 46]

enum class State : std::uint8_t { stopped = 0x04, operational = 0x05, pre_operational = 0x7F };

constexpr State states[] = {State::pre_operational, State::operational, State::stopped};

struct Reaction {
  State state;
  bool boots;
};

Reaction reaction(State before, const CO_IF_FRM& command) {
  const bool addressed = command.Data[1] == 0 || command.Data[1] == 5;
  if (command.DLC != 2 || !addressed) {
    return {before, false};
  }
  switch (command.Data[0]) {
    case 1: return {State::operational, false};
    case 2: return {State::stopped, false};
    case 128: return {State::pre_operational, false};
    case 129:
    case 130: return {State::pre_operational, true};
    default: return {before, false};
  }
}

const char* command_into(State state) {
  switch (state) {
    case State::operational: return "000#0105";
    case State::stopped: return "000#0205";
    default: return "000#8005";
  }
}

std::string heartbeat_of(State state) {
  switch (state) {
    case State::operational: return "705#05";
    case State::stopped: return "705#04";
    default: return "705#7F";
  }
}

void walk_nmt(Bench& bench, State before, const CO_IF_FRM& command) {
  bench.ask(command_into(before));
  const Reaction expected = reaction(before, command);
  REQUIRE(bench.ask(command) == (expected.boots ? Texts{"705#00"} : Texts{}));
  const Texts answer = bench.ask("605#4002200000000000");
  REQUIRE(answer == (expected.state == State::stopped ? Texts{} : Texts{"585#4302200044332211"}));
  bench.world.pass(1ms);
  REQUIRE(bench.line.take_texts() == Texts{heartbeat_of(expected.state)});
}

// SDO server with one object, 2010h:00, a domain of 14 bytes. [301:7.2.4.3]

// Builds a request. Bytes 1…7 are the multiplexer and a size of 14, or seven bytes of data. The sub-blocks of an upload
// have one segment, and each is acknowledged; the CRC at the end of a download is that of two such segments.
SdoBytes request(std::uint8_t command) {
  SdoBytes bytes = {command, 0x10, 0x20, 0x00, 0x0E, 0x00, 0x00, 0x00};
  if (command == 0xA0 || command == 0xA4) {
    bytes[4] = 1;
  } else if (command == 0xA2) {
    bytes[1] = bytes[2] = 1;
  } else if ((command & 0xE3U) == 0xC1) {
    static const std::uint16_t crc =
        test::crc_16({0x10, 0x20, 0x00, 0x0E, 0x00, 0x00, 0x00, 0x10, 0x20, 0x00, 0x0E, 0x00, 0x00, 0x00});
    bytes[1] = static_cast<std::uint8_t>(crc);
    bytes[2] = static_cast<std::uint8_t>(crc >> 8);
  }
  return bytes;
}

CO_IF_FRM frame_of(std::uint32_t identifier, const SdoBytes& bytes) {
  CO_IF_FRM frame{identifier, {}, 8};
  std::copy(bytes.begin(), bytes.end(), frame.Data);
  return frame;
}

// A device's SDO server and its model, which receive the same requests.
struct Pair {
  Texts answers_of_model(const SdoBytes& bytes) {
    Texts texts;
    for (const SdoBytes& answer : model.answers(bytes)) {
      texts.push_back(test::notation(frame_of(0x585, answer)));
    }
    return texts;
  }
  void step(std::uint8_t command) {
    const SdoBytes bytes = request(command);
    CAPTURE(int{command});
    REQUIRE(bench.ask(frame_of(0x605, bytes)) == answers_of_model(bytes));
    REQUIRE(bench.device.domain_bytes == model.objects()[0].value);
  }
  void walk(const Bytes& way) {
    for (const std::uint8_t command : way) {
      step(command);
    }
  }
  // Lets \a slices eighths of the SDO time-out pass without frames.
  void be_silent(std::size_t slices) {
    for (; slices > 0; --slices) {
      const std::optional<SdoBytes> said = model.slice();
      bench.world.pass(std::chrono::milliseconds{CO_SDO_TIMEOUT / 8});
      REQUIRE(bench.line.take_texts() == (said ? Texts{test::notation(frame_of(0x585, *said))} : Texts{}));
    }
  }
  // Checks that no transfer is open: an unexpected segment is then aborted with the multiplexer of its bytes.
  void check_idle() {
    REQUIRE(bench.ask("605#60AABBCC00000000") == Texts{"585#80AABBCC01000405"});
    REQUIRE(bench.ask("605#00AABBCC00000000") == Texts{"585#80AABBCC01000405"});
  }

  Bench bench;
  SdoServerModel model{{{0x2010, 0, true, true, SdoObject::Kind::domain, 14, Bytes(14)}},
                       USE_SDO_BLOCK != 0 ? CO_SDO_BUF_SEG : 0};
};

// Request sequences that lead into each state of the server.
const std::vector<Bytes> ways = {
    {},                        // idle
    {0x21},                    // download, size indicated: toggle 0
    {0x21, 0x00},              //   toggle 1
    {0x21, 0x00, 0x11},        //   complete
    {0x20},                    // download, no size: toggle 0
    {0x20, 0x00},              //   toggle 1
    {0x20, 0x00, 0x10},        //   14 bytes received, toggle 0
    {0x40},                    // upload: toggle 0
    {0x40, 0x60},              //   toggle 1
    {0x40, 0x60, 0x70},        //   complete
    {0x40, 0x70},              // aborted
    {0xC6},                    // block download, size and CRC: segment 1
    {0xC6, 0x01},              //   segment 2
    {0xC6, 0x02},              //   segment 1, a gap
    {0xC6, 0x01, 0x83},        //   segment 1 of a block after the first
    {0xC6, 0x01, 0x02, 0x03},  //   more bytes than indicated
    {0xC6, 0x01, 0x82},        //   waiting for the end request
    {0xC6, 0x01, 0x82, 0x82},  //   the last segment is repeated
    {0xC6, 0x01, 0x82, 0xC1},  //   complete
    {0xC0},                    // block download, no size, no CRC: segment 1
    {0xC0, 0x81},              //   waiting for the end request
    {0xC0, 0x01, 0x02},        //   14 bytes received: segment 3
    {0xC0, 0x01, 0x02, 0x83},  //   waiting for the end request
    {0xA4},                    // block upload: waiting for the start request
    {0xA4, 0xA3},              //   waiting for an acknowledge
    {0xA4, 0xA3, 0xA2},        //   waiting for the acknowledge of the last block
    {0xA4, 0xA3, 0xA2, 0xA2},  //   waiting for the end response
    {0xA0, 0xA3, 0xA2, 0xA2},  // block upload, no CRC: waiting for the end response
};

// First bytes that are meaningful in at least one state.
constexpr std::uint8_t usual[] = {0x00, 0x10, 0x01, 0x11, 0x0D, 0x1D, 0x20, 0x21, 0x23, 0x40, 0x60, 0x70, 0x80,
                                  0x02, 0x03, 0x81, 0x82, 0xC0, 0xC6, 0xC1, 0xDD, 0xA0, 0xA4, 0xA3, 0xA2, 0xA1};

class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}
  std::size_t below(std::size_t limit) { return random_() % limit; }
  std::uint8_t command() {
    return below(8) == 0 ? static_cast<std::uint8_t>(random_()) : usual[below(std::size(usual))];
  }

 private:
  std::mt19937 random_;
};

// Returns true in the large walk (tests/run --lane sdo), which tries all first bytes instead of the usual ones.
bool is_large() { return std::getenv("LEXICAN_SDO_WALK") != nullptr; }

Bytes walked_bytes() {
  Bytes bytes(256);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return is_large() ? bytes : Bytes(std::begin(usual), std::end(usual));
}

}  // namespace

TEST_CASE("machine walk: each NMT command specifier in each state for all nodes, this and another node [N1] [N2]") {
  Bench bench(1);
  for (const State before : states) {
    for (unsigned specifier = 0; specifier < 256; ++specifier) {
      for (const std::uint8_t node_id : {std::uint8_t{0}, std::uint8_t{5}, std::uint8_t{6}}) {
        CAPTURE(int(before));
        CAPTURE(specifier);
        CAPTURE(int{node_id});
        walk_nmt(bench, before, CO_IF_FRM{0, {static_cast<std::uint8_t>(specifier), node_id}, 2});
      }
    }
  }
}

TEST_CASE("machine walk: NMT commands with a length other than 2 are ignored and counted in each state [N1]") {
  Bench bench(1);
  std::uint32_t wrong = 0;
  for (const State before : states) {
    for (const std::uint8_t specifier : Bytes{1, 2, 128, 129, 130}) {
      for (const std::uint8_t dlc : Bytes{0, 1, 3, 4, 5, 6, 7, 8}) {
        CAPTURE(int(before));
        CAPTURE(int{specifier});
        CAPTURE(int{dlc});
        walk_nmt(bench, before, CO_IF_FRM{0, {specifier, 5}, dlc});
        ++wrong;
      }
    }
  }
  CHECK(bench.device.counters().Malformed == wrong);
}

TEST_CASE("machine walk: NMT commands with each of 256 node-IDs reach the addressed node only [N1]") {
  Bench bench(1);
  for (unsigned node_id = 0; node_id < 256; ++node_id) {
    CAPTURE(node_id);
    walk_nmt(bench, State::operational, CO_IF_FRM{0, {2, static_cast<std::uint8_t>(node_id)}, 2});
  }
}

TEST_CASE("machine walk: a node in Initialisation processes no NMT command and no SDO request [N3] [D17]") {
  World world;
  Line& line = world.add_line("walk");
  Device& device = world.add_device(line, {5, 1, 14, true, false, false});
  for (unsigned byte = 0; byte < 256; ++byte) {
    line.say(CO_IF_FRM{0, {static_cast<std::uint8_t>(byte), 5}, 2});
    line.say(frame_of(0x605, request(static_cast<std::uint8_t>(byte))));
    world.pass(1ms);
  }
  CHECK(line.take_texts().empty());
  CHECK(device.mode() == CO_INIT);
  CHECK(device.counters().Unclaimed == 512);
  CONodeStart(&device.node);
  CHECK(line.take_texts() == Texts{"705#00"});
}

TEST_CASE("machine walk: SDO first bytes have their defined reaction and next state in each state") {
  for (std::size_t way = 0; way < ways.size(); ++way) {
    for (auto byte = static_cast<unsigned>(way % test::stride(3)); byte < 256; byte += test::stride(3)) {
      CAPTURE(way);
      CAPTURE(byte);
      Pair pair;
      pair.walk(ways[way]);
      pair.step(static_cast<std::uint8_t>(byte));
      if (pair.model.is_in_block()) {
        pair.step(0x80);
      }
      if (!pair.model.is_open()) {
        pair.check_idle();
      }
      REQUIRE(pair.bench.ask("605#2B00200034120000") ==
              Texts{"585#6000200000000000"});  // a new initiate request ends any transfer
      REQUIRE(pair.bench.device.value == 0x1234);
      pair.check_idle();
    }
  }
}

TEST_CASE("machine walk: SDO first bytes in all pairs from idle [T7]") {
  Pair pair;
  for (unsigned first = 0; first < 256; ++first) {
    for (unsigned second = first % test::stride(5); second < 256; second += test::stride(5)) {
      CAPTURE(first);
      CAPTURE(second);
      pair.walk({static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(second), 0x80});
    }
  }
}

TEST_CASE("machine walk: SDO first bytes in pairs from every state (all pairs in the large walk) [T7]") {
  const Bytes bytes = walked_bytes();
  Pair pair;
  for (const Bytes& way : ways) {
    for (const std::uint8_t first : bytes) {
      for (const std::uint8_t second : bytes) {
        pair.walk(way);
        pair.walk({first, second, 0x80});
      }
    }
  }
}

TEST_CASE("machine walk: SDO first bytes in triples from idle (all triples in the large walk) [T7]") {
  const Bytes bytes = walked_bytes();
  Pair pair;
  for (const std::uint8_t first : bytes) {
    for (const std::uint8_t second : bytes) {
      for (const std::uint8_t third : bytes) {
        pair.walk({first, second, third, 0x80});
      }
    }
  }
}

TEST_CASE("machine walk: SDO requests in a long random walk with pauses that prefers changes of state [T7]") {
  Chance chance(301);
  Pair pair;
  const unsigned steps = is_large() ? 20000000 : 100000;
  for (unsigned n = 0; n < steps; ++n) {
    CAPTURE(n);
    pair.step(chance.command());
    pair.be_silent(chance.below(64) == 0 ? 1 + chance.below(9) : 0);
  }
}

TEST_CASE("machine walk: SDO requests with a length other than 8 change nothing in any state [D1]") {
  for (const Bytes& way : ways) {
    for (const std::uint8_t dlc : Bytes{0, 1, 2, 3, 4, 5, 6, 7}) {
      Pair pair;
      pair.walk(way);
      for (unsigned byte = 0; byte < 256; ++byte) {
        CO_IF_FRM frame = frame_of(0x605, request(static_cast<std::uint8_t>(byte)));
        frame.DLC = dlc;
        REQUIRE(pair.bench.ask(frame).empty());
      }
      CHECK(pair.bench.device.counters().Malformed == 256);
      pair.walk({0x82, 0x00, 0x10, 0x60});
    }
  }
}

TEST_CASE("machine walk: SDO transfers continue in Operational and end with Stopped and reset [N8]") {
  const char* const commands[] = {"000#0105", "000#8005", "000#0205", "000#8105", "000#8205", "000#0206", "000#8106"};
  for (const Bytes& way : ways) {
    for (const char* const command : commands) {
      CAPTURE(command);
      Pair pair;
      pair.walk(way);
      const Reaction expected = reaction(State::pre_operational, test::frame(command));
      CHECK(pair.bench.ask(command) == (expected.boots ? Texts{"705#00"} : Texts{}));
      for (unsigned byte = 0; expected.state == State::stopped && byte < 256; ++byte) {
        REQUIRE(pair.bench.ask(frame_of(0x605, request(static_cast<std::uint8_t>(byte)))).empty());
      }
      CHECK(pair.bench.ask("000#0105").empty());
      if (expected.state == State::stopped || expected.boots) {
        pair.model.close();
        pair.check_idle();
      }
      pair.walk({0x82, 0xC1, 0xA2, 0x00, 0x10, 0x60});
    }
  }
}
