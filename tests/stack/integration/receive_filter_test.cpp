// SPDX-License-Identifier: Apache-2.0
// Tests that nodes with and without receive filters behave alike and differ in their load only.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <random>
#include <vector>

#include "support/network.hpp"
#include "support/notation.hpp"
#include "support/raw_sdo_client.hpp"

namespace {

using namespace std::chrono_literals;
using test::Device;
using test::DeviceOptions;
using test::Line;
using test::RawSdoClient;
using test::Texts;
using test::World;
using Bytes = std::vector<std::uint8_t>;

DeviceOptions options(bool filter) {
  DeviceOptions options{5, 50};
  options.filter = filter;
  return options;
}

// Returns a random frame; identifiers that the node consumes are more frequent.
CO_IF_FRM any_frame(std::mt19937& random) {
  constexpr std::uint32_t near[] = {0x000, 0x605, 0x585, 0x705, 0x606, 0x085, 0x205, 0x640, 0x80000605, 0x40000605};
  constexpr std::uint8_t commands[] = {0x00, 0x01, 0x0D, 0x10, 0x1D, 0x21, 0x2B, 0x2F, 0x40, 0x60, 0x70, 0x80, 0xA0, 2};
  constexpr std::uint8_t subs[] = {0x00, 0x00, 0x01};
  CO_IF_FRM frame{};
  frame.Identifier = (random() % 4 != 0) ? near[random() % std::size(near)] : random() % 0x800;
  frame.DLC = static_cast<std::uint8_t>((random() % 4 != 0) ? 8 : random() % 9);
  const std::uint8_t index_low = static_cast<std::uint8_t>(random() % 3);
  const std::uint8_t data[8] = {
      commands[random() % std::size(commands)], index_low, 0x20, subs[random() % 3], 2, 0, 0, 0};
  std::copy(std::begin(data), std::end(data), frame.Data);
  if (frame.Identifier == 0) {
    constexpr std::uint8_t specifiers[] = {1, 2, 128, 129, 130, 1, 128};
    frame.DLC = 2;
    frame.Data[0] = specifiers[random() % std::size(specifiers)];
    frame.Data[1] = static_cast<std::uint8_t>(random() % 3 + 4);
  }
  return frame;
}

std::uint32_t served(const CO_NODE_COUNTERS& counters) {
  return counters.Received - counters.Unclaimed - counters.Malformed;
}

}  // namespace

TEST_CASE("receive filter: a node with a filter behaves like one without") {
  World world;
  Line& left = world.add_line("left");
  Line& right = world.add_line("right");
  Device& filtered = world.add_device(left, options(true));
  Device& open = world.add_device(right, options(false));
  std::mt19937 random(20240501);
  std::uint32_t said = 0;
  for (; said < 20000; ++said) {
    const CO_IF_FRM frame = any_frame(random);
    left.say(frame);
    right.say(frame);
    world.pass(std::chrono::milliseconds(random() % 3));
    const Texts heard = left.take_texts();
    REQUIRE(heard == right.take_texts());
  }
  CHECK(filtered.value == open.value);
  CHECK(filtered.long_value == open.long_value);
  CHECK(filtered.mode() == open.mode());
  const CO_NODE_COUNTERS behind = filtered.counters();
  const CO_NODE_COUNTERS all = open.counters();
  CHECK(all.Received == said);
  CHECK(behind.Received < said / 2);
  CHECK(served(behind) == served(all));
  CHECK(behind.Malformed == all.Malformed);
  CHECK(behind.Sent == all.Sent);
  CHECK(behind.SdoAborts == all.SdoAborts);
}

TEST_CASE("receive filter: it contains the CAN-IDs of NMT, the SDO server and the own error control only") {
  World world;
  Line& line = world.add_line("bus");
  const Device& device = world.add_device(line, {5, 0, 16, true, false, false});
  CHECK(device.port.filtered());
  CHECK(device.port.accepted() == std::vector<std::uint32_t>{0x000, 0x605, 0x705});
  line.say("000#8105");
  line.say("000#0100");
  world.settle();
  CHECK(device.port.accepted() == std::vector<std::uint32_t>{0x000, 0x605, 0x705});
}

