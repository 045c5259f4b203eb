// SPDX-License-Identifier: Apache-2.0
/// \file program_bench.hpp
/// A hub with devices, and the program lexican on it.
#pragma once

#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <list>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "json_schema.hpp"
#include "process.hpp"

namespace test {

using Words = std::vector<std::string>;
using Json = nlohmann::json;

inline const std::string eds = LEXICAN_TOOL_DIR "/tests/fixtures/device.eds";

/// Directory of a test, also for the sockets of hubs.
class Directory {
 public:
  Directory() {
    char name[] = "/tmp/lexican-test-XXXXXX";
    path_ = mkdtemp(name);
  }
  ~Directory() { std::filesystem::remove_all(path_); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
  std::string operator/(const std::string& name) const { return path_ + '/' + name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

inline std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Replaces durations, whose digits depend on the computer: "in 1.3 s" and "0.6 ms".
inline std::string without_times(const std::string& text) {
  const std::string seconds = std::regex_replace(text, std::regex("in [0-9.]+ s"), "in T s");
  return std::regex_replace(seconds, std::regex("[0-9.]+ ms"), "T ms");
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

/// Returns the fault of the lines of --json, held against docs/schema.json.
inline std::string fault_of(const std::string& text, const std::string& verb) {
  static const Schema schema(Json::parse(bytes_of(LEXICAN_TOOL_DIR "/docs/schema.json")));
  for (const std::string& line : lines_of(text)) {
    const Json value = Json::parse(line, nullptr, false);
    const std::string fault = value.is_discarded() ? "no JSON: " + line : schema.fault_of(value, verb);
    if (!fault.empty()) {
      return fault;
    }
  }
  return lines_of(text).empty() ? "no line" : "";
}

/// A hub with devices, and the program on it.
class Bench {
 public:
  Bench() : hub_("hub:test-" + std::to_string(getpid())) {
    environment_ = {{"XDG_RUNTIME_DIR", directory.path()},
                    {"XDG_CONFIG_HOME", directory.path()},
                    {"LEXICAN_BUS", hub_},
                    {"NO_COLOR", "1"}};
  }
  /// A bench with devices of some node-IDs.
  explicit Bench(std::initializer_list<unsigned> nodes) : Bench() {
    for (const unsigned node : nodes) {
      add(node);
    }
  }

  /// Gives the hub a bit rate, before there are devices.
  void pace(const std::string& rate) {
    hub_ += '@' + rate;
    environment_["LEXICAN_BUS"] = hub_;
  }

  Process& add(unsigned node, const std::string& kind = "usual") { return add_kinds(node, {kind}); }
  Process& add_kinds(unsigned node, const Words& kinds) {
    Words words{LEXICAN_TEST_DEVICE, hub_, std::to_string(node)};
    words.insert(words.end(), kinds.begin(), kinds.end());
    devices_.emplace_back(words, environment_);
    devices_.back().wait_for("ready");
    return devices_.back();
  }

  Words line(const std::string& verb, Words words) const {
    const bool is_transfer = verb == "read" || verb == "write";
    if (is_transfer && std::find(words.begin(), words.end(), "--timeout") == words.end()) {
      words.insert(words.begin(), {"--timeout", "60000"});  // no answer is late on a busy computer
    }
    words.insert(words.begin(), {LEXICAN_PROGRAM, verb});
    return words;
  }
  Ran run(const std::string& verb, const Words& words) const {
    return Process(line(verb, words), environment_).finish();
  }
  /// Runs it with a file as standard input.
  Ran run_with_input(const std::string& verb, const Words& words, const std::string& path) const {
    const int input = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    REQUIRE(input >= 0);
    Process process(line(verb, words), environment_, input);
    close(input);
    return process.finish();
  }
  /// Runs it in a shell, with "$0" as the program.
  Ran run_shell(const std::string& command) const {
    return Process({"/bin/sh", "-c", command, LEXICAN_PROGRAM}, environment_).finish();
  }
  const std::string& hub() const { return hub_; }
  const Process::Environment& environment() const { return environment_; }
  void set(const std::string& name, const std::string& value) { environment_[name] = value; }

  Directory directory;

 private:
  std::string hub_;
  Process::Environment environment_;
  std::list<Process> devices_;
};

inline void check(const Ran& ran, int status, const std::string& out, const std::string& err) {
  CHECK(ran.out == out);
  CHECK(ran.err == err);
  CHECK(ran.status == status);
}

inline Ran run(const Words& words) {
  Words line = words;
  line.insert(line.begin(), LEXICAN_PROGRAM);
  return Process(line, {{"LEXICAN_BUS", ""}}).finish();
}

}  // namespace test
