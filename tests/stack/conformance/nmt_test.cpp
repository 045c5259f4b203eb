// SPDX-License-Identifier: Apache-2.0
// NMT slave. [301:7.3.2]
#include "support/fixture.hpp"

namespace {

using namespace test;

constexpr const char* read_1000 = "601#4000100000000000";
constexpr const char* value_1000 = "581#4300100091010F00";

TEST_CASE("NMT: start, stop and enter pre-operational change the state [N2] [N5] [Transition 02-04]") {
  Fixture node;
  CHECK(node.mode() == CO_PREOP);
  node.rx("000#0101");
  CHECK(node.mode() == CO_OPERATIONAL);
  node.rx("000#0201");
  CHECK(node.mode() == CO_STOP);
  node.rx("000#8001");
  CHECK(node.mode() == CO_PREOP);
  node.rx("000#0201");
  node.rx("000#0101");
  CHECK(node.mode() == CO_OPERATIONAL);
  node.rx("000#8001");
  CHECK(node.mode() == CO_PREOP);
  node.silent();
}

TEST_CASE("NMT: node-ID 0 addresses all nodes; another node-ID does not address this node [N1]") {
  Fixture node(Setup().node_id(5));
  node.rx("000#0100");
  CHECK(node.mode() == CO_OPERATIONAL);
  node.rx("000#0204");
  node.rx("000#0206");
  node.rx("000#0285");
  CHECK(node.mode() == CO_OPERATIONAL);
  node.rx("000#0205");
  CHECK(node.mode() == CO_STOP);
}

TEST_CASE("NMT: a command whose length is not 2 is ignored and counted [N1]") {
  for (const std::string command : {"000#", "000#01", "000#010100", "000#01010000", "000#0101000000000000"}) {
    CAPTURE(command);
    Fixture node;
    const std::uint32_t before = node.counters().Malformed;
    node.rx(command);
    CHECK(node.mode() == CO_PREOP);
    CHECK(node.counters().Malformed == before + 1);
    node.silent();
  }
}

TEST_CASE("NMT: a command of one byte does not use the second byte of an earlier frame [N1]") {
  Fixture node;
  CO_IF_FRM frm = frame("000#0101");
  frm.DLC = 1;
  node.rx(frm);
  CHECK(node.mode() == CO_PREOP);
}

TEST_CASE("NMT: remote frames and 29-bit frames are not commands [N1] [Q1]") {
  Fixture node;
  node.rx("000#R2");
  node.rx("00000000#0101");
  CHECK(node.mode() == CO_PREOP);
  node.silent();
}

TEST_CASE("NMT: in Stopped the SDO server does not answer, and the request is passed to the application [N3] [D17]") {
  Fixture node;
  unsigned passed_on = 0;
  callbacks().can_receive = [&](CO_IF_FRM* frm) {
    ++passed_on;
    CHECK(notation(*frm) == read_1000);
  };
  node.rx("000#0201");
  const std::uint32_t before = node.counters().Unclaimed;
  node.rx(read_1000);
  node.silent();
  CHECK(passed_on == 1);
  CHECK(node.counters().Unclaimed == before + 1);
  node.rx("000#8001");
  node.ask(read_1000, value_1000);
  node.rx("000#0101");
  node.ask(read_1000, value_1000);
  CHECK(passed_on == 1);
}

TEST_CASE("NMT: in Initialisation no request is answered and no command carried out [N3] [N4] [D17]") {
  Fixture node(Setup().stay_in_init());
  unsigned passed_on = 0;
  callbacks().can_receive = [&](CO_IF_FRM*) { ++passed_on; };
  node.rx(read_1000);
  node.rx("000#0101");
  node.rx("123#11");
  node.silent();
  CHECK(node.mode() == CO_INIT);
  CHECK(passed_on == 0);
}

TEST_CASE("NMT: each state allows the services of CiA 301 [N3]") {
  constexpr unsigned configured =
      CO_LSS_ALLOWED | CO_NMT_ALLOWED | CO_EMCY_ALLOWED | CO_TIME_ALLOWED | CO_SYNC_ALLOWED | CO_SDO_ALLOWED;
  Fixture node(Setup().stay_in_init());
  CHECK(node->Nmt.Allowed == (CO_BOOT_ALLOWED | CO_LSS_ALLOWED));
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  CHECK(node->Nmt.Allowed == configured);
  node.rx("000#0101");
  CHECK(node->Nmt.Allowed == (configured | CO_PDO_ALLOWED));
  node.rx("000#0201");
  CHECK(node->Nmt.Allowed == (CO_NMT_ALLOWED | CO_LSS_ALLOWED));
}

TEST_CASE("NMT: reset node and reset communication end in Pre-operational after boot-up, from every state [N2] [N6]") {
  for (const std::string state : {"000#8001", "000#0101", "000#0201"}) {
    for (const std::string reset : {"000#8101", "000#8100", "000#8201", "000#8200"}) {
      CAPTURE(state);
      CAPTURE(reset);
      Fixture node;
      node.rx(state);
      node.rx(reset);
      node.tx("701#00");
      CHECK(node.mode() == CO_PREOP);
      node.ask(read_1000, value_1000);
      node.after(1000ms);
      node.silent();
    }
  }
}

TEST_CASE("NMT: the reset callback is called after the reset, callbacks of state changes before it") {
  Fixture node;
  std::vector<int> told;
  callbacks().reset_request = [&](CO_NMT* nmt, CO_NMT_RESET reset) {
    told.push_back(100 + reset);
    CHECK(nmt->Mode == CO_PREOP);
  };
  callbacks().mode_change = [&](CO_NMT* nmt, CO_MODE mode) {
    told.push_back(mode);
    CHECK(nmt->Mode != mode);
  };
  node.rx("000#0101");
  node.rx("000#0101");
  node.rx("000#8101");
  node.tx("701#00");
  CHECK(told == std::vector<int>{CO_OPERATIONAL, CO_INIT, CO_PREOP, 100 + CO_RESET_NODE});
  told.clear();
  node.rx("000#8201");
  node.tx("701#00");
  CHECK(told == std::vector<int>{CO_INIT, CO_PREOP, 100 + CO_RESET_COM});
}

TEST_CASE("NMT: a reset by the application sends a boot-up message and does not call the reset callback") {
  Fixture node;
  unsigned told = 0;
  callbacks().reset_request = [&](CO_NMT*, CO_NMT_RESET) { ++told; };
  node.rx("000#0101");
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_NODE); });
  node.tx("701#00");
  CHECK(node.mode() == CO_PREOP);
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_INVALID); });
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_NUM); });
  node.silent();
  CHECK(told == 0);
}

