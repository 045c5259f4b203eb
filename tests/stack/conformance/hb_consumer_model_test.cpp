// SPDX-License-Identifier: Apache-2.0
// Compares the heartbeat consumer with a model that processes every entry in every millisecond: random heartbeats,
// changes of 1016h, NMT commands and resets.
#include <optional>
#include <random>

#include "support/monitor.hpp"

#if CO_HBCONS_N > 0

namespace {

using namespace test;

struct Entry {
  unsigned node_id = 0;
  unsigned ms = 0;
  std::optional<unsigned> waited;  // ms since the last heartbeat or heartbeat event
  bool missing = false;
  int state = -1;
};

class Model {
 public:
  std::vector<std::string> told;
  std::array<Entry, monitor_entries> entry;

  bool configure(std::size_t n, unsigned node_id, unsigned ms) {
    const bool used = ms != 0 && node_id >= 1 && node_id <= 127;
    for (std::size_t other = 0; other < entry.size(); ++other) {
      if (used && other != n && is_used(entry[other]) && entry[other].node_id == node_id) return false;
    }
    if (entry[n].node_id != node_id || entry[n].ms != ms) {
      entry[n] = Entry{node_id, ms, std::nullopt, false, -1};
    }
    return true;
  }

  void beat(unsigned node_id, int state) {
    for (Entry& one : entry) {
      if (!is_used(one) || one.node_id != node_id) continue;
      if (one.state != state || one.missing || state == 0) {
        told.push_back(std::to_string(node_id) + " " + name_of(CONmtModeDecode(static_cast<std::uint8_t>(state))));
      }
      one.waited = 0;
      one.missing = false;
      one.state = state;
    }
  }

  void millisecond() {
    for (Entry& one : entry) {
      if (one.waited && ++*one.waited == one.ms) {
        one.waited = 0;
        one.missing = true;
        told.push_back(std::to_string(one.node_id) + " missing");
      }
    }
  }

  void reset() {
    for (Entry& one : entry) one = Entry{one.node_id, one.ms, std::nullopt, false, -1};
  }

  static bool is_used(const Entry& one) { return one.ms != 0 && one.node_id >= 1 && one.node_id <= 127; }
};

class Walk {
 public:
  Walk(unsigned seed, std::uint32_t clock) : random_(seed), node_({}, Setup().only_small().clock(clock)) {
    callbacks().mode_change = nullptr;
  }

  void step() {
    switch (below(12)) {
      case 0: return configure();
      case 1: return command();
      case 2:
      case 3: return pass(below(120));
      case 4: return pass(below(5));
      default: return beat();
    }
  }

 private:
  unsigned below(unsigned end) { return std::uniform_int_distribution<unsigned>(0, end - 1)(random_); }

  void configure() {
    const auto sub = static_cast<std::uint8_t>(1 + below(monitor_entries));
    const unsigned node_id = below(8) == 0 ? 120 + below(20) : 2 + below(9);
    const unsigned ms = below(4) == 0 ? 0 : 1 + below(60);
    const bool accepted = model_.configure(sub - 1U, node_id, ms);
    CHECK(node_.configure(sub, (node_id << 16) | ms) == (accepted ? 0U : 0x06040043U));
    compare();
  }

  void beat() {
    static constexpr int states[] = {0, 4, 5, 5, 5, 5, 127};
    const unsigned node_id = 2 + below(9);
    const int state = states[below(7)];
    model_.beat(node_id, state);
    node_.rx(CO_IF_FRM{0x700U + node_id, {static_cast<std::uint8_t>(state)}, 1});
    compare();
  }

  // Sends a random NMT command, except stop: 1016h is not writable in Stopped.
  void command() {
    static constexpr std::uint8_t commands[] = {1, 128, 129, 130};
    const std::uint8_t command = commands[below(4)];
    if (command >= 129) model_.reset();
    node_.rx(CO_IF_FRM{0, {command, 1}, 2});
    compare();
  }

  void pass(unsigned ms) {
    for (unsigned n = 0; n < ms; ++n) model_.millisecond();
    node_.after(std::chrono::milliseconds{ms});
    compare();
  }

  void compare() {
    node_.trace();
    REQUIRE(node_.record == model_.told);
    node_.record.clear();
    model_.told.clear();
  }

  std::mt19937 random_;
  Monitor node_;
  Model model_;
};

TEST_CASE("heartbeat consumer: random heartbeats, times and writes give the events of the model [H1-H6] [T14] [T15]") {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    Walk walk(seed, clock_starts[seed % 3]);
    for (unsigned step = 0; step < 1000 / stride(20); ++step) {
      CAPTURE(step);
      walk.step();
    }
  }
}

}  // namespace

#endif
