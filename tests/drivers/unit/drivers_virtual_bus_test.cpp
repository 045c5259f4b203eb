// SPDX-License-Identifier: Apache-2.0
// Virtual bus: delivery, order, filters, queues, and all kinds of injected faults.
#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <vector>

#include "support/notation.hpp"
#include "virtual_bus.hpp"

namespace {

using namespace std::chrono_literals;
using co::VirtualBus;
using Fault = VirtualBus::Fault;
using Texts = std::vector<std::string>;

constexpr std::int16_t taken = sizeof(CO_IF_FRM);

std::int16_t send(VirtualBus::Port& port, const char* text) { return port.send(test::frame(text)); }

// Returns the frames that a port has received since the last call.
Texts received(VirtualBus::Port& port) {
  Texts texts;
  while (const auto frame = port.read()) {
    texts.push_back(test::notation(*frame));
  }
  return texts;
}

VirtualBus::Port& online(VirtualBus& bus, VirtualBus::Options options) {
  VirtualBus::Port& port = bus.attach(std::move(options));
  port.enable();
  return port;
}

bool is_201(const VirtualBus::Traffic& traffic) { return traffic.frame.Identifier == 0x201; }

// A bus with two ports, a time that the test sets, and a trace of the frames on the bus.
struct Bench {
  Bench() {
    bus.set_time([this] { return time; });
    bus.set_trace([this](const VirtualBus::Traffic& traffic) { trace.push_back(traffic); });
  }
  VirtualBus bus;
  VirtualBus::Time time{0};
  std::vector<VirtualBus::Traffic> trace;
  VirtualBus::Port& a = online(bus, {"a"});
  VirtualBus::Port& b = online(bus, {"b"});
};

}  // namespace

TEST_CASE("virtual bus: a frame reaches every port except its sender with all flags and bytes") {
  Bench bench;
  VirtualBus::Port& c = online(bench.bus, {"c"});
  CHECK(send(bench.a, "123#1122334455667788") == taken);
  CHECK(send(bench.a, "00000123#AA") == taken);
  CHECK(send(bench.a, "123#R") == taken);
  const Texts all = {"123#1122334455667788", "00000123#AA", "123#R"};
  CHECK(received(bench.b) == all);
  CHECK(received(c) == all);
  CHECK(received(bench.a).empty());
}

TEST_CASE("virtual bus: a port off the bus neither sends nor receives, and restarts with empty queues") {
  VirtualBus bus;
  VirtualBus::Port& a = online(bus, {"a"});
  VirtualBus::Port& b = bus.attach();
  CHECK(send(b, "701#00") == -1);
  send(a, "701#00");
  b.enable();
  CHECK(received(b).empty());
  send(a, "701#05");
  b.close();
  CHECK_FALSE(b.read());
  b.enable();
  CHECK(received(b).empty());
  send(a, "701#04");
  b.enable();
  CHECK(received(b).empty());
}

TEST_CASE("virtual bus: ports with different bit rates are separate; rate 0 matches every rate") {
  VirtualBus bus;
  VirtualBus::Port& slow = bus.attach({"slow"});
  VirtualBus::Port& fast = bus.attach({"fast"});
  VirtualBus::Port& any = bus.attach({"any"});
  slow.enable(125000);
  fast.enable(1000000);
  any.enable();
  send(slow, "701#05");
  CHECK(received(fast).empty());
  CHECK(received(any) == Texts{"701#05"});
  send(any, "000#0101");
  CHECK(received(slow) == Texts{"000#0101"});
  CHECK(received(fast) == Texts{"000#0101"});
  fast.enable(125000);
  send(slow, "701#04");
  CHECK(received(fast) == Texts{"701#04"});
}

TEST_CASE("virtual bus: frames from outside reach every port") {
  Bench bench;
  bench.a.enable(500000);
  bench.bus.inject(test::frame("000#8200"));
  CHECK(received(bench.a) == Texts{"000#8200"});
  CHECK(received(bench.b) == Texts{"000#8200"});
  REQUIRE(bench.trace.size() == 1);
  CHECK(bench.trace[0].sender == nullptr);
}

