// SPDX-License-Identifier: Apache-2.0
// Tests two, sixteen and 127 nodes on one virtual bus, with one clock.
#include <doctest/doctest.h>

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "support/network.hpp"
#include "support/notation.hpp"
#include "support/raw_sdo_client.hpp"

namespace {

using namespace std::chrono_literals;
using test::Device;
using test::Line;
using test::RawSdoClient;
using test::Texts;
using test::World;

CO_IF_FRM request(std::uint8_t node_id, const std::string& data) {
  CO_IF_FRM frame = test::frame("600#" + data);
  frame.Identifier += node_id;
  return frame;
}

struct Crowd {
  explicit Crowd(std::uint8_t nodes, std::uint16_t first_heartbeat = 0, std::uint16_t heartbeat_step = 0) {
    for (std::uint8_t id = 1; id <= nodes; ++id) {
      const auto heartbeat = static_cast<std::uint16_t>(first_heartbeat + heartbeat_step * (id - 1));
      devices.push_back(&world.add_device(line, {id, heartbeat}));
    }
  }
  World world{1000, 0xFFFFFF00};
  Line& line = world.add_line("crowd");
  std::vector<Device*> devices;
};

void check_boot_up(Crowd& crowd) {
  const auto heard = crowd.line.take();
  REQUIRE(heard.size() == crowd.devices.size());
  for (std::size_t i = 0; i < heard.size(); ++i) {
    CHECK(heard[i].sender == &crowd.devices[i]->port);
    CHECK(heard[i].frame.Identifier == 0x701 + i);
    CHECK(heard[i].frame.DLC == 1);
    CHECK(heard[i].frame.Data[0] == 0);
  }
}

// Writes a different value to each server without a pause; checks that each answers once and changes its own variable
// only.
void check_sdo(Crowd& crowd) {
  for (const Device* device : crowd.devices) {
    CO_IF_FRM write = request(device->node.NodeId, "2B00200000A50000");
    write.Data[4] = device->node.NodeId;
    crowd.line.say(write);
  }
  crowd.world.settle();
  std::map<std::uint32_t, const co::VirtualBus::Port*> answers;
  for (const auto& traffic : crowd.line.take()) {
    if (traffic.sender != &crowd.line.master) {
      CHECK(test::notation(traffic.frame).substr(3) == "#6000200000000000");
      CHECK(answers.emplace(traffic.frame.Identifier, traffic.sender).second);
    }
  }
  CHECK(answers.size() == crowd.devices.size());
  for (const Device* device : crowd.devices) {
    CHECK(answers[0x580u + device->node.NodeId] == &device->port);
    CHECK(device->value == (0xA500 | device->node.NodeId));
  }
}

void check_modes(const Crowd& crowd, CO_MODE mode, const Device* other = nullptr, CO_MODE others_mode = CO_INVALID) {
  for (Device* device : crowd.devices) {
    CHECK(device->mode() == (device == other ? others_mode : mode));
  }
}

void check_nmt(Crowd& crowd) {
  crowd.line.say("000#0100");
  crowd.world.settle();
  check_modes(crowd, CO_OPERATIONAL);
  for (const Device* device : crowd.devices) {
    crowd.line.say(CO_IF_FRM{0, {2, device->node.NodeId}, 2});
    crowd.world.settle();
    check_modes(crowd, CO_OPERATIONAL, device, CO_STOP);
    crowd.line.say(CO_IF_FRM{0, {1, device->node.NodeId}, 2});
    crowd.world.settle();
  }
  CHECK(crowd.line.take_texts().empty());
  crowd.line.say("000#8000");
  crowd.world.settle();
  check_modes(crowd, CO_PREOP);
}

// Checks the times of each node's heartbeats: exactly one after each full period since the boot-up.
void check_heartbeats(Crowd& crowd, std::chrono::microseconds time) {
  const auto begin = crowd.world.clock.time();
  crowd.world.pass(time);
  std::map<const co::VirtualBus::Port*, std::vector<co::VirtualBus::Time>> times;
  for (const auto& traffic : crowd.line.take()) {
    times[traffic.sender].push_back(traffic.time - begin);
    CHECK(traffic.frame.DLC == 1);
    CHECK(traffic.frame.Data[0] == 0x7F);
  }
  for (const Device* device : crowd.devices) {
    const auto& beats = times[&device->port];
    const auto period = std::chrono::milliseconds(97 + 61 * (device->node.NodeId - 1));
    REQUIRE(beats.size() == static_cast<std::size_t>(time / period));
    for (std::size_t n = 0; n < beats.size(); ++n) {
      REQUIRE(beats[n] == period * static_cast<std::int64_t>(n + 1));
    }
  }
}

}  // namespace

