// SPDX-License-Identifier: Apache-2.0
#include "simulate/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "simulate/profile.hpp"
#include "text/number.hpp"

namespace lexican::simulate {
namespace {

using EntryKey = std::pair<std::uint16_t, std::uint8_t>;  // index and sub-index

constexpr Micros signal_interval = 10 * millisecond;
constexpr const char* commands =
    "set OBJECT VALUE | set OBJECT ramp FROM TO TIME | set OBJECT sine LOW HIGH TIME | get OBJECT\n"
    "emcy CODE | emcy 0 | abort OBJECT CODE | abort OBJECT off\n"
    "drop 5% | double 5% | delay 20ms | off TIME | reboot\n"
    "node ID | after TIME COMMAND | quit";

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::string word;
  bool is_quoted = false;
  bool has_word = false;
  for (const char c : line) {
    if (c == '"') {
      is_quoted = !is_quoted;
      has_word = true;
    } else if (!is_quoted && (c == ' ' || c == '\t' || c == '\r')) {
      if (has_word) {
        words.push_back(word);
      }
      word.clear();
      has_word = false;
    } else {
      word += c;
      has_word = true;
    }
  }
  if (has_word) {
    words.push_back(word);
  }
  return words;
}

/// Parses a real number that is the whole text, or all but a unit.
std::optional<double> real_in(std::string_view text, std::string_view& unit) {
  double number = 0;
  const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  unit = std::string_view(next, static_cast<std::size_t>(text.data() + text.size() - next));
  return error == std::errc() && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

/// Parses 3s, 500ms, 2min.
std::optional<Micros> time_in(std::string_view text) {
  std::string_view unit;
  const std::optional<double> number = real_in(text, unit);
  const double factor = unit == "ms" ? 1e3 : unit == "s" ? 1e6 : unit == "min" ? 60e6 : 0;
  const bool is_time = number && factor != 0 && *number >= 0 && *number * factor < 1e15;
  return is_time ? std::optional(static_cast<Micros>(*number * factor)) : std::nullopt;
}

/// Parses 5%.
std::optional<double> part_in(std::string_view text) {
  std::string_view unit;
  const std::optional<double> number = real_in(text, unit);
  return number && unit == "%" && *number >= 0 && *number <= 100 ? std::optional(*number / 100) : std::nullopt;
}

std::optional<std::uint32_t> hex_in(std::string_view text) {
  std::uint64_t number = 0;
  if (text.substr(0, 2) == "0x") {
    text.remove_prefix(2);
  } else if (!text.empty() && text.back() == 'h') {
    text.remove_suffix(1);
  }
  return codict::parse_hex(text, number) && number <= UINT32_MAX ? std::optional(static_cast<std::uint32_t>(number))
                                                                 : std::nullopt;
}

}  // namespace

/// A device with its connection to the bus.
struct Simulation::Member {
  Member(Ground& ground, std::uint64_t seed) : can(ground.add_can(), seed, [&ground] { return ground.now(); }) {}

  /// Sets a value by a command.
  bool put(std::uint16_t index, std::uint8_t sub_index, const Bytes& value) {
    return behaviours.commanded(index, sub_index, value) || device->set(index, sub_index, value);
  }