TEST_CASE("virtual bus: the trace contains frame, sender and time in the order of the bus") {
  Bench bench;
  bench.time = 3ms;
  send(bench.a, "201#01");
  bench.time = 5ms;
  send(bench.b, "202#02");
  REQUIRE(bench.trace.size() == 2);
  CHECK(test::notation(bench.trace[0].frame) == "201#01");
  CHECK(bench.trace[0].sender->name() == "a");
  CHECK(bench.trace[0].time == 3ms);
  CHECK_FALSE(bench.trace[0].dropped);
  CHECK(bench.trace[1].sender == &bench.b);
  CHECK(bench.trace[1].time == 5ms);
}

TEST_CASE("virtual bus: an answer sent by a trace hook follows the traced frame") {
  Bench bench;
  VirtualBus::Port& device = online(bench.bus, {"device"});
  Texts order;
  bench.bus.set_trace([&](const VirtualBus::Traffic& traffic) {
    order.push_back(test::notation(traffic.frame));
    if (traffic.frame.Identifier == 0x601) {
      send(device, "581#60");
    }
  });
  send(bench.a, "601#40");
  CHECK(order == Texts{"601#40", "581#60"});
  CHECK(received(bench.b) == Texts{"601#40", "581#60"});
}

TEST_CASE("virtual bus: queued frames are sent in the order of arbitration, those of one port in their order") {
  Bench bench;
  VirtualBus::Port& c = online(bench.bus, {"c"});
  bench.bus.hold();
  send(bench.a, "300#");  // 080 of the same port is queued behind it
  send(bench.a, "080#");
  send(bench.b, "200#");
  send(bench.b, "700#");
  bench.bus.inject(test::frame("1FF#"));
  CHECK(received(c).empty());
  bench.bus.release();
  CHECK(received(c) == Texts{"1FF#", "200#", "300#", "080#", "700#"});
}

TEST_CASE(
    "virtual bus: the base identifier decides then 11-bit before 29-bit then the extension then data before remote") {
  VirtualBus bus;
  // 123h << 18 = 048C0000h: the 29-bit identifiers with base 123h.
  const Texts by_priority = {"122#", "123#", "123#R", "048C0000#", "048C0000#R", "048C0001#", "048E0000#", "124#"};
  std::vector<VirtualBus::Port*> ports;
  for (std::size_t i = 0; i < by_priority.size(); ++i) {
    ports.push_back(&online(bus, {"sender"}));
  }
  VirtualBus::Port& tap = online(bus, {"tap"});
  bus.hold();
  for (std::size_t i = 0; i < by_priority.size(); ++i) {
    send(*ports[i], by_priority[by_priority.size() - 1 - i].c_str());
  }
  bus.release();
  CHECK(received(tap) == by_priority);
}

TEST_CASE("virtual bus: equal identifiers are sent in the order of attachment") {
  Bench bench;
  VirtualBus::Port& c = online(bench.bus, {"c"});
  bench.bus.hold();
  send(bench.b, "100#0B");
  send(bench.a, "100#0A");
  bench.bus.release();
  CHECK(received(c) == Texts{"100#0A", "100#0B"});
}

TEST_CASE("virtual bus: a full transmit queue refuses frames without loss until the bus is free") {
  VirtualBus bus;
  VirtualBus::Port& a = online(bus, {"a", 512, 2});
  VirtualBus::Port& b = online(bus, {"b"});
  bus.hold();
  CHECK(send(a, "201#01") == taken);
  CHECK(send(a, "201#02") == taken);
  CHECK(send(a, "201#03") == 0);
  bus.release();
  CHECK(send(a, "201#03") == taken);
  CHECK(received(b) == Texts{"201#01", "201#02", "201#03"});
}

TEST_CASE("virtual bus: an accept list passes exactly its identifiers in their format, data and remote frames") {
  Bench bench;
  const std::uint32_t ids[] = {CO_IF_FRM_EXT | 0x201u, 0x601, 0x000, 0x181};  // in any order
  CHECK_FALSE(bench.b.filtered());
  co::VirtualBusDriver.Filter(&bench.b, ids, 4);
  CHECK(bench.b.filtered());
  for (const char* text : {"000#0101", "601#40", "602#40", "181#R", "181#01", "00000201#02", "201#02", "00000601#40"}) {
    send(bench.a, text);
  }
  CHECK(received(bench.b) == Texts{"000#0101", "601#40", "181#R", "181#01", "00000201#02"});
  co::VirtualBusDriver.Filter(&bench.b, ids, 0);
  send(bench.a, "000#0101");
  CHECK(received(bench.b).empty());
}

