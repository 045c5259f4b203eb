// SPDX-License-Identifier: Apache-2.0
// Tests several buses in one process: their nodes share only the code and the data that the application shares.
#include <doctest/doctest.h>

#include <chrono>
#include <cstddef>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "support/callbacks.hpp"
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

// Variables of one node of the shared dictionary below, which holds only their offsets.
struct Variables {
  std::uint16_t setpoint;
  std::uint32_t serial_number;
};

// Returns the address of the node's variable of an entry.
std::uint8_t* address_of(const CO_OBJ& obj, const CO_NODE* node) {
  return static_cast<std::uint8_t*>(CONodeGetUser(node)) + std::uintptr_t{obj.Data};
}

template <typename T>
std::uint32_t size_of(CO_OBJ*, CO_NODE*, std::uint32_t) {
  return sizeof(T);
}

CO_ERR read_own(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
  std::memcpy(buffer, address_of(*obj, node), size);
  return CO_ERR_NONE;
}

CO_ERR write_own(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
  std::memcpy(address_of(*obj, node), buffer, size);
  return CO_ERR_NONE;
}

constexpr CO_OBJ_TYPE own_u16 = {size_of<std::uint16_t>, nullptr, read_own, write_own, nullptr};
constexpr CO_OBJ_TYPE own_u32 = {size_of<std::uint32_t>, nullptr, read_own, write_own, nullptr};

std::uint8_t error_register = 0;

const CO_OBJ shared_table[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 0},
    {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, &error_register},
    {CO_KEY(0x1017, 0, CO_OBJ_D___R_), CO_THB_PROD, 100},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 4},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, 0},
    {CO_KEY(0x1018, 4, CO_OBJ_____R_), &own_u32, offsetof(Variables, serial_number)},
    {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 2},
    {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TSDO_ID, 0x600},
    {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TSDO_ID, 0x580},
    {CO_KEY(0x2000, 0, CO_OBJ_____RW), &own_u16, offsetof(Variables, setpoint)},
    CO_OBJ_DICT_ENDMARK,
};

// Two buses with a booted node 5 on each.
struct TwoLines {
  explicit TwoLines(DeviceOptions left_options = {5, 100}, DeviceOptions right_options = {5, 100})
      : at_left(world.add_device(left, left_options)), at_right(world.add_device(right, right_options)) {
    world.settle();
    left.take();
    right.take();
  }
  World world;
  Line& left = world.add_line("left");
  Line& right = world.add_line("right");
  Device& at_left;
  Device& at_right;
};

}  // namespace

TEST_CASE("many buses: two nodes of one node-ID on two buses boot, answer and send heartbeats independently") {
  World world;
  Line& left = world.add_line("left");
  Line& right = world.add_line("right");
  Device& at_left = world.add_device(left, {5, 100});
  Device& at_right = world.add_device(right, {5, 250});
  CHECK(left.take_texts() == Texts{"705#00"});
  CHECK(right.take_texts() == Texts{"705#00"});
  left.say("605#2B00200034120000");
  right.say("605#4000200000000000");
  world.settle();
  CHECK(left.take_texts() == Texts{"585#6000200000000000"});
  CHECK(right.take_texts() == Texts{"585#4B00200000000000"});
  CHECK(at_left.value == 0x1234);
  CHECK(at_right.value == 0);
  left.say("000#0100");
  world.pass(500ms);
  CHECK(left.take_texts() == Texts{"705#05", "705#05", "705#05", "705#05", "705#05"});
  CHECK(right.take_texts() == Texts{"705#7F", "705#7F"});
}

TEST_CASE("many buses: segmented transfers of equal nodes on two buses run simultaneously") {
  TwoLines lines({5, 0, 14}, {5, 0, 14});
  for (std::uint8_t i = 0; i < 14; ++i) {
    lines.at_left.domain_bytes[i] = static_cast<std::uint8_t>(0x10 + i);
    lines.at_right.domain_bytes[i] = static_cast<std::uint8_t>(0x20 + i);
  }
  for (const char* const request : {"605#4010200000000000", "605#6000000000000000", "605#7000000000000000"}) {
    lines.left.say(request);
    lines.right.say(request);
    lines.world.settle();
  }
  CHECK(lines.left.take_texts() == Texts{"585#411020000E000000", "585#0010111213141516", "585#111718191A1B1C1D"});
  CHECK(lines.right.take_texts() == Texts{"585#411020000E000000", "585#0020212223242526", "585#112728292A2B2C2D"});
}

