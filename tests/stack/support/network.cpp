// SPDX-License-Identifier: Apache-2.0
#include "network.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>

#include "co_timer_software.h"
#include "notation.hpp"

namespace test {
namespace {

constexpr std::uint32_t baud = 250000;
constexpr unsigned patience = 100000;  // maximum number of rounds until the network is idle

// Controller of the classic drivers, which have no context argument.
co::VirtualBus::Port* plain_port = nullptr;

void plain_init() { plain_port->close(); }
void plain_enable(std::uint32_t rate) { plain_port->enable(rate); }
std::int16_t plain_read(CO_IF_FRM* frame) { return co::VirtualBusDriver.Read(plain_port, frame); }
std::int16_t plain_send(CO_IF_FRM* frame) { return plain_port->send(*frame); }
void plain_reset() { plain_port->reset(); }
void plain_close() { plain_port->close(); }

constexpr CO_IF_CAN_DRV plain_can = {plain_init, plain_enable, plain_read, plain_send, plain_reset, plain_close};

const std::uint8_t device_name[] = "device";

CO_OBJ entry(std::uint16_t index, std::uint8_t sub, std::uint32_t flags, const CO_OBJ_TYPE* type, CO_DATA data) {
  return {CO_KEY(index, sub, flags), type, data};
}

std::uint16_t length_of(const CO_OBJ* table) {
  std::uint16_t length = 0;
  while (table[length].Key != 0) {
    ++length;
  }
  return length;
}

const std::string device_prefix = "node ";

bool is_device(const co::VirtualBus::Port* port) {
  return port != nullptr && port->name().compare(0, device_prefix.size(), device_prefix) == 0;
}

}  // namespace

Line::Line(const std::string& name, co::VirtualClock& clock) : master(bus.attach({name + " master", 0})) {
  bus.set_time([&clock] { return clock.time(); });
  bus.set_trace([this](const co::VirtualBus::Traffic& traffic) { recorded_.push_back(traffic); });
  master.filter(nullptr, 0);
  master.enable(baud);
}

void Line::say(std::string_view notation) { say(frame(notation)); }

void Line::say(const CO_IF_FRM& frame) {
  if (master.send(frame) <= 0) {
    FAIL("the master cannot send");
  }
}

std::vector<co::VirtualBus::Traffic> Line::take() { return std::exchange(recorded_, {}); }

Texts Line::take_texts() {
  Texts texts;
  for (const auto& traffic : take()) {
    if (is_device(traffic.sender)) {
      texts.push_back(notation(traffic.frame));
    }
  }
  return texts;
}

void Line::stop_recording() {
  bus.set_trace({});
  recorded_.clear();
}

Device::Device(Line& line, co::VirtualClock& clock, const DeviceOptions& options)
    : port(line.bus.attach({device_prefix + std::to_string(options.node_id), 512, 10, options.filter})),
      domain_bytes(options.domain_bytes),
      timer_(clock, [this] { on_alarm(); }),
      plain_(options.plain),
      heartbeat_(options.heartbeat_ms),
      name_{0, device_name},
      domain_{0, options.domain_bytes, domain_bytes.data()} {
  build_table();
  ext_.Size = sizeof ext_;
  ext_.User = options.user;
  if (plain_) {
    REQUIRE(plain_port == nullptr);
    plain_port = &port;
    plain_drivers_ = {&plain_can, &SoftwareTimerDriver, nullptr};
    timer_.set_alarm(1);
  } else {
    ext_.Can = &co::VirtualBusDriver;
    ext_.CanCtx = &port;
    ext_.Timer = &co::VirtualTimerDriver;
    ext_.TimerCtx = &timer_;
  }
  const CO_OBJ* const table = (options.table != nullptr) ? options.table : table_.data();
  CO_NODE_SPEC spec{};
  spec.NodeId = options.node_id;
  spec.Baudrate = baud;
  spec.Dict = const_cast<CO_OBJ*>(table);
  spec.DictLen = length_of(table);
  spec.TmrFreq = clock.frequency();
  spec.Drv = plain_ ? &plain_drivers_ : nullptr;
  spec.SdoBuf = sdo_memory_.data();
  CONodeInitEx(&node, &spec, &ext_);
  REQUIRE(CONodeGetErr(&node) == CO_ERR_NONE);
  if (options.start) {
    CONodeStart(&node);
  }
}

Device::~Device() {
  CONodeStop(&node);
  if (plain_) {
    plain_port = nullptr;
  }
}

void Device::build_table() {
  add_communication();
  add_second_server();
  add_application();
  table_.push_back(CO_OBJ_DICT_ENDMARK);
}

void Device::add_communication() {
  table_ = {
      entry(0x1000, 0, CO_OBJ_D___R_, CO_TUNSIGNED32, 0),
      entry(0x1001, 0, CO_OBJ_____R_, CO_TUNSIGNED8, &error_register_),
      entry(0x1008, 0, CO_OBJ_____R_, CO_TSTRING, &name_),
      entry(0x1017, 0, CO_OBJ_____RW, CO_THB_PROD, &heartbeat_),
      entry(0x1018, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 1),
      entry(0x1018, 1, CO_OBJ_D___R_, CO_TUNSIGNED32, 0),
      entry(0x1200, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 2),
      entry(0x1200, 1, CO_OBJ_DN__R_, CO_TSDO_ID, 0x600),
      entry(0x1200, 2, CO_OBJ_DN__R_, CO_TSDO_ID, 0x580),
  };
}

void Device::add_second_server() {
#if CO_SSDO_N >= 2
  table_.push_back(entry(0x1201, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 2));
  table_.push_back(entry(0x1201, 1, CO_OBJ_____RW, CO_TSDO_ID, &sdo2_request));
  table_.push_back(entry(0x1201, 2, CO_OBJ_____RW, CO_TSDO_ID, &sdo2_response));
#endif
}

void Device::add_application() {
  table_.push_back(entry(0x2000, 0, CO_OBJ_____RW, CO_TUNSIGNED16, &value));
  table_.push_back(entry(0x2001, 0, CO_OBJ_____RW, CO_TUNSIGNED64, &long_value));
  table_.push_back(entry(0x2002, 0, CO_OBJ_____R_, CO_TUNSIGNED32, &constant));
  table_.push_back(entry(0x2010, 0, CO_OBJ_____RW, CO_TDOMAIN, &domain_));
}

// Handles the alarm. For a device with classic drivers it is the periodic timer interrupt.
void Device::on_alarm() {
  if (plain_) {
    timer_.set_alarm(1);
  }
  COTmrService(&node.Tmr);
}

bool Device::process() {
  const std::uint64_t now = timer_.clock().elapsed();
  if (port.waiting() == 0 && due_at_ > now) {
    return false;
  }
  CONodeProcess(&node);
  COTmrProcess(&node.Tmr);
  const std::uint32_t deadline = CONodeNextDeadline(&node);
  due_at_ = (deadline == UINT32_MAX) ? UINT64_MAX : now + deadline;
  return true;
}

void Device::wake() {
  due_at_ = 0;
  process();
}

World::World(std::uint32_t ticks_per_second, std::uint32_t start_tick) : clock(start_tick) {
  clock.set_frequency(ticks_per_second);
}

Line& World::add_line(const std::string& name) {
  lines_.push_back(std::make_unique<Line>(name, clock));
  return *lines_.back();
}

Device& World::add_device(Line& line, const DeviceOptions& options) {
  devices_.push_back(std::make_unique<Device>(line, clock, options));
  return *devices_.back();
}

void World::settle() {
  bool any = true;
  for (unsigned round = 0; any; ++round) {
    if (round == patience) {
      FAIL("the network does not come to rest");
    }
    for (const auto& line : lines_) {
      line->bus.poll();
    }
    any = false;
    for (const auto& device : devices_) {
      any = device->process() || any;
    }
  }
}

void World::pass(std::chrono::microseconds time) {
  const std::uint64_t end = clock.elapsed() + clock.ticks(time);
  for (const auto& device : devices_) {
    device->wake();  // A call of the test may have changed the deadline.
  }
  settle();
  while (clock.elapsed() < end) {
    clock.advance(std::min(end - clock.elapsed(), ticks_to_next_event()));
    settle();
  }
}

std::uint64_t World::ticks_to_next_event() {
  std::uint64_t ticks = UINT64_MAX;
  for (const auto& device : devices_) {
    ticks = std::min(ticks, device->due_at() - clock.elapsed());
  }
  for (const auto& line : lines_) {
    if (line->bus.next_due() != co::VirtualBus::never) {
      ticks = std::min(ticks, clock.ticks(line->bus.next_due() - clock.time()));
    }
  }
  return std::max<std::uint64_t>(ticks, 1);
}

}  // namespace test