TEST_CASE("receive filter: a reset after a change of the node-ID updates it") {
  World world;
  Line& line = world.add_line("bus");
  Device& device = world.add_device(line, {5, 0, 16, true, false, false});
  CONmtSetNodeId(&device.node.Nmt, 6);
  CONmtReset(&device.node.Nmt, CO_RESET_NODE);
  CHECK(device.port.accepted() == std::vector<std::uint32_t>{0x000, 0x606, 0x706});
  CONodeStart(&device.node);
  line.say("605#4002200000000000");
  line.say("606#4002200000000000");
  world.settle();
  CHECK(line.take_texts() == Texts{"706#00", "586#4302200044332211"});
}

#if CO_SSDO_N >= 2

TEST_CASE("receive filter: it follows the COB-IDs of a second SDO server that are written at run time [D16]") {
  for (const bool filter : {true, false}) {
    CAPTURE(filter);
    World world;
    Line& line = world.add_line("bus");
    const Device& device = world.add_device(line, options(filter));
    RawSdoClient first(world, line, 5);
    CHECK(device.port.accepted() == std::vector<std::uint32_t>{0x000, 0x605, 0x705});
    CHECK(first.download(0x1201, 1, {0x81, 0x06, 0, 0}).is_done());
    CHECK(device.port.accepted() == std::vector<std::uint32_t>{0x000, 0x605, 0x705});  // 1201h:2 is not valid [D26]
    CHECK(first.download(0x1201, 2, {0x91, 0x06, 0, 0}).is_done());
    CHECK(device.port.accepted() == std::vector<std::uint32_t>{0x000, 0x605, 0x681, 0x705});
    CHECK(RawSdoClient(world, line, 0x681u, 0x691u).upload(0x2002, 0).data == Bytes{0x44, 0x33, 0x22, 0x11});

    CHECK(first.download(0x1201, 1, {0x81, 0x06, 0, 0x80}).is_done());
    CHECK(device.port.accepted() == std::vector<std::uint32_t>{0x000, 0x605, 0x705});
    CHECK_FALSE(RawSdoClient(world, line, 0x681u, 0x691u).ask({0x40, 0x02, 0x20}).has_value());
    CHECK(first.download(0x1201, 1, {0xA5, 0x01, 0, 0}).is_done());
    CHECK(device.port.accepted() == std::vector<std::uint32_t>{0x000, 0x1A5, 0x605, 0x705});
    CHECK_FALSE(RawSdoClient(world, line, 0x681u, 0x691u).ask({0x40, 0x02, 0x20}).has_value());
    CHECK(RawSdoClient(world, line, 0x1A5u, 0x691u).upload(0x2002, 0).data == Bytes{0x44, 0x33, 0x22, 0x11});
    CHECK(first.upload(0x2002, 0).is_done());
  }
}

TEST_CASE("receive filter: a server that its own client disables answers before its identifier is removed [D16, Q3]") {
  World world;
  Line& line = world.add_line("bus");
  const Device& device = world.add_device(line, options(true));
  RawSdoClient first(world, line, 5);
  CHECK(first.download(0x1201, 1, {0x81, 0x06, 0, 0}).is_done());
  CHECK(first.download(0x1201, 2, {0x91, 0x06, 0, 0}).is_done());
  RawSdoClient second(world, line, 0x681u, 0x691u);
  CHECK(second.download(0x1201, 1, {0x81, 0x06, 0, 0x80}).is_done());
  CHECK(device.port.accepted() == std::vector<std::uint32_t>{0x000, 0x605, 0x705});
  CHECK_FALSE(second.ask({0x40, 0x02, 0x20}).has_value());
}

TEST_CASE("receive filter: a 29-bit identifier of a second server is distinguished from the 11-bit one [Q1]") {
  World world;
  Line& line = world.add_line("bus");
  const Device& device = world.add_device(line, options(true));
  RawSdoClient first(world, line, 5);
  CHECK(first.download(0x1201, 2, {0x91, 0x06, 0, 0}).is_done());
  CHECK(first.download(0x1201, 1, {0x81, 0x06, 0, 0x20}).is_done());
  CHECK(device.port.accepted() == std::vector<std::uint32_t>{0x000, 0x605, 0x705, 0x80000681});
  CHECK_FALSE(RawSdoClient(world, line, 0x681u, 0x691u).ask({0x40, 0x02, 0x20}).has_value());
  CHECK(RawSdoClient(world, line, 0x80000681u, 0x691u).upload(0x2002, 0).is_done());
}

#endif