TEST_CASE("NMT: a reset in Initialisation is carried out at the start") {
  Fixture node(Setup().stay_in_init());
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_COM); });
  node.silent();
  CHECK(node.mode() == CO_INIT);
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
}

TEST_CASE("NMT: timers of the application continue over a reset") {
  Fixture node;
  static unsigned ran;
  ran = 0;
  node.call([&] {
    COTmrCreate(
        &node->Tmr, 10, 10, [](void*) { ++ran; }, nullptr);
  });
  node.after(25ms);
  CHECK(ran == 2);
  node.rx("000#8201");
  node.tx("701#00");
  node.after(25ms);
  CHECK(ran == 5);
}

TEST_CASE("NMT: a command to enter the present state has no effect [N7]") {
  Fixture node(Setup().heartbeat(100));
  node.rx("000#0101");
  unsigned changes = 0;
  callbacks().mode_change = [&](CO_NMT*, CO_MODE) { ++changes; };
  node.after(70ms);
  node.rx("000#0101");
  node.after(100ms);
  node.tx_at(30ms, "701#05");
  node.silent();
  CHECK(changes == 0);
}

TEST_CASE("NMT: an open SDO transfer ends without a frame when SDO becomes unavailable [N8]") {
  Fixture node;
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.rx("000#0201");
  node.silent();
  node.after(3000ms);
  node.silent();
  node.rx("000#8001");
  node.ask("601#6001020300000000", "581#8001020301000405");
}

TEST_CASE("NMT: a queued SDO answer is withdrawn when the node is stopped [D17] [N8]") {
  Fixture node;
  node.can.refuse_all();
  node.rx(read_1000);
  node.rx("000#0201");
  node.can.accept_all();
  node.loop();
  node.after(100ms);
  node.silent();
}

TEST_CASE("NMT: an open SDO transfer continues after start and enter pre-operational [N8]") {
  Fixture node;
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.rx("000#0101");
  node.ask("601#6000000000000000", "581#004C65786963616E");
  node.rx("000#8001");
  node.ask("601#7000000000000000", "581#102074657374206E");
  node.ask("601#6000000000000000", "581#096F646500000000");
}

