// SPDX-License-Identifier: Apache-2.0
// Tests a node whose CAN controller refuses frames for a while, at every point of the node's life.
#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <vector>

#include "support/network.hpp"
#include "support/notation.hpp"
#include "support/raw_sdo_client.hpp"

namespace {

using namespace std::chrono_literals;
using co::VirtualBus;
using test::Device;
using test::Line;
using test::RawSdoClient;
using test::SdoResult;
using test::Texts;
using test::World;
using Fault = VirtualBus::Fault;

std::string joined(const Texts& texts) {
  std::string all;
  for (const std::string& text : texts) {
    all += text + "\n";
  }
  return all;
}

// Frames other than heartbeats: each must be sent once and in this order, whatever the controller refuses.
const Texts expected_frames = {
    "705#00",  // boot-up
    "585#4108100006000000",
    "585#0364657669636500",  // upload of 1008h
    "585#6001200000000000",
    "585#2000000000000000",
    "585#3000000000000000",  // download to 2001h
    "585#4302200044332211",  // upload of 2002h, in Operational
    "585#8003200000000206",  // abort: 2003h does not exist
    "705#00",                // boot-up after the reset
    "585#4302200044332211",
};

const Texts expected_states = {"705#7F", "705#05", "705#04", "705#7F"};

struct Life {
  Texts frames;
  Texts states;  // heartbeats; consecutive equal ones count once
  std::uint32_t offered;
  std::uint32_t dropped;
  CO_ERR error;
};

void sort_out(const Texts& heard, Life& life) {
  for (const std::string& text : heard) {
    const bool is_heartbeat = text.substr(0, 4) == "705#" && text != "705#00";
    if (!is_heartbeat) {
      life.frames.push_back(text);
    } else if (life.states.empty() || life.states.back() != text) {
      life.states.push_back(text);
    }
  }
}

// Runs the node through its life while the controller refuses offers from number \a position on. A frame that is
// offered again counts as another offer.
Life live(Fault fault, std::uint32_t position, std::uint32_t times) {
  World world;
  Line& line = world.add_line("busy");
  const auto of_device = [&](const VirtualBus::Traffic& traffic) {
    return traffic.sender != nullptr && traffic.sender->name() == "node 5";
  };
  line.bus.add_rule({fault, of_device, position, times});
  std::uint32_t offered = 0;
  line.bus.add_rule({Fault::refuse, [&](const auto& traffic) { return offered += of_device(traffic), false; }});
  Device& device = world.add_device(line, {5, 20});
  RawSdoClient client(world, line, 5);
  world.pass(100ms);
  CHECK(client.upload(0x1008, 0).is_done());
  CHECK(client.download(0x2001, 0, {1, 2, 3, 4, 5, 6, 7, 8}).is_done());
  line.say("000#0105");
  world.pass(100ms);
  CHECK(client.upload(0x2002, 0).is_done());
  CHECK(client.upload(0x2003, 0).code == 0x06020000);
  line.say("000#0205");
  world.pass(100ms);
  const std::uint32_t dropped = device.counters().Dropped;  // read before the reset, which may discard an old heartbeat
  line.say("000#8105");
  world.pass(100ms);
  CHECK(client.upload(0x2002, 0).is_done());
  Life life{{}, {}, offered, dropped, CONodeGetErr(&device.node)};
  sort_out(line.take_texts(), life);
  return life;
}

void check_all_positions(Fault fault, CO_ERR error) {
  const std::uint32_t offers = live(Fault::none, 1, 1).offered;
  REQUIRE(offers > expected_frames.size());
  for (const std::uint32_t times : {1u, 2u, 3u, 7u, 19u, 20u, 21u, 60u}) {
    CAPTURE(times);
    for (std::uint32_t position = 1; position <= offers; ++position) {
      CAPTURE(position);
      const Life life = live(fault, position, times);
      CHECK(joined(life.frames) == joined(expected_frames));
      CHECK(joined(life.states) == joined(expected_states));
      CHECK(life.dropped == 0);
      CHECK(life.error == error);
    }
  }
}

// Build a request and the answer to it. The sub-index, which 2000h does not have, is the number of the pair.
std::string numbered(const char* head, unsigned number, const char* tail) {
  return std::string(head) + std::to_string(10 + number) + tail;
}
std::string request(unsigned number) { return numbered("605#400020", number, "00000000"); }
std::string answer(unsigned number) { return numbered("585#800020", number, "11000906"); }

struct Blocked {
  explicit Blocked(bool start) : device(world.add_device(line, {5, 0, 16, true, false, start})) {
    line.take();
    line.bus.add_rule(
        {Fault::refuse, [this](const auto& traffic) { return traffic.sender == &device.port; }, 1, VirtualBus::always});
  }
  bool application_sends(const std::string& text) {
    CO_IF_FRM frame = test::frame(text);
    return COIfCanSend(&device.node.If, &frame) > 0;
  }
  Texts unblock() {
    line.bus.clear_rules();
    world.pass(10ms);
    return line.take_texts();
  }
  World world;
  Line& line = world.add_line("blocked");
  Device& device;
};

}  // namespace

