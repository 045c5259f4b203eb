// SPDX-License-Identifier: Apache-2.0
/// \file bus_state.hpp
/// The state of a bus as `lexican top` shows it, by the frames: nodes, values of PDOs, and a log of events. The memory
/// in use does not depend on the number of frames.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "describe/monitor.hpp"
#include "describe/plot.hpp"
#include "program/printable.hpp"

namespace lexican::program {

struct LoggedEvent {
  host_bus::Micros time = 0;
  std::uint8_t node = 0;  ///< 0: none, or all
  std::string text;
  bool is_fault = false;
};

/// Last value of an object in a PDO, and those before it.
struct WatchedValue {
  std::string name;  ///< may have control characters
  std::string text;  ///< as the name
  host_bus::Micros time = 0;
  std::vector<describe::Point> points;  ///< of the last seconds, if it is a number; time since the first frame
};

struct WatchedNode {
  static constexpr std::size_t most_values = 64;
  /// Direction (TPDO first), number, position in the PDO.
  using ValueKey = std::tuple<bool, std::uint16_t, std::size_t>;

  /// Returns true if the last message of error control is older than three of its periods.
  bool is_overdue(host_bus::Micros now) const;

  bool is_heard = false;
  std::optional<std::uint8_t> state;  ///< of the last message of error control
  host_bus::Micros state_time = 0;
  std::array<host_bus::Micros, 2> periods{};  ///< the last two times between messages of error control; 0: none
  std::string emergency;                      ///< the last one; empty: none
  host_bus::Micros emergency_time = 0;
  bool is_faulty = false;  ///< the last EMCY is not "no error"
  std::string name;        ///< of the description, or 1008h as a scan has read it
  std::map<ValueKey, WatchedValue> values;
};

/// Context: one thread.
class BusState {
 public:
  static constexpr std::size_t most_events = 1000;
  static constexpr double plotted_seconds = 10;

  /// \a network must outlive the state. \a identified: see describe::Monitor.
  BusState(const describe::Network& network, describe::Monitor::Identified identified);
  BusState(const BusState&) = delete;
  BusState& operator=(const BusState&) = delete;

  void process(const host_bus::Entry& received);
  /// Ends transfers without an answer, and measures the rate. \a now: time of the bus.
  void advance(host_bus::Micros now);
  /// Adds a line to the log that is not of a frame.
  void note(const std::string& text, bool is_fault);
  void set_name(std::uint8_t node, const std::string& name) { nodes_[node].name = one_line(name); }

  const WatchedNode& node(std::uint8_t node) const { return nodes_[node]; }
  bool is_described(std::uint8_t node) const { return network_.of(node).device() != nullptr; }
  /// Returns the node-IDs that were heard.
  std::vector<std::uint8_t> heard() const;
  const std::deque<LoggedEvent>& events() const { return events_; }
  host_bus::Micros first() const { return first_; }
  host_bus::Micros now() const { return now_; }
  double frames_per_second() const { return frames_per_second_; }
  double bits_per_second() const { return bits_per_second_; }
  std::uint64_t frames() const { return monitor_.statistics().frames; }
  std::uint64_t errors() const { return monitor_.statistics().errors; }

 private:
  /// Numbers of the frames at a time.
  struct Measured {
    host_bus::Micros time = 0;
    std::uint64_t frames = 0;
    std::uint64_t bits = 0;
  };

  void add_event(const describe::Event& event);
  void follow_state(const CO_IF_FRM& frame);
  void follow_values(const CO_IF_FRM& frame);
  void note_time(host_bus::Micros time);
  double seconds(host_bus::Micros time) const { return static_cast<double>(time - first_) / 1e6; }

  const describe::Network& network_;
  describe::Monitor monitor_;
  std::array<WatchedNode, 128> nodes_{};
  std::deque<LoggedEvent> events_;
  host_bus::Micros first_ = 0;
  host_bus::Micros now_ = 0;
  Measured measured_;
  double frames_per_second_ = 0;
  double bits_per_second_ = 0;
};

}  // namespace lexican::program
