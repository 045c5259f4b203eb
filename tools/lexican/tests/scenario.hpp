// SPDX-License-Identifier: Apache-2.0
/// \file scenario.hpp
/// Logs made from simulated devices and a master in virtual time, by a text. A text has sections, each for one log:
///
///     == NAME: CAUSE CAUSE ...      the causes that `lexican why` has to name; none: the log is good
///     devices FILE NODE [COUNT]     simulated devices of a description of tests/fixtures; NODE can be none
///     knows nothing                 `why` has no descriptions; default: those of the devices
///     rate RATE                     bit rate that `why` is told; default 0: none. The bus has 500 kbit/s
///     sim NODE COMMAND              a command of `lexican sim` for the device with this node-ID, or none
///     nmt start|stop|preop|reset|reset-comm NODE|all
///     read NODE OBJECT              object in hexadecimal digits: 1018:4; objects above 28 bytes by block transfer
///     write NODE OBJECT BYTES       the bytes as on the bus, such as C80005
///     send FRAME                    a frame in the notation of candump; an error frame is only recorded
///     every TIME [COUNT] send|nmt|sim …   repeats in the background, COUNT times if it is given
///     stop                          ends all repetitions
///     repeat COUNT TIME COMMAND     repeats any command, with this time after each
///     wait TIME                     times: 5ms, 2s
///
/// Lines with # are comments.
#pragma once

#include <cstdlib>
#include <sstream>

#include "simulated_devices.hpp"

namespace lexican {

class Scenario {
 public:
  struct Section {
    std::string name;
    std::vector<std::string> causes;
    std::vector<std::string> lines;
  };

  static std::vector<Section> sections_of(const std::string& path) {
    std::istringstream text(bytes_of_file(path));
    std::vector<Section> sections;
    for (std::string line; std::getline(text, line);) {
      line.erase(std::min(line.find('#') == 0 ? 0 : line.size(), line.size()));
      const std::vector<std::string> words = words_of(line);
      if (words.empty()) {
        continue;
      }
      if (words.front() != "==") {
        REQUIRE_MESSAGE(!sections.empty(), path << ": a section begins with ==");
        sections.back().lines.push_back(line);
        continue;
      }
      const std::string name = words.at(1).substr(0, words[1].find(':'));
      sections.push_back({name, {words.begin() + 2, words.end()}, {}});
    }
    return sections;
  }

  explicit Scenario(const Section& section) : name_(section.name) {
    network_.bus().set_trace([this](const co::VirtualBus::Traffic& traffic) {
      if (!traffic.dropped) {
        frames.push_back({static_cast<Micros>(traffic.time.count()) + epoch, traffic.frame});
      }
    });
    co::VirtualBus::Rule no_boot_up{co::VirtualBus::Fault::drop};
    no_boot_up.match = [](const co::VirtualBus::Traffic& traffic) {
      return traffic.sender != nullptr && traffic.sender->name() == "adapter" && traffic.frame.Identifier >= 0x700;
    };
    no_boot_up.times = co::VirtualBus::always;
    network_.bus().add_rule(no_boot_up);
    network_.run([this] { return repeat_due(); });
    for (const std::string& line : section.lines) {
      CAPTURE(name_);
      CAPTURE(line);
      execute(words_of(line));
    }
    if (const char* const directory = std::getenv("LEXICAN_LOGS")) {  // to look at them
      write_log(std::string(directory) + '/' + name_ + ".log");
    }
  }

  void write_log(const std::string& path) const {
    std::ofstream file(path, std::ios::binary);
    const auto log = host_bus::write_log(file, path, "can0");
    for (const host_bus::Entry& frame : frames) {
      log->write(frame);
    }
  }

  static constexpr Micros epoch = 1'700'000'000 * second;
  std::vector<host_bus::Entry> frames;
  describe::Network described;
  std::uint32_t rate = 0;

 private:
  using Words = std::vector<std::string>;

  struct Devices {
    std::unique_ptr<simulate::Simulation> simulation;
    unsigned node;
    unsigned count;
  };
  struct Repetition {
    Micros due;
    Micros interval;
    std::uint64_t left;
    Words words;
  };

  static Words words_of(const std::string& line) {
    std::istringstream text(line);
    Words words;
    for (std::string word; text >> word;) {
      words.push_back(word);
    }
    return words;
  }
  static std::string joined(const Words& words, std::size_t first) {
    std::string text;
    for (std::size_t n = first; n < words.size(); ++n) {
      text += (n == first ? "" : " ") + words[n];
    }
    return text;
  }
  static Words from(const Words& words, std::size_t first) {
    return {words.begin() + static_cast<std::ptrdiff_t>(first), words.end()};
  }
  static Micros time_of(const std::string& text) {
    std::size_t end = 0;
    const double number = std::stod(text, &end);
    const std::string unit = text.substr(end);
    REQUIRE_MESSAGE((unit == "ms" || unit == "s" || unit == "us"), text << " is no time");
    return static_cast<Micros>(number * (unit == "s" ? 1e6 : unit == "ms" ? 1e3 : 1));
  }
  static std::uint8_t node_of(const std::string& text) {
    return text == "none"  ? std::uint8_t{255}
           : text == "all" ? std::uint8_t{0}
                           : static_cast<std::uint8_t>(std::stoul(text));
  }

