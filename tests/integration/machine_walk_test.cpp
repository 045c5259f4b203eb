// SPDX-License-Identifier: Apache-2.0
// The machines of NMT and SDO, walked from outside: every event in every state, against models that know the tables of
// the standard and nothing of the stack. What state the node is in afterwards, it must tell by what it does.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "support/network.hpp"
#include "support/notation.hpp"

namespace {

using namespace std::chrono_literals;
using test::Device;
using test::Line;
using test::Texts;
using test::World;
using Bytes = std::vector<std::uint8_t>;

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

class Server {
 public:
  // Bytes 1…7 of all requests: the multiplexer and a size of 14, or seven bytes of data.
  static constexpr std::uint8_t payload[7] = {0x10, 0x20, 0x00, 0x0E, 0x00, 0x00, 0x00};

  // The answer to a request; empty: none.
  std::string answer(std::uint8_t command) {
    if (command < 0x20) {
      return take_segment(command);
    }
    if (command < 0x30) {
      return begin_download(command);
    }
    if (command == 0x40) {
      open_ = Open::upload;
      toggle_ = 0;
      done_ = 0;
      return "585#411020000E000000";
    }
    if (command == 0x60 || command == 0x70) {
      return give_segment(command);
    }
    if (command >= 0x80 && command < 0xA0) {
      open_ = Open::none;
      return "";
    }
    return abort("01000405");
  }

  const Bytes& bytes() const { return bytes_; }
  bool is_open() const { return open_ != Open::none; }

 private:
  enum class Open { none, download, upload };

  // All requests name the object of the transfer, so all aborts do.
  std::string abort(const char* code) {
    open_ = Open::none;
    return std::string("585#80102000") + code;
  }

  std::string begin_download(std::uint8_t command) {
    open_ = Open::none;
    const bool has_size = (command & 1) != 0;
    if ((command & 2) == 0) {
      open_ = Open::download;
      sized_ = has_size;
      toggle_ = 0;
      done_ = 0;
    } else if (!has_size) {
      return abort("10000706");
    } else {
      std::copy_n(payload + 3, 4 - ((command >> 2) & 3), bytes_.begin());
    }
    return "585#6010200000000000";
  }

  std::string take_segment(std::uint8_t command) {
    if (open_ != Open::download) {
      return abort("01000405");
    }
    if ((command & 0x10) != toggle_) {
      return abort("00000305");
    }
    const std::size_t n = 7u - ((command >> 1) & 7u);
    if (done_ + n > bytes_.size()) {
      return abort("12000706");
    }
    std::copy_n(payload, n, bytes_.begin() + static_cast<std::ptrdiff_t>(done_));
    done_ += n;
    if ((command & 1) != 0) {
      if (sized_ && done_ < bytes_.size()) {
        return abort("13000706");
      }
      open_ = Open::none;
    }
    const bool was_set = toggle_ != 0;
    toggle_ ^= 0x10;
    return was_set ? "585#3000000000000000" : "585#2000000000000000";
  }

  std::string give_segment(std::uint8_t command) {
    if (open_ != Open::upload) {
      return abort("01000405");
    }
    if ((command & 0x10) != toggle_) {
      return abort("00000305");
    }
    const bool last = done_ == 7;
    CO_IF_FRM frame{0x585, {static_cast<std::uint8_t>(toggle_ | (last ? 1 : 0))}, 8};
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(done_), 7, frame.Data + 1);
    done_ += 7;
    toggle_ ^= 0x10;
    open_ = last ? Open::none : open_;
    return test::notation(frame);
  }

  Open open_ = Open::none;
  bool sized_ = false;
  std::uint8_t toggle_ = 0;
  std::size_t done_ = 0;
  Bytes bytes_ = Bytes(14);
};

CO_IF_FRM request(std::uint8_t command) {
  CO_IF_FRM frame{0x605, {command}, 8};
  std::copy(std::begin(Server::payload), std::end(Server::payload), frame.Data + 1);
  return frame;
}

void step(Bench& bench, Server& server, std::uint8_t command) {
  const std::string expected = server.answer(command);
  REQUIRE(bench.ask(request(command)) == (expected.empty() ? Texts{} : Texts{expected}));
  REQUIRE(bench.device.domain_bytes == server.bytes());
}

// A segment that nobody has asked for tells whether a transfer is open: without one, the abort names its own bytes.
void check_idle(Bench& bench) {
  REQUIRE(bench.ask("605#60AABBCC00000000") == Texts{"585#80AABBCC01000405"});
  REQUIRE(bench.ask("605#00AABBCC00000000") == Texts{"585#80AABBCC01000405"});
}

// Ways into each state of the server.
const std::vector<Bytes> ways = {
    {},                  // idle
    {0x21},              // download, size indicated: toggle 0
    {0x21, 0x00},        //   toggle 1
    {0x21, 0x00, 0x11},  //   ended
    {0x20},              // download, no size: toggle 0
    {0x20, 0x00},        //   toggle 1
    {0x20, 0x00, 0x10},  //   full, toggle 0
    {0x40},              // upload: toggle 0
    {0x40, 0x60},        //   toggle 1
    {0x40, 0x60, 0x70},  //   ended
    {0x40, 0x70},        // aborted
};