TEST_CASE("virtual bus: a port without filters receives every frame") {
  VirtualBus bus;
  VirtualBus::Port& a = online(bus, {"a"});
  VirtualBus::Port& b = online(bus, {"b", 512, 10, false});
  const std::uint32_t id = 0x601;
  b.filter(&id, 1);
  CHECK(b.accepted() == std::vector<std::uint32_t>{0x601});
  send(a, "123#");
  CHECK(received(b) == Texts{"123#"});
}

TEST_CASE("virtual bus: a full receive queue keeps the oldest frames, counts lost ones and reports one overrun") {
  VirtualBus bus;
  VirtualBus::Port& a = online(bus, {"a"});
  VirtualBus::Port& b = online(bus, {"b", 2});
  for (const char* text : {"201#01", "201#02", "201#03", "201#04"}) {
    send(a, text);
  }
  CHECK(b.waiting() == 2);
  CHECK(b.lost() == 2);
  CHECK(received(b) == Texts{"20000004#0001000000000000", "201#01", "201#02"});
  send(a, "201#05");
  CHECK(received(b) == Texts{"201#05"});
}

TEST_CASE("virtual bus: error frames of one port and of all ports are received regardless of filters") {
  Bench bench;
  bench.a.filter(nullptr, 0);
  bench.a.report(VirtualBus::error_frame(0x4, 0x20));
  CHECK(received(bench.a) == Texts{"20000004#0020000000000000"});
  CHECK(received(bench.b).empty());
  bench.bus.inject(test::frame("20000100#0000000000000000"));
  CHECK(received(bench.a) == Texts{"20000100#0000000000000000"});
  CHECK(received(bench.b) == Texts{"20000100#0000000000000000"});
}

TEST_CASE("virtual bus: a port in bus-off neither sends nor receives until its recovery; both are reported") {
  Bench bench;
  bench.a.bus_off();
  CHECK(send(bench.a, "701#05") == -1);
  send(bench.b, "000#0100");
  CHECK(received(bench.a) == Texts{"20000040#0000000000000000"});
  bench.a.recover();
  CHECK(received(bench.a) == Texts{"20000100#0000000000000000"});
  CHECK(send(bench.a, "701#05") == taken);
  bench.a.bus_off();
  bench.a.reset();
  CHECK(received(bench.a) == Texts{"20000100#0000000000000000"});
  CHECK(send(bench.a, "701#05") == taken);
}

TEST_CASE("virtual bus: bus-off drops queued frames and ends when the port is enabled again") {
  Bench bench;
  bench.bus.hold();
  send(bench.a, "201#01");
  bench.a.bus_off();
  bench.bus.release();
  bench.a.recover();
  CHECK(received(bench.b).empty());
  bench.a.bus_off();
  bench.a.enable();
  CHECK(received(bench.a).empty());
  CHECK(send(bench.a, "201#02") == taken);
  CHECK(received(bench.b) == Texts{"201#02"});
}

TEST_CASE("virtual bus: recovery without bus-off and bus-off of a port off the bus report nothing") {
  Bench bench;
  bench.a.recover();
  CHECK(received(bench.a).empty());
  bench.a.close();
  bench.a.bus_off();
  bench.a.enable();
  CHECK(received(bench.a).empty());
  CHECK(send(bench.a, "701#05") == taken);
}

TEST_CASE("virtual bus: reset empties the queues and keeps the filter") {
  Bench bench;
  const std::uint32_t id = 0x201;
  bench.b.filter(&id, 1);
  send(bench.a, "201#01");
  bench.b.reset();
  send(bench.a, "202#02");
  send(bench.a, "201#03");
  CHECK(received(bench.b) == Texts{"201#03"});
}

