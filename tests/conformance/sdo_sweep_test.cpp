// SPDX-License-Identifier: Apache-2.0
// SDO server: each of the 256 command bytes in each state that the server can be in, at each length. [T6]
//
// The reactions are computed here from the tables of the standard: initiate requests have ccs 1 and 2 with the unused
// bits 0 (20h…2Fh, 40h), segments are 000t nnnc, segment requests 60h and 70h, an abort is 80h…9Fh; anything else is
// not a command. [301:7.2.4.3] [D2] [D4] [D6] [D7] [D8]
#include "support/fixture.hpp"

namespace {

using namespace test;

enum class Open { nothing, download, upload };
enum class Kind { value, stream };

// A server after \a segments segments of a transfer of \a kind.
struct State {
  std::string name;
  Open open;
  Kind kind;
  unsigned segments;
  unsigned toggle() const { return segments % 2; }
};

const State states[] = {
    {"idle, value", Open::nothing, Kind::value, 0},
    {"idle, stream", Open::nothing, Kind::stream, 0},
    {"download of a value, toggle 0", Open::download, Kind::value, 0},
    {"download of a value, toggle 1", Open::download, Kind::value, 1},
    {"download of a stream, toggle 0", Open::download, Kind::stream, 0},
    {"download of a stream, toggle 1", Open::download, Kind::stream, 1},
    {"upload of a value, toggle 0", Open::upload, Kind::value, 0},
    {"upload of a value, toggle 1", Open::upload, Kind::value, 1},
    {"upload of a stream, toggle 0", Open::upload, Kind::stream, 0},
    {"upload of a stream, toggle 1", Open::upload, Kind::stream, 1},
};

// The transfer that is open: 2008h:00, eight bytes, or 2100h:09, a domain of nine bytes.
std::string object(Kind kind) { return kind == Kind::value ? "082000" : "002109"; }

// The requests carry bytes that are a multiplexer and a length: 2004h:00 or 2100h:0F, four bytes.
std::string target(Kind kind) { return kind == Kind::value ? "042000" : "00210F"; }

void bring_into(Fixture& node, const State& state) {
  const std::string name = object(state.kind);
  const char* length = state.kind == Kind::value ? "08000000" : "09000000";
  if (state.open == Open::download) {
    node.ask("601#20" + name + "00000000", "581#60" + name + "00000000");
    if (state.segments == 1) node.ask("601#0001020304050607", "581#2000000000000000");
  }
  if (state.open == Open::upload) {
    node.ask("601#40" + name + "00000000", "581#41" + name + length);
    if (state.segments == 1) {
      node.ask("601#6000000000000000", state.kind == Kind::value ? "581#0011223344556677" : "581#0001020304050607");
    }
  }
}

struct Reaction {
  std::string answer;  // empty: none
  bool open;           // the old transfer goes on, or a new one was begun
  std::string name;    // of the transfer that is then open
};

std::string abort_frame(const std::string& name, const char* code) { return "581#80" + name + code; }

Reaction closed(std::string answer) { return {std::move(answer), false, ""}; }

Reaction refused(const State& state, const char* code) {
  return closed(abort_frame(state.open == Open::nothing ? target(state.kind) : object(state.kind), code));
}

Reaction to_initiate_download(const State& state, unsigned command) {
  const std::string name = target(state.kind);
  const bool expedited = (command & 2U) != 0;
  const bool sized = (command & 1U) != 0;
  const unsigned length = 4 - ((command >> 2) & 3U);
  const std::string done = "581#60" + name + "00000000";
  if (!expedited) return {done, true, name};
  if (state.kind == Kind::stream) return sized ? closed(done) : closed(abort_frame(name, "10000706"));
  return !sized || length == 4 ? closed(done) : closed(abort_frame(name, "13000706"));
}

Reaction to_initiate_upload(const State& state) {
  const std::string name = target(state.kind);
  if (state.kind == Kind::stream) return {"581#41" + name + "0F000000", true, name};
  return closed("581#43" + name + "11223344");
}

// Eight or up to nine bytes are wanted, 0 or 7 of them are there.
Reaction to_download_segment(const State& state, unsigned command) {
  if (state.open != Open::download) return refused(state, "01000405");
  if (((command >> 4) & 1U) != state.toggle()) return refused(state, "00000305");
  const unsigned total = 7 * state.segments + 7 - ((command >> 1) & 7U);
  const bool last = (command & 1U) != 0;
  if (total > (state.kind == Kind::value ? 8U : 9U)) return refused(state, "12000706");
  if (last && state.kind == Kind::value && total < 8) return refused(state, "13000706");
  const std::string answer = state.toggle() == 0 ? "581#2000000000000000" : "581#3000000000000000";
  return {answer, !last, object(state.kind)};
}

Reaction to_upload_segment(const State& state, unsigned command) {
  if (state.open != Open::upload || (command & 0x0FU) != 0) return refused(state, "01000405");
  if (((command >> 4) & 1U) != state.toggle()) return refused(state, "00000305");
  if (state.kind == Kind::value) {
    return state.segments == 0 ? Reaction{"581#0011223344556677", true, "082000"} : closed("581#1D88000000000000");
  }
  return state.segments == 0 ? Reaction{"581#0001020304050607", true, "002109"} : closed("581#1B08090000000000");
}

Reaction expected(const State& state, unsigned command) {
  if (command < 0x20) return to_download_segment(state, command);
  if (command < 0x30) return to_initiate_download(state, command);
  if (command == 0x40) return to_initiate_upload(state);
  if (command >= 0x60 && command < 0x80) return to_upload_segment(state, command);
  if (command >= 0x80 && command < 0xA0) return closed("");
  return refused(state, "01000405");
}

// An unknown command is answered with the multiplexer of the open transfer, else with its own bytes. [D7]
std::string transfer_of(Fixture& node) {
  node.rx("601#E0AABBCC00000000");
  const std::vector<std::string> sent = node.frames();
  return sent.size() == 1 && sent[0].size() == 20 ? sent[0].substr(6, 6) : "none";
}

CO_IF_FRM request(const State& state, unsigned command, unsigned dlc) {
  CO_IF_FRM frm = frame("601#00" + target(state.kind) + "04000000");
  frm.Data[0] = static_cast<std::uint8_t>(command);
  frm.DLC = static_cast<std::uint8_t>(dlc);
  return frm;
}

std::string one_of(const std::vector<std::string>& sent) { return sent.empty() ? "" : sent.back(); }

TEST_CASE("SDO server: the reaction to every command byte in every state [T6] [D1]-[D9]") {
  for (const State& state : states) {
    Fixture node(Setup().only_small());
    const Bytes stream_before = node.objects.memory[9];
    std::vector<std::string> wrong;
    for (unsigned command = 0; command < 256; ++command) {
      node.objects.u32 = 0x44332211;
      node.objects.u64 = 0x8877665544332211;
      node.objects.memory[9].assign(stream_before.begin(), stream_before.end());
      bring_into(node, state);
      const Reaction reaction = expected(state, command);
      node.rx(request(state, command, 8));
      const std::vector<std::string> sent = node.frames();
      const std::string open = transfer_of(node);
      const bool right = sent.size() == (reaction.answer.empty() ? 0U : 1U) && one_of(sent) == reaction.answer &&
                         open == (reaction.open ? reaction.name : "AABBCC");
      if (!right) {
        wrong.push_back(notation(request(state, command, 8)) + " -> " + one_of(sent) + ", expected " + reaction.answer +
                        ", then open: " + open);
      }
    }
    CHECK_MESSAGE(wrong.empty(), state.name, ": ", wrong.size(), " wrong, e.g. ", wrong.empty() ? "" : wrong[0],
                  " and ", one_of(wrong));
  }
}

TEST_CASE("SDO server: no frame of another length than 8 has any effect, in any state [T6] [D1]") {
  for (const State& state : states) {
    Fixture node(Setup().only_small());
    bring_into(node, state);
    const std::uint32_t before = node.counters().Malformed;
    unsigned wrong = 0;
    for (unsigned command = 0; command < 256; ++command) {
      for (unsigned dlc = 0; dlc < 8; ++dlc) {
        node.rx(request(state, command, dlc));
        wrong += node.frames().empty() ? 0U : 1U;
      }
    }
    CAPTURE(state.name);
    CHECK(wrong == 0);
    CHECK(node.counters().Malformed == before + 256 * 8);
    CHECK(transfer_of(node) == (state.open == Open::nothing ? "AABBCC" : object(state.kind)));
  }
}

TEST_CASE("SDO server: every command byte after every other, the server always answers the next read [T7]") {
  Fixture node(Setup().only_small());
  unsigned wrong = 0;
  for (unsigned first = 0; first < 256; ++first) {
    for (unsigned second = 0; second < 256; second += 7) {
      node.rx(request(states[1], first, 8));
      node.frames();
      node.rx(request(states[1], (second + first) % 256, 8));
      node.frames();
      node.rx("601#4000100000000000");
      wrong += one_of(node.frames()) == "581#4300100091010F00" ? 0U : 1U;
    }
  }
  CHECK(wrong == 0);
}

}  // namespace
