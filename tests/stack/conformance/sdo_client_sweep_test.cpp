// SPDX-License-Identifier: Apache-2.0
// SDO client: each of the 256 command bytes of a server in each state of the client. [T6] The expected reactions are in
// support/sdo_client_states.cpp.
#include "support/sdo_client_states.hpp"

#if USE_CSDO

namespace {

using namespace test;

CO_IF_FRM answer(const ClientState& state, unsigned command, std::uint8_t dlc = 8) {
  CO_IF_FRM frm = frame("585#00" + state.payload);
  frm.Data[0] = static_cast<std::uint8_t>(command);
  frm.DLC = dlc;
  return frm;
}

std::string text(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += " " + line;
  return all.empty() ? " nothing" : all;
}

// Returns the difference between the client's reaction and the table; empty: none.
std::string deviation(SdoClient& node, const ClientState& state, unsigned command) {
  const ClientReaction& expected = *reactions_to(state, command).at(0);
  enter(node, state);
  node.rx(answer(state, command));
  std::string what;
  const std::vector<std::string> sent = node.frames();
  if (sent != expected.sent) what += " sent" + text(sent) + ", not" + text(expected.sent);
  const bool ended = !node.ends.empty();
  if (node.ends.size() > 1) what += " several callbacks";
  if (ended == node.is_busy()) what += " callback and state differ";
  const std::uint32_t code = ended ? node.ends.front().code : goes_on_code;
  if (code != expected.code) what += " code " + std::to_string(code) + ", not " + std::to_string(expected.code);
  node.ends.clear();
  if (node.is_busy()) {
    node.cancel();
    node.frames();
    node.ends.clear();
  }
  return what.empty() ? "" : notation(answer(state, command)) + ":" + what;
}

TEST_CASE("SDO client: the table of reactions has every state and one reaction for each command byte [T6]") {
  CHECK(client_states().size() == (CO_CSDO_BLOCK != 0 ? 20 : 9));
  for (const ClientState& state : client_states()) {
    CAPTURE(state.name);
    for (unsigned command = 0; command < 256; ++command) {
      CAPTURE(command);
      CHECK(reactions_to(state, command).size() == 1);
    }
  }
}

TEST_CASE("SDO client: every command byte in every state has the reaction of the table [T6] [C1]") {
  unsigned round = 0;
  for (const ClientState& state : client_states()) {
    SdoClient node;
    std::vector<std::string> wrong;
    for (unsigned command = round++ % stride(61); command < 256; command += stride(61)) {
      const std::string deviates = deviation(node, state, command);
      if (!deviates.empty()) wrong.push_back(deviates);
    }
    const std::string first = wrong.empty() ? "" : wrong.front();
    CHECK_MESSAGE(wrong.empty(), state.name, ": ", wrong.size(), " wrong, the first is ", first);
  }
}

TEST_CASE("SDO client: after any command byte in any state the next transfer is complete [T6]") {
  unsigned round = 0;
  for (const ClientState& state : client_states()) {
    CAPTURE(state.name);
    SdoClient node;
    for (unsigned command = round++ % stride(61); command < 256; command += stride(61)) {
      CAPTURE(command);
      enter(node, state);
      node.rx(answer(state, command));
      node.frames();
      if (node.is_busy()) node.cancel();
      node.frames();
      node.ends.clear();
      node.start_upload(0x2001, 0, 4);
      node.tx("605#4001200000000000");
      node.rx("585#4B01200011220000");
      node.has_read({0x11, 0x22});
    }
  }
}

TEST_CASE("SDO client: frames of another length than 8 have no effect in any state, and are counted [T6] [D1]") {
  unsigned round = 0;
  for (const ClientState& state : client_states()) {
    CAPTURE(state.name);
    SdoClient node;
    enter(node, state);
    std::uint32_t malformed = node.counters().Malformed;
    for (unsigned command = round++ % stride(61); command < 256; command += stride(61)) {
      for (std::uint8_t dlc = 0; dlc < 8; ++dlc, ++malformed) {
        node.rx(answer(state, command, dlc));
      }
    }
    node.silent();
    node.goes_on();
    CHECK(node.counters().Malformed == malformed);
    node.cancel();
    node.frames();
    node.ended(CO_SDO_ERR_TOS_LOCAL);
  }
}

TEST_CASE("SDO client: remote frames and 29-bit frames with the server's CAN-ID have no effect in any state [Q1]") {
  for (const ClientState& state : client_states()) {
    CAPTURE(state.name);
    SdoClient node;
    enter(node, state);
    CO_IF_FRM frm = answer(state, 0x80);
    frm.Identifier |= CO_IF_FRM_RTR;
    node.rx(frm);
    frm.Identifier = 0x585 | CO_IF_FRM_EXT;
    node.rx(frm);
    frm.Identifier = 0x605;  // request of another client
    node.rx(frm);
    node.silent();
    node.goes_on();
    node.cancel();
    node.frames();
    node.ended(CO_SDO_ERR_TOS_LOCAL);
  }
}

}  // namespace

#endif
