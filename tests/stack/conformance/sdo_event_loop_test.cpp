// SPDX-License-Identifier: Apache-2.0
// An application that calls CONodeProcess() only when a frame has arrived, and COTmrProcess() cyclically:
// COTmrProcess() continues paused block transfers, and sends frames that the driver has refused. [T12] [T17] [D20]
#include <algorithm>

#include "support/block_frames.hpp"
#include "support/logged_stream.hpp"
#include "support/real_time_fixture.hpp"
#include "support/sdo_client_fixture.hpp"

namespace {

using namespace test;

constexpr std::size_t pace = CO_SDO_BLOCK_PACE;

enum class Call { always, when_elapsed };

// Lets 1 ms pass. Returns the frames sent by COTmrProcess().
std::vector<std::string> tick(Fixture& node, Call call = Call::always) {
  node.idle(1ms);
  node.call([&] {
    if (COTmrService(&node->Tmr) > 0 || call == Call::always) {
      COTmrProcess(&node->Tmr);
    }
  });
  return node.frames();
}

[[maybe_unused]] void append(std::vector<std::string>& all, const std::vector<std::string>& some) {
  all.insert(all.end(), some.begin(), some.end());
}

TEST_CASE("loop without idle calls: frames that the driver has refused are sent by COTmrProcess() [T12]") {
  for (const Call call : {Call::always, Call::when_elapsed}) {
    Fixture node;
    node.calls(1);
    node.can.refuse_all();
    node.rx("601#4000100000000000");
    CO_IF_FRM urgent = frame("081#0102030405060708");
    node.call([&] { COIfCanSend(&node->If, &urgent); });
    CHECK(tick(node, call).empty());
    CHECK(CONodeNextDeadline(&node.node) == 1);
    node.can.accept_next(1);
    CHECK(tick(node, call) == std::vector<std::string>{"081#0102030405060708"});
    node.can.accept_all();
    CHECK(tick(node, call) == std::vector<std::string>{"581#4300100091010F00"});
    CHECK(CONodeNextDeadline(&node.node) > 1);
    CHECK(tick(node, call).empty());
  }
}

TEST_CASE("loop without idle calls: a boot-up message that the driver has refused is sent by COTmrProcess()") {
  Fixture node(Setup().stay_in_init());
  node.can.refuse_all();
  node.call([&] { CONodeStart(&node.node); });
  CHECK(tick(node).empty());
  node.can.accept_all();
  CHECK(tick(node) == std::vector<std::string>{"701#00"});
}

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

void begin_upload(Fixture& node) {
  node.calls(1);
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.rx("601#A300000000000000");
}

void check_segments(const std::vector<std::string>& sent, const Bytes& data, std::uint32_t identifier) {
  for (std::size_t n = 0; n < sent.size(); ++n) {
    CO_IF_FRM segment = block_segment(data, n, static_cast<unsigned>(n + 1));
    segment.Identifier = identifier;
    CHECK(sent[n] == notation(segment));
  }
}

TEST_CASE("loop without idle calls: COTmrProcess() continues a block upload of the server within the segment limit") {
  for (const Call call : {Call::always, Call::when_elapsed}) {
    Fixture node;
    begin_upload(node);
    std::vector<std::string> all = node.frames();
    CHECK(all.size() == std::min<std::size_t>(pace, 127));
    while (all.size() < 127) {
      CHECK(CONodeNextDeadline(&node.node) == 0);
      const std::vector<std::string> some = tick(node, call);
      REQUIRE(some.size() == std::min<std::size_t>(pace, 127 - all.size()));
      append(all, some);
    }
    check_segments(all, counting(890), 0x581);
    CHECK(CONodeNextDeadline(&node.node) != 0);
    CHECK(tick(node, call).empty());
    node.rx("601#A27F7F0000000000");
    expect_segments(node, counting(890), 127, 1);
    node.rx("601#A2017F0000000000");
    node.tx(notation(block_end(0x581, counting(890))));
    node.rx("601#A100000000000000");
    node.silent();
  }
}

TEST_CASE("loop without idle calls: a block upload is continued with a driver that refuses frames temporarily") {
  for (const std::uint64_t places : {1U, 3U, 16U, 100U}) {
    CAPTURE(places);
    Fixture node;
    node.can.refuse_all();
    node.calls(1);
    node.rx("601#A40421007F000000");
    CHECK(tick(node).empty());
    node.can.accept_all();
    CHECK(tick(node) == std::vector<std::string>{"581#C60421007A030000"});
    node.can.refuse_all();
    node.rx("601#A300000000000000");
    CHECK(tick(node).empty());
    std::vector<std::string> all;
    for (unsigned n = 0; n < 200 && all.size() < 127; ++n) {
      node.can.accept_next(places);
      const std::vector<std::string> some = tick(node);
      CHECK(some.size() <= std::min<std::uint64_t>(pace, places));
      append(all, some);
    }
    CHECK(all.size() == 127);
    check_segments(all, counting(890), 0x581);
    node.can.accept_all();
    node.rx("601#8004210000000008");
  }
}

TEST_CASE("loop without idle calls: answers to a block download that the driver refuses are sent later") {
  Fixture node;
  const Bytes data = counting(890, 31);
  node.calls(1);
  node.can.refuse_all();
  node.rx("601#C60421007A030000");
  node.can.accept_all();
  CHECK(tick(node) == std::vector<std::string>{"581#A40421007F000000"});
  node.can.refuse_all();
  send_segments(node, data, 0, 127);
  node.can.accept_all();
  CHECK(tick(node) == std::vector<std::string>{"581#A27F7F0000000000"});
  send_segments(node, data, 127, 1);
  expect_last_ack(node, 1);
  node.can.refuse_all();
  node.rx(block_end(0x601, data));
  node.can.accept_all();
  CHECK(tick(node) == std::vector<std::string>{"581#A100000000000000"});
  CHECK(node.objects.memory[890] == data);
}

TEST_CASE("loop without idle calls: a loop may sleep until CONodeNextDeadline and call only COTmrProcess()") {
  Fixture node;
  begin_upload(node);
  std::vector<std::string> all = node.frames();
  for (unsigned calls = 0; calls < 10 && all.size() < 127; ++calls) {
    const std::uint32_t deadline = CONodeNextDeadline(&node.node);
    REQUIRE(deadline <= 1);
    node.idle(std::chrono::milliseconds{deadline});
    node.call([&] {
      COTmrService(&node->Tmr);
      COTmrProcess(&node->Tmr);
    });
    append(all, node.frames());
  }
  CHECK(all.size() == 127);
  node.rx("601#8004210000000008");
}

#if USE_OBJ_EX
// Runs an upload until 37 segments are left in the buffer, so that COTmrProcess() reads the second piece of the object.
void read_second_piece(Fixture& node) {
  node.calls(1);
  node.ask("601#A40031007F000000", "581#C600310008070000");
  node.rx("601#A300000000000000");
  while (!tick(node).empty()) {
  }
  node.frames();
  node.rx("601#A25A7F0000000000");
  CHECK(node.frames().size() == pace);
}

TEST_CASE("loop without idle calls: requests of a type function in COTmrProcess() follow the segments") {
  if (pace >= 37) {
    return;
  }
  LoggedStream stream;
  stream.data = counting(1800);
  Fixture node(Setup().only_small().with(stream.extended(0x3100)));
  read_second_piece(node);
  stream.on_piece = [](CO_OBJ*, CO_NODE* of) {
    CONmtReset(&of->Nmt, CO_RESET_COM);
    CHECK(of->Nmt.Mode == CO_PREOP);
    return CO_ERR_NONE;
  };
  const std::vector<std::string> sent = tick(node);
  REQUIRE_FALSE(sent.empty());
  CHECK(sent.back() == "701#00");
  CHECK(stream.log.back() == "end up 08000022");
}

TEST_CASE("loop without idle calls: a type function may stop the node in COTmrProcess()") {
  if (pace >= 37) {
    return;
  }
  LoggedStream stream;
  stream.data = counting(1800);
  Fixture node(Setup().only_small().with(stream.extended(0x3100)));
  read_second_piece(node);
  stream.on_piece = [](CO_OBJ*, CO_NODE* of) {
    CONodeStop(of);
    return CO_ERR_NONE;
  };
  tick(node);
  CHECK(node.mode() == CO_INVALID);
  CHECK(tick(node).empty());
}
#endif

#if USE_CSDO && CO_CSDO_BLOCK > 0

TEST_CASE("loop without idle calls: COTmrProcess() continues a block download of the client within the segment limit") {
  SdoClient node;
  node.calls(1);
  node.start_download(0x2000, 5, counted(890));
  node.tx("605#C60020057A030000");
  node.rx("585#A40020057F000000");
  std::vector<std::string> all = node.frames();
  CHECK(all.size() == std::min<std::size_t>(pace, 127));
  while (all.size() < 127) {
    const std::vector<std::string> some = tick(node);
    REQUIRE(some.size() == std::min<std::size_t>(pace, 127 - all.size()));
    append(all, some);
  }
  check_segments(all, counted(890), 0x605);
  node.rx("585#A27F7F0000000000");
  CHECK(node.frames().size() == 1);
  node.rx("585#A2017F0000000000");
  node.tx(notation(block_end(0x605, counted(890))));
  node.rx("585#A100000000000000");
  node.has_written();
}

TEST_CASE("loop without idle calls: requests of the client that the driver refuses are sent later") {
  SdoClient node;
  node.calls(1);
  node.can.refuse_all();
  node.start_upload(0x2000, 5, 1000);
  node.can.accept_all();
  CHECK(tick(node) == std::vector<std::string>{"605#A40020057F1C0000"});
  node.can.refuse_all();
  node.rx("585#C60020051E000000");
  node.can.accept_all();
  CHECK(tick(node) == std::vector<std::string>{"605#A300000000000000"});
  node.can.refuse_all();
  const Bytes data = counted(30);
  for (unsigned n = 0; n < 5; ++n) {
    CO_IF_FRM segment = block_segment(data, n, n + 1);
    segment.Identifier = 0x585;
    node.rx(segment);
  }
  node.can.accept_all();
  CHECK(tick(node) == std::vector<std::string>{"605#A2057F0000000000"});
  node.can.refuse_all();
  node.rx(block_end(0x585, data));
  node.can.accept_all();
  CHECK(tick(node) == std::vector<std::string>{"605#A100000000000000"});
  node.has_read(data);
}

TEST_CASE("loop without idle calls: server and client share the segments of a call") {
  SdoClient node{Setup()};
  begin_upload(node);
  std::vector<std::string> all = node.frames();
  node.start_download(0x2000, 5, counted(890));
  node.tx("605#C60020057A030000");
  node.rx("585#A40020057F000000");
  append(all, node.frames());
  for (unsigned n = 0; n < 20; ++n) {
    const std::vector<std::string> some = tick(node);
    CHECK(some.size() <= pace);
    append(all, some);
  }
  const auto of_server = std::count_if(all.begin(), all.end(), [](const auto& text) { return text[0] == '5'; });
  CHECK(of_server == 127);
  CHECK(all.size() == 254);
  node.cancel();
  node.frames();
  node.ended(CO_SDO_ERR_TOS_LOCAL);
  node.rx("601#8004210000000008");
}

#endif

#if USE_REAL_TIME
TEST_CASE("loop without idle calls: with a node lock COTmrProcess() holds it while it continues a block upload") {
  Fixture node(Setup().turns());
  begin_upload(node);
  std::vector<std::string> all = node.frames();
  unsigned turns = 0;
  callbacks().enter = [&] { ++turns; };
  for (unsigned calls = 1; all.size() < 127; ++calls) {
    const std::vector<std::string> some = tick(node);
    REQUIRE(some.size() == std::min<std::size_t>(pace, 127 - all.size()));
    append(all, some);
    CHECK(turns == calls);
  }
  check_segments(all, counting(890), 0x581);
  node.rx("601#8004210000000008");
}
#endif

#endif

#if USE_REAL_TIME
TEST_CASE(
    "loop without idle calls: with a real-time thread COTmrProcess() sends refused frames and carries out no reset") {
  RealTimeNode node;
  node.can.refuse_all();
  node.arrive("601#4000100000000000");
  node.real_time();
  node.call([&] { CONodeProcess(&node.node); });
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_COM); });
  node.can.accept_all();
  CHECK(tick(node) == std::vector<std::string>{"581#4300100091010F00"});
  node.mainline();
  node.tx("701#00");
}
#endif

}  // namespace
