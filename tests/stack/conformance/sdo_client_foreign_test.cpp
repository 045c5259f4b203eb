// SPDX-License-Identifier: Apache-2.0
// SDO client: responses that belong to a transfer that has ended, or to another client. [C1]
#include "support/sdo_client_states.hpp"

#if USE_CSDO

namespace {

using namespace test;

bool awaits_initiate(const ClientState& state) { return state.path.empty(); }

// Returns all responses of a server to an initiate, with this multiplexer.
std::vector<std::string> initiate_answers(const std::string& multiplexer) {
  return {
      "585#43" + multiplexer + "11223344", "585#4F" + multiplexer + "11000000", "585#42" + multiplexer + "11223344",
      "585#41" + multiplexer + "08000000", "585#40" + multiplexer + "00000000", "585#60" + multiplexer + "00000000",
      "585#C6" + multiplexer + "08000000", "585#C0" + multiplexer + "00000000", "585#A4" + multiplexer + "7F000000",
      "585#A0" + multiplexer + "01000000", "585#80" + multiplexer + "00000405", "585#80" + multiplexer + "01000405"};
}

// Multiplexers of other objects than 2000h:05.
constexpr const char* others[] = {"002006", "002004", "002105", "002205", "012005", "000000", "FFFFFF", "200005"};

// Returns whether an abort counts for an initiate of any object: with index 0, or 0504 0001h.
bool is_abort_of_any(const std::string& answer) {
  return answer.compare(4, 2, "80") == 0 &&
         (answer.compare(6, 6, "000000") == 0 || answer.compare(12, 8, "01000405") == 0);
}

TEST_CASE("SDO client: an initiate answer or abort for another object is ignored before the first answer [C1]") {
  for (const ClientState& state : client_states()) {
    if (!awaits_initiate(state)) continue;
    CAPTURE(state.name);
    SdoClient node;
    enter(node, state);
    for (const char* other : others) {
      for (const std::string& answer : initiate_answers(other)) {
        CAPTURE(answer);
        if (is_abort_of_any(answer)) continue;
        node.rx(answer);
        node.silent();
        node.goes_on();
      }
    }
    node.rx("585#8000200520000008");
    node.ended(CO_SDO_ERR_TOS);
  }
}

TEST_CASE("SDO client: an ignored answer does not restart the time-out") {
  for (const ClientState& state : client_states()) {
    if (!awaits_initiate(state)) continue;
    CAPTURE(state.name);
    SdoClient node;
    enter(node, state, 100);
    node.after(99ms);
    node.rx("585#8000200600000405");
    node.rx("585#4300200611223344");
    node.rx("585#43002005112233");
    node.goes_on();
    node.after(1ms);
    node.tx("605#8000200500000405");
    node.ended(CO_SDO_ERR_TIMEOUT);
  }
}

TEST_CASE("SDO client: an abort for another object ends a transfer after its first answer [C1]") {
  for (const ClientState& state : client_states()) {
    if (awaits_initiate(state)) continue;
    CAPTURE(state.name);
    SdoClient node;
    enter(node, state);
    node.rx("585#8011223320000008");
    node.silent();
    node.ended(CO_SDO_ERR_TOS);
  }
}

// Frames that a slow server may send for the transfer of 2000h:05 after its time-out.
constexpr const char* late[] = {
    "585#4300200511223344", "585#410020050E000000", "585#6000200500000000", "585#0001020304050607",
    "585#1108090A0B0C0D0E", "585#2000000000000000", "585#3000000000000000", "585#8000200500000008",
    "585#C600200528000000", "585#A40020057F000000", "585#0208090A0B0C0D0E", "585#C9C38B0000000000",
    "585#A2047F0000000000", "585#A100000000000000",
};

void time_out(SdoClient& node, const ClientState& state) {
  enter(node, state, 100);
  node.after(130ms);  // within a block the time-out may be a quarter longer
  node.frames();
  node.ended(CO_SDO_ERR_TIMEOUT);
}

TEST_CASE("SDO client: late answers after a time-out are ignored while the client is idle [C1]") {
  for (const ClientState& state : client_states()) {
    CAPTURE(state.name);
    SdoClient node;
    time_out(node, state);
    for (const char* answer : late) {
      CAPTURE(std::string(answer));
      node.rx(answer);
      node.silent();
    }
    CHECK(node.ends.empty());
  }
}

TEST_CASE("SDO client: late answers after a time-out do not disturb the next transfer [C1]") {
  for (const ClientState& state : client_states()) {
    CAPTURE(state.name);
    for (const char* answer : late) {
      CAPTURE(std::string(answer));
      SdoClient node;
      time_out(node, state);
      node.start_upload(0x2001, 0, 4);
      node.tx("605#4001200000000000");
      node.rx(answer);
      node.silent();
      node.goes_on();
      node.rx("585#4B01200011220000");
      node.has_read({0x11, 0x22});
    }
  }
}

TEST_CASE("SDO client: an answer after a cancel does not disturb the next transfer [C1]") {
  SdoClient node;
  node.start_download(0x2000, 5, {1});
  node.tx("605#2F00200501000000");
  node.cancel();
  node.tx("605#8000200521000008");
  node.ended(CO_SDO_ERR_TOS_LOCAL);
  node.start_download(0x2001, 0, {2});
  node.tx("605#2F01200002000000");
  node.rx("585#6000200500000000");
  node.goes_on();
  node.rx("585#6001200000000000");
  node.has_written();
}

#if CO_CSDO_BLOCK > 0

void check_ignores_others(SdoClient& node) {
  for (const char* other : others) {
    std::vector<std::string> answers = initiate_answers(other);
    answers.push_back("585#80" + std::string(other) + "00000008");
    for (const std::string& answer : answers) {
      CAPTURE(answer);
      if (is_abort_of_any(answer)) continue;
      node.rx(answer);
      node.silent();
      node.goes_on();
    }
  }
}

TEST_CASE("SDO client: 0504 0001h, or 0800 0000h for its object, makes a block upload be repeated [C1]") {
  for (const char* refusal : {"585#8000200501000405", "585#8000200500000008"}) {
    SdoClient node;
    node.start_upload(0x2000, 5, 29);
    node.tx("605#A40020057F1C0000");
    check_ignores_others(node);
    node.rx(refusal);
    node.tx("605#4000200500000000");
    check_ignores_others(node);
    node.rx("585#4100200508000000");
    node.tx("605#6000000000000000");
    node.rx("585#0001020304050607");
    node.tx("605#7000000000000000");
    node.rx("585#1D08000000000000");
    node.has_read(counted(8));
  }
}

TEST_CASE("SDO client: 0504 0001h, or 0800 0000h for its object, makes a block download be repeated [C1]") {
  for (const char* refusal : {"585#8000200501000405", "585#8000200500000008"}) {
    SdoClient node;
    node.start_download(0x2000, 5, counted(29));
    node.tx("605#C60020051D000000");
    check_ignores_others(node);
    node.rx(refusal);
    node.tx("605#210020051D000000");
    check_ignores_others(node);
    node.rx("585#6000200500000000");
    node.tx("605#0001020304050607");
    node.rx("585#2000000000000000");
    node.tx("605#1008090A0B0C0D0E");
    node.rx("585#3000000000000000");
    node.tx("605#000F101112131415");
    node.rx("585#2000000000000000");
    node.tx("605#10161718191A1B1C");
    node.rx("585#3000000000000000");
    node.tx("605#0D1D000000000000");
    node.rx("585#2000000000000000");
    node.has_written();
  }
}

#endif

#if CO_CSDO_N >= 2

TEST_CASE("SDO client: the answer of a server is received only by its own client") {
  SdoClient node;
  node.start_upload(0x2000, 5, 4, 1000, 0);
  node.start_upload(0x2000, 5, 4, 1000, 1);
  node.tx({"605#4000200500000000", "606#4000200500000000"});
  node.rx("586#4F00200522000000");
  node.has_read({0x22}, 1);
  CHECK(node.is_busy(0));
  node.rx("585#4F00200511000000");
  node.has_read({0x11}, 0);
}

#endif

// SDO client: each of the 256 command bytes of a server in each state of the client. [T6] The expected reactions are
// in support/sdo_client_states.cpp.

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
