// SPDX-License-Identifier: Apache-2.0
// Resets and stops injected after every frame of every scenario. [T14]
#include <cstring>
#include <utility>

#include "support/fixture.hpp"

namespace {

using namespace test;

// Object of a stream type of the application, 20 bytes.
struct Stream {
  std::uint32_t offset;
  std::uint8_t memory[20];
} stream;

uint32_t stream_size(CO_OBJ*, CO_NODE*, uint32_t width) { return width == 0 || width > 20 ? 20 : width; }
CO_ERR stream_reset(CO_OBJ*, CO_NODE*, uint32_t position) {
  stream.offset = position;
  return CO_ERR_NONE;
}
CO_ERR stream_read(CO_OBJ*, CO_NODE*, void* buffer, uint32_t size) {
  std::memcpy(buffer, stream.memory + stream.offset, size);
  stream.offset += size;
  return CO_ERR_NONE;
}
CO_ERR stream_write(CO_OBJ*, CO_NODE*, void* buffer, uint32_t size) {
  std::memcpy(stream.memory + stream.offset, buffer, size);
  stream.offset += size;
  return CO_ERR_NONE;
}
const CO_OBJ_TYPE stream_type = {stream_size, nullptr, stream_read, stream_write, stream_reset};

// Accesses the objects of the transfers as the application, between two frames.
void use_dictionary(Fixture& node) {
  node.call([&] {
    std::uint8_t bytes[4] = {0xA1, 0xA2, 0xA3, 0xA4};
    std::uint64_t value = 7;
    CODictWrBuffer(&node->Dict, CO_DEV(0x2100, 15), bytes, sizeof bytes);
    CODictWrBuffer(&node->Dict, CO_DEV(0x2110, 0), bytes, sizeof bytes);
    CODictRdBuffer(&node->Dict, CO_DEV(0x1008, 0), bytes, sizeof bytes);
    COObjWrValue(node.find(0x2008, 0), &node.node, &value, sizeof value);
    COObjRdBufStart(node.find(0x3001, 0), &node.node, bytes, sizeof bytes);
    COObjWrBufCont(node.find(0x3001, 0), &node.node, bytes, sizeof bytes);
  });
}

using Requests = std::vector<const char*>;

struct Scenario {
  std::string name;
  Requests requests;
  std::uint16_t heartbeat = 0;
  unsigned timers = 0;               // number of cyclic timers of the application
  bool application_meddles = false;  // use_dictionary() after each frame
};

const Requests value_up = {"601#4008200000000000", "601#6000000000000000", "601#7000000000000000"};
const Requests value_down = {"601#2108200008000000", "601#0001020304050607", "601#1D08000000000000"};
const Requests text_up = {"601#4008100000000000", "601#6000000000000000", "601#7000000000000000"};
const Requests text_down = {"601#2110210009000000", "601#0041424344454647", "601#1B48490000000000"};
const Requests domain_down = {"601#2100210F0F000000", "601#0001020304050607", "601#1001020304050607"};
const Requests stream_up = {"601#4001300000000000", "601#6000000000000000", "601#7000000000000000"};
const Requests stream_down = {"601#2101300014000000", "601#0001020304050607", "601#1001020304050607",
                              "601#0301020304050600"};
#if CO_SSDO_N >= 2
const Requests two_servers = {"601#2301120190060000", "601#23011202A0060000", "690#4008100000000000",
                              "601#2108200008000000", "690#6000000000000000", "601#0001020304050607"};
#endif

const std::vector<Scenario>& scenarios() {
  static const std::vector<Scenario> all = {
    {"value of 8 bytes, up", value_up},
    {"value of 8 bytes, down", value_down},
    {"text, up", text_up},
    {"string, down", text_down},
    {"domain, down", domain_down},
    {"stream of the application, up", stream_up},
    {"stream of the application, down", stream_down},
    {"heartbeat", {"000#0101", "601#4000100000000000", "000#0201", "000#8001"}, 100},
    {"heartbeat started over the network", {"601#2B171000C8000000", "000#0101", "601#2B17100064000000"}},
    {"transfer while heartbeats are sent", domain_down, 2},
    {"errors", {"601#4004100000000000", "601#E000000000000000", "601#7000000000000000", "000#01", "601#R"}},
    {"transfer while timers of the application run", value_up, 0, 3},
    {"heartbeats and timers of the application", {"000#0101", "601#4008100000000000", "000#8001"}, 7, 2},
    {"the application uses a text that is read", text_up, 0, 0, true},
    {"the application uses a string that is written", text_down, 0, 0, true},
    {"the application uses a domain that is written", domain_down, 0, 0, true},
    {"the application uses its stream that is read", stream_up, 0, 1, true},
    {"the application uses a value that is written", value_down, 5, 1, true},
#if CO_SSDO_N >= 2
    {"two servers", two_servers},
    {"two servers, heartbeats, timers, the application in between", two_servers, 10, 2, true},
#endif
  };
  return all;
}

Setup setup_of(const Scenario& scenario) {
  return Setup().only_small().heartbeat(scenario.heartbeat).with({CO_KEY(0x3001, 0, CO_OBJ_____RW), &stream_type, 0});
}

constexpr std::uint32_t period = 10;
std::vector<std::uint64_t> expiries;

void note_expiry(void* fixture) {
  const OutsideStack outside;
  expiries.push_back(static_cast<Fixture*>(fixture)->now());
}

void start_timers(Fixture& node, unsigned number) {
  expiries.clear();
  for (unsigned n = 0; n < number; ++n) {
    node.call([&] { COTmrCreate(&node->Tmr, 0, period, note_expiry, &node); });
  }
}

// Checks that no expiry is missing. The timers were started at tick 0, so all expiries are multiples of the period.
void check_timers_went_on(Fixture& node, const Scenario& scenario) {
  std::vector<std::uint64_t> expected;
  for (std::uint64_t tick = period; tick <= node.now(); tick += period) {
    expected.insert(expected.end(), scenario.timers, tick);
  }
  CHECK(expiries == expected);
}

void play(Fixture& node, const Scenario& scenario, std::size_t steps, bool busy) {
  stream = {};
  start_timers(node, scenario.timers);
  for (const auto& [index, sub] : {std::pair<int, int>{0x2100, 15}, {0x2110, 0}, {0x2008, 0}}) {
    if (scenario.application_meddles)
      node.may_change(static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub));
  }
  for (std::size_t i = 0; i < steps; ++i) {
    if (busy && i + 1 == steps) node.can.refuse_all();
    node.rx(scenario.requests[i]);
    if (scenario.application_meddles) use_dictionary(node);
    node.after(3ms);
    node.frames();
  }
}