  DisturbedCan can;
  std::unique_ptr<Device> device;
  Behaviours behaviours;
  Micros on_again = 0;  ///< time of the end of "off"; 0: it is on
};

/// A value that changes with time.
struct Simulation::Signal {
  Member* member;
  EntryKey key;
  bool is_sine;
  double low;
  double high;
  Micros begin;
  Micros time;  ///< of the ramp, or period of the sine
};

struct Simulation::Later {
  Micros time;
  std::string line;
};

Simulation::Simulation(Ground& ground, const SimulationSetup& setup, FindObject find)
    : ground_(ground), find_(std::move(find)) {
  for (unsigned n = 0; n < setup.count; ++n) {
    members_.push_back(std::make_unique<Member>(ground, setup.seed + n));
    Member& member = *members_.back();
    const bool has_id = setup.node_id != no_node_id;
    DeviceSetup of_device;
    of_device.node_id = has_id ? static_cast<std::uint8_t>(setup.node_id + n) : no_node_id;
    of_device.serial = setup.serial != 0 ? setup.serial + n : n;
    of_device.storage = setup.storage.empty() || n == 0 ? setup.storage : fmt::format("{}.{}", setup.storage, n + 1);
    of_device.can = member.can.can();
    of_device.timer = ground.add_timer();
    member.device = std::make_unique<Device>(setup.description, setup.file, of_device);
  }
}

Simulation::~Simulation() = default;

Device& Simulation::device(std::size_t n) { return *members_[n]->device; }

std::string Simulation::start() {
  for (const std::unique_ptr<Member>& member : members_) {
    const std::string fault = member->device->start();
    if (!fault.empty()) {
      return fault;
    }
    member->behaviours.start(*member->device);
  }
  return {};
}

Micros Simulation::process() {
  const Micros now = ground_.now();
  run_later(now);
  switch_on(now);
  for (const std::unique_ptr<Member>& member : members_) {
    member->can.process();
  }
  if (!signals_.empty() && now - updated_ >= signal_interval) {
    update_signals(now);
    updated_ = now;
  }
  Micros wait = signals_.empty() ? second : signal_interval;
  bool has_changed = false;
  for (const std::unique_ptr<Member>& member : members_) {
    has_changed = member->device->node().process() || has_changed;
    wait = std::min(wait, member->behaviours.process(now));
  }
  for (const std::unique_ptr<Member>& member : members_) {
    const Micros due = member->can.due();
    wait = std::min({wait, member->device->node().due_in(), due > now ? due - now : 0});
    wait = member->on_again != 0 ? std::min(wait, member->on_again > now ? member->on_again - now : 0) : wait;
  }
  for (const Later& later : later_) {
    wait = std::min(wait, later.time > now ? later.time - now : 0);
  }
  return has_changed ? 0 : wait;
}

void Simulation::run_later(Micros now) {
  for (std::size_t n = 0; n < later_.size();) {
    if (later_[n].time > now) {
      ++n;
      continue;
    }
    const std::string line = later_[n].line;
    later_.erase(later_.begin() + static_cast<std::ptrdiff_t>(n));
    bool ignored = false;
    execute(line, ignored);
  }
}

void Simulation::switch_on(Micros now) {
  for (const std::unique_ptr<Member>& member : members_) {
    if (member->on_again != 0 && member->on_again <= now) {
      member->on_again = 0;
      member->can.is_off = false;
      member->device->power_cycle();
    }
  }
}

void Simulation::update_signals(Micros now) {
  for (std::size_t n = 0; n < signals_.size();) {
    const Signal signal = signals_[n];
    const double part = static_cast<double>(now - signal.begin) / static_cast<double>(signal.time);
    constexpr double circle = 6.283185307179586;
    const double middle = (signal.low + signal.high) / 2;
    const bool has_ended = !signal.is_sine && part >= 1;
    const double value = signal.is_sine ? middle + (signal.high - middle) * std::sin(circle * part)
                                        : signal.low + (signal.high - signal.low) * std::min(part, 1.0);
    Device& device = *signal.member->device;
    const std::optional<ValueType> type = device.description().type_of(signal.key.first, signal.key.second);
    const bool is_real = type && type->kind == ValueType::Kind::real;
    const Encoded encoded =
        type ? encode(*type, is_real ? fmt::format("{}", value) : fmt::format("{}", std::llround(value))) : Encoded{};
    if (encoded.fault.empty() && device.get(signal.key.first, signal.key.second) != encoded.bytes) {
      signal.member->put(signal.key.first, signal.key.second, encoded.bytes);
    }
    if (has_ended) {
      signals_.erase(signals_.begin() + static_cast<std::ptrdiff_t>(n));
    } else {
      ++n;
    }
  }
}

std::string Simulation::execute(const std::string& line, bool& is_fault) {
  const std::vector<std::string> words = words_of(line);
  is_fault = false;
  if (words.empty() || words.front().front() == '#') {
    return {};
  }
  if (words.front() == "help") {
    return commands;
  }
  if (words.front() == "quit" || words.front() == "exit") {
    has_ended_ = true;
    return {};
  }
  const std::string text = execute_words(*members_[chosen_], words);
  is_fault = !text.empty() && words.front() != "get";
  return text;
}

std::string Simulation::execute_words(Member& member, const std::vector<std::string>& words) {
  const std::string& verb = words.front();
  Device& device = *member.device;
  const auto wrong = [&](const char* usage) { return fmt::format("{} needs: {}", verb, usage); };
  const std::string first = words.size() > 1 ? words[1] : "";
  if (verb == "set" && words.size() >= 3) {
    return set(member, words);
  }
  if (verb == "get" && words.size() == 2) {
    std::uint16_t index = 0;
    std::uint8_t sub_index = 0;
    std::string why;
    if (!find_(first, device.description(), index, sub_index, why)) {
      return why;
    }
    const std::optional<Bytes> value = device.get(index, sub_index);
    return device.description().object(index, sub_index) + " = " +
           (value ? device.description().show(index, sub_index, *value) : "no number") +
           member.behaviours.terminals(index, sub_index);
  }
  if (verb == "emcy") {
    const std::optional<std::uint32_t> code = hex_in(first);
    if (words.size() != 2 || !code || *code > 0xFFFF) {
      return wrong("emcy 4310, or emcy 0 when the error has gone");
    }
    *code == 0 ? device.clear() : device.raise(static_cast<std::uint16_t>(*code));
    member.behaviours.raised(static_cast<std::uint16_t>(*code));
    return {};
  }
  if (verb == "abort" && words.size() == 3) {
    std::uint16_t index = 0;
    std::uint8_t sub_index = 0;
    std::string why;
    const std::optional<std::uint32_t> code = words[2] == "off" ? std::optional(std::uint32_t{0}) : hex_in(words[2]);
    if (!find_(first, device.description(), index, sub_index, why)) {
      return why;
    }
    if (!code) {
      return wrong("abort OBJECT 08000022, or abort OBJECT off");
    }
    return device.dictionary().refuse(index, sub_index, *code)
               ? ""
               : device.description().object(index, sub_index) + " cannot be refused: the stack itself implements it";
  }
  if ((verb == "drop" || verb == "double") && words.size() == 2) {
    const std::optional<double> part = part_in(first);
    if (!part) {
      return wrong("a part of the frames, such as 5%");
    }
    (verb == "drop" ? member.can.drop : member.can.repeat) = *part;
    return {};
  }
  if ((verb == "delay" || verb == "off") && words.size() == 2) {
    const std::optional<Micros> time = time_in(first);
    if (!time) {
      return wrong("a time, such as 20ms or 3s");
    }
    if (verb == "delay") {
      member.can.delay = *time;
    } else {
      member.can.is_off = true;
      member.on_again = ground_.now() + std::max(*time, Micros{1});
    }
    return {};
  }
  if (verb == "reboot" && words.size() == 1) {
    device.power_cycle();
    return {};
  }
  if (verb == "node" && words.size() == 2) {
    for (std::size_t n = 0; n < members_.size(); ++n) {
      if (std::to_string(members_[n]->device->node().stack().NodeId) == first) {
        chosen_ = n;
        return {};
      }
    }
    return "no device has the node-ID " + first;
  }
  if (verb == "after" && words.size() >= 3) {
    const std::optional<Micros> time = time_in(first);
    if (!time) {
      return wrong("a time and a command, such as after 3s emcy 4310");
    }
    std::string line;
    for (std::size_t n = 2; n < words.size(); ++n) {
      line += (n == 2 ? "\"" : " \"") + words[n] + '"';
    }
    later_.push_back({ground_.now() + *time, line});
    return {};
  }
  return fmt::format("unknown command, or wrong arguments: {}\n{}", verb, commands);
}

std::string Simulation::set(Member& member, const std::vector<std::string>& words) {
  Device& device = *member.device;
  const describe::Description& description = device.description();
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  std::string why;
  if (!find_(words[1], description, index, sub_index, why)) {
    return why;
  }
  const EntryKey key{index, sub_index};
  const std::string object = description.object(index, sub_index);
  const bool is_signal = words[2] == "ramp" || words[2] == "sine";
  signals_.erase(std::remove_if(signals_.begin(), signals_.end(),
                                [&](const Signal& signal) { return signal.member == &member && signal.key == key; }),
                 signals_.end());
  const std::optional<ValueType> type = description.type_of(index, sub_index);
  if (is_signal) {
    std::string_view rest;
    const std::optional<double> low = words.size() == 6 ? real_in(words[3], rest) : std::nullopt;
    const std::optional<double> high = low && rest.empty() ? real_in(words[4], rest) : std::nullopt;
    const std::optional<Micros> time = high && rest.empty() ? time_in(words[5]) : std::nullopt;
    if (!time || *time == 0) {
      return fmt::format("set OBJECT {0} needs two numbers and a time, such as set 606C {0} 0 2000 5s", words[2]);
    }
    const bool is_number = type && type->kind != ValueType::Kind::text && type->kind != ValueType::Kind::bytes &&
                           device.get(index, sub_index);
    if (!is_number) {
      return object + " is no number of the device";
    }
    signals_.push_back({&member, key, words[2] == "sine", *low, *high, ground_.now(), *time});
    return {};
  }
  const Encoded encoded = type && words.size() == 3 ? encode(*type, words[2]) : Encoded{{}, "it needs one value"};
  if (!encoded.fault.empty()) {
    return object + ": " + encoded.fault;
  }
  return member.put(index, sub_index, encoded.bytes) ? "" : object + " is a constant of the device";
}

}  // namespace lexican::simulate
