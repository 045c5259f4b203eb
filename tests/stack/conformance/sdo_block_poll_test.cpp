// SPDX-License-Identifier: Apache-2.0
// SDO server, block download: within a block, requests of a client that polls are treated as segments. Only frames that
// belong to the transfer restart its time-out. [301:7.2.4.3.10] [D18]
#include <algorithm>

#include "support/block_frames.hpp"

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

namespace {

using namespace test;

// Returns true if the server has aborted: after the time-out, or because the data exceed the size.
bool has_ended(Fixture& node) {
  const std::vector<std::string> sent = node.frames();
  return std::any_of(sent.begin(), sent.end(), [](const std::string& text) {
    return text == "581#8000210F00000405" || text == "581#8000210F12000706";
  });
}

// Sends one of the frames every 100 ms until the server has aborted. Returns the time that has passed.
Time poll(Fixture& node, const std::vector<CO_IF_FRM>& requests, Time limit) {
  Time passed{0};
  for (std::size_t n = 0; passed < limit; ++n) {
    node.after(100ms);
    passed += 100ms;
    if (has_ended(node)) {
      return passed;
    }
    node.rx(requests[n % requests.size()]);
    node.frames();
  }
  return limit;
}

void open_block_download(Fixture& node) { node.ask("601#C600210F0F000000", "581#A400210F7F000000"); }

TEST_CASE("SDO block download: a client that polls faster than the time-out with any request does not keep it open") {
  for (unsigned command = 0; command < 256; ++command) {
    if (command == 0x80) {
      continue;
    }
    CAPTURE(command);
    Fixture node(Setup().only_small());
    open_block_download(node);
    CO_IF_FRM request = frame("601#0000100000000000");
    request.Data[0] = static_cast<std::uint8_t>(command);
    CHECK(poll(node, {request}, 10s) <= 2 * node.sdo_time_out());
    node.ask("601#4000100000000000", "581#4300100091010F00");
  }
}

TEST_CASE("SDO block download: a client that polls with several requests does not keep it open") {
  const char* const polls[][4] = {
      {"601#4000100000000000", "601#4001100000000000", "601#6000000000000000", "601#7000000000000000"},
      {"601#2317100000000000", "601#4017100000000000", "601#2B17100000000000", "601#4000100000000000"},
      {"601#A40810007F000000", "601#A300000000000000", "601#A2017F0000000000", "601#A100000000000000"},
      {"601#A00810007F000000", "601#C000210000000000", "601#4000100000000000", "601#C100000000000000"},
      {"601#7F00000000000000", "601#FF00000000000000", "601#0200000000000000", "601#8200000000000000"}};
  for (const auto& some : polls) {
    CAPTURE(some[0]);
    Fixture node(Setup().only_small());
    open_block_download(node);
    std::vector<CO_IF_FRM> requests;
    for (const char* text : some) {
      requests.push_back(frame(text));
    }
    CHECK(poll(node, requests, 10s) <= 2 * node.sdo_time_out());
    node.ask("601#4000100000000000", "581#4300100091010F00");
  }
}

TEST_CASE("SDO block download: a repeated last segment without an end does not keep it open [D27]") {
  Fixture node(Setup().only_small());
  open_block_download(node);
  node.rx("601#0101020304050607");
  node.rx("601#0208090A0B0C0D0E");
  node.ask("601#830F000000000000", "581#A2037C0000000000");
  CHECK(poll(node, {frame("601#830F000000000000")}, 10s) <= node.sdo_time_out() + 100ms);
}

// The server acknowledges after a time without segments, so that each segment is the first of a block.
TEST_CASE("SDO block download: a client that sends a segment every 1.5 s completes the transfer [D18]") {
  Fixture node(Setup().only_small());
  const Bytes data = counting(15, 0x21);
  open_block_download(node);
  for (std::size_t place = 0; place < 3; ++place) {
    node.after(1500ms);
    CHECK_FALSE(has_ended(node));
    node.rx(block_segment(data, place, 1));
  }
  node.frames();
  node.after(1500ms);
  node.frames();
  node.rx(block_end(0x601, data));
  node.tx("581#A100000000000000");
  CHECK(node.objects.memory[15] == data);
}

}  // namespace

#endif
