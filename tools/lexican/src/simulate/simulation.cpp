// SPDX-License-Identifier: Apache-2.0
#include "simulate/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulate/arguments.hpp"
#include "simulate/faults.hpp"
#include "simulate/profile.hpp"
#include "simulate/sources.hpp"

namespace lexican::simulate {
namespace {

using EntryKey = std::pair<std::uint16_t, std::uint8_t>;  // index and sub-index

constexpr Micros signal_interval = 10 * millisecond;
constexpr const char* commands =
    "set OBJECT VALUE | set OBJECT ramp FROM TO TIME | set OBJECT sine LOW HIGH TIME\n"
    "set OBJECT csv FILE [COLUMN] [repeat] | play FILE | play off | get OBJECT\n"
    "emcy CODE | emcy 0 | abort OBJECT CODE | abort OBJECT off\n"
    "wrong-length [N] | wrong-length off | wrong-toggle | wrong-toggle off | hang-sdo [TIME] | hang-sdo off\n"
    "same-id | same-id off | busoff [TIME] | busoff off | flood ID [RATE] | flood off\n"
    "drop 5% | double 5% | delay 20ms | off TIME | reboot\n"
    "node ID | after TIME COMMAND | quit";

}  // namespace

/// A device with its connection to the bus.
struct Simulation::Member {
  Member(Ground& ground, std::uint64_t seed)
      : can(ground.add_can(), seed, [&ground] { return ground.now(); }),
        timer(ground.add_timer()),
        faults(ground, can) {}

  /// Starts a device, instead of the present one.
  /// \retval text  why it cannot run; empty: it runs
  std::string start() {
    const std::string fault = device->start();
    if (fault.empty()) {
      behaviours.start(*device);
    }
    return fault;
  }
  /// Sets a value by a command.
  bool put(std::uint16_t index, std::uint8_t sub_index, const Bytes& value) {
    return behaviours.commanded(index, sub_index, value) || device->set(index, sub_index, value);
  }

  DisturbedCan can;
  Timer timer;
  Faults faults;
  std::unique_ptr<Device> device;
  Behaviours behaviours;
  Member* twin = nullptr;  ///< the device with the same node-ID
  Micros on_again = 0;     ///< time of the end of "off"; 0: it is on
};

/// A value that changes with time.
struct Simulation::Signal {
  Member* member;
  EntryKey key;
  bool is_sine;
  double low;
  double high;
  Micros begin;
  Micros time;                       ///< of the ramp, or period of the sine
  std::vector<TimedValue> values{};  ///< of a CSV; empty: a ramp or a sine
  bool is_repeated = false;          ///< the CSV
  std::size_t next = 0;              ///< position in values
};

struct Simulation::Later {
  Micros time;
  std::string line;
};

Simulation::Simulation(Ground& ground, const SimulationSetup& setup, FindObject find)
    : ground_(ground), setup_(setup), find_(std::move(find)) {
  for (unsigned n = 0; n < setup.count; ++n) {
    const bool has_id = setup.node_id != no_node_id;
    DeviceSetup of_device;
    of_device.node_id = has_id ? static_cast<std::uint8_t>(setup.node_id + n) : no_node_id;
    of_device.serial = setup.serial != 0 ? setup.serial + n : n;
    of_device.storage = setup.storage.empty() || n == 0 ? setup.storage : fmt::format("{}.{}", setup.storage, n + 1);
    make_device(add_member(), of_device);
  }
}

Simulation::Member& Simulation::add_member() {
  members_.push_back(std::make_unique<Member>(ground_, setup_.seed + members_.size()));
  return *members_.back();
}

void Simulation::make_device(Member& member, DeviceSetup setup) {
  setup.can = member.can.can();
  setup.timer = member.timer;
  member.device = std::make_unique<Device>(setup_.description, setup_.file, setup);
  member.faults.start(*member.device);
}

Simulation::~Simulation() = default;

Device& Simulation::device(std::size_t n) { return *members_[n]->device; }

std::string Simulation::start() {
  for (const std::unique_ptr<Member>& member : members_) {
    const std::string fault = member->start();
    if (!fault.empty()) {
      return fault;
    }
  }
  return {};
}

Micros Simulation::process() {
  const Micros now = ground_.now();
  run_later(now);
  const Micros until_line = run_played(now);
  switch_on(now);
  for (const std::unique_ptr<Member>& member : members_) {
    member->can.process();
  }
  if (!signals_.empty() && now - updated_ >= signal_interval) {
    update_signals(now);
    updated_ = now;
  }
  Micros wait = std::min(until_line, signals_.empty() ? second : signal_interval);
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
    note(execute(line, ignored));
  }
}

