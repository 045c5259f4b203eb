// SPDX-License-Identifier: Apache-2.0
#include "program/bus_state.hpp"

#include <algorithm>

#include "program/printable.hpp"

namespace lexican::program {
namespace {

using host_bus::Micros;

constexpr Micros measuring_time = 1'000'000;
constexpr std::uint64_t overdue_periods = 3;
constexpr std::size_t most_curve_points = 100;  // of a plot

/// Returns the node that has sent a frame by the predefined connection set; 0: none. [301:7.3.5]
std::uint8_t sender_of(const CO_IF_FRM& frame) {
  const bool is_data = (frame.Identifier & (CO_IF_FRM_EXT | CO_IF_FRM_RTR | CO_IF_FRM_ERROR)) == 0;
  switch (is_data ? frame.Identifier & 0x780U : 0U) {
    case 0x080:  // EMCY; 080h itself is SYNC
    case 0x180:
    case 0x280:
    case 0x380:
    case 0x480:
    case 0x580:  // SDO response
    case 0x700: return static_cast<std::uint8_t>(frame.Identifier & 0x7FU);
    default: return 0;
  }
}

}  // namespace

bool WatchedNode::is_overdue(Micros now) const {
  const Micros period = std::max(periods[0], periods[1]);
  return period != 0 && now > state_time && now - state_time > overdue_periods * period;
}

BusState::BusState(const describe::Network& network, describe::Monitor::Identified identified)
    : network_(network),
      monitor_(
          network, [this](const describe::Event& event) { add_event(event); }, std::move(identified)) {}

void BusState::process(const host_bus::Entry& received) {
  host_bus::Entry entry = received;
  entry.frame.DLC = std::min<std::uint8_t>(entry.frame.DLC, 8);
  note_time(entry.time);
  monitor_.process(entry);
  const CO_IF_FRM& frame = entry.frame;
  if (const std::uint8_t sender = sender_of(frame); sender != 0) {
    nodes_[sender].is_heard = true;
  }
  follow_state(frame);
  follow_values(frame);
}

/// The time of a log can go back; ages are then 0.
void BusState::note_time(Micros time) {
  if (first_ == 0) {
    first_ = time;
    measured_.time = time;
  }
  now_ = std::max(now_, time);
  if (now_ - measured_.time < measuring_time) {
    return;
  }
  const describe::Statistics& numbers = monitor_.statistics();
  const double passed = static_cast<double>(now_ - measured_.time) / 1e6;
  frames_per_second_ = static_cast<double>(numbers.frames - measured_.frames) / passed;
  bits_per_second_ = static_cast<double>(numbers.bits - measured_.bits) / passed;
  measured_ = {now_, numbers.frames, numbers.bits};
}

void BusState::advance(Micros now) {
  note_time(now);
  monitor_.expire(now);
}

void BusState::note(const std::string& text, bool is_fault) {
  events_.push_back({now_, 0, one_line(text), is_fault});
  if (events_.size() > most_events) {
    events_.pop_front();
  }
}

/// Adds an event to the log. PDOs are left out: their values are shown, and would hide the other events.
void BusState::add_event(const describe::Event& event) {
  using describe::Service;
  if (event.service == Service::emcy && event.node != 0) {
    constexpr std::string_view prefix = "EMCY ";
    WatchedNode& node = nodes_[event.node];
    const bool has_prefix = event.text.compare(0, prefix.size(), prefix) == 0;
    node.emergency = one_line(event.text.substr(has_prefix ? prefix.size() : 0));
    node.emergency_time = event.time;
    node.is_faulty = event.is_fault;
  }
  if (event.is_repeated || event.service == Service::pdo) {
    return;
  }
  events_.push_back({event.time, event.node, one_line(event.text), event.is_fault});
  if (events_.size() > most_events) {
    events_.pop_front();
  }
}

void BusState::follow_state(const CO_IF_FRM& frame) {
  if (sender_of(frame) == 0 || (frame.Identifier & 0x780U) != 0x700 || frame.DLC != 1) {
    return;
  }
  WatchedNode& node = nodes_[sender_of(frame)];
  const auto state = static_cast<std::uint8_t>(frame.Data[0] & 0x7FU);
  const bool is_boot_up = state == 0;
  const bool has_before = node.state.has_value() && *node.state != 0 && now_ > node.state_time;
  node.periods = is_boot_up ? std::array<Micros, 2>{}
                            : std::array<Micros, 2>{has_before ? now_ - node.state_time : 0, node.periods[0]};
  node.state = state;
  node.state_time = now_;
}

/// A value is a point of the plot at most once in a column; memory and effort do not depend on the rate of the PDO.
void BusState::follow_values(const CO_IF_FRM& frame) {
  const std::optional<describe::PdoContent> content = monitor_.values_of(frame);
  if (!content || content->node == 0 || content->node > 127) {
    return;
  }
  WatchedNode& node = nodes_[content->node];
  node.is_heard = node.is_heard || content->is_transmit;
  const double time = seconds(now_);
  for (std::size_t n = 0; n < content->values.size(); ++n) {
    const WatchedNode::ValueKey key{!content->is_transmit, content->number, n};
    if (node.values.size() >= WatchedNode::most_values && node.values.find(key) == node.values.end()) {
      return;
    }
    const describe::PdoValue& value = content->values[n];
    WatchedValue& watched = node.values[key];
    if (watched.name != value.name) {  // the mapping has changed
      watched = {};
      watched.name = value.name;
    }
    watched.text = value.text;
    watched.time = now_;
    std::vector<describe::Point>& points = watched.points;
    if (!value.number) {
      continue;
    }
    constexpr double interval = plotted_seconds / most_curve_points;
    if (points.size() >= 2 && time - points[points.size() - 2].time < interval) {
      points.back() = {time, *value.number};
      continue;
    }
    const auto begin = std::find_if(points.begin(), points.end(),
                                    [&](const describe::Point& point) { return point.time > time - plotted_seconds; });
    points.erase(points.begin(), begin);
    points.push_back({time, *value.number});
  }
}

std::vector<std::uint8_t> BusState::heard() const {
  std::vector<std::uint8_t> result;
  for (std::uint8_t node = 1; node < 128; ++node) {
    if (nodes_[node].is_heard) {
      result.push_back(node);
    }
  }
  return result;
}

}  // namespace lexican::program
