// SPDX-License-Identifier: Apache-2.0
// SDO server: block transfers while the controller refuses frames. [D20] [T12]
#include <algorithm>
#include <string>

#include "support/block_frames.hpp"
#include "support/logged_stream.hpp"
#include "support/real_time_fixture.hpp"
#include "support/sdo_client_fixture.hpp"

namespace {

using namespace test;

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

void finish_upload(Fixture& node, std::uint8_t ackseq) {
  node.rx(CO_IF_FRM{0x601, {0xA2, ackseq, 0x7F}, 8});
  if (ackseq == 127) {
    expect_segments(node, counting(890), 127, 1);
    node.rx("601#A2017F0000000000");
  }
  node.tx(notation(block_end(0x581, counting(890))));
  node.rx("601#A100000000000000");
  node.silent();
}

// Runs a block upload and a block download. Returns the frames of the server.
std::vector<std::string> session(Fixture& node) {
  std::vector<std::string> all;
  const auto say = [&](const CO_IF_FRM& frm) {
    node.rx(frm);
    for (int i = 0; i < 4; ++i) node.loop();
    for (const std::string& sent : node.frames()) all.push_back(sent);
  };
  for (const char* request : {"601#A400210F02000000", "601#A300000000000000", "601#A202020000000000",
                              "601#A201020000000000", "601#A100000000000000", "601#C600210F0F000000",
                              "601#0111121314151617", "601#0218191A1B1C1D1E", "601#831F000000000000"}) {
    say(frame(request));
  }
  say(block_end(0x601, counting(15, 0x11)));
  CHECK(node.objects.memory[15] == counting(15, 0x11));
  return all;
}

TEST_CASE("SDO block: no frame is lost or repeated, whichever ones the controller refuses [D20] [T12]") {
  Fixture undisturbed;
  const std::vector<std::string> expected = session(undisturbed);
  REQUIRE(expected.size() == 8);
  for (const std::int16_t refusal : {std::int16_t{0}, std::int16_t{-1}}) {
    for (const std::uint64_t times : {1U, 2U, 3U}) {
      for (std::uint64_t n = 1; n <= expected.size(); ++n) {
        CAPTURE(refusal);
        CAPTURE(times);
        CAPTURE(n);
        Fixture node;
        node.can.refuse_nth(n, refusal);
        node.can.refuse_to += times - 1;
        CHECK(session(node) == expected);
        CHECK(node.error() == (refusal == 0 ? CO_ERR_NONE : CO_ERR_IF_CAN_SEND));
        CHECK(node.counters().Dropped == 0);
      }
    }
  }
}

TEST_CASE("SDO block upload: it pauses at any segment and resumes with the next one [D20]") {
  for (std::uint64_t taken = 0; taken < 127; ++taken) {
    CAPTURE(taken);
    Fixture node;
    node.ask("601#A40421007F000000", "581#C60421007A030000");
    node.can.accept_next(taken);
    node.rx("601#A300000000000000");
    node.loop();
    const std::vector<std::string> first = node.frames();
    CHECK(first.size() == taken);
    node.can.accept_all();
    node.loop();
    std::vector<std::string> rest = node.frames();
    CHECK(rest.size() == 127 - taken);
    rest.insert(rest.begin(), first.begin(), first.end());
    for (std::size_t n = 0; n < rest.size(); ++n) {
      CO_IF_FRM segment = block_segment(counting(890), n, static_cast<unsigned>(n + 1));
      segment.Identifier = 0x581;
      CHECK(rest[n] == notation(segment));
    }
    finish_upload(node, 127);
  }
}

TEST_CASE("SDO block upload: it works with a controller that accepts a few frames at a time [D20]") {
  for (const std::uint64_t places : {1U, 2U, 3U, 16U}) {
    CAPTURE(places);
    Fixture node;
    node.ask("601#A40421007F000000", "581#C60421007A030000");
    node.can.accept_next(places);
    node.rx("601#A300000000000000");
    std::vector<std::string> all = node.frames();
    for (unsigned calls = 0; calls < 127 && all.size() < 127; ++calls) {
      node.can.accept_next(places);
      node.loop();
      const std::vector<std::string> some = node.frames();
      CHECK(some.size() <= places);
      all.insert(all.end(), some.begin(), some.end());
    }
    CHECK(all.size() == 127);
    CHECK(all.back() ==
          "581#7F737475767778"
          "79");
    node.can.accept_all();
    finish_upload(node, 127);
  }
}

TEST_CASE("SDO block upload: other frames are sent between its segments, and first [D20] [Q4]") {
  Fixture node(Setup().heartbeat(100));
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.accept_next(50);
  node.rx("601#A300000000000000");
  expect_segments(node, counting(890), 0, 50);
  CO_IF_FRM urgent = frame("081#0102030405060708");
  node.after(100ms);
  node.call([&] { COIfCanSend(&node->If, &urgent); });
  node.silent();
  node.can.accept_next(2);
  node.loop();
  node.tx({"081#0102030405060708", "701#7F"});
  node.can.accept_all();
  node.loop();
  const std::vector<std::string> rest = node.frames();
  REQUIRE(rest.size() == 77);
  CHECK(rest.front().substr(0, 6) == "581#33");
  CHECK(rest.back().substr(0, 6) == "581#7F");
}

TEST_CASE("SDO block upload: heartbeats keep their period during a paused upload [D20]") {
  Fixture node(Setup().heartbeat(50));
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.accept_next(0);
  node.rx("601#A300000000000000");
  unsigned heartbeats = 0;
  std::vector<std::string> segments;
  for (unsigned n = 0; n < 40; ++n) {
    node.after(25ms);
    node.can.accept_next(4);
    node.loop();
    for (const std::string& sent : node.frames()) {
      sent == "701#7F" ? void(++heartbeats) : segments.push_back(sent);
    }
  }
  CHECK(heartbeats == 20);
  CHECK(segments.size() == 127);
  node.can.accept_all();
}

TEST_CASE("SDO block upload: segments do not fill the transmit queue [D20]") {
  Fixture node(Setup().tx_queue(4));
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.refuse_all();
  node.rx("601#A300000000000000");
  node.loop();
  CHECK(node->TxQueue.Num == 0);
  CO_IF_FRM frm = frame("181#01");
  node.call([&] { CHECK(COIfCanSend(&node->If, &frm) == sizeof(CO_IF_FRM)); });
  node.can.accept_all();
  node.loop();
  std::vector<std::string> sent = node.frames();
  REQUIRE(sent.size() == 128);
  CHECK(sent.front() == "181#01");
  CHECK(sent.back().substr(0, 6) == "581#7F");
}

TEST_CASE("SDO block upload: a paused one resumes in a loop that sleeps until CONodeNextDeadline() [D20]") {
  Fixture node(Setup().wake(Wake::deadline));
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.accept_next(5);
  node.rx("601#A300000000000000");
  expect_segments(node, counting(890), 0, 5);
  CHECK(CONodeNextDeadline(&node.node) == 1);
  node.can.accept_all();
  node.after(1ms);
  CHECK(node.frames().size() == 122);
  CHECK(CONodeNextDeadline(&node.node) > 1);
}

TEST_CASE("SDO block upload: a slow controller does not cause a time-out of the client [D18] [D20]") {
  Fixture node;
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.accept_next(1);
  node.rx("601#A300000000000000");
  std::vector<std::string> all = node.frames();
  while (all.size() < 127) {
    node.can.accept_next(1);
    node.after(1000ms);
    node.loop();
    const std::vector<std::string> some = node.frames();
    REQUIRE(some.size() == 1);
    all.push_back(some[0]);
    REQUIRE(some[0].substr(0, 6) != "581#80");
  }
  node.can.accept_all();
  finish_upload(node, 127);
}

TEST_CASE("SDO block upload: a controller that refuses frames for long ends the transfer [D18] [D20]") {
  Fixture node;
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.refuse_all();
  node.rx("601#A300000000000000");
  node.after(3 * node.sdo_time_out());
  node.silent();
  node.can.accept_all();
  node.loop();
  node.frames();
  node.after(node.sdo_time_out());
  node.frames();
  node.ask("601#A3DEADBE00000000", "581#80DEADBE01000405");
  CHECK(node.block_upload(0x2104, 0).data == counting(890));
}

TEST_CASE(
    "SDO block upload: an acknowledge before all segments are sent begins the next block after them [D12] [D20]") {
  Fixture node;
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.accept_next(10);
  node.rx("601#A300000000000000");
  expect_segments(node, counting(890), 0, 10);
  node.rx("601#A204140000000000");
  node.silent();
  node.can.accept_all();
  node.loop();
  expect_segments(node, counting(890), 4, 20);
  node.rx("601#A214700000000000");
  expect_segments(node, counting(890), 24, 104);
  finish_upload(node, 104);
}

TEST_CASE("SDO block upload: an acknowledge of more segments than sent is aborted [D12] [D20]") {
  Fixture node;
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.accept_next(10);
  node.rx("601#A300000000000000");
  expect_segments(node, counting(890), 0, 10);
  node.rx("601#A20B140000000000");
  node.can.accept_all();
  node.loop();
  node.tx("581#8004210003000405");
}

TEST_CASE("SDO block upload: its end is queued like other answers [T12]") {
  Fixture node;
  node.ask("601#A40010007F000000", "581#C600100004000000");
  node.ask("601#A300000000000000", "581#8191010F00000000");
  node.can.refuse_all();
  node.rx("601#A2017F0000000000");
  node.silent();
  node.can.accept_all();
  node.loop();
  node.tx("581#CD25970000000000");
  node.rx("601#A100000000000000");
  node.silent();
}

TEST_CASE("SDO block download: refused answers are sent later and no segment counts twice [T12]") {
  for (const bool sized : {true, false}) {
    Fixture node;
    const Bytes data = counting(890, 31);
    node.can.refuse_all();
    node.rx(sized ? "601#C60421007A030000" : "601#C404210000000000");
    node.can.accept_all();
    node.loop();
    node.tx("581#A40421007F000000");
    node.can.refuse_all();
    send_segments(node, data, 0, 127);
    node.can.accept_all();
    node.loop();
    node.tx("581#A27F7F0000000000");
    node.can.refuse_all();
    send_segments(node, data, 127, 1);
    node.can.accept_all();
    node.loop();
    expect_last_ack(node, 1);
    node.can.refuse_all();
    node.rx(block_end(0x601, data));
    node.silent();
    CHECK(node.objects.memory[890] == data);
    node.can.accept_all();
    node.loop();
    node.tx("581#A100000000000000");
  }
}

// Returns the frames sent by one call, with or without a received frame.
std::vector<std::string> call_once(Fixture& node, std::string_view received = {}) {
  node.calls(1);
  received.empty() ? node.loop() : node.rx(received);
  node.calls(Fixture::enough_calls);
  return node.frames();
}

constexpr std::size_t pace = CO_SDO_BLOCK_PACE;

TEST_CASE("SDO block upload: each call sends a limited number of segments; the rest is due at once [T17] [Q2]") {
  Fixture node(Setup().only_small().with_mebibyte());
  node.ask("601#A40521007F000000", "581#C605210000001000");
  std::vector<std::string> sent = call_once(node, "601#A300000000000000");
  for (std::size_t number = sent.size(); number < 127; number += sent.size()) {
    CAPTURE(number);
    CHECK(sent.size() <= pace);
    CHECK(CONodeNextDeadline(&node.node) == 0);
    sent = call_once(node);
    REQUIRE(sent.size() == std::min(pace, 127 - number));
  }
  CHECK(CONodeNextDeadline(&node.node) != 0);
  CHECK(call_once(node).empty());
  node.rx("601#A27F010000000000");
  CHECK(node.frames().size() == 1);
  node.rx("601#8005210000000008");
}

TEST_CASE("SDO block upload: frames sent between two of its calls are not delayed until its end [T17] [Q4]") {
  Fixture node(Setup().only_small().with_mebibyte());
  node.ask("601#A40521007F000000", "581#C605210000001000");
  CHECK(call_once(node, "601#A300000000000000").size() == pace);
  CO_IF_FRM urgent = frame("181#01");
  node.call([&] { COIfCanSend(&node->If, &urgent); });
  node.tx("181#01");
  node.loop();
  CHECK(node.frames().size() == 127 - std::min<std::size_t>(pace, 127));
  node.rx("601#8005210000000008");
}

#if CO_SSDO_N > 1
TEST_CASE("SDO block upload: servers share the segments of a call in rotation [T17] [D20]") {
  Fixture node(Setup().before_init([](Objects& objects) {
    objects.sdo2_rx = 0x640;
    objects.sdo2_tx = 0x5C0;
  }));
  node.ask("601#A00421007F000000", "581#C60421007A030000");
  node.ask("640#A00321007F000000", "5C0#C603210078030000");
  std::vector<std::string> first = call_once(node, "601#A300000000000000");
  std::vector<std::string> all = call_once(node, "640#A300000000000000");
  CHECK(first.size() == pace);
  CHECK(all.size() <= pace);
  for (unsigned calls = 0; calls < 300 && first.size() + all.size() < 254; ++calls) {
    const std::vector<std::string> sent = call_once(node);
    CHECK(sent.size() <= pace);
    CHECK(!sent.empty());
    if (first.size() + all.size() < 127) {
      CHECK(sent.front().substr(0, 3) == sent.back().substr(0, 3));
      CHECK(sent.front().substr(0, 3) != all.back().substr(0, 3));
    }
    all.insert(all.end(), sent.begin(), sent.end());
  }
  CHECK(first.size() + all.size() == 254);
  node.rx("601#8000000000000008");
  node.rx("640#8000000000000008");
}
#endif

#endif

// An application that calls CONodeProcess() only when a frame has arrived, and COTmrProcess() cyclically:
// COTmrProcess() continues paused block transfers, and sends frames that the driver has refused. [T12] [T17] [D20]

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

// SDO: several block transfers with a slow controller, and ambiguous frames.

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

#if CO_SSDO_N > 1
// Returns the CAN-IDs of the frames sent by a controller that accepts one frame at a time.
std::vector<std::uint32_t> senders(Fixture& node, unsigned frames) {
  std::vector<std::uint32_t> ids;
  while (ids.size() < frames) {
    node.can.accept_next(1);
    node.loop();
    for (const std::string& text : node.frames()) {
      ids.push_back(frame(text).Identifier);
    }
  }
  return ids;
}

TEST_CASE("SDO block upload: channels send in rotation, however few frames the controller accepts [D20]") {
  Fixture node(Setup().before_init([](Objects& objects) {
    objects.sdo2_rx = 0x640;
    objects.sdo2_tx = 0x5C0;
  }));
  node.ask("601#A00421007F000000", "581#C60421007A030000");
  node.ask("640#A00321007F000000", "5C0#C603210078030000");
  node.can.refuse_all();
  node.rx("601#A300000000000000");
  node.rx("640#A300000000000000");
  const std::vector<std::uint32_t> ids = senders(node, 40);
  for (std::size_t n = 1; n < ids.size(); ++n) {
    CAPTURE(n);
    CHECK(ids[n] != ids[n - 1]);
  }
  node.can.refuse_all();
  node.rx("601#8000000000000008");
  node.rx("640#8000000000000008");
  node.can.accept_all();
}
#endif

// 617 bytes are 88 segments and one byte: the last segment and the end request are equal, D9h and seven bytes 0.
TEST_CASE("SDO block download: a frame equal to the last segment is the end if length and CRC are right [D27]") {
  for (const char* initiate : {"601#C202210069020000", "601#C602210069020000"}) {
    CAPTURE(initiate);
    Fixture node(Setup().with_70000());
    node.may_change(0x2102, 0);  // the fixture treats this end request as a repeated segment
    const Bytes zeros(617);
    node.ask(initiate, "581#A40221007F000000");
    for (unsigned n = 0; n < 89; ++n) {
      node.rx(block_segment(zeros, n, n + 1));
    }
    node.tx("581#A259260000000000");
    node.ask("601#D900000000000000", "581#A100000000000000");
    CHECK(node.objects.memory[70000][616] == 0);
  }
}

TEST_CASE("SDO stream types: a long object without Reset is refused for block uploads, which may be repeated") {
  LoggedStream stream;
  stream.data = counting(2000);
  CO_OBJ entry = stream.extended(0x2300);
  CO_OBJ_TYPE_EX type = *reinterpret_cast<const CO_OBJ_TYPE_EX*>(entry.Type);
  type.Reset = nullptr;
  entry.Type = &type.Type;
  Fixture node(Setup().with(entry));
  node.ask("601#A40023007F000000", "581#8000230001000405");
  stream.data = counting(889);
  node.ask("601#A40023007F000000", "581#C600230079030000");
  node.rx("601#8000230000000008");
}

TEST_CASE("SDO block upload: its time-out runs although its type changes the NMT state meanwhile [D18]") {
  LoggedStream stream;
  stream.data = counting(1900);
  unsigned reads = 0;
  stream.on_piece = [&](CO_OBJ*, CO_NODE* node) {
    if (++reads == 2) {
      CONmtSetMode(&node->Nmt, CO_STOP);
      CONmtSetMode(&node->Nmt, CO_PREOP);
    }
    return CO_ERR_NONE;
  };
  Fixture node(Setup().with(stream.extended(0x2300)));
  node.ask("601#A00023007F000000", "581#C60023006C070000");
  node.rx("601#A300000000000000");
  node.frames();
  node.can.accept_next(20);
  node.rx("601#A23C7F0000000000");
  node.can.accept_all();
  node.loop();
  node.frames();
  node.after(node.sdo_time_out());
  for (const std::string& text : node.frames()) {
    CHECK(text == "581#8000230000000405");
  }
  CHECK(stream.log.back().substr(0, 3) == "end");
}

#endif

#if USE_CSDO && USE_CSDO_OWN

TEST_CASE("SDO client, own node: after a cancel in a type function the buffer stays valid until the callback") {
  LoggedStream stream;
  SdoClient node(Setup().only_small().with(stream.extended(0x2300)), local_entries());
  stream.on_open = [&](CO_OBJ*, CO_NODE* of) {
    CHECK(COCSdoCancel(&of->CSdo[0]) == CO_ERR_NONE);
    CHECK(of->CSdo[0].State ==
          CO_CSDO_STATE_BUSY);  // The buffer remains valid until the callback, which is called later.
    return CO_ERR_NONE;
  };
  node.start_download(0x2300, 0, counted(40));
  node.after(10ms);
  REQUIRE(node.ends.size() == 1);
  CHECK(node.ends.front().code == 0x08000021);
  node.ends.clear();
  CHECK(stream.data == counted(40));
}

#endif

}  // namespace