// Returns the difference to a new node with the same dictionary values and number of application timers; empty: none.
std::string difference_to_fresh(Fixture& node, const Scenario& scenario, unsigned timers) {
  Fixture fresh(setup_of(scenario).before_init([&](Objects& o) {
    o.heartbeat = node.objects.heartbeat;
    o.sdo2_rx = node.objects.sdo2_rx;
    o.sdo2_tx = node.objects.sdo2_tx;
  }));
  const std::vector<std::uint64_t> kept = expiries;
  start_timers(fresh, timers);
  expiries = kept;
  for (unsigned n = 0; n < CO_SSDO_N; ++n) {
    CHECK(fresh->Sdo[n].Obj == nullptr);
    CHECK(node->Sdo[n].Obj == nullptr);
  }
  return node.difference(fresh);
}

void check_no_transfer(Fixture& node) {
  node.ask("601#6001020300000000", "581#8001020301000405");
  node.ask("601#0001020300000000", "581#8001020301000405");
}

// Checks that the node sends only heartbeats, like a new node after boot-up.
void check_heartbeats_only(Fixture& node, Time time) {
  const std::uint16_t ms = node.objects.heartbeat;
  node.after(time);
  const auto total = static_cast<std::uint64_t>(time / 1ms);
  const std::vector<std::string> sent = node.trace();
  CHECK(sent.size() == (ms == 0 ? 0 : total / ms));
  for (std::size_t n = 0; n < sent.size(); ++n) {
    CHECK(sent[n] == std::to_string((n + 1) * ms) + " 701#7F");
  }
}