TEST_CASE("NMT: every command to every node has the effect of the table of CiA 301 [N1] [N2]") {
  Fixture node(Setup().node_id(5).only_small());
  std::vector<std::string> wrong;
  for (unsigned command = 0; command < 256; ++command) {
    for (unsigned target = 0; target < 256; target += target < 6 ? 1 : stride(37)) {
      CO_IF_FRM frm{0, {static_cast<std::uint8_t>(command), static_cast<std::uint8_t>(target)}, 2};
      const CO_MODE before = node.mode();
      node.rx(frm);
      CO_MODE expected = before;
      const bool ours = target == 0 || target == 5;
      const bool reset = ours && (command == 129 || command == 130);
      if (ours && command == 1) expected = CO_OPERATIONAL;
      if (ours && command == 2) expected = CO_STOP;
      if (ours && (command == 128 || reset)) expected = CO_PREOP;
      const std::vector<std::string> sent = node.frames();
      const bool right = sent == (reset ? std::vector<std::string>{"705#00"} : std::vector<std::string>{});
      if (node.mode() != expected || !right) wrong.push_back(notation(frm));
    }
  }
  CHECK_MESSAGE(wrong.empty(), wrong.size(), " wrong, the first is ", wrong.empty() ? "" : wrong[0]);
}

TEST_CASE("NMT: commands of another length have no effect [N1]") {
  Fixture node(Setup().node_id(5).only_small());
  const std::uint32_t before = node.counters().Malformed;
  std::uint32_t number = 0;
  unsigned wrong = 0;
  for (unsigned command = 0; command < 256; command += command < 4 ? 1 : stride(21)) {
    for (const unsigned target : {0U, 1U, 4U, 5U, 6U, 127U, 128U, 255U}) {
      for (const unsigned dlc : {0U, 1U, 3U, 4U, 5U, 6U, 7U, 8U}) {
        node.rx(CO_IF_FRM{0,
                          {static_cast<std::uint8_t>(command), static_cast<std::uint8_t>(target)},
                          static_cast<std::uint8_t>(dlc)});
        ++number;
        if (node.mode() != CO_PREOP || !node.frames().empty()) ++wrong;
      }
    }
  }
  CHECK(wrong == 0);
  CHECK(node.counters().Malformed == before + number);
}

TEST_CASE("NMT: the application may change the state") {
  Fixture node(Setup().stay_in_init());
  node.call([&] { CONmtSetMode(&node->Nmt, CO_OPERATIONAL); });
  node.tx("701#00");
  CHECK(CONmtGetMode(&node->Nmt) == CO_OPERATIONAL);
  node.call([&] { CONmtSetMode(&node->Nmt, CO_STOP); });
  CHECK(CONmtGetMode(&node->Nmt) == CO_STOP);
  node.call([&] { CONmtSetMode(&node->Nmt, CO_PREOP); });
  CHECK(CONmtGetMode(&node->Nmt) == CO_PREOP);
  CHECK(node.error() == CO_ERR_NONE);
  for (const CO_MODE refused : {CO_INVALID, CO_INIT, CO_MODE_NUM}) {
    node.call([&] { CONmtSetMode(&node->Nmt, refused); });
    CHECK(node.error() == CO_ERR_NMT_MODE);
    CHECK(CONmtGetMode(&node->Nmt) == CO_PREOP);
  }
  node.silent();
}

TEST_CASE("NMT: the node-ID is set in Initialisation, and CAN-IDs follow it after a reset") {
  Fixture node(Setup().stay_in_init());
  node.call([&] { CONmtSetNodeId(&node->Nmt, 0); });
  CHECK(node.error() == CO_ERR_BAD_ARG);
  node.call([&] { CONmtSetNodeId(&node->Nmt, 128); });
  CHECK(node.error() == CO_ERR_BAD_ARG);
  CHECK(CONmtGetNodeId(&node->Nmt) == 1);
  node.call([&] {
    CONmtSetNodeId(&node->Nmt, 0x42);
    CONmtReset(&node->Nmt, CO_RESET_NODE);
    CONodeStart(&node.node);
  });
  node.tx("742#00");
  CHECK(CONmtGetNodeId(&node->Nmt) == 0x42);
  node.ask("642#4000120100000000", "5C2#4300120142060000");
  node.ask("642#4000120200000000", "5C2#43001202C2050000");
  node.ask("642#4014100000000000", "5C2#43141000C2000000");
  node.call([&] { CONmtSetNodeId(&node->Nmt, 3); });
  CHECK(node.error() == CO_ERR_NMT_MODE);
  CHECK(CONmtGetNodeId(&node->Nmt) == 0x42);
}