TEST_CASE("several nodes: each boots once and with its own CAN-ID [N4]") {
  for (const std::uint8_t nodes : {std::uint8_t{2}, std::uint8_t{16}, std::uint8_t{127}}) {
    CAPTURE(int{nodes});
    Crowd crowd(nodes);
    check_boot_up(crowd);
  }
}

TEST_CASE("several nodes: each answers SDO requests with its own CAN-IDs only") {
  for (const std::uint8_t nodes : {std::uint8_t{2}, std::uint8_t{16}, std::uint8_t{127}}) {
    CAPTURE(int{nodes});
    Crowd crowd(nodes);
    crowd.line.take();
    check_sdo(crowd);
  }
}

TEST_CASE("several nodes: requests to unused node-IDs are not answered") {
  Crowd crowd(16);
  crowd.line.take();
  for (unsigned id = 0; id <= 127; id = (id == 0) ? 17 : id + 1) {
    crowd.line.say(request(static_cast<std::uint8_t>(id), "4000200000000000"));
  }
  crowd.world.pass(5000ms);
  CHECK(crowd.line.take_texts().empty());
}

TEST_CASE("several nodes: an NMT command to node-ID 0 reaches all and one to a node-ID reaches only that node [N1]") {
  for (const std::uint8_t nodes : {std::uint8_t{2}, std::uint8_t{16}, std::uint8_t{127}}) {
    CAPTURE(int{nodes});
    Crowd crowd(nodes);
    crowd.line.take();
    check_nmt(crowd);
  }
}

TEST_CASE("several nodes: a reset of all boots all, on a busy bus in the order of their CAN-IDs [N4]") {
  Crowd crowd(16);
  crowd.line.take();
  crowd.line.say("000#8100");
  crowd.line.bus.hold();
  crowd.world.settle();
  CHECK(crowd.line.take_texts().empty());
  crowd.line.bus.release();
  check_boot_up(crowd);
  check_modes(crowd, CO_PREOP);
}

TEST_CASE("several nodes: sixteen heartbeats keep their periods for an hour, on a clock that wraps [H1]") {
  Crowd crowd(16, 97, 61);
  crowd.line.take();
  check_heartbeats(crowd, 1h);
}

TEST_CASE("several nodes: 127 heartbeats keep their periods [H1]") {
  Crowd crowd(127, 97, 61);
  crowd.line.take();
  check_heartbeats(crowd, 60s);
}

TEST_CASE("several nodes: interleaved segmented transfers of all nodes do not mix [D8]") {
  Crowd crowd(16);
  crowd.line.take();
  for (const Device* device : crowd.devices) {
    crowd.line.say(request(device->node.NodeId, "2101200008000000"));
  }
  crowd.world.settle();
  for (const char* const segment : {"0001020304050600", "1D08000000000000"}) {
    for (const Device* device : crowd.devices) {
      CO_IF_FRM frame = request(device->node.NodeId, segment);
      if (frame.Data[0] == 0) {
        frame.Data[7] = device->node.NodeId;
      }
      crowd.line.say(frame);
    }
    crowd.world.settle();
  }
  for (const Device* device : crowd.devices) {
    CHECK(device->long_value == (0x0800060504030201u | (std::uint64_t{device->node.NodeId} << 48)));
  }
  std::set<std::string> answers;
  for (const std::string& text : crowd.line.take_texts()) {
    CHECK(answers.insert(text).second);
  }
  CHECK(answers.size() == 3 * crowd.devices.size());
  CHECK(answers.count("581#6001200000000000") == 1);
  CHECK(answers.count("581#2000000000000000") == 1);
  CHECK(answers.count("590#3000000000000000") == 1);
}

TEST_CASE("several nodes: a node that is stopped or reset does not disturb the transfers of the others") {
  Crowd crowd(3);
  RawSdoClient one(crowd.world, crowd.line, 1);
  RawSdoClient two(crowd.world, crowd.line, 2);
  one.ask({0x40, 0x08, 0x10, 0});
  two.ask({0x40, 0x08, 0x10, 0});
  crowd.line.say("000#8101");
  crowd.world.settle();
  const auto segment = two.ask({0x60});
  REQUIRE(segment.has_value());
  CHECK(test::notation(*segment) == "582#0364657669636500");  // "device"
  const auto refused = one.ask({0x60});
  REQUIRE(refused.has_value());
  CHECK(test::notation(*refused) == "581#8000000001000405");  // the reset has ended this transfer
  crowd.line.say("000#0203");
  crowd.world.settle();
  CHECK(one.upload(0x2002, 0).data == std::vector<std::uint8_t>{0x44, 0x33, 0x22, 0x11});
  CHECK(two.upload(0x2002, 0).data == std::vector<std::uint8_t>{0x44, 0x33, 0x22, 0x11});
}
