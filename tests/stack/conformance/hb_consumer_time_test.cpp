// SPDX-License-Identifier: Apache-2.0
// Heartbeat consumer: times of several nodes, clocks, late loops, and drivers without a clock. [301:7.2.8.3.2.2]
#include <chrono>
#include <optional>
#include <random>
#include <string>

#include "support/monitor.hpp"
#include "support/plain_drivers.hpp"

#if CO_HBCONS_N > 0

namespace {

using namespace test;

constexpr const char* five_missing = "081#3081110000050000";

TEST_CASE("heartbeat consumer: several nodes are each monitored with their own time") {
  Monitor node({{5, 100}, {6, 250}, {127, 70}});
  node.rx("705#05");
  node.rx("706#05");
  node.rx("77F#05");
  node.told("5 OPERATIONAL, 6 OPERATIONAL, 127 OPERATIONAL");
  node.after(70ms);
  node.told("127 missing");
  node.emergency("081#30811100007F0000");
  node.after(30ms);
  node.told("5 missing");
  node.emergency(five_missing);
  node.after(150ms);
  node.told("127 missing, 5 missing, 127 missing, 6 missing");
  node.emergency("081#3081110000060000");
  node.rx("706#05");
  node.emergency("081#0000110000060000");
  node.rx("705#05");
  node.emergency("081#0000110000050000");
  node.rx("77F#05");
  node.emergency("081#00000000007F0000");
  node.told("6 OPERATIONAL, 5 OPERATIONAL, 127 OPERATIONAL");
}

TEST_CASE("heartbeat consumer: a new node with a shorter time than the others is reported on time") {
  Monitor node({{5, 1000}, {6, 10}});
  node.rx("705#05");
  node.after(100ms);
  node.rx("706#05");
  node.told("5 OPERATIONAL, 6 OPERATIONAL");
  node.after(9ms);
  node.told("");
  node.after(1ms);
  node.told("6 missing");
  node.emergency("081#3081110000060000");
  node.after(890ms);
  node.record.erase(node.record.begin(), node.record.begin() + 88);
  node.told("5 missing, 6 missing");  // both at 1000 ms
  node.emergency(five_missing);
}

TEST_CASE("heartbeat consumer: a late main loop reports a missing node once, and keeps the phase of the periods [Q8]") {
  Monitor node({{5, 100}});
  node.rx("705#05");
  node.jump(1050ms);
  node.told("5 OPERATIONAL, 5 missing");
  node.emergency(five_missing);
  CHECK(CONmtGetHbEvents(&node->Nmt, 5) == 1);
  node.after(49ms);
  node.told("");
  node.after(1ms);
  node.told("5 missing");
}

TEST_CASE("heartbeat consumer: a heartbeat that is processed before the late timer prevents the report [Q8]") {
  Monitor node({{5, 100}});
  node.rx("705#05");
  node.elapse_only(120ms);
  node.can.to_node.push_back(frame("705#05"));
  node.call([&] {
    CONodeProcess(&node.node);
    COTmrProcess(&node->Tmr);
  });
  node.told("5 OPERATIONAL");
  node.after(99ms);
  node.told("");
}

TEST_CASE("heartbeat consumer: times of 1 ms and of 65535 ms are kept") {
  Monitor node({{5, 1}, {6, 65535}});
  node.rx("706#05");
  node.after(65534ms);
  node.rx("705#05");
  node.told("6 OPERATIONAL, 5 OPERATIONAL");
  node.after(1ms);
  node.told("5 missing, 6 missing");
#if USE_EMCY
  node.tx({five_missing, "081#3081110000060000"});
#endif
}

TEST_CASE("heartbeat consumer: the events do not depend on start and rate of the clock [T15]") {
  for (const std::uint32_t rate : {1000U, 1000000U}) {
    std::vector<std::string> first;
    for (const std::uint32_t start : clock_starts) {
      Monitor node({{5, 100}, {6, 130}}, Setup().clock(start).rate(rate));
      std::vector<std::string> trace;
      const auto note = [&](const std::string& what) {
        const std::uint64_t us = node.now() * 1000000 / rate;
        trace.push_back(std::to_string(us) + " " + what);
      };
      callbacks().heartbeat_event = [&](CO_NMT*, std::uint8_t id) { note("missing " + std::to_string(id)); };
      callbacks().heartbeat_change = [&](CO_NMT*, std::uint8_t id, CO_MODE) { note("changed " + std::to_string(id)); };
      for (int round = 0; round < 30; ++round) {
        node.rx(round % 3 == 0 ? "706#05" : "705#05");
        node.after(std::chrono::milliseconds{20 + 13 * (round % 9)});
        for (const std::string& frm : node.trace()) note(frm);
      }
      first = first.empty() ? trace : first;
      CHECK(trace == first);
    }
    CHECK(first.size() > 20);
  }
}

TEST_CASE("heartbeat consumer: it needs neither a timer of the application's pool nor an alarm of the driver") {
  for (const Wake wake : {Wake::alarm, Wake::deadline, Wake::every_tick}) {
    Monitor node({{5, 100}}, Setup().timers(0).wake(wake));
    node.rx("705#05");
    node.after(99ms);
    node.told("5 OPERATIONAL");
    node.after(1ms);
    node.told("5 missing");
    node.emergency(five_missing);
    CHECK(node.error() == CO_ERR_NONE);
  }
}

// A heartbeat of node 5 that the classic driver has received.
bool beat_waits = false;
std::int16_t read_beat(CO_IF_FRM* frm) {
  if (!beat_waits) return 0;
  beat_waits = false;
  *frm = CO_IF_FRM{0x705, {0x05}, 1};
  return sizeof *frm;
}

TEST_CASE("heartbeat consumer: works with classic drivers whose timer has no clock, cyclic and tickless") {
  for (const bool cyclic : {true, false}) {
    CAPTURE(cyclic);
    CO_HBCONS entry{nullptr, nullptr, (CO_MODE)0, 0, 100, 5, 0};
    PlainNode device(cyclic, {CO_KEY(0x1016, 1, CO_OBJ_____RW), CO_THB_CONS, &entry});
    CO_IF_CAN_DRV can = *device.drivers.Can;
    can.Read = read_beat;
    device.drivers.Can = &can;
    const auto beat = [&] {
      beat_waits = true;
      CONodeProcess(&device.node);
    };
    device.ticks(1000);
    CHECK(CONmtGetHbEvents(&device.node.Nmt, 5) == 0);
    for (int round = 0; round < 50; ++round) {
      beat();
      device.ticks(99);
    }
    CHECK(CONmtGetHbEvents(&device.node.Nmt, 5) == 0);
    device.tick();
    CHECK(CONmtGetHbEvents(&device.node.Nmt, 5) == 1);
    device.ticks(1000);
    CHECK(CONmtGetHbEvents(&device.node.Nmt, 5) == 10);
    device.ticks(50);
    beat();
    device.ticks(99);
    CHECK(CONmtGetHbEvents(&device.node.Nmt, 5) == 0);
    device.tick();
    CHECK(CONmtGetHbEvents(&device.node.Nmt, 5) == 1);
    CONodeStop(&device.node);
  }
}

// Compares the heartbeat consumer with a model that processes every entry in every millisecond: random heartbeats,
// changes of 1016h, NMT commands and resets.

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
