// SPDX-License-Identifier: Apache-2.0
#include "sdo_client_states.hpp"

#if USE_CSDO

#include <algorithm>
#include <cstdio>

#include "words.hpp"

namespace test {
namespace {

using States = std::vector<ClientState>;

constexpr std::uint32_t done = 0;

// Returns the reaction that the client aborts: it sends the code to the server, low byte first, and passes it to its
// callback.
ClientReaction abort(const std::string& commands, std::uint32_t code) {
  char text[24];
  const auto bytes = static_cast<unsigned>(code);
  std::snprintf(text, sizeof text, "605#80002005%02X%02X%02X%02X", bytes & 0xFFU, (bytes >> 8) & 0xFFU,
                (bytes >> 16) & 0xFFU, bytes >> 24);
  return {commands, {text}, code};
}

const ClientReaction unknown = abort("rest", CO_SDO_ERR_CMD);

void add_segmented_upload(States& all) {
  const std::string ask0 = "605#6000000000000000";
  const std::string ask1 = "605#7000000000000000";
  const std::string initiate = "605#4000200500000000";
  const ClientState::Step first = {"585#0001020304050607", {ask1}};
  all.push_back({"upload: initiate sent",
                 true,
                 28,
                 initiate,
                 {},
                 "00200504000000",
                 {{"40-41 44-45 48-49 4C-4D", {ask0}, goes_on_code},
                  {"42-43 46-47 4A-4B 4E-4F", {}, done},
                  {"80", {}, 0x00000004},
                  unknown}});
  all.push_back({"upload: first segment asked, 14 announced",
                 true,
                 28,
                 initiate,
                 {{"585#410020050E000000", {ask0}}},
                 "01020304050607",
                 {{"00 02 04 06 08 0A 0C 0E", {ask1}, goes_on_code},
                  abort("01 03 05 07 09 0B 0D 0F", CO_SDO_ERR_LEN_SMALL),
                  abort("10-1F", CO_SDO_ERR_TBIT),
                  {"80", {}, 0x07060504},
                  unknown}});
  all.push_back({"upload: second segment asked, 14 announced",
                 true,
                 28,
                 initiate,
                 {{"585#410020050E000000", {ask0}}, first},
                 "08090A0B0C0D0E",
                 {{"10 12 14 16 18 1A 1C 1E", {ask0}, goes_on_code},
                  {"11", {}, done},
                  abort("13 15 17 19 1B 1D 1F", CO_SDO_ERR_LEN_SMALL),
                  abort("00-0F", CO_SDO_ERR_TBIT),
                  {"80", {}, 0x0E0D0C0B},
                  unknown}});
  all.push_back({"upload: second segment asked, 8 announced",
                 true,
                 28,
                 initiate,
                 {{"585#4100200508000000", {ask0}}, first},
                 "08090A0B0C0D0E",
                 {abort("10 12-1B", CO_SDO_ERR_LEN_HIGH),
                  {"1C 1E", {ask0}, goes_on_code},
                  {"11 1D", {}, done},
                  abort("1F", CO_SDO_ERR_LEN_SMALL),
                  abort("00-0F", CO_SDO_ERR_TBIT),
                  {"80", {}, 0x0E0D0C0B},
                  unknown}});
  all.push_back({"upload: second segment asked, nothing announced, buffer of 8",
                 true,
                 8,
                 initiate,
                 {{"585#4000200500000000", {ask0}}, first},
                 "08090A0B0C0D0E",
                 {abort("10-1B", CO_SDO_ERR_MEM),
                  {"1C 1E", {ask0}, goes_on_code},
                  {"1D 1F", {}, done},
                  abort("00-0F", CO_SDO_ERR_TBIT),
                  {"80", {}, 0x0E0D0C0B},
                  unknown}});
}

void add_segmented_download(States& all) {
  const std::string segment0 = "605#0001020304050607";
  const std::string segment1 = "605#1108090A0B0C0D0E";
  all.push_back({"download: expedited, initiate sent",
                 false,
                 4,
                 "605#2300200501020304",
                 {},
                 "00200504000000",
                 {{"60", {}, done}, {"80", {}, 0x00000004}, unknown}});
  all.push_back({"download: initiate sent",
                 false,
                 14,
                 "605#210020050E000000",
                 {},
                 "00200504000000",
                 {{"60", {segment0}, goes_on_code}, {"80", {}, 0x00000004}, unknown}});
  all.push_back({"download: first segment sent",
                 false,
                 14,
                 "605#210020050E000000",
                 {{"585#6000200500000000", {segment0}}},
                 "00000004000000",
                 {{"20", {segment1}, goes_on_code}, abort("30", CO_SDO_ERR_TBIT), {"80", {}, 0x00000004}, unknown}});
  all.push_back({"download: last segment sent",
                 false,
                 14,
                 "605#210020050E000000",
                 {{"585#6000200500000000", {segment0}}, {"585#2000000000000000", {segment1}}},
                 "00000004000000",
                 {{"30", {}, done}, abort("20", CO_SDO_ERR_TBIT), {"80", {}, 0x00000004}, unknown}});
}

#if CO_CSDO_BLOCK > 0

std::string acknowledge(unsigned sequence) {
  char text[24];
  std::snprintf(text, sizeof text, "605#A2%02X7F0000000000", sequence);
  return text;
}

// Returns the server's segment with this command byte, with the bytes of the object at its position.
std::string segment(unsigned command) {
  CO_IF_FRM frm = frame("585#0000000000000000");
  const Bytes data = counted(7, 7 * ((command & 0x7FU) - 1) + 1);
  frm.Data[0] = static_cast<std::uint8_t>(command);
  std::copy(data.begin(), data.end(), frm.Data + 1);
  return notation(frm);
}

std::vector<ClientState::Step> segments(unsigned number) {
  std::vector<ClientState::Step> path = {{"585#C000200500000000", {"605#A300000000000000"}}};
  for (unsigned n = 1; n <= number; ++n) {
    path.push_back({segment(n), {}});
  }
  return path;
}

void add_block_upload_initiate(States& all) {
  const std::string request = "605#A40020057F1C0000";
  const std::string start = "605#A300000000000000";
  const std::string ask0 = "605#6000000000000000";
  all.push_back({"block upload: initiate sent",
                 true,
                 889,
                 request,
                 {},
                 "00200504000000",
                 {{"C0 C2 C4 C6", {start}, goes_on_code},
                  {"40-41 44-45 48-49 4C-4D", {ask0}, goes_on_code},
                  {"42-43 46-47 4A-4B 4E-4F", {}, done},
                  {"80", {}, 0x00000004},
                  unknown}});
  all.push_back({"block upload: initiate sent, the server aborts with 0504 0001h",
                 true,
                 889,
                 request,
                 {},
                 "00200501000405",
                 {{"C0 C4", {start}, goes_on_code},
                  abort("C2 C6", CO_SDO_ERR_MEM),
                  {"40 44 48 4C", {ask0}, goes_on_code},
                  abort("41 45 49 4D", CO_SDO_ERR_MEM),
                  {"42-43 46-47 4A-4B 4E-4F", {}, done},
                  {"80", {"605#4000200500000000"}, goes_on_code},
                  unknown}});
}

// Adds the states of a block upload. A sub-block ends with segment 127 or with bit 7, even after a gap. [D22] Other
// segments out of order are ignored. Sequence number 0 is invalid. [5.2]
void add_block_upload(States& all) {
  const std::string request = "605#A40020057F1C0000";
  all.push_back({"block upload: started",
                 true,
                 1000,
                 request,
                 segments(0),
                 "01020304050607",
                 {abort("00", CO_SDO_ERR_SEQ_NUM),
                  {"01-7E", {}, goes_on_code},
                  {"81", {acknowledge(1)}, goes_on_code},
                  {"7F 82-FF", {acknowledge(0)}, goes_on_code},
                  {"80", {}, 0x07060504}}});
  all.push_back({"block upload: one segment taken",
                 true,
                 1000,
                 request,
                 segments(1),
                 "08090A0B0C0D0E",
                 {abort("00", CO_SDO_ERR_SEQ_NUM),
                  {"01-7E", {}, goes_on_code},
                  {"82", {acknowledge(2)}, goes_on_code},
                  {"7F 81 83-FF", {acknowledge(1)}, goes_on_code},
                  {"80", {}, 0x0E0D0C0B}}});
  all.push_back({"block upload: all segments but one taken",
                 true,
                 1000,
                 request,
                 segments(126),
                 segment(127).substr(6),
                 {abort("00", CO_SDO_ERR_SEQ_NUM),
                  {"01-7E", {}, goes_on_code},
                  {"7F FF", {acknowledge(127)}, goes_on_code},
                  {"81-FE", {acknowledge(126)}, goes_on_code},
                  {"80", {}, 0x79787776}}});
  std::vector<ClientState::Step> path = segments(2);
  path.push_back({segment(0x83), {acknowledge(3)}});
  all.push_back({"block upload: last segment taken",
                 true,
                 1000,
                 request,
                 path,
                 segment(0x83).substr(6),
                 {{"C1 C5 C9 CD D1 D5 D9 DD", {"605#A100000000000000"}, done},
                  {"83", {}, goes_on_code},
                  {"80", {}, 0x15141312},
                  unknown}});
}

// Adds the states of a block download of 40 bytes: 5 segments of 7 bytes and one of 5.
void add_block_download(States& all) {
  const std::string request = "605#C600200528000000";
  const std::vector<std::string> four = {"605#0101020304050607", "605#0208090A0B0C0D0E", "605#030F101112131415",
                                         "605#04161718191A1B1C"};
  const std::vector<std::string> two = {"605#011D1E1F20212223", "605#8224252627280000"};
  const ClientState::Step initiated = {"585#A000200504000000", four};
  const ClientState::Step acknowledged = {"585#A204020000000000", two};
  all.push_back({"block download: initiate sent",
                 false,
                 40,
                 request,
                 {},
                 "00200504000000",
                 {{"A0 A4", four, goes_on_code}, {"80", {}, 0x00000004}, unknown}});
  all.push_back({"block download: initiate sent, the server aborts with 0504 0001h",
                 false,
                 40,
                 request,
                 {},
                 "00200501000405",
                 {{"A0 A4", {four[0]}, goes_on_code}, {"80", {"605#2100200528000000"}, goes_on_code}, unknown}});
  all.push_back({"block download: first sub-block sent",
                 false,
                 40,
                 request,
                 {initiated},
                 "04020004000000",
                 {{"A2", two, goes_on_code}, {"A0 A4", {}, goes_on_code}, {"80", {}, 0x00000004}, unknown}});
  all.push_back(
      {"block download: last sub-block sent",
       false,
       40,
       request,
       {initiated, acknowledged},
       "02010004000000",
       {{"A2", {"605#C900000000000000"}, goes_on_code}, {"A0 A4", {}, goes_on_code}, {"80", {}, 0x00000004}, unknown}});
  all.push_back({"block download: end sent",
                 false,
                 40,
                 request,
                 {initiated, acknowledged, {"585#A202010000000000", {"605#C900000000000000"}}},
                 "00000004000000",
                 {{"A1", {}, done}, {"A2", {}, goes_on_code}, {"80", {}, 0x00000004}, unknown}});
}

#endif

States make_states() {
  States all;
  add_segmented_upload(all);
  add_segmented_download(all);
#if CO_CSDO_BLOCK > 0
  add_block_upload_initiate(all);
  add_block_upload(all);
  add_block_download(all);
#endif
  return all;
}

bool names(const std::string& commands, unsigned command) {
  for (const std::string& word : words_of(commands)) {
    const unsigned long first = std::stoul(word, nullptr, 16);
    const unsigned long last = word.size() > 2 ? std::stoul(word.substr(3), nullptr, 16) : first;
    if (command >= first && command <= last) {
      return true;
    }
  }
  return false;
}

}  // namespace

const std::vector<ClientState>& client_states() {
  static const States all = make_states();
  return all;
}

std::vector<const ClientReaction*> reactions_to(const ClientState& state, unsigned command) {
  std::vector<const ClientReaction*> found;
  for (const ClientReaction& reaction : state.reactions) {
    if (reaction.commands != "rest" && names(reaction.commands, command)) {
      found.push_back(&reaction);
    }
  }
  if (found.empty() && state.reactions.back().commands == "rest") {
    found.push_back(&state.reactions.back());
  }
  return found;
}

void enter(SdoClient& node, const ClientState& state, std::uint32_t timeout) {
  if (state.is_upload) {
    node.start_upload(0x2000, 5, state.size, timeout);
  } else {
    node.start_download(0x2000, 5, counted(state.size), timeout);
  }
  node.tx(state.request);
  for (const ClientState::Step& step : state.path) {
    node.rx(step.answer);
    CHECK(node.frames() == step.sent);
  }
}

}  // namespace test

#endif