/// Executes the lines of the playback whose time has come.
/// \retval time until it has to be called again
Micros Simulation::run_played(Micros now) {
  constexpr int at_most = 100;  // so that the devices continue
  for (int n = 0; playback_ != nullptr && n < at_most; ++n) {
    const std::optional<PlayedLine> line = playback_->next(now);
    if (!line) {
      const Micros due = playback_->due(now);
      if (playback_->has_ended()) {
        playback_.reset();
        return for_ever;
      }
      return due > now ? due - now : 0;
    }
    const std::string text = execute_played(*line);
    note(text.empty() ? text : line->place + ": " + text);
  }
  return playback_ != nullptr ? 0 : for_ever;
}

std::string Simulation::execute_played(const PlayedLine& line) {
  if (!line.fault.empty()) {
    return line.fault;
  }
  const std::size_t chosen = chosen_;
  if (line.node && !choose(std::to_string(*line.node))) {
    return fmt::format("no device has the node-ID {}", *line.node);
  }
  std::string text;
  for (const auto& [object, value] : line.values) {
    const std::string fault = set(*members_[chosen_], {"set", object, value}, true);
    text += !text.empty() && !fault.empty() ? '\n' + fault : fault;
  }
  bool ignored = false;
  const std::string answer = line.command.empty() ? "" : execute(line.command, ignored);
  chosen_ = line.node ? chosen : chosen_;
  return text + (!text.empty() && !answer.empty() ? "\n" : "") + answer;
}

bool Simulation::choose(const std::string& node) {
  for (std::size_t n = 0; n < members_.size(); ++n) {
    if (std::to_string(members_[n]->device->node().stack().NodeId) == node) {
      chosen_ = n;
      return true;
    }
  }
  return false;
}