  void execute(const Words& words) {
    const std::string& verb = words.at(0);
    if (verb == "devices") {
      add_devices(words);
    } else if (verb == "knows") {
      described = {};
      knows_nothing_ = true;
    } else if (verb == "rate") {
      rate = static_cast<std::uint32_t>(std::stoul(words.at(1))) * (words[1].back() == 'k' ? 1000U : 1U);
    } else if (verb == "wait") {
      pass(time_of(words.at(1)));
    } else if (verb == "every") {
      const bool has_count = words.at(2).find_first_not_of("0123456789") == std::string::npos;
      const Micros interval = time_of(words[1]);
      repetitions_.push_back({network_.now() + interval, interval, has_count ? std::stoul(words[2]) : UINT64_MAX,
                              from(words, has_count ? 3 : 2)});
    } else if (verb == "repeat") {
      for (unsigned long n = std::stoul(words.at(1)); n > 0; --n) {
        execute(from(words, 3));
        pass(time_of(words.at(2)));
      }
    } else if (verb == "stop") {
      repetitions_.clear();
    } else if (verb == "read" || verb == "write") {
      transfer(words);
    } else {
      act(words);
    }
  }

  /// Commands that take no time.
  void act(const Words& words) {
    const std::string& verb = words.at(0);
    if (verb == "send") {
      CO_IF_FRM frame{};
      REQUIRE_MESSAGE(host_bus::parse_frame(words.at(1), frame) == host_bus::Parsed::frame, words[1]);
      if ((frame.Identifier & CO_IF_FRM_ERROR) != 0) {
        frames.push_back({network_.now() + epoch, frame});
      } else {
        port_of(frame).send(frame);
      }
    } else if (verb == "nmt") {
      const std::map<std::string, std::uint8_t> commands = {
          {"start", 0x01}, {"stop", 0x02}, {"preop", 0x80}, {"reset", 0x81}, {"reset-comm", 0x82}};
      CO_IF_FRM frame{};
      frame.DLC = 2;
      frame.Data[0] = commands.at(words.at(1));
      frame.Data[1] = node_of(words.at(2));
      port_of(frame).send(frame);
    } else if (verb == "sim") {
      const unsigned node = node_of(words.at(1));
      for (const Devices& devices : devices_) {
        if (node == devices.node || (node >= devices.node && node < devices.node + devices.count)) {
          bool is_fault = false;
          if (devices.count > 1) {
            devices.simulation->execute("node " + words[1], is_fault);
          }
          const std::string answer = devices.simulation->execute(joined(words, 2), is_fault);
          REQUIRE_MESSAGE(!is_fault, answer);
          return;
        }
      }
      FAIL("no device " << words[1]);
    } else {
      FAIL("unknown command " << verb);
    }
  }

  /// A port for each identifier: a frame does not wait for one of lower priority.
  co::VirtualBus::Port& port_of(const CO_IF_FRM& frame) {
    co::VirtualBus::Port*& port = ports_[frame.Identifier];
    if (port == nullptr) {
      port = &network_.bus().attach({"master", 16, 4096, true});
      port->enable();
      port->filter(nullptr, 0);
    }
    return *port;
  }

  void add_devices(const Words& words) {
    const std::string path = LEXICAN_TOOL_DIR "/tests/fixtures/" + words.at(1);
    const std::uint8_t node = node_of(words.at(2));
    const auto count = static_cast<unsigned>(words.size() > 3 ? std::stoul(words[3]) : 1);
    simulate::SimulationSetup setup = SimulatedDevices::setup_of(path, node, count, devices_.size() + 1);
    setup.serial = static_cast<std::uint32_t>(0x100 * (devices_.size() + 1));
    devices_.push_back({std::make_unique<simulate::Simulation>(ground_, setup, find_by_index), node, count});
    simulate::Simulation& simulation = *devices_.back().simulation;
    REQUIRE(simulation.start() == "");
    network_.run([&simulation] { return simulation.process(); });
    for (unsigned n = 0; n < count && node <= 127 && !knows_nothing_; ++n) {
      described.describe(static_cast<std::uint8_t>(node + n), setup.description);
    }
  }

  void transfer(const Words& words) {
    std::uint16_t index = 0;
    std::uint8_t sub_index = 0;
    std::string why;
    find_by_index(words.at(2), {}, index, sub_index, why);
    DeviceClient client(network_, node_of(words.at(1)));
    if (words[0] == "read") {
      client.sdo().upload(index, sub_index, {65536, 1000, {}});
      return;
    }
    Bytes bytes;
    for (std::size_t n = 0; n + 1 < words.at(3).size(); n += 2) {
      bytes.push_back(static_cast<std::uint8_t>(std::stoul(words[3].substr(n, 2), nullptr, 16)));
    }
    client.sdo().download(index, sub_index, bytes, {SdoClient::small, 1000, {}});
  }

  void pass(Micros time) {
    for (const Micros end = network_.now() + time; network_.now() < end;) {
      network_.wait(end - network_.now());
    }
  }

  Micros repeat_due() {
    network_.bus().poll();  // a bus without devices
    Micros next = second;
    for (std::size_t n = 0; n < repetitions_.size(); ++n) {
      if (repetitions_[n].left > 0 && repetitions_[n].due <= network_.now()) {
        repetitions_[n].due += repetitions_[n].interval;
        --repetitions_[n].left;
        act(repetitions_[n].words);
      }
      const Repetition& repetition = repetitions_[n];
      if (repetition.left > 0) {
        next = std::min(next, repetition.due > network_.now() ? repetition.due - network_.now() : 0);
      }
    }
    return next;
  }

  std::string name_;
  bool knows_nothing_ = false;
  VirtualNetwork network_;
  VirtualGround ground_{network_};
  std::map<std::uint32_t, co::VirtualBus::Port*> ports_;
  std::vector<Devices> devices_;
  std::vector<Repetition> repetitions_;
};

}  // namespace lexican
