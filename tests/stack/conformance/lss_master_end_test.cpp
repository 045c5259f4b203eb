// SPDX-License-Identifier: Apache-2.0
// LSS master: ends of services, and services that must not start. [305]
#include <algorithm>
#include <utility>

#include "support/lss_master_fixture.hpp"

#if USE_LSS_MASTER

namespace {

using namespace test;

TEST_CASE("LSS master: one service at a time") {
  LssMaster node;
  node.run("7E5#5E00000000000000", COLssmInquireNodeId);
  std::vector<LssDialogue> all = lss_dialogues();
  all.insert(all.end(), lss_searches().begin(), lss_searches().end());
  for (const LssDialogue& dialogue : all) {
    node.call([&] { CHECK(dialogue.start(&node->Lssm) == CO_ERR_LSS_BUSY); });
  }
  CHECK(node.start(COLssmSwitchGlobal, lss_waiting) == CO_ERR_LSS_BUSY);
  CHECK(node.start(COLssmActivateBitTiming, std::uint16_t{0}, 0U) == CO_ERR_LSS_BUSY);
  CHECK(node.start(COLssmFastscan, nullptr, std::uint8_t{0}) == CO_ERR_LSS_BUSY);
  node.silent();
  node.goes_on();
  node.rx("7E4#5E05000000000000");
  CHECK(node.end(CO_LSSM_OK).value == 5);
}

TEST_CASE("LSS master: a cancelled service ends at once, and its answer is ignored") {
  std::vector<LssDialogue> all = lss_dialogues();
  all.insert(all.end(), lss_searches().begin(), lss_searches().end());
  for (const LssDialogue& dialogue : all) {
    CAPTURE(dialogue.name);
    LssMaster node;
    start(node, dialogue);
    node.tx(dialogue.requests[0]);
    node.cancel();
    node.end(CO_LSSM_CANCELLED);
    node.rx(dialogue.answer);
    node.after(2000ms);
    node.goes_on();
    node.silent();
    start_all(node, dialogue);
    node.cancel();
    node.end(CO_LSSM_CANCELLED);
    node.cancel();
    node.goes_on();
  }
}

TEST_CASE("LSS master: the callback may start the next service, repeatedly") {
  LssMaster node;
  unsigned left = 1000;
  lss_next = [&](CO_LSSM* lssm) {
    if (left-- > 0) {
      CHECK(COLssmInquireNodeId(lssm, note_lss) == CO_ERR_NONE);
    }
  };
  node.run("7E5#5E00000000000000", COLssmInquireNodeId);
  for (unsigned n = 0; n < 500; ++n) {
    node.ask("7E4#5E05000000000000", "7E5#5E00000000000000");
    node.after(1000ms);
    node.tx("7E5#5E00000000000000");
  }
  node.rx("7E4#5E05000000000000");
  node.silent();
  CHECK(lss_ends.size() == 1001);
}

TEST_CASE("LSS master: the callback may start the next service after every result") {
  LssMaster node;
  bool first = true;
  lss_next = [&](CO_LSSM* lssm) {
    if (std::exchange(first, false)) {
      CHECK(COLssmStore(lssm, note_lss) == CO_ERR_NONE);
    }
  };
  SUBCASE("answer") {
    node.run("7E5#5E00000000000000", COLssmInquireNodeId);
    node.rx("7E4#5E05000000000000");
    node.end(CO_LSSM_OK);
  }
  SUBCASE("time-out") {
    node.run("7E5#5E00000000000000", COLssmInquireNodeId);
    node.after(1000ms);
    node.end(CO_LSSM_TIMEOUT);
  }
  SUBCASE("no answer needed") {
    node.run("7E5#0400000000000000", COLssmSwitchGlobal, lss_waiting);
    node.after(1ms);
    node.end(CO_LSSM_OK);
  }
  SUBCASE("not found") {
    node.run("7E5#4C00000000000000", COLssmIdentifyUnconfigured);
    node.after(50ms);
    node.end(CO_LSSM_NOT_FOUND);
  }
  SUBCASE("cancelled") {
    node.run("7E5#5E00000000000000", COLssmInquireNodeId);
    node.cancel();
    node.end(CO_LSSM_CANCELLED);
  }
  SUBCASE("bit timing activated") {
    node.run("7E5#1501000000000000", COLssmActivateBitTiming, std::uint16_t{1}, 0U);
    node.after(2ms);
    node.end(CO_LSSM_OK);
  }
  node.tx("7E5#1700000000000000");
  node.rx("7E4#1700000000000000");
  node.end(CO_LSSM_OK);
}

TEST_CASE("LSS master: arguments out of range are refused and start no service") {
  LssMaster node;
  for (const unsigned id : {0U, 128U, 200U, 254U}) {
    CHECK(node.start(COLssmConfigureNodeId, static_cast<std::uint8_t>(id)) == CO_ERR_BAD_ARG);
  }
  for (const std::uint32_t rate : std::initializer_list<std::uint32_t>{0, 1, 100000, 1000001, UINT32_MAX}) {
    CHECK(node.start(COLssmConfigureBitTiming, rate) == CO_ERR_BAD_ARG);
  }
  for (const unsigned part : {4U, 5U, 255U}) {
    CHECK(node.start(COLssmInquire, static_cast<std::uint8_t>(part)) == CO_ERR_BAD_ARG);
  }
  for (const unsigned state : {2U, 3U, 255U}) {
    CHECK(node.start(COLssmSwitchGlobal, static_cast<std::uint8_t>(state)) == CO_ERR_BAD_ARG);
  }
  CHECK(node.start(COLssmSwitchSelective, nullptr) == CO_ERR_BAD_ARG);
  CHECK(node.start(COLssmIdentify, nullptr) == CO_ERR_BAD_ARG);
  CHECK(node.start(COLssmFastscan, nullptr, std::uint8_t{1}) == CO_ERR_BAD_ARG);
  CHECK(node.start(COLssmFastscan, lss_address, std::uint8_t{5}) == CO_ERR_BAD_ARG);
  node.silent();
  node.goes_on();
}

TEST_CASE("LSS master: null pointers and a node that was never initialised are refused") {
  LssMaster node;
  CO_LSSM nobody{};
  for (CO_LSSM* const lssm : {static_cast<CO_LSSM*>(nullptr), &nobody}) {
    for (const LssDialogue& dialogue : lss_dialogues()) {
      CHECK(dialogue.start(lssm) == CO_ERR_BAD_ARG);
    }
    for (const LssDialogue& dialogue : lss_searches()) {
      CHECK(dialogue.start(lssm) == CO_ERR_BAD_ARG);
    }
    CHECK(COLssmSwitchGlobal(lssm, CO_LSSM_WAITING, note_lss) == CO_ERR_BAD_ARG);
    CHECK(COLssmActivateBitTiming(lssm, 0, 0, note_lss) == CO_ERR_BAD_ARG);
    CHECK(COLssmFastscan(lssm, nullptr, 0, note_lss) == CO_ERR_BAD_ARG);
  }
  CHECK(COLssmSetTimes(nullptr, 1, 1) == CO_ERR_BAD_ARG);
  CHECK(COLssmCancel(nullptr) == CO_ERR_BAD_ARG);
  CHECK(COLssmCancel(&nobody) == CO_ERR_NONE);
  CHECK(COLssmStore(&node->Lssm, nullptr) == CO_ERR_BAD_ARG);
  CHECK(COLssmActivateBitTiming(&node->Lssm, 0, 0, nullptr) == CO_ERR_BAD_ARG);
  CHECK(COLssmFastscan(&node->Lssm, nullptr, 0, nullptr) == CO_ERR_BAD_ARG);
  node.silent();
}

TEST_CASE("LSS master: works in every NMT state except Initialisation") {
  for (const char* state : {"000#8001", "000#0101", "000#0201"}) {
    LssMaster node;
    node.rx(state);
    node.run("7E5#5E00000000000000", COLssmInquireNodeId);
    node.rx("7E4#5E05000000000000");
    node.end(CO_LSSM_OK);
  }
  LssMaster starting(Setup().stay_in_init());
  CHECK(starting.start(COLssmInquireNodeId) == CO_ERR_NMT_MODE);
  starting.call([&] { CONodeStop(&starting.node); });
  CHECK(starting.start(COLssmInquireNodeId) == CO_ERR_NMT_MODE);
  starting.silent();
}

TEST_CASE("LSS master: a service continues when the node changes between Pre-operational, Operational and Stopped") {
  LssMaster node;
  node.run("7E5#5E00000000000000", COLssmInquireNodeId);
  for (const char* state : {"000#0101", "000#0201", "000#8001"}) {
    node.rx(state);
    node.goes_on();
  }
  node.rx("7E4#5E05000000000000");
  node.end(CO_LSSM_OK);
}

TEST_CASE("LSS master: a reset and a stop of the node end the service, whose callback cannot start another one") {
  lss_next = nullptr;
  LssMaster node;
  CO_ERR err = CO_ERR_NONE;
  lss_next = [&](CO_LSSM* lssm) { err = COLssmStore(lssm, note_lss); };
  node.run("7E5#5E00000000000000", COLssmInquireNodeId);
  SUBCASE("reset communication") { node.ask("000#8201", "701#00"); }
  SUBCASE("reset node") { node.ask("000#8101", "701#00"); }
  SUBCASE("stop") {
    node.call([&] { CONodeStop(&node.node); });
  }
  node.end(CO_LSSM_STOPPED);
  CHECK(err == CO_ERR_NMT_MODE);
  node.after(2000ms);
  node.silent();
  node.goes_on();
}

TEST_CASE("LSS master: a callback may stop the node") {
  LssMaster node;
  lss_next = [&](CO_LSSM* lssm) { CONodeStop(lssm->Node); };
  SUBCASE("answer") {
    node.run("7E5#5E00000000000000", COLssmInquireNodeId);
    node.rx("7E4#5E05000000000000");
    node.end(CO_LSSM_OK);
  }
  SUBCASE("time-out") {
    node.run("7E5#5E00000000000000", COLssmInquireNodeId);
    node.after(1000ms);
    node.end(CO_LSSM_TIMEOUT);
  }
  SUBCASE("fastscan") {
    node.run("7E5#5100000000800000", COLssmFastscan, nullptr, std::uint8_t{0});
    node.after(50ms);
    node.end(CO_LSSM_NOT_FOUND);
  }
  SUBCASE("activate bit timing") {
    node.run("7E5#1501000000000000", COLssmActivateBitTiming, std::uint16_t{1}, 0U);
    node.after(2ms);
    node.end(CO_LSSM_OK);
  }
  CHECK(node.mode() == CO_INVALID);
  node.silent();
}

TEST_CASE("LSS master: the configured times are kept over a reset") {
  LssMaster node;
  node.times(20, 30);
  node.ask("000#8101", "701#00");
  node.run("7E5#1700000000000000", COLssmStore);
  node.after(20ms);
  node.end(CO_LSSM_TIMEOUT);
  node.run("7E5#4C00000000000000", COLssmIdentifyUnconfigured);
  node.after(30ms);
  node.end(CO_LSSM_NOT_FOUND);
}

TEST_CASE("LSS master: a full transmit queue is reported") {
  LssMaster node(Setup().tx_queue(2));  // the application may use one of the two entries
  node.can.refuse_all();
  SUBCASE("at the start: no service begins") {
    node.call([&] { CHECK(COLssmStore(&node->Lssm, note_lss) == CO_ERR_NONE); });
    node.cancel();
    node.end(CO_LSSM_CANCELLED);
    CHECK(node.start(COLssmStore) == CO_ERR_IF_CAN_SEND);
    CHECK(node.start(COLssmFastscan, nullptr, std::uint8_t{0}) == CO_ERR_IF_CAN_SEND);
    node.goes_on();
    node.can.accept_all();
    node.loop();
    node.tx("7E5#1700000000000000");
    node.after(2000ms);
    node.goes_on();
  }
  SUBCASE("within a request: the service ends") {
    CHECK(node.start(COLssmSwitchSelective, lss_address) == CO_ERR_NONE);
    node.after(1ms);
    node.end(CO_LSSM_NOT_SENT);
    node.can.accept_all();
    node.loop();
    node.tx("7E5#4019030000000000");
    node.silent();
  }
  SUBCASE("within a fastscan: the service ends") {
    CHECK(node.start(COLssmFastscan, nullptr, std::uint8_t{0}) == CO_ERR_NONE);
    node.rx("7E4#4F00000000000000");
    node.after(50ms);
    node.end(CO_LSSM_NOT_SENT);
    node.can.accept_all();
    node.loop();
    node.tx("7E5#5100000000800000");
  }
}

TEST_CASE("LSS master: answers are received from the first service until a reset") {
  LssMaster node;
  const std::vector<std::uint32_t> without = node.can.filter;
  std::vector<std::uint32_t> with = without;
  with.insert(std::upper_bound(with.begin(), with.end(), 0x7E4U), 0x7E4U);
  CHECK(std::count(without.begin(), without.end(), 0x7E4) == 0);
  for (const char* reset : {"000#8201", "000#8101"}) {
    node.run("7E5#5E00000000000000", COLssmInquireNodeId);
    CHECK((node.can.filter == with));
    node.rx("7E4#5E05000000000000");
    node.end(CO_LSSM_OK);
    node.run("7E5#1700000000000000", COLssmStore);
    CHECK((node.can.filter == with));
    node.rx("7E4#1700000000000000");
    node.end(CO_LSSM_OK);
    node.ask(reset, "701#00");
    CHECK((node.can.filter == without));
  }
}

TEST_CASE("LSS master: the answers to the last request are counted, also after its end") {
  LssMaster node;
  node.run("7E5#1105000000000000", COLssmConfigureNodeId, std::uint8_t{5});
  node.rx("7E4#1300000000000000");  // response of another service
  CHECK(node->Lssm.Heard == 0);
  node.rx("7E4#1100000000000000");
  node.end(CO_LSSM_OK);
  CHECK(node->Lssm.Heard == 1);
  node.rx("7E4#1100000000000000");
  node.rx("7E4#1300000000000000");
  CHECK(node->Lssm.Heard == 2);
  for (unsigned n = 0; n < 300; ++n) {
    node.rx("7E4#1100000000000000");
  }
  CHECK(node->Lssm.Heard == 255);
  node.run("7E5#5D00000000000000", COLssmInquire, std::uint8_t{3});
  CHECK(node->Lssm.Heard == 0);
  node.rx("7E4#1100000000000000");
  CHECK(node->Lssm.Heard == 0);
  node.rx("7E4#5D04000000000000");
  CHECK(node->Lssm.Heard == 1);
  CHECK(node.end(CO_LSSM_OK).value == 4);
}

TEST_CASE("LSS master: several answers to the end of a fastscan are counted") {
  LssMaster node;
  const std::uint32_t known[] = {1, 2, 3, 4};
  CHECK(node.start(COLssmFastscan, known, std::uint8_t{4}) == CO_ERR_NONE);
  for (unsigned request = 0; request < 5; ++request) {
    node.frames();
    node.rx("7E4#4F00000000000000");
    node.rx("7E4#4F00000000000000");
    CHECK(node->Lssm.Heard == 2);
    node.after(50ms);
  }
  node.end(CO_LSSM_OK);
  CHECK(node->Lssm.Heard == 2);
}

}  // namespace

#endif