TEST_CASE("virtual bus fault: drop affects the n-th matching frame as often as configured and is traced") {
  Bench bench;
  const auto rule = bench.bus.add_rule({Fault::drop, is_201, 2, 2});
  for (const char* text : {"201#01", "202#01", "201#02", "202#02", "201#03", "201#04"}) {
    CHECK(send(bench.a, text) == taken);
  }
  CHECK(received(bench.b) == Texts{"201#01", "202#01", "202#02", "201#04"});
  CHECK(bench.bus.struck(rule) == 2);
  CHECK(bench.bus.struck(rule + 1) == 0);
  REQUIRE(bench.trace.size() == 6);
  CHECK(bench.trace[2].dropped);
  CHECK(bench.trace[4].dropped);
  CHECK_FALSE(bench.trace[5].dropped);
}

TEST_CASE("virtual bus fault: two rules at two positions both count every frame; the older one decides") {
  Bench bench;
  const auto drop = bench.bus.add_rule({Fault::drop, {}, 2});
  const auto twice = bench.bus.add_rule({Fault::duplicate, {}, 2, 2});
  send(bench.a, "201#01");
  send(bench.a, "201#02");
  send(bench.a, "201#03");
  CHECK(received(bench.b) == Texts{"201#01", "201#03", "201#03"});
  CHECK(bench.bus.struck(drop) == 1);
  CHECK(bench.bus.struck(twice) == 1);
}

TEST_CASE("virtual bus fault: an unlimited rule applies until the rules are cleared") {
  Bench bench;
  bench.bus.add_rule({Fault::drop, {}, 1, VirtualBus::always});
  for (int i = 0; i < 100; ++i) {
    send(bench.a, "201#01");
  }
  CHECK(received(bench.b).empty());
  bench.bus.clear_rules();
  send(bench.a, "201#02");
  CHECK(received(bench.b) == Texts{"201#02"});
}

TEST_CASE("virtual bus fault: a delayed frame is received at its time, after later frames") {
  Bench bench;
  bench.bus.add_rule({Fault::delay, {}, 1, 2, 20ms});
  CHECK(bench.bus.next_due() == VirtualBus::never);
  send(bench.a, "201#01");
  bench.time = 5ms;
  send(bench.a, "201#02");
  send(bench.a, "201#03");
  CHECK(bench.bus.next_due() == 20ms);
  bench.time = 20ms - 1us;
  CHECK(received(bench.b) == Texts{"201#03"});
  bench.time = 20ms;
  CHECK(received(bench.b) == Texts{"201#01"});
  CHECK(bench.bus.next_due() == 25ms);
  bench.time = 30ms;
  bench.bus.poll();
  CHECK(bench.b.waiting() == 1);
  CHECK(received(bench.b) == Texts{"201#02"});
  CHECK(bench.trace.back().time == 30ms);
  CHECK(bench.bus.next_due() == VirtualBus::never);
}

TEST_CASE("virtual bus fault: frames delayed to the same time keep their order") {
  Bench bench;
  bench.bus.add_rule({Fault::delay, {}, 1, 3, 10ms});
  send(bench.a, "203#01");
  send(bench.a, "202#02");
  send(bench.b, "201#03");
  bench.time = 10ms;
  CHECK(received(bench.b) == Texts{"203#01", "202#02"});
  CHECK(received(bench.a) == Texts{"201#03"});
}

TEST_CASE("virtual bus fault: reorder swaps a frame with the next one of the same sender") {
  Bench bench;
  bench.bus.add_rule({Fault::reorder, is_201});
  VirtualBus::Port& c = online(bench.bus, {"c"});
  send(bench.a, "201#01");
  send(bench.b, "301#99");
  CHECK(received(c) == Texts{"301#99"});
  send(bench.a, "202#02");
  send(bench.a, "203#03");
  CHECK(received(c) == Texts{"202#02", "201#01", "203#03"});
}

TEST_CASE("virtual bus fault: reorder can have a time limit") {
  Bench bench;
  bench.bus.add_rule({Fault::reorder, {}, 1, 1, 50ms});
  send(bench.a, "201#01");
  bench.time = 49ms;
  CHECK(received(bench.b).empty());
  bench.time = 50ms;
  CHECK(received(bench.b) == Texts{"201#01"});
  send(bench.a, "201#02");
  CHECK(received(bench.b) == Texts{"201#02"});
}

