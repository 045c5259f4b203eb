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

}  // namespace

#endif