TEST_CASE("many buses: the reset of one node does not affect transfer and heartbeat of the other") {
  TwoLines lines;
  lines.world.pass(50ms);
  RawSdoClient at_right(lines.world, lines.right, 5);
  at_right.ask({0x40, 0x08, 0x10, 0});
  for (const char* const reset : {"000#8105", "000#8205"}) {
    CAPTURE(reset);
    lines.left.take();
    lines.left.say(reset);
    lines.world.settle();
    CHECK(lines.left.take_texts() == Texts{"705#00"});
  }
  const auto segment = at_right.ask({0x60});
  REQUIRE(segment.has_value());
  CHECK(test::notation(*segment) == "585#0364657669636500");
  lines.right.take();
  lines.world.pass(100ms);
  const auto beats = lines.right.take();
  REQUIRE(beats.size() == 1);
  CHECK(beats[0].time == 100ms);  // the phase is unchanged; the boot-up of the other bus's node was at 50 ms
  const auto twin = lines.left.take();
  REQUIRE(twin.size() == 1);
  CHECK(twin[0].time == 150ms);
}

TEST_CASE("many buses: nodes share one constant dictionary and have their own variables") {
  Variables left_variables = {0x1111, 0xAAAAAAAA};
  Variables right_variables = {0x2222, 0xBBBBBBBB};
  DeviceOptions left_options{5};
  left_options.table = shared_table;
  left_options.user = &left_variables;
  DeviceOptions right_options{6};
  right_options.table = shared_table;
  right_options.user = &right_variables;
  TwoLines lines(left_options, right_options);
  CHECK(RawSdoClient(lines.world, lines.left, 5).upload(0x1018, 4).data == Bytes{0xAA, 0xAA, 0xAA, 0xAA});
  CHECK(RawSdoClient(lines.world, lines.right, 6).upload(0x1018, 4).data == Bytes{0xBB, 0xBB, 0xBB, 0xBB});
  CHECK(RawSdoClient(lines.world, lines.left, 5).download(0x2000, 0, {0x34, 0x12}).is_done());
  CHECK(left_variables.setpoint == 0x1234);
  CHECK(right_variables.setpoint == 0x2222);
  CHECK(RawSdoClient(lines.world, lines.right, 6).upload(0x1200, 1).data == Bytes{0x06, 0x06, 0, 0});
  CHECK(RawSdoClient(lines.world, lines.left, 5).upload(0x1200, 1).data == Bytes{0x05, 0x06, 0, 0});
}

TEST_CASE("many buses: a shared dictionary serves interleaved transfers, resets and heartbeats of both nodes") {
  Variables left_variables = {1, 0};
  Variables right_variables = {2, 0};
  DeviceOptions left_options{5};
  left_options.table = shared_table;
  left_options.user = &left_variables;
  DeviceOptions right_options{5};
  right_options.table = shared_table;
  right_options.user = &right_variables;
  TwoLines lines(left_options, right_options);
  lines.left.say("605#2100200002000000");  // both nodes begin a transfer; only the left node is reset during it
  lines.right.say("605#2100200002000000");
  lines.world.settle();
  lines.left.say("000#8105");
  lines.right.say("605#0B66770000000000");
  lines.world.settle();
  CHECK(left_variables.setpoint == 1);
  CHECK(right_variables.setpoint == 0x7766);
  CHECK(lines.left.take_texts() == Texts{"585#6000200000000000", "705#00"});
  CHECK(lines.right.take_texts() == Texts{"585#6000200000000000", "585#2000000000000000"});
  lines.world.pass(300ms);
  CHECK(lines.left.take_texts() == Texts{"705#7F", "705#7F", "705#7F"});
  CHECK(lines.right.take_texts() == Texts{"705#7F", "705#7F", "705#7F"});
}