TEST_CASE("virtual bus fault: refuse returns 0 n times; the frame is sent when repeated") {
  Bench bench;
  const auto rule = bench.bus.add_rule({Fault::refuse, is_201, 1, 3});
  int attempts = 1;
  while (send(bench.a, "201#01") == 0) {
    ++attempts;
  }
  CHECK(attempts == 4);
  CHECK(bench.bus.struck(rule) == 3);
  CHECK(received(bench.b) == Texts{"201#01"});
}

TEST_CASE("virtual bus fault: refused attempts are not counted as frames on the bus") {
  Bench bench;
  bench.bus.add_rule({Fault::refuse, {}, 1, 2});
  bench.bus.add_rule({Fault::drop, {}, 2});
  while (send(bench.a, "201#01") == 0) {
  }
  send(bench.a, "201#02");
  CHECK(received(bench.b) == Texts{"201#01"});
}

TEST_CASE("virtual bus fault: error returns -1 and drops the frame") {
  Bench bench;
  bench.bus.add_rule({Fault::error, {}, 2});
  CHECK(send(bench.a, "201#01") == taken);
  CHECK(send(bench.a, "201#02") == -1);
  CHECK(send(bench.a, "201#03") == taken);
  CHECK(received(bench.b) == Texts{"201#01", "201#03"});
}

TEST_CASE("virtual bus fault: bus-off removes the sender from the bus and reports it there") {
  Bench bench;
  bench.bus.add_rule({Fault::bus_off, is_201});
  CHECK(send(bench.a, "201#01") == -1);
  CHECK(send(bench.a, "202#02") == -1);
  CHECK(received(bench.a) == Texts{"20000040#0000000000000000"});
  CHECK(received(bench.b).empty());
  bench.a.recover();
  CHECK(send(bench.a, "201#01") == taken);
}

TEST_CASE("virtual bus fault: a rule can select sender and time, and applies to frames from outside") {
  Bench bench;
  bench.bus.add_rule(
      {Fault::drop, [](const VirtualBus::Traffic& traffic) { return traffic.sender == nullptr && traffic.time >= 1ms; },
       1, VirtualBus::always});
  bench.bus.inject(test::frame("000#0101"));
  bench.time = 1ms;
  bench.bus.inject(test::frame("000#0201"));
  send(bench.a, "000#8001");
  CHECK(received(bench.b) == Texts{"000#0101", "000#8001"});
}

TEST_CASE("virtual bus: the driver table has the behaviour of the port") {
  VirtualBus bus;
  VirtualBus::Port& master = online(bus, {"master"});
  VirtualBus::Port& port = bus.attach({"node"});
  const CO_IF_CAN_DRV_EX& driver = co::VirtualBusDriver;
  CO_IF_FRM frame{};
  driver.Init(&port);
  CHECK_FALSE(port.enabled());
  driver.Enable(&port, 250000);
  CHECK(port.enabled());
  CHECK(port.baud() == 250000);
  CHECK(driver.Read(&port, &frame) == 0);
  send(master, "601#4000100000000000");
  CHECK(driver.Read(&port, &frame) == taken);
  CHECK(test::notation(frame) == "601#4000100000000000");
  frame = test::frame("581#80");
  CHECK(driver.Send(&port, &frame) == taken);
  CHECK(received(master) == Texts{"581#80"});
  send(master, "601#00");
  driver.Reset(&port);
  CHECK(driver.Read(&port, &frame) == 0);
  driver.Close(&port);
  CHECK(driver.Send(&port, &frame) == -1);
}

TEST_CASE("virtual bus: equal traffic gives equal traces") {
  const auto run = [] {
    Bench bench;
    bench.bus.add_rule({Fault::delay, {}, 3, 5, 7ms});
    bench.bus.add_rule({Fault::reorder, is_201, 4, 9});
    for (int i = 0; i < 50; ++i) {
      bench.time = i * 1ms;
      send(i % 3 == 0 ? bench.a : bench.b, i % 2 == 0 ? "201#01" : "182#02");
      bench.bus.poll();
    }
    Texts texts;
    for (const auto& traffic : bench.trace) {
      texts.push_back(std::to_string(traffic.time.count()) + traffic.sender->name() + test::notation(traffic.frame));
    }
    return texts;
  };
  CHECK(run() == run());
}
