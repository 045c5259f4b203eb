// SPDX-License-Identifier: Apache-2.0
// Resets and stops injected after every frame of every scenario. [T14]
#include "support/fixture.hpp"

namespace {

using namespace test;

struct Scenario {
  std::string name;
  std::vector<const char*> requests;
  unsigned heartbeat;
};

const std::vector<Scenario>& scenarios() {
  static const std::vector<Scenario> all = {
    {"segmented upload", {"601#4008100000000000", "601#6000000000000000", "601#7000000000000000"}, 0},
    {"segmented download of a value", {"601#2108200008000000", "601#0001020304050607"}, 0},
    {"segmented download of a stream", {"601#2100210F0F000000", "601#0001020304050607", "601#1001020304050607"}, 0},
    {"heartbeat", {"000#0101", "601#4000100000000000", "000#0201", "000#8001"}, 100},
    {"heartbeat started over the network", {"601#2B171000C8000000", "000#0101", "601#2B17100064000000"}, 0},
    {"errors", {"601#4004100000000000", "601#E000000000000000", "601#7000000000000000", "000#01", "601#R"}, 0},
#if CO_SSDO_N >= 2
    {"second server",
     {"601#2301120190060000", "601#23011202A0060000", "690#4008100000000000", "690#6000000000000000"},
     0},
#endif
  };
  return all;
}

Setup setup_of(const Scenario& scenario) { return Setup().heartbeat(static_cast<std::uint16_t>(scenario.heartbeat)); }

void play(Fixture& node, const Scenario& scenario, std::size_t steps, bool busy) {
  for (std::size_t i = 0; i < steps; ++i) {
    if (busy && i + 1 == steps) node.can.refuse_all();
    node.rx(scenario.requests[i]);
    node.after(3ms);
    node.frames();
  }
}

// A fresh node that has the same values in its dictionary.
std::string difference_to_fresh(Fixture& node, const Scenario& scenario) {
  Fixture fresh(setup_of(scenario).before_init([&](Objects& o) {
    o.heartbeat = node.objects.heartbeat;
    o.sdo2_rx = node.objects.sdo2_rx;
    o.sdo2_tx = node.objects.sdo2_tx;
  }));
  for (unsigned n = 0; n < CO_SSDO_N; ++n) {
    CHECK(fresh->Sdo[n].Obj == nullptr);
    CHECK(node->Sdo[n].Obj == nullptr);
  }
  return node.difference(fresh);
}

void check_new_life(Fixture& node, const Scenario& scenario) {
  CHECK(difference_to_fresh(node, scenario) == "");
  node.ask("601#6001020300000000", "581#8001020301000405");
  node.ask("601#0001020300000000", "581#8001020301000405");
  node.after(30ms);
  node.silent();
}

template <class Function>
void at_every_step(const Function& function) {
  for (const Scenario& scenario : scenarios()) {
    for (std::size_t steps = 0; steps <= scenario.requests.size(); ++steps) {
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

TEST_CASE("reset: after reset node and reset communication at any moment the node is as fresh [T14] [N6] [N8]") {
  for (const std::string reset : {"000#8101", "000#8201"}) {
    CAPTURE(reset);
    at_every_step([&](Fixture& node, const Scenario& scenario) {
      node.rx(reset);
      node.can.accept_all();
      node.loop();
      node.tx("701#00");
      CHECK(node.mode() == CO_PREOP);
      check_new_life(node, scenario);
    });
  }
}

TEST_CASE("reset: the same when the application resets the node; what still waits goes out before the boot-up [T14]") {
  for (const CO_NMT_RESET reset : {CO_RESET_NODE, CO_RESET_COM}) {
    CAPTURE(reset);
    at_every_step([&](Fixture& node, const Scenario& scenario) {
      const std::size_t waiting = node->TxQueue.Num;
      node.call([&] { CONmtReset(&node->Nmt, reset); });
      node.can.accept_all();
      node.loop();
      const std::vector<std::string> sent = node.frames();
      CHECK(sent.size() == waiting + 1);
      CHECK(sent.back() == "701#00");
      check_new_life(node, scenario);
    });
  }
}

TEST_CASE("reset: after stop and enter pre-operational at any moment no transfer is open [T14] [N8]") {
  at_every_step([](Fixture& node, const Scenario&) {
    node.rx("000#0201");
    node.can.accept_all();
    node.loop();
    for (const std::string& sent : node.frames()) {
      CHECK(sent.substr(0, 3) == "701");
    }
    node.rx("000#8001");
    node.ask("601#6001020300000000", "581#8001020301000405");
    node.ask("601#0001020300000000", "581#8001020301000405");
  });
}

TEST_CASE("reset: after CONodeStop at any moment nothing is left and nothing is sent [T14]") {
  at_every_step([](Fixture& node, const Scenario&) {
    node.call([&] { CONodeStop(&node.node); });
    CHECK(node.mode() == CO_INVALID);
    CHECK(node.armed_timers() == 0);
    CHECK_FALSE(node.can.on_bus);
    node.can.accept_all();
    node.after(5000ms);
    node.rx("601#4000100000000000");
    node.rx("000#8101");
    node.silent();
    CHECK(node.mode() == CO_INVALID);
  });
}

TEST_CASE("reset: CONodeStop, CONodeInit and CONodeStart at any moment make a fresh node [T14]") {
  at_every_step([](Fixture& node, const Scenario& scenario) {
    node.call([&] { CONodeStop(&node.node); });
    node.can.accept_all();
    node.init_again();
    node.silent();
    CHECK(node.mode() == CO_INIT);
    CHECK(node.can.on_bus);
    node.call([&] { CONodeStart(&node.node); });
    node.tx("701#00");
    check_new_life(node, scenario);
  });
}

}  // namespace