void walk(Bench& bench, Server& server, const Bytes& way) {
  for (const std::uint8_t command : way) {
    step(bench, server, command);
  }
}

}  // namespace

TEST_CASE("machine walk: NMT, each command specifier in each state, to all, to this node and to another [N1] [N2]") {
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

TEST_CASE("machine walk: NMT, commands of another length than 2 are ignored and counted in each state [N1]") {
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

TEST_CASE("machine walk: NMT, all 256 node-IDs address the right node only [N1]") {
  Bench bench(1);
  for (unsigned node_id = 0; node_id < 256; ++node_id) {
    CAPTURE(node_id);
    walk_nmt(bench, State::operational, CO_IF_FRM{0, {2, static_cast<std::uint8_t>(node_id)}, 2});
  }
}

TEST_CASE("machine walk: a node in Initialisation hears no NMT command and no SDO request [N3] [D17]") {
  World world;
  Line& line = world.add_line("walk");
  Device& device = world.add_device(line, {5, 1, 14, true, false, false});
  for (unsigned byte = 0; byte < 256; ++byte) {
    line.say(CO_IF_FRM{0, {static_cast<std::uint8_t>(byte), 5}, 2});
    line.say(request(static_cast<std::uint8_t>(byte)));
    world.pass(1ms);
  }
  CHECK(line.take_texts().empty());
  CHECK(device.mode() == CO_INIT);
  CHECK(device.counters().Unclaimed == 512);
  CONodeStart(&device.node);
  CHECK(line.take_texts() == Texts{"705#00"});
}

TEST_CASE("machine walk: SDO, each first byte in each state has its one reaction, and the state is as it should be") {
  for (std::size_t way = 0; way < ways.size(); ++way) {
    for (unsigned byte = 0; byte < 256; ++byte) {
      CAPTURE(way);
      CAPTURE(byte);
      Bench bench;
      Server server;
      walk(bench, server, ways[way]);
      step(bench, server, static_cast<std::uint8_t>(byte));
      if (!server.is_open()) {
        check_idle(bench);
      }
      REQUIRE(bench.ask("605#2B00200034120000") == Texts{"585#6000200000000000"});  // a known request ends anything
      REQUIRE(bench.device.value == 0x1234);
      check_idle(bench);
    }
  }
}

TEST_CASE("machine walk: SDO, all pairs of first bytes one after the other [T7]") {
  Bench bench;
  Server server;
  for (unsigned first = 0; first < 256; ++first) {
    for (unsigned second = 0; second < 256; ++second) {
      CAPTURE(first);
      CAPTURE(second);
      step(bench, server, static_cast<std::uint8_t>(first));
      step(bench, server, static_cast<std::uint8_t>(second));
    }
  }
}

TEST_CASE("machine walk: SDO, a long random walk that prefers what leads on [T7]") {
  constexpr std::uint8_t usual[] = {0x00, 0x10, 0x01, 0x11, 0x0D, 0x1D, 0x20, 0x21, 0x23, 0x40, 0x60, 0x70, 0x80};
  Bench bench;
  Server server;
  std::mt19937 random(301);
  for (unsigned n = 0; n < 50000; ++n) {
    CAPTURE(n);
    const bool any = random() % 8 == 0;
    step(bench, server, any ? static_cast<std::uint8_t>(random()) : usual[random() % std::size(usual)]);
  }
}

TEST_CASE("machine walk: SDO, requests of another length than 8 change nothing in any state [D1]") {
  for (const Bytes& way : ways) {
    for (const std::uint8_t dlc : Bytes{0, 1, 2, 3, 4, 5, 6, 7}) {
      Bench bench;
      Server server;
      walk(bench, server, way);
      for (unsigned byte = 0; byte < 256; ++byte) {
        CO_IF_FRM frame = request(static_cast<std::uint8_t>(byte));
        frame.DLC = dlc;
        REQUIRE(bench.ask(frame).empty());
      }
      CHECK(bench.device.counters().Malformed == 256);
      for (const std::uint8_t next : Bytes{0x00, 0x10, 0x60}) {
        step(bench, server, next);
      }
    }
  }
}

TEST_CASE("machine walk: SDO across NMT, a transfer lives on in Operational and ends with Stopped and reset [N8]") {
  const char* const commands[] = {"000#0105", "000#8005", "000#0205", "000#8105", "000#8205", "000#0206", "000#8106"};
  for (const Bytes& way : ways) {
    for (const char* const command : commands) {
      CAPTURE(command);
      Bench bench;
      Server server;
      walk(bench, server, way);
      const Reaction expected = reaction(State::pre_operational, test::frame(command));
      CHECK(bench.ask(command) == (expected.boots ? Texts{"705#00"} : Texts{}));
      for (unsigned byte = 0; expected.state == State::stopped && byte < 256; ++byte) {
        REQUIRE(bench.ask(request(static_cast<std::uint8_t>(byte))).empty());
      }
      CHECK(bench.ask("000#0105").empty());
      if (expected.state == State::stopped || expected.boots) {
        check_idle(bench);
      } else {
        for (const std::uint8_t next : Bytes{0x00, 0x10, 0x60}) {
          step(bench, server, next);
        }
      }
    }
  }
}
