// SPDX-License-Identifier: Apache-2.0
/// \file network.hpp
/// Simulates many devices on many virtual buses with one virtual clock, observed from the buses.
///
///     test::World world;
///     test::Line& line = world.add_line("left");
///     test::Device& five = world.add_device(line, {5});      // boots
///     line.say("000#0105");  world.settle();                 // processes all frames, without time
///     world.pass(100ms);  line.take();                       // returns the frames since the last take()
///
/// Context: one thread. Owner: the world owns lines and devices.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "co_core.h"
#include "virtual_bus.hpp"
#include "virtual_clock.hpp"

namespace test {

using Texts = std::vector<std::string>;
using Milliseconds = std::chrono::milliseconds;

/// A bus with a master port that receives nothing: all frames on the bus are recorded.
class Line {
 public:
  Line(const std::string& name, co::VirtualClock& clock);

  void say(std::string_view notation);
  void say(const CO_IF_FRM& frame);

  /// Returns the frames on the bus since the last call, with their senders and times.
  std::vector<co::VirtualBus::Traffic> take();
  /// Returns the frames sent by devices, in can-utils notation.
  Texts take_texts();
  /// Stops recording frames, for long runs.
  void stop_recording();

  co::VirtualBus bus;
  co::VirtualBus::Port& master;

 private:
  std::vector<co::VirtualBus::Traffic> recorded_;
};

struct DeviceOptions {
  std::uint8_t node_id;
  std::uint16_t heartbeat_ms = 0;
  std::uint32_t domain_bytes = 16;  ///< capacity of 2010h
  bool filter = true;               ///< the controller has receive filters
  bool plain = false;               ///< classic drivers; one device at a time
  bool start = true;                ///< false: stays in CO_INIT
  const CO_OBJ* table = nullptr;    ///< replaces the device's dictionary; ended by CO_OBJ_DICT_ENDMARK
  void* user = nullptr;             ///< CO_NODE_EXT.User
};

/// A node with its memory. Its dictionary: 1000h, 1001h, 1008h "device", 1017h, 1018h, 1200h, 1201h (not valid, rw, if
/// configured), 2000h UNSIGNED16 rw, 2001h UNSIGNED64 rw, 2002h UNSIGNED32 ro 11223344h, 2010h DOMAIN rw.
class Device {
 public:
  Device(Line& line, co::VirtualClock& clock, const DeviceOptions& options);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  /// Processes frames and timers if there are frames or the deadline of CONodeNextDeadline() has passed. Returns false
  /// if there was no work.
  bool process();
  /// Processes the device even before its deadline.
  void wake();
  /// Returns the deadline of the node in clock ticks; UINT64_MAX: none.
  std::uint64_t due_at() const { return due_at_; }
  CO_MODE mode() { return CONmtGetMode(&node.Nmt); }
  CO_NODE_COUNTERS counters() const { return CONodeGetCounters(&node); }

  co::VirtualBus::Port& port;
  CO_NODE node{};
  std::uint16_t value = 0;                   ///< 2000h
  std::uint64_t long_value = 0;              ///< 2001h
  std::uint32_t constant = 0x11223344;       ///< 2002h
  std::vector<std::uint8_t> domain_bytes;    ///< 2010h
  std::uint32_t sdo2_request = 0x80000000;   ///< 1201h:1
  std::uint32_t sdo2_response = 0x80000000;  ///< 1201h:2

 private:
  void build_table();
  void add_communication();
  void add_second_server();
  void add_application();
  void on_alarm();

  co::VirtualTimer timer_;
  bool plain_;
  std::uint64_t due_at_ = 0;
  std::uint8_t error_register_ = 0;
  std::uint16_t heartbeat_;
  CO_OBJ_STR name_;
  CO_OBJ_DOM domain_;
  std::vector<CO_OBJ> table_;
  CO_NODE_EXT ext_{};
  CO_IF_DRV plain_drivers_{};
  std::array<std::uint8_t, CO_SSDO_N * CO_SDO_BUF_BYTE> sdo_memory_{};
};

class World {
 public:
  explicit World(std::uint32_t ticks_per_second = 1000, std::uint32_t start_tick = 0);

  Line& add_line(const std::string& name);
  Device& add_device(Line& line, const DeviceOptions& options);

  /// Processes all devices until they are idle. A network that does not become idle ends the test case.
  void settle();
  /// Lets time pass; every device is processed at its deadlines (CONodeNextDeadline()).
  void pass(std::chrono::microseconds time);

  co::VirtualClock clock;

 private:
  std::uint64_t ticks_to_next_event();

  std::vector<std::unique_ptr<Line>> lines_;
  std::vector<std::unique_ptr<Device>> devices_;
};

}  // namespace test
