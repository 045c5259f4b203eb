// SPDX-License-Identifier: Apache-2.0
// CONodeStop() in all contexts: only CONodeInit() makes the node work again.
#include "support/fixture.hpp"

namespace {

using namespace test;

std::function<void(CO_NODE*)> on_init;

CO_ERR scripted_init(CO_OBJ*, CO_NODE* node) {
  if (on_init) {
    on_init(node);
  }
  return CO_ERR_NONE;
}

uint32_t one_byte(CO_OBJ*, CO_NODE*, uint32_t) { return 1; }

const CO_OBJ_TYPE scripted_type = {one_byte, scripted_init, nullptr, nullptr, nullptr};

Setup scripted() {
  on_init = nullptr;
  return Setup().with({CO_KEY(0x3000, 0, CO_OBJ_____RW), &scripted_type, 0});
}

void check_stopped(Fixture& node) {
  CHECK(node.mode() == CO_INVALID);
  CHECK(node->TxQueue.Num == 0);
  CHECK(node.armed_timers() == 0);
  node.after(1000ms);
  node.rx("000#8100");
  node.silent();
  CHECK(node.mode() == CO_INVALID);
}

}  // namespace

TEST_CASE("stop: a mode requested when the node becomes invalid is refused") {
  Fixture node;
  callbacks().mode_change = [](CO_NMT* nmt, CO_MODE mode) {
    if (mode == CO_INVALID) CONmtSetMode(nmt, CO_OPERATIONAL);
  };
  node.call([&] { CONodeStop(&node.node); });
  CHECK(CONodeGetErr(&node.node) == CO_ERR_NMT_MODE);
  check_stopped(node);
}

TEST_CASE("stop: from Init of a type in a reset: a mode requested in the callback does not start the node") {
  Fixture node(scripted());
  on_init = [](CO_NODE* n) { CONodeStop(n); };
  callbacks().mode_change = [](CO_NMT* nmt, CO_MODE mode) {
    if (mode == CO_INVALID) CONmtSetMode(nmt, CO_PREOP);
  };
  node.rx("000#8101");
  check_stopped(node);
}

TEST_CASE("stop: a mode requested after the stop in the same callback is refused") {
  Fixture node;
  callbacks().mode_change = [&](CO_NMT* nmt, CO_MODE mode) {
    if (mode != CO_STOP) return;
    CONodeStop(&node.node);
    CONmtSetMode(nmt, CO_OPERATIONAL);
    CONodeStart(&node.node);
  };
  node.rx("000#0201");
  check_stopped(node);
}

TEST_CASE("stop: within the change to Initialisation in CONodeInit() it leaves the node invalid and off the bus") {
  Fixture node;
  node.call([&] { CONodeStop(&node.node); });
  callbacks().mode_change = [&](CO_NMT*, CO_MODE mode) {
    if (mode == CO_INIT) CONodeStop(&node.node);
  };
  const unsigned closes = node.can.closes;
  node.init_again();
  CHECK_FALSE(node.can.on_bus);
  CHECK(node.can.closes == closes + 1);
  check_stopped(node);
}

TEST_CASE("stop: a later write of a COB-ID configures nothing in a node that was never initialised") {
  Fixture node;
  node.call([&] { CONodeStop(&node.node); });
  callbacks().mode_change = [&](CO_NMT*, CO_MODE mode) {
    if (mode == CO_INIT) CONodeStop(&node.node);
  };
  node.init_again();
  CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1201, 1), 0x80000640) ==
        (CO_SSDO_N > 1 ? CO_ERR_NONE : CO_ERR_OBJ_NOT_FOUND));
  check_stopped(node);
}

TEST_CASE("stop: within the change at the start the boot-up message is the last frame") {
  Fixture node(Setup().stay_in_init());
  callbacks().mode_change = [&](CO_NMT*, CO_MODE mode) {
    if (mode == CO_PREOP) CONodeStop(&node.node);
  };
  node.call([&] { CONmtSetMode(&node->Nmt, CO_OPERATIONAL); });
  node.tx("701#00");
  check_stopped(node);
}

TEST_CASE("stop: each call reads and drops one pending frame; nothing is sent and no error reported") {
  Fixture node;
  unsigned passed_on = 0;
  callbacks().can_receive = [&](CO_IF_FRM*) { ++passed_on; };
  node.call([&] { CONodeStop(&node.node); });
  const CO_NODE_COUNTERS before = node.counters();
  for (const char* const text : {"601#4000100000000000", "000#0101", "000#8101", "7E5#0401000000000000", "123#00"}) {
    node.can.to_node.push_back(frame(text));
  }
  unsigned calls = 0;
  while (!node.can.to_node.empty() && calls < 100) {
    node.call([&] { CONodeProcess(&node.node); });
    ++calls;
  }
  CHECK(calls == 5);
  node.can.read_result = -1;
  node.call([&] { CONodeProcess(&node.node); });
  CHECK(node.error() == CO_ERR_NONE);
  CHECK(node.counters().Received == before.Received + 5);
  CHECK(node.counters().Unclaimed == before.Unclaimed + 5);
  CHECK(node.mode() == CO_INVALID);
  CHECK(passed_on == 0);
  node.silent();
}

TEST_CASE("stop: in the driver's Read it drops the frame that is being read, and works at once") {
  Fixture node;
  node.can.on_read = [&] { CONodeStop(&node.node); };
  node.rx("000#0101");
  CHECK(node->State == 0);
  CHECK_FALSE(node.can.on_bus);
  check_stopped(node);
}

TEST_CASE("stop: a node that was never initialised reads no frame") {
  static CO_NODE node;
  CONodeProcess(&node);
  CHECK(CONodeGetCounters(&node).Received == 0);
}

TEST_CASE("timers: deleting an identifier outside of the pool has no effect") {
  Fixture node;
  const std::int16_t beyond = static_cast<std::int16_t>(node->Tmr.Max);
  CHECK(COTmrDelete(&node->Tmr, beyond) == -1);
  CHECK(COTmrDelete(&node->Tmr, INT16_MAX) == -1);
  CHECK(COTmrDelete(&node->Tmr, -1) == -1);
}