TEST_CASE("NMT: the heartbeat has the byte of each state [N5]") {
  CHECK(CONmtModeDecode(0) == CO_INIT);
  CHECK(CONmtModeDecode(4) == CO_STOP);
  CHECK(CONmtModeDecode(5) == CO_OPERATIONAL);
  CHECK(CONmtModeDecode(127) == CO_PREOP);
  for (const unsigned other : {1U, 2U, 3U, 6U, 126U, 128U, 255U}) {
    CHECK(CONmtModeDecode(static_cast<std::uint8_t>(other)) == CO_INVALID);
  }
  CHECK(CONmtModeEncode(CO_INIT) == 0);
  CHECK(CONmtModeEncode(CO_STOP) == 4);
  CHECK(CONmtModeEncode(CO_OPERATIONAL) == 5);
  CHECK(CONmtModeEncode(CO_PREOP) == 127);
  CHECK(CONmtModeEncode(CO_INVALID) == 255);
  CHECK(CONmtModeEncode(CO_MODE_NUM) == 255);
}

TEST_CASE("NMT: null arguments call CONodeFatalError() or return an error") {
  Fixture node;
  CONmtReset(nullptr, CO_RESET_NODE);
  CONmtSetMode(nullptr, CO_STOP);
  CONmtSetNodeId(nullptr, 5);
  CHECK(callbacks().fatal_errors == 3);
  CHECK(CONmtGetMode(nullptr) == CO_INVALID);
  CHECK(CONmtGetNodeId(nullptr) == 0);
  CHECK(callbacks().fatal_errors == 5);
}

// All NMT frames: 65 536 contents of two bytes in frames of 0…8 bytes, in every state. [301:7.3.2.1, 7.2.8.2.1]

constexpr std::uint8_t own = 5;
constexpr std::uint8_t state_commands[] = {128, 1, 2};

// Effect of a frame of two bytes: the NMT state after it, and whether the node is reset.
struct Outcome {
  CO_MODE mode;
  bool reset;
};

Outcome outcome(CO_MODE before, unsigned command, unsigned target) {
  if (target != 0 && target != own) return {before, false};
  switch (command) {
    case 1: return {CO_OPERATIONAL, false};
    case 2: return {CO_STOP, false};
    case 128: return {CO_PREOP, false};
    case 129:
    case 130: return {CO_PREOP, true};
    default: return {before, false};
  }
}

void enter(Fixture& node, std::uint8_t command) { node.rx(CO_IF_FRM{0, {command, own}, 2}); }

TEST_CASE("NMT: every command to every target from every state has the defined effect [N1] [N2]") {
  unsigned round = 0;
  for (const std::uint8_t state : state_commands) {
    Fixture node(Setup().node_id(own).only_small());
    std::vector<std::string> wrong;
    for (unsigned content = round++ % stride(127); content < 0x10000; content += stride(127)) {
      enter(node, state);
      const CO_MODE before = node.mode();
      const CO_IF_FRM frm{0, {static_cast<std::uint8_t>(content >> 8), static_cast<std::uint8_t>(content)}, 2};
      node.rx(frm);
      const Outcome expected = outcome(before, content >> 8, content & 0xFFU);
      const auto sent = expected.reset ? std::vector<std::string>{"705#00"} : std::vector<std::string>{};
      if (node.frames() != sent || node.mode() != expected.mode) wrong.push_back(notation(frm));
    }
    CHECK_MESSAGE(wrong.empty(), wrong.size(), " wrong, the first is ", wrong.empty() ? "" : wrong[0]);
    CHECK(node.counters().Malformed == 0);
  }
}

TEST_CASE("NMT: frames of another length have no effect from any state [N1]") {
  Fixture node(Setup().node_id(own).only_small());
  std::uint32_t number = 0;
  unsigned wrong = 0;
  for (std::uint8_t dlc = 0; dlc <= 8; dlc = static_cast<std::uint8_t>(dlc == 1 ? 3 : dlc + 1)) {
    for (unsigned content = 0; content < 0x10000; content += stride(127)) {
      if (content % 0x100 < stride(127)) enter(node, state_commands[(content >> 8) % 3]);
      const CO_MODE before = node.mode();
      node.rx(CO_IF_FRM{0, {static_cast<std::uint8_t>(content >> 8), static_cast<std::uint8_t>(content)}, dlc});
      ++number;
      wrong += node.mode() == before && node.frames().empty() ? 0U : 1U;
    }
  }
  CHECK(wrong == 0);
  CHECK(node.counters().Malformed == number);
}

}  // namespace
