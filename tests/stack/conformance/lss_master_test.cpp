// SPDX-License-Identifier: Apache-2.0
// LSS master: requests and responses. [305]
#include "support/lss_master_fixture.hpp"

#if USE_LSS_MASTER

namespace {

using namespace test;

TEST_CASE("LSS master: each service sends its request and ends with the answer of the slave") {
  for (const LssDialogue& dialogue : lss_dialogues()) {
    CAPTURE(dialogue.name);
    LssMaster node;
    start_all(node, dialogue);
    node.after(999ms);
    node.goes_on();
    CHECK(node.armed_timers() == 1);
    node.rx(dialogue.answer);
    node.end(CO_LSSM_OK);
    CHECK(node.armed_timers() == 0);
    node.after(5000ms);
    node.goes_on();
    node.silent();
  }
}

TEST_CASE("LSS master: an inquired value is passed to the callback") {
  LssMaster node;
  const std::uint32_t numbers[] = {0x00000319, 0x12345678, 0xFFFFFFFF, 0x00000044, 255};
  for (std::size_t n = 0; n < 5; ++n) {
    start_all(node, lss_dialogues()[n + 4]);
    node.rx(lss_dialogues()[n + 4].answer);
    CHECK(node.end(CO_LSSM_OK).value == numbers[n]);
  }
  node.run("7E5#5E00000000000000", COLssmInquireNodeId);
  node.rx("7E4#5E7FEEEEEEEEEEEE");  // the value of reserved bytes is ignored
  CHECK(node.end(CO_LSSM_OK).value == 127);
}

TEST_CASE("LSS master: switch state global has no answer and ends after 1 ms") {
  LssMaster node;
  node.run("7E5#0401000000000000", COLssmSwitchGlobal, lss_configuration);
  node.goes_on();
  node.after(1ms);
  node.end(CO_LSSM_OK);
  node.run("7E5#0400000000000000", COLssmSwitchGlobal, lss_waiting);
  node.rx("7E4#0400000000000000");
  node.goes_on();
  node.after(1ms);
  node.end(CO_LSSM_OK);
}

TEST_CASE("LSS master: configure bit timing sends table 0 and the index of the bit rate") {
  const std::pair<std::uint32_t, const char*> rates[] = {
      {1000000, "7E5#1300000000000000"}, {800000, "7E5#1300010000000000"}, {500000, "7E5#1300020000000000"},
      {250000, "7E5#1300030000000000"},  {125000, "7E5#1300040000000000"}, {50000, "7E5#1300060000000000"},
      {20000, "7E5#1300070000000000"},   {10000, "7E5#1300080000000000"}};
  for (const auto& [rate, request] : rates) {
    LssMaster node;
    node.run(request, COLssmConfigureBitTiming, rate);
    node.rx("7E4#1300000000000000");
    node.end(CO_LSSM_OK);
  }
}

TEST_CASE("LSS master: a refusal is reported with its error code and the manufacturer-specific one") {
  const char* refusals[][2] = {
      {"7E5#1120000000000000", "7E4#11"}, {"7E5#1300040000000000", "7E4#13"}, {"7E5#1700000000000000", "7E4#17"}};
  for (std::size_t n = 0; n < 3; ++n) {
    LssMaster node;
    for (const auto& [error, codes] : {std::pair(1, "0100"), std::pair(2, "0200"), std::pair(255, "FF7B")}) {
      start_all(node, lss_dialogues()[n + 1]);
      node.rx(std::string(refusals[n][1]) + codes + "0000000000");
      const LssEnd end = node.end(CO_LSSM_REFUSED);
      CHECK(end.error == error);
      CHECK(end.specific == (error == 255 ? 0x7B : 0));
    }
    start_all(node, lss_dialogues()[n + 1]);
    node.rx(std::string(refusals[n][1]) + "000000000000");
    node.goes_on();  // a frame of 7 bytes is ignored
    node.rx(std::string(refusals[n][1]) + "00000000000000");
    CHECK(node.end(CO_LSSM_OK).error == 0);
  }
}

TEST_CASE("LSS master: without an answer a service ends exactly after its time-out") {
  for (const LssDialogue& dialogue : lss_dialogues()) {
    CAPTURE(dialogue.name);
    LssMaster node;
    start_all(node, dialogue);
    node.after(999ms);
    node.goes_on();
    node.after(1ms);
    node.end(CO_LSSM_TIMEOUT);
    node.times(20, 3);
    start_all(node, dialogue);
    node.after(19ms);
    node.goes_on();
    node.after(1ms);
    node.end(CO_LSSM_TIMEOUT);
    node.times(0, 0);
    start_all(node, dialogue);
    node.after(999ms);
    node.goes_on();
    node.after(1ms);
    node.end(CO_LSSM_TIMEOUT);
  }
}

TEST_CASE("LSS master: times beyond the range of the timer are limited to the longest one") {
  LssMaster node(Setup().rate(1000000));
  node.times(UINT32_MAX, UINT32_MAX);
  node.run("7E5#1700000000000000", COLssmStore);
  node.after(1h);
  node.goes_on();
  node.rx("7E4#1700000000000000");
  node.end(CO_LSSM_OK);
}

TEST_CASE("LSS master: a frame with another command specifier is not accepted as the answer") {
  std::vector<LssDialogue> all = lss_dialogues();
  all.insert(all.end(), lss_searches().begin(), lss_searches().end());
  for (const LssDialogue& dialogue : all) {
    CAPTURE(dialogue.name);
    LssMaster node;
    start_all(node, dialogue);
    CO_IF_FRM answer = frame("7E4#0000000000000000");
    const CO_IF_FRM right = frame(dialogue.answer);
    for (unsigned command = 0; command <= 255; ++command) {
      answer.Data[0] = static_cast<std::uint8_t>(command);
      if (command != right.Data[0]) {
        node.rx(answer);
      }
    }
    node.goes_on();
    node.after(1000ms);
    node.end(right.Data[0] == 0x4F || right.Data[0] == 0x50 ? CO_LSSM_NOT_FOUND : CO_LSSM_TIMEOUT);
  }
}

TEST_CASE("LSS master: frames of a wrong length and remote frames are malformed and no answers") {
  LssMaster node;
  node.run("7E5#5E00000000000000", COLssmInquireNodeId);
  const std::uint32_t before = node.counters().Malformed;
  for (const char* wrong : {"7E4#", "7E4#5E", "7E4#5E050000000000", "7E4#R"}) {
    node.rx(wrong);
    node.goes_on();
  }
  CHECK(node.counters().Malformed == before + 4);
  node.rx("80007E4#5E05000000000000");
  node.goes_on();
  node.rx("7E4#5E05000000000000");
  CHECK(node.end(CO_LSSM_OK).value == 5);
}

TEST_CASE("LSS master: late, repeated and unrequested answers are ignored") {
  for (const LssDialogue& dialogue : lss_dialogues()) {
    CAPTURE(dialogue.name);
    LssMaster node;
    node.rx(dialogue.answer);
    node.goes_on();
    start_all(node, dialogue);
    node.rx(dialogue.answer);
    node.end(CO_LSSM_OK);
    node.rx(dialogue.answer);
    node.goes_on();
    start_all(node, dialogue);
    node.after(1000ms);
    node.end(CO_LSSM_TIMEOUT);
    node.rx(dialogue.answer);
    node.goes_on();
    node.silent();
  }
}

TEST_CASE("LSS master: a late answer is not accepted by the next service") {
  LssMaster node;
  for (std::size_t n = 4; n + 1 < lss_dialogues().size(); ++n) {
    start_all(node, lss_dialogues()[n]);
    node.after(1000ms);
    node.end(CO_LSSM_TIMEOUT);
    start_all(node, lss_dialogues()[n + 1]);
    node.rx(lss_dialogues()[n].answer);
    node.goes_on();
    node.rx(lss_dialogues()[n + 1].answer);
    node.end(CO_LSSM_OK);
  }
}

TEST_CASE("LSS master: an answer before the request is complete is ignored") {
  LssMaster node;
  const LssDialogue& selective = lss_dialogues()[0];
  start(node, selective);
  node.tx(selective.requests[0]);
  node.rx(selective.answer);
  node.goes_on();
  for (unsigned n = 1; n < 4; ++n) {
    node.after(1ms);
    node.tx(selective.requests[n]);
  }
  node.goes_on();
  node.rx(selective.answer);
  node.end(CO_LSSM_OK);
}

TEST_CASE("LSS master: identify waits for the whole time, however many answers are received") {
  for (const LssDialogue& dialogue : lss_searches()) {
    CAPTURE(dialogue.name);
    LssMaster node;
    start_all(node, dialogue);
    node.rx(dialogue.answer);
    node.after(25ms);
    node.rx(dialogue.answer);
    node.after(24ms);
    node.rx(dialogue.answer);
    node.goes_on();
    node.after(1ms);
    node.end(CO_LSSM_OK);
    node.times(20, 200);
    start_all(node, dialogue);
    node.after(199ms);
    node.goes_on();
    node.after(1ms);
    node.end(CO_LSSM_NOT_FOUND);
  }
}

#if USE_LSS
TEST_CASE("LSS master: a node can be slave and master at the same time") {
  Setup setup;
  for (std::uint8_t sub = 1; sub <= 4; ++sub) {
    setup.with({CO_KEY(0x1018, sub, CO_OBJ_D___R_), CO_TUNSIGNED32, sub});
  }
  LssMaster node(setup);
  node.run("7E5#0401000000000000", COLssmSwitchGlobal, lss_configuration);
  node.rx("7E5#5E00000000000000");  // the LSS slave of the node is still in state waiting
  node.silent();
  node.after(1ms);
  node.end(CO_LSSM_OK);
  node.run("7E5#5E00000000000000", COLssmInquireNodeId);
  node.rx("7E5#0401000000000000");
  node.ask("7E5#5E00000000000000", "7E4#5E01000000000000");
  node.goes_on();
  node.rx("7E4#5E05000000000000");
  CHECK(node.end(CO_LSSM_OK).value == 5);
}
#endif

// LSS master: activate bit timing. [305]

// The initialisation of a controller may clear its filters.
TEST_CASE("LSS master and slave: after the switch of the bit rate the driver's filters are set again") {
  Setup setup;
  for (std::uint8_t sub = 1; sub <= 4; ++sub) {
    setup.with({CO_KEY(0x1018, sub, CO_OBJ_D___R_), CO_TUNSIGNED32, sub});
  }
  LssMaster node(setup);
  std::vector<std::uint32_t> filter;
  SUBCASE("master") {
    node.run("7E5#1500000000000000", COLssmActivateBitTiming, std::uint16_t{0}, 500000U);
    filter.swap(node.can.filter);
    node.after(2ms);
    node.end(CO_LSSM_OK);
  }
#if USE_LSS
  SUBCASE("slave") {
    node.rx("7E5#0401000000000000");
    filter.swap(node.can.filter);
    node.rx("7E5#1500000000000000");
  }
#endif
  CHECK_FALSE(filter.empty());
  CHECK((node.can.filter == filter));
}

TEST_CASE("LSS master: activate bit timing: this node is silent for the delay, switches, and is silent again") {
  LssMaster node(Setup().heartbeat(30));
  node.run("7E5#1564000000000000", COLssmActivateBitTiming, std::uint16_t{100}, 500000U);
  node.after(99ms);
  node.silent();
  CHECK(node.can.baud == 250000);
  node.after(1ms);
  CHECK(node.can.baud == 500000);
  CHECK(node.can.init_calls == 2);
  node.after(99ms);
  node.silent();
  node.goes_on();
  node.after(1ms);
  node.tx("701#7F");
  node.end(CO_LSSM_OK);
  CHECK(node->Baudrate == 500000);
}

TEST_CASE("LSS master: activate bit timing: delay 0 takes 1 ms each; a delay of 65535 ms is kept") {
  LssMaster node;
  node.run("7E5#1500000000000000", COLssmActivateBitTiming, std::uint16_t{0}, 1000000U);
  node.after(1ms);
  CHECK(node.can.baud == 1000000);
  node.goes_on();
  node.after(1ms);
  node.end(CO_LSSM_OK);
  node.run("7E5#15FFFF0000000000", COLssmActivateBitTiming, std::uint16_t{65535}, 20000U);
  node.after(65534ms);
  CHECK(node.can.baud == 1000000);
  node.after(1ms);
  CHECK(node.can.baud == 20000);
  node.after(65535ms);
  node.end(CO_LSSM_OK);
}

TEST_CASE(
    "LSS master: activate bit timing without bit rate of its own node: the controller is not changed, but silent") {
  LssMaster node(Setup().heartbeat(30));
  node.run("7E5#1514000000000000", COLssmActivateBitTiming, std::uint16_t{20}, 0U);
  node.after(39ms);
  node.silent();
  node.after(1ms);
  node.end(CO_LSSM_OK);
  node.tx("701#7F");
  CHECK(node.can.baud == 250000);
  CHECK(node.can.init_calls == 1);
}

TEST_CASE("LSS master: activate bit timing continues over a reset and ends with a stop") {
  LssMaster node;
  node.run("7E5#150A000000000000", COLssmActivateBitTiming, std::uint16_t{10}, 500000U);
  SUBCASE("reset") {
    node.rx("000#8201");
    node.silent();
    node.goes_on();
    node.after(20ms);
    node.tx("701#00");
    node.end(CO_LSSM_OK);
    CHECK(node.can.baud == 500000);
  }
  SUBCASE("stop before and after the switch") {
    node.after(10ms);
    node.call([&] { CONodeStop(&node.node); });
    node.end(CO_LSSM_STOPPED);
    node.init_again();
    node.call([&] { CONodeStart(&node.node); });
    node.tx("701#00");
  }
}

TEST_CASE("LSS master: activate bit timing that is cancelled: the node sends again at its present bit rate") {
  LssMaster node(Setup().heartbeat(5));
  node.run("7E5#150A000000000000", COLssmActivateBitTiming, std::uint16_t{10}, 500000U);
  node.after(6ms);
  node.silent();
  node.cancel();
  node.end(CO_LSSM_CANCELLED);
  node.loop();
  node.tx("701#7F");
  CHECK(node.can.baud == 250000);
}

TEST_CASE("LSS master: activate bit timing that is cancelled in a callback after CONodeStop(): nothing is sent") {
  Fixture node;
  CHECK(COLssmActivateBitTiming(&node->Lssm, 100, 250000, [](CO_LSSM*, CO_LSSM_RESULT) {}) == CO_ERR_NONE);
  node.frames();
  callbacks().can_receive = [&](CO_IF_FRM* frm) {
    CONodeStop(&node.node);
    CHECK(COLssmCancel(&node->Lssm) == CO_ERR_NONE);
    (void)COIfCanSend(&node->If, frm);
  };
  node.rx("222#00");
  node.silent();
  CHECK(node.mode() == CO_INVALID);
}

TEST_CASE("LSS master: activate bit timing does not start while frames are queued for the controller") {
  LssMaster node;
  node.can.refuse_all();
  CHECK(node.start(COLssmActivateBitTiming, std::uint16_t{10}, 500000U) == CO_ERR_IF_CAN_SEND);
  CHECK(node.start(COLssmSwitchGlobal, lss_configuration) == CO_ERR_NONE);
  node.after(1ms);
  node.end(CO_LSSM_OK);
  CHECK(node.start(COLssmActivateBitTiming, std::uint16_t{10}, 500000U) == CO_ERR_IF_CAN_SEND);
  node.goes_on();
  node.can.accept_all();
  node.loop();
  node.tx("7E5#0401000000000000");
  node.after(100ms);
  node.goes_on();
  CHECK(node.can.baud == 250000);
  node.run("7E5#150A000000000000", COLssmActivateBitTiming, std::uint16_t{10}, 500000U);
}

}  // namespace

#endif
