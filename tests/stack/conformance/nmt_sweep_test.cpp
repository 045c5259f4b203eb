// SPDX-License-Identifier: Apache-2.0
// All NMT frames: 65 536 contents of two bytes in frames of 0…8 bytes, in every state. [301:7.3.2.1, 7.2.8.2.1]
#include "support/fixture.hpp"

namespace {

using namespace test;

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