void Simulation::note(const std::string& text) {
  if (!text.empty() && note_) {
    note_(text);
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

/// Returns the value of a ramp or a sine.
double Simulation::level_of(const Signal& signal, Micros now) {
  const double part = static_cast<double>(now - signal.begin) / static_cast<double>(signal.time);
  constexpr double circle = 6.283185307179586;
  const double middle = (signal.low + signal.high) / 2;
  return signal.is_sine ? middle + (signal.high - middle) * std::sin(circle * part)
                        : signal.low + (signal.high - signal.low) * std::min(part, 1.0);
}

/// Advances a CSV.
/// \retval text  the value whose time has come; empty: that of the last call continues
std::string Simulation::next_of(Signal& signal, Micros now) {
  const std::vector<TimedValue>& values = signal.values;
  const Micros period = values.back().time - values.front().time;
  while (signal.is_repeated && signal.begin + values.back().time <= now) {  // the last row is the end
    signal.begin += period * std::max<Micros>((now - signal.begin - values.back().time) / period, 1);
    signal.next = 0;
  }
  const std::size_t before = signal.next;
  while (signal.next < values.size() && signal.begin + values[signal.next].time <= now) {
    ++signal.next;
  }
  return signal.next != before ? values[signal.next - 1].text : "";
}

void Simulation::update_signals(Micros now) {
  for (std::size_t n = 0; n < signals_.size();) {
    Signal& signal = signals_[n];
    const bool is_csv = !signal.values.empty();
    Device& device = *signal.member->device;
    const std::optional<ValueType> type = device.description().type_of(signal.key.first, signal.key.second);
    const bool is_real = type && type->kind == ValueType::Kind::real;
    const double level = is_csv ? 0 : level_of(signal, now);
    const std::string text = is_csv    ? next_of(signal, now)
                             : is_real ? fmt::format("{}", level)
                                       : fmt::format("{}", std::llround(level));
    const Encoded encoded = type && !text.empty() ? encode_rounded(*type, text) : Encoded{{}, "no value"};
    if (encoded.fault.empty() && device.get(signal.key.first, signal.key.second) != encoded.bytes) {
      signal.member->put(signal.key.first, signal.key.second, encoded.bytes);
    }
    const bool has_ended =
        is_csv ? signal.next == signal.values.size() : !signal.is_sine && now - signal.begin >= signal.time;
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
    return set(member, words, false);
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
  if (verb == "same-id") {
    return double_node_id(member, words);
  }
  if (verb == "play" && words.size() == 2) {
    return play(first);
  }
  if (Faults::has(verb)) {
    return member.faults.execute(words);
  }
  if (verb == "reboot" && words.size() == 1) {
    device.power_cycle();
    return {};
  }
  if (verb == "node" && words.size() == 2) {
    return choose(first) ? "" : "no device has the node-ID " + first;
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

/// Starts a second device with the node-ID of another one, or switches it off.
std::string Simulation::double_node_id(Member& member, const std::vector<std::string>& words) {
  const bool is_end = words.size() == 2 && words[1] == "off";
  if (words.size() > 1 && !is_end) {
    return "same-id needs: nothing, or off";
  }
  if (is_end) {
    if (member.twin != nullptr) {
      member.twin->can.is_off = true;
    }
    return {};
  }
  DeviceSetup setup;
  setup.node_id = member.device->node().stack().NodeId;
  if (setup.node_id == no_node_id) {
    return "same-id needs: a device with a node-ID; give it one by LSS first";
  }
  const std::optional<Bytes> serial = member.device->get(0x1018, 4);
  setup.serial = static_cast<std::uint32_t>((serial ? number_of(*serial) : 0) + setup_.count);  // not that of another
  if (member.twin == nullptr) {
    member.twin = &add_member();
  }
  member.twin->can.is_off = false;
  make_device(*member.twin, setup);
  return member.twin->start();
}

/// Executes play.
std::string Simulation::play(const std::string& file) {
  auto playback = file != "off" ? std::make_unique<Playback>(file, ground_.now()) : nullptr;
  std::string why;
  if (playback != nullptr && !playback->open(why)) {
    return why;
  }
  playback_ = std::move(playback);
  return {};
}

/// Executes set OBJECT csv FILE [COLUMN] [repeat].
std::string Simulation::set_csv(Signal signal, ValueType type, std::vector<std::string> words) {
  signal.is_repeated = words.size() > 4 && words.back() == "repeat";
  if (signal.is_repeated) {
    words.pop_back();
  }
  if (words.size() < 4 || words.size() > 5) {
    return "set OBJECT csv needs a file, a column and repeat, such as set 606C csv speed.csv velocity repeat";
  }
  std::string why;
  signal.values = read_csv(words[3], words.size() == 5 ? words[4] : "", type, why);
  if (!why.empty()) {
    return why;
  }
  if (signal.is_repeated && signal.values.back().time - signal.values.front().time < signal_interval) {
    return words[3] + " cannot be repeated: it lasts less than 10 ms";
  }
  signals_.push_back(std::move(signal));
  return {};
}

/// \a is_played: the third word is a value, which may be rounded
std::string Simulation::set(Member& member, const std::vector<std::string>& words, bool is_played) {
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
  const bool is_csv = !is_played && words.size() > 3 && words[2] == "csv";
  const bool is_signal = !is_played && (words[2] == "ramp" || words[2] == "sine");
  signals_.erase(std::remove_if(signals_.begin(), signals_.end(),
                                [&](const Signal& signal) { return signal.member == &member && signal.key == key; }),
                 signals_.end());
  const std::optional<ValueType> type = description.type_of(index, sub_index);
  if (is_csv && type) {
    return set_csv({&member, key, false, 0, 0, ground_.now(), 0}, *type, words);
  }
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
  Encoded encoded{{}, "it needs one value"};
  if (type && words.size() == 3) {
    encoded = is_played ? encode_rounded(*type, words[2]) : encode(*type, words[2]);
  }
  if (!encoded.fault.empty()) {
    return object + ": " + encoded.fault;
  }
  return member.put(index, sub_index, encoded.bytes) ? "" : object + " is a constant of the device";
}

}  // namespace lexican::simulate