TEST_CASE("busy controller: no answer, boot-up or state is lost when it refuses frames from any time [T12]") {
  check_all_positions(Fault::refuse, CO_ERR_NONE);
}

TEST_CASE("busy controller: no answer, boot-up or state is lost when it reports errors from any time [T12]") {
  check_all_positions(Fault::error, CO_ERR_IF_CAN_SEND);
}

TEST_CASE("busy controller: answers are queued in order; those refused by a full queue are counted [Q4]") {
  Blocked blocked(true);
  const unsigned requests = CO_TX_QUEUE_N + 5;
  Texts expected;
  for (unsigned n = 0; n < requests; ++n) {
    blocked.line.say(request(n));
    if (n < CO_TX_QUEUE_N) {
      expected.push_back(answer(n));
    }
  }
  blocked.world.settle();
  CHECK(blocked.line.take_texts().empty());
  CHECK(blocked.device.counters().Dropped == 5);
  CHECK(blocked.unblock() == expected);
  CHECK(blocked.device.counters().Sent == 1 + expected.size());
  blocked.line.say(request(50));
  blocked.world.settle();
  CHECK(blocked.line.take_texts() == Texts{answer(50)});
}

TEST_CASE("busy controller: queued frames are sent by CAN priority [Q4]") {
  Blocked blocked(true);
  CHECK(blocked.application_sends("700#01"));
  CHECK(blocked.application_sends("080#03"));
  blocked.line.say(request(0));
  blocked.world.settle();
  CHECK(blocked.unblock() == Texts{"080#03", answer(0), "700#01"});
}

TEST_CASE("busy controller: frames of the application leave slots for the boot-up, sent first, and answers [N4]") {
  Blocked blocked(false);
  Texts expected = {"705#00"};
  for (unsigned n = 0; blocked.application_sends(numbered("0", n, "#00")); ++n) {
    expected.push_back(numbered("0", n, "#00"));
  }
  CHECK(expected.size() > CO_TX_QUEUE_N / 2);
  CHECK(blocked.device.counters().Dropped == 1);
  CONodeStart(&blocked.device.node);
  blocked.line.say(request(0));
  blocked.world.settle();
  expected.push_back(answer(0));
  CHECK(blocked.unblock() == expected);
  CHECK(blocked.device.counters().Dropped == 1);
}

TEST_CASE("busy controller: of queued heartbeats only the newest state is sent [N5]") {
  World world;
  Line& line = world.add_line("blocked");
  Device& device = world.add_device(line, {5, 20});
  line.take();
  line.bus.add_rule(
      {Fault::refuse, [&](const auto& traffic) { return traffic.sender == &device.port; }, 1, VirtualBus::always});
  world.pass(50ms);
  line.say("000#0105");
  world.pass(205ms);
  CHECK(device.counters().Dropped == 0);
  line.bus.clear_rules();
  world.pass(2ms);
  CHECK(line.take_texts() == Texts{"705#05"});
  world.pass(3ms);
  CHECK(line.take_texts() == Texts{"705#05"});  // the next heartbeat has the original phase: 260 ms
}

TEST_CASE("busy controller: a queued answer is withdrawn when the node is stopped [N3] [N8]") {
  Blocked blocked(true);
  blocked.line.say(request(0));
  blocked.world.settle();
  blocked.line.say("000#0205");
  blocked.world.settle();
  CHECK(blocked.unblock().empty());
  CHECK(blocked.device.counters().Dropped == 1);
  blocked.line.say("000#0105");
  blocked.line.say(request(1));
  blocked.world.settle();
  CHECK(blocked.line.take_texts() == Texts{answer(1)});
}

TEST_CASE("busy controller: a new answer never overtakes a queued one [Q4]") {
  for (std::uint32_t times = 1; times <= 12; ++times) {
    CAPTURE(times);
    Blocked blocked(true);
    blocked.line.bus.clear_rules();
    blocked.line.bus.add_rule(
        {Fault::refuse, [&](const auto& traffic) { return traffic.sender == &blocked.device.port; }, 1, times});
    for (unsigned n = 0; n < 4; ++n) {
      blocked.line.say(request(n));
    }
    blocked.world.pass(20ms);
    CHECK(blocked.line.take_texts() == Texts{answer(0), answer(1), answer(2), answer(3)});
  }
}