void check_new_life(Fixture& node, const Scenario& scenario, bool timers_live) {
  CHECK(difference_to_fresh(node, scenario, timers_live ? scenario.timers : 0) == "");
  check_no_transfer(node);
  check_heartbeats_only(node, 30ms);
  if (timers_live) check_timers_went_on(node, scenario);
}

template <class Function>
void at_every_step(const Function& function) {
  for (const Scenario& scenario : scenarios()) {
    for (std::size_t steps = 0; steps <= scenario.requests.size(); steps += stride(3)) {
      for (const bool busy : {false, true}) {
        CAPTURE(scenario.name);
        CAPTURE(steps);
        CAPTURE(busy);
        Fixture node(setup_of(scenario));
        play(node, scenario, steps, busy);
        function(node, scenario);
      }
    }
  }
}

TEST_CASE("reset: reset node and reset communication at any time give the state after power-on [T14] [N6] [N8]") {
  for (const std::string reset : {"000#8101", "000#8201"}) {
    CAPTURE(reset);
    at_every_step([&](Fixture& node, const Scenario& scenario) {
      node.rx(reset);
      node.can.accept_all();
      node.loop();
      node.tx("701#00");
      CHECK(node.mode() == CO_PREOP);
      check_new_life(node, scenario, true);
    });
  }
}

TEST_CASE(
    "reset: a reset by the application at any time sends queued responses and gives the state after power-on [T14]") {
  for (const CO_NMT_RESET reset : {CO_RESET_NODE, CO_RESET_COM}) {
    CAPTURE(reset);
    at_every_step([&](Fixture& node, const Scenario& scenario) {
      const CO_TX_QUEUE& queue = node->TxQueue;
      const auto is_response = [&](const CO_IF_FRM& frm) {
        return std::any_of(std::begin(node->Sdo), std::end(node->Sdo),
                           [&](const CO_SDO& server) { return server.TxId == frm.Identifier; });
      };
      const auto waiting = static_cast<std::size_t>(std::count_if(queue.Frame, queue.Frame + queue.Num, is_response));
      node.call([&] { CONmtReset(&node->Nmt, reset); });
      node.can.accept_all();
      node.loop();
      const std::vector<std::string> sent = node.frames();
      CHECK(sent.size() == waiting + 1);
      CHECK(sent.back() == "701#00");
      check_new_life(node, scenario, true);
    });
  }
}

TEST_CASE("reset: after stop and start or enter pre-operational at any time no transfer is open [T14] [N8]") {
  for (const std::string on : {"000#8001", "000#0101"}) {
    CAPTURE(on);
    at_every_step([&](Fixture& node, const Scenario& scenario) {
      node.rx("000#0201");
      CHECK(node.mode() == CO_STOP);
      node.can.accept_all();
      node.loop();
      for (const std::string& sent : node.frames()) {
        CHECK(sent.substr(0, 3) == "701");
      }
      node.rx(on);
      CHECK(node.mode() == (on == "000#0101" ? CO_OPERATIONAL : CO_PREOP));
      check_no_transfer(node);
      check_timers_went_on(node, scenario);
    });
  }
}

TEST_CASE("reset: after CONodeStop at any time nothing is queued and nothing is sent [T14]") {
  at_every_step([](Fixture& node, const Scenario& scenario) {
    node.call([&] { CONodeStop(&node.node); });
    CHECK(node.mode() == CO_INVALID);
    CHECK(node.armed_timers() == scenario.timers);
    CHECK_FALSE(node.can.on_bus);
    node.can.accept_all();
    node.after(5000ms);
    node.rx("601#4000100000000000");
    node.rx("000#8101");
    node.silent();
    CHECK(node.mode() == CO_INVALID);
  });
}

TEST_CASE("reset: CONodeStop, CONodeInit and CONodeStart at any time give the state after power-on [T14]") {
  at_every_step([](Fixture& node, const Scenario& scenario) {
    node.call([&] { CONodeStop(&node.node); });
    node.can.accept_all();
    node.init_again();
    node.silent();
    CHECK(node.mode() == CO_INIT);
    CHECK(node.can.on_bus);
    node.call([&] { CONodeStart(&node.node); });
    node.tx("701#00");
    check_new_life(node, scenario, false);
  });
}

}  // namespace