TEST_CASE("many buses: a node with classic drivers runs beside one with context arguments") {
  World world(1000, 0xFFFFFFF0);
  Line& left = world.add_line("left");
  Line& right = world.add_line("right");
  DeviceOptions plain{5, 70};
  plain.plain = true;
  Device& old_style = world.add_device(left, plain);
  Device& neighbour = world.add_device(left, {6, 110});
  Device& twin = world.add_device(right, {5, 130});
  CHECK(left.take_texts() == Texts{"705#00", "706#00"});
  CHECK_FALSE(old_style.port.filtered());  // classic drivers have no receive filter
  CHECK(neighbour.port.filtered());
  left.say("605#2B00200034120000");
  left.say("606#2B00200078560000");
  right.say("605#2B002000BC9A0000");
  left.say("000#0105");
  world.settle();
  CHECK(old_style.value == 0x1234);
  CHECK(neighbour.value == 0x5678);
  CHECK(twin.value == 0x9ABC);
  CHECK(old_style.mode() == CO_OPERATIONAL);
  CHECK(neighbour.mode() == CO_PREOP);
  CHECK(twin.mode() == CO_PREOP);
  left.take();
  right.take();
  world.pass(10s);
  int of_old_style = 0;
  int of_neighbour = 0;
  for (const auto& traffic : left.take()) {
    const bool is_old = traffic.sender == &old_style.port;
    const auto period = is_old ? 70ms : 110ms;
    CHECK(traffic.time % period == 0ms);
    ++(is_old ? of_old_style : of_neighbour);
  }
  CHECK(of_old_style == 142);
  CHECK(of_neighbour == 90);
  CHECK(right.take().size() == 76);
}

TEST_CASE("many buses: transfers of nodes with classic drivers have their own time-outs [D18]") {
  World world;
  Line& line = world.add_line("bus");
  DeviceOptions plain{5};
  plain.plain = true;
  world.add_device(line, plain);
  world.add_device(line, {6});
  line.say("605#2101200008000000");
  line.say("606#2101200008000000");
  world.settle();
  line.take();
  world.pass(1749ms);
  CHECK(line.take_texts().empty());  // no abort before 7/8 of the time-out
  world.pass(252ms);
  CHECK(line.take_texts() == Texts{"585#8001200000000405", "586#8001200000000405"});
}

TEST_CASE("many buses: callbacks get the node that they concern") {
  std::vector<std::pair<CO_NMT*, CO_MODE>> changes;
  std::vector<std::pair<CO_NMT*, CO_NMT_RESET>> resets;
  TwoLines lines;
  test::callbacks().mode_change = [&](CO_NMT* nmt, CO_MODE mode) { changes.emplace_back(nmt, mode); };
  test::callbacks().reset_request = [&](CO_NMT* nmt, CO_NMT_RESET reset) { resets.emplace_back(nmt, reset); };
  lines.left.say("000#0105");
  lines.world.settle();
  lines.right.say("000#8205");
  lines.world.settle();
  test::callbacks() = {};
  CO_NMT* const left = &lines.at_left.node.Nmt;
  CO_NMT* const right = &lines.at_right.node.Nmt;
  CHECK(changes ==
        std::vector<std::pair<CO_NMT*, CO_MODE>>{{left, CO_OPERATIONAL}, {right, CO_INIT}, {right, CO_PREOP}});
  CHECK(resets == std::vector<std::pair<CO_NMT*, CO_NMT_RESET>>{{right, CO_RESET_COM}});
}

TEST_CASE("many buses: bus-off of one controller affects only its node") {
  TwoLines lines;
  lines.at_left.port.bus_off();
  lines.world.pass(350ms);
  CHECK(lines.left.take().empty());
  CHECK(lines.right.take_texts() == Texts{"705#7F", "705#7F", "705#7F"});
  CHECK(lines.at_left.counters().CanEvents[CO_CAN_BUS_OFF] == 1);
  CHECK(lines.at_right.counters().CanEvents[CO_CAN_BUS_OFF] == 0);
  CHECK(CONodeGetErr(&lines.at_left.node) == CO_ERR_IF_CAN_SEND);
  CHECK(CONodeGetErr(&lines.at_right.node) == CO_ERR_NONE);
  lines.at_left.port.recover();
  lines.world.pass(100ms);
  CHECK(lines.left.take_texts() == Texts{"705#7F", "705#7F"});  // the newest of the queued heartbeats, then one on time
}
