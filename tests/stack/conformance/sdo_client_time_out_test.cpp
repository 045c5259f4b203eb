// SPDX-License-Identifier: Apache-2.0
// SDO client: time-outs. [301:7.2.4.3.17] [D18] [C1]
#include "support/sdo_client_peer.hpp"
#include "support/sdo_client_states.hpp"

#if USE_CSDO

namespace {

using namespace test;

constexpr const char* time_out_abort = "605#8000200500000405";

// Returns the frames without acknowledges, which a client repeats within a sub-block before the time-out.
std::vector<std::string> without_acknowledges(std::vector<std::string> frames) {
  const auto is_acknowledge = [](const std::string& text) { return text.compare(0, 6, "605#A2") == 0; };
  frames.erase(std::remove_if(frames.begin(), frames.end(), is_acknowledge), frames.end());
  return frames;
}

// Returns true for states in which the time-out is checked in quarters and may be a quarter longer.
bool is_within_block(const ClientState& state) {
  return state.name == "block upload: one segment taken" || state.name == "block upload: all segments but one taken";
}

TEST_CASE("SDO client: silence of the server ends the transfer at the configured time in every state") {
  for (const ClientState& state : client_states()) {
    CAPTURE(state.name);
    for (const int ms : {1000, 100, 8}) {
      CAPTURE(ms);
      SdoClient node;
      enter(node, state, static_cast<std::uint32_t>(ms));
      node.after(std::chrono::milliseconds{ms - 1});
      node.goes_on();
      CHECK(without_acknowledges(node.frames()).empty());
      node.after(std::chrono::milliseconds{is_within_block(state) ? ms / 4 + 1 : 1});
      CHECK(without_acknowledges(node.frames()) == std::vector<std::string>{time_out_abort});
      node.ended(CO_SDO_ERR_TIMEOUT);
      node.after(5000ms);
      node.silent();
    }
  }
}

TEST_CASE("SDO client: time-outs are not early and at most the rounded-up quarters late, also for odd times") {
  for (const ClientState& state : client_states()) {
    CAPTURE(state.name);
    for (const int ms : {1, 2, 3, 5, 7, 11, 13, 101}) {
      CAPTURE(ms);
      SdoClient node;
      enter(node, state, static_cast<std::uint32_t>(ms));
      node.after(std::chrono::milliseconds{ms - 1});
      node.goes_on();
      node.frames();
      const int quarter = (ms + 3) / 4;
      node.after(std::chrono::milliseconds{(is_within_block(state) ? 5 : 4) * quarter - ms + 1});
      CHECK(without_acknowledges(node.frames()) == std::vector<std::string>{time_out_abort});
      node.ended(CO_SDO_ERR_TIMEOUT);
    }
  }
}

TEST_CASE("SDO client: each answer of the server restarts the time-out") {
  SdoClient node;
  node.start_upload(0x2000, 5, 28, 100);
  node.tx("605#4000200500000000");
  node.after(99ms);
  node.rx("585#410020051C000000");
  node.tx("605#6000000000000000");
  node.after(99ms);
  node.rx("585#0001020304050607");
  node.tx("605#7000000000000000");
  node.after(99ms);
  node.goes_on();
  node.silent();
  node.after(1ms);
  node.tx(time_out_abort);
  CHECK(node.ended(CO_SDO_ERR_TIMEOUT).num == 7);
}

TEST_CASE("SDO client: segments without data do not restart the time-out [D18]") {
  SdoClient node;
  node.start_upload(0x2000, 5, 28, 100);
  node.tx("605#4000200500000000");
  node.rx("585#410020051C000000");
  node.tx("605#6000000000000000");
  node.after(60ms);
  node.rx("585#0E00000000000000");
  node.tx("605#7000000000000000");
  node.after(39ms);
  node.silent();
  node.after(1ms);
  node.tx(time_out_abort);
  CHECK(node.ended(CO_SDO_ERR_TIMEOUT).num == 0);
}

TEST_CASE("SDO client: a time-out of 0 disables it in every state") {
  for (const ClientState& state : client_states()) {
    CAPTURE(state.name);
    SdoClient node;
    enter(node, state, 0);
    CHECK_FALSE(node.is_watched());
    CHECK(CONodeNextDeadline(&node.node) == 0xFFFFFFFF);
    node.after(std::chrono::hours{24});
    node.goes_on();
    CHECK(without_acknowledges(node.frames()).empty());
    node.cancel();
    CHECK(node.frames() == std::vector<std::string>{"605#8000200521000008"});
    node.ended(CO_SDO_ERR_TOS_LOCAL);
  }
}

TEST_CASE("SDO client: time-outs of more than 16 bits are not truncated") {
  SdoClient node;
  node.start_upload(0x2000, 5, 4, 65536 + 10);
  node.tx("605#4000200500000000");
  node.after(65545ms);
  node.goes_on();
  node.after(1ms);
  node.tx(time_out_abort);
  node.ended(CO_SDO_ERR_TIMEOUT);
}

TEST_CASE("SDO client: a time-out of 40 minutes is counted by a timer of 1 MHz") {
  SdoClient node(Setup().only_small().rate(1000000));
  node.start_upload(0x2000, 5, 4, 40 * 60 * 1000);
  node.tx("605#4000200500000000");
  node.after(std::chrono::minutes{40} - 1us);
  node.goes_on();
  node.silent();
  node.after(1us);
  node.tx(time_out_abort);
  node.ended(CO_SDO_ERR_TIMEOUT);
}

TEST_CASE("SDO client: a time-out beyond the range of the timer is limited to the longest one") {
  SdoClient node(Setup().only_small().rate(1000000));
  node.start_upload(0x2000, 5, 4, 0xFFFFFFFF);
  node.tx("605#4000200500000000");
  node.after(std::chrono::minutes{35});
  node.goes_on();
  node.silent();
  node.after(std::chrono::minutes{37});  // 2^32 µs are 71.6 min
  node.tx(time_out_abort);
  node.ended(CO_SDO_ERR_TIMEOUT);
}

TEST_CASE("SDO client: time-outs do not depend on start and rate of the clock and on the main loop [T15]") {
  for (const std::uint32_t start : clock_starts) {
    for (const std::uint32_t rate : {1000U, 1024U, 300U, 1000000U}) {
      for (const Wake wake : {Wake::alarm, Wake::deadline}) {
        CAPTURE(start);
        CAPTURE(rate);
        SdoClient node(Setup().only_small().clock(start).rate(rate).wake(wake));
        node.start_upload(0x2000, 5, 4, 100);
        node.tx("605#4000200500000000");
        node.after(200ms);
        node.tx_at(100ms, time_out_abort);
        node.ended(CO_SDO_ERR_TIMEOUT);
      }
    }
  }
}

TEST_CASE("SDO client: a transfer that has ended leaves no running time-out") {
  SdoClient node;
  for (const ClientState& state : client_states()) {
    CAPTURE(state.name);
    enter(node, state, 100);
    node.rx("585#8000200520000008");
    node.ended(CO_SDO_ERR_TOS);
    CHECK(node.armed_timers() == 0);
    node.start_upload(0x2001, 0, 4, 1000);
    node.tx("605#4001200000000000");
    node.after(999ms);
    node.goes_on();
    node.rx("585#4F01200011000000");
    node.has_read({0x11});
  }
}

TEST_CASE("SDO client: a late main loop reports a time-out once") {
  SdoClient node;
  node.start_upload(0x2000, 5, 4, 100);
  node.tx("605#4000200500000000");
  node.jump(5000ms);
  node.tx(time_out_abort);
  node.ended(CO_SDO_ERR_TIMEOUT);
}

TEST_CASE("SDO client: an answer at the time of the time-out causes one callback") {
  SdoClient node;
  node.start_upload(0x2000, 5, 4, 100);
  node.tx("605#4000200500000000");
  node.elapse_only(100ms);
  node.rx("585#4F00200511000000");
  node.after(0ms);
  node.frames();
  CHECK(node.ends.size() == 1);
  node.ends.clear();
  CHECK_FALSE(node.is_busy());
}

TEST_CASE("SDO client: the abort of a time-out has the multiplexer of the object, also within a transfer [D25]") {
  SdoClient node;
  node.start_download(0x1A02, 0xFE, counted(14), 50);
  node.tx("605#21021AFE0E000000");
  node.rx("585#60021AFE00000000");
  node.tx("605#0001020304050607");
  node.after(50ms);
  node.tx("605#80021AFE00000405");
  CHECK(node.ended(CO_SDO_ERR_TIMEOUT).num == 0);
}

#if CO_CSDO_BLOCK > 0

// Returns the times in ms at which the client repeats the acknowledge before its time-out of 1 s.
std::vector<std::uint64_t> acknowledges_in_silence(SdoClient& node, const std::string& acknowledge) {
  node.after(999ms);
  std::vector<std::uint64_t> times;
  for (const std::string& line : node.trace()) {
    const std::size_t space = line.find(' ');
    CHECK(line.substr(space + 1) == acknowledge);
    times.push_back(std::stoul(line));
  }
  return times;
}

TEST_CASE("SDO client: blocks without a segment in order do not restart the time-out [D18]") {
  SdoClient node;
  node.start_upload(0x2000, 5, 1000, 1000);
  node.tx("605#A40020057F1C0000");
  node.rx("585#C600200514000000");
  node.tx("605#A300000000000000");
  std::vector<std::string> sent;
  for (unsigned n = 0; n < 12 && sent.empty(); ++n) {
    node.rx("585#0208090A0B0C0D0E");
    node.rx("585#7F08090A0B0C0D0E");
    node.after(250ms);
    sent = without_acknowledges(node.frames());
  }
  CHECK(sent == std::vector<std::string>{time_out_abort});
  CHECK(node.ended(CO_SDO_ERR_TIMEOUT).num == 0);
}

void read_some(SdoClient& node, unsigned taken) {
  constexpr const char* segments[] = {"585#0101020304050607", "585#0208090A0B0C0D0E", "585#030F101112131415"};
  node.start_upload(0x2000, 5, 1000, 1000);
  node.tx("605#A40020057F1C0000");
  node.rx("585#C600200514000000");
  node.tx("605#A300000000000000");
  for (unsigned n = 0; n < taken; ++n) {
    node.rx(segments[n]);
  }
}

TEST_CASE(
    "SDO client: silence within a sub-block acknowledges the received segments, so that the server continues [D11]") {
  for (const unsigned taken : {1U, 2U}) {
    CAPTURE(taken);
    SdoClient node;
    read_some(node, taken);
    const std::vector<std::uint64_t> times =
        acknowledges_in_silence(node, taken == 1 ? "605#A2017F0000000000" : "605#A2027F0000000000");
    REQUIRE(times.size() == 1);
    CHECK(times[0] == 750);
    node.after(251ms);
    CHECK(without_acknowledges(node.frames()) == std::vector<std::string>{time_out_abort});
    node.ended(CO_SDO_ERR_TIMEOUT);
  }
}

TEST_CASE("SDO client: data are complete if the server continues after the acknowledge of a silence [D11]") {
  SdoClient node;
  read_some(node, 2);  // segment 3, the last one, is lost
  node.after(750ms);
  const std::vector<std::string> sent = node.frames();
  REQUIRE_FALSE(sent.empty());
  for (const std::string& line : sent) CHECK(line == "605#A2027F0000000000");
  CHECK(node.num() == 14);
  node.rx("585#810F101112131400");
  node.tx("605#A2017F0000000000");
  node.rx("585#C5D3EA0000000000");
  node.tx("605#A100000000000000");
  node.has_read(counted(20));
}

TEST_CASE("SDO client: after a silence within a block the complete time-out starts again") {
  SdoClient node;
  read_some(node, 2);
  node.after(750ms);
  node.frames();
  node.rx("585#810F101112131400");
  node.tx("605#A2017F0000000000");
  node.after(999ms);
  node.goes_on();
  CHECK(without_acknowledges(node.frames()).empty());
  node.after(1ms);
  CHECK(without_acknowledges(node.frames()) == std::vector<std::string>{time_out_abort});
  node.ended(CO_SDO_ERR_TIMEOUT);
}

TEST_CASE("SDO client: a lost acknowledge of the last segment is repeated after a silence [D11]") {
  SdoClient node;
  read_some(node, 2);
  node.rx("585#830F101112131400");
  node.tx("605#A2037F0000000000");  // lost
  node.after(750ms);
  const std::vector<std::string> sent = node.frames();
  REQUIRE_FALSE(sent.empty());
  for (const std::string& line : sent) CHECK(line == "605#A2037F0000000000");
  node.rx("585#C5D3EA0000000000");
  node.tx("605#A100000000000000");
  node.has_read(counted(20));
}

#endif

// SDO client: transfers while the controller refuses frames. [T12] [D20]

TEST_CASE("SDO client: a request with a full transmit queue is refused with CO_ERR_IF_CAN_SEND without callback") {
  SdoClient node(Setup().only_small().tx_queue(1));
  node.can.refuse_all();
  CO_IF_FRM urgent = frame("091#01");
  node.call([&] { REQUIRE(COIfCanSend(&node->If, &urgent) == sizeof(CO_IF_FRM)); });
  for (const std::uint32_t size : {4U, 28U, 1000U}) {
    CAPTURE(size);
    CHECK(node.try_upload(0x2000, 5, size, 100) == CO_ERR_IF_CAN_SEND);
    CHECK(node.try_download(0x2000, 5, counted(size), 100) == CO_ERR_IF_CAN_SEND);
    CHECK(node.csdo()->State == CO_CSDO_STATE_IDLE);
    CHECK(node.armed_timers() == 0);
  }
  node.after(1000ms);
  CHECK(node.ends.empty());
  node.can.accept_all();
  node.loop();
  node.tx("091#01");
  check_asks(node);
}

TEST_CASE("SDO client: a request that the controller refuses is sent later") {
  SdoClient node;
  node.can.refuse_next(3);
  node.start_upload(0x2000, 5, 4);
  node.silent();
  node.goes_on();
  for (int i = 0; i < 4; ++i) node.loop();
  node.tx("605#4000200500000000");
  node.rx("585#4F00200511000000");
  node.has_read({0x11});
}

#if CO_CSDO_BLOCK > 0

// Runs a transfer while the controller refuses \a times frames of the client, from number \a refuse_at. Returns the
// client's frames.
std::vector<std::string> session(bool upload, std::size_t length, std::uint64_t refuse_at, std::uint64_t times,
                                 std::int16_t with) {
  SdoClient node;
  std::vector<std::string> all;
  SdoPeer peer(upload ? counted(length) : Bytes{});
  if (times > 0) {
    node.can.refuse_nth(refuse_at, with);
    node.can.refuse_to += times - 1;
  }
  if (upload) {
    node.start_upload(0x2000, 5, static_cast<std::uint32_t>(std::max<std::size_t>(length, 29)));
  } else {
    node.start_download(0x2000, 5, counted(length));
  }
  for (unsigned rounds = 0; rounds < 50 && node.ends.empty(); ++rounds) {
    for (int i = 0; i < 4; ++i) node.loop();
    std::deque<Sent> sent;
    sent.swap(node.can.sent);
    for (const Sent& one : sent) {
      all.push_back(notation(one.frm));
      for (const CO_IF_FRM& answer : peer.answers_to(one.frm)) node.can.to_node.push_back(answer);
    }
  }
  for (int i = 0; i < 4; ++i) node.loop();
  for (const std::string& line : node.frames()) all.push_back(line);
  CHECK(peer.fault == "");
  node.ended(0);
  if (!upload) CHECK((peer.object == counted(length)));
  CHECK(node.counters().Dropped == 0);
  return all;
}

TEST_CASE("SDO client: whichever frames the controller refuses the transfer is complete [T12]") {
  for (const bool upload : {true, false}) {
    const std::size_t length = 100;
    const std::vector<std::string> expected = session(upload, length, 0, 0, 0);
    CHECK(expected.size() == (upload ? 4 : 17));
    for (const std::int16_t refusal : {std::int16_t{0}, std::int16_t{-1}}) {
      for (const std::uint64_t times : {1U, 2U, 3U}) {
        for (std::uint64_t n = 1; n <= expected.size(); ++n) {
          CAPTURE(upload);
          CAPTURE(refusal);
          CAPTURE(times);
          CAPTURE(n);
          CHECK(session(upload, length, n, times, refusal) == expected);
        }
      }
    }
  }
}

// Starts a block download of 40 bytes, and lets the controller refuse the third segment and later frames.
void pause(SdoClient& node) {
  node.start_download(0x2000, 5, counted(40));
  node.tx("605#C600200528000000");
  node.can.refuse_nth(3);
  node.can.refuse_to += 1000000;
  node.rx("585#A40020057F000000");
  node.tx({"605#0101020304050607", "605#0208090A0B0C0D0E"});
}

TEST_CASE("SDO client: a block download pauses while the controller refuses frames, and resumes [D20]") {
  SdoClient node;
  pause(node);
  for (int i = 0; i < 10; ++i) node.loop();
  node.silent();
  node.goes_on();
  CHECK(CONodeNextDeadline(&node.node) <= 1);
  node.can.accept_all();
  for (int i = 0; i < 10; ++i) node.loop();
  node.tx({"605#030F101112131415", "605#04161718191A1B1C", "605#051D1E1F20212223", "605#8624252627280000"});
  node.rx("585#A2067F0000000000");
  node.tx("605#C9C38B0000000000");
  node.rx("585#A100000000000000");
  node.has_written();
}

TEST_CASE("SDO client: a paused block download resumes in a loop that sleeps until CONodeNextDeadline [D20]") {
  SdoClient node(Setup().only_small().wake(Wake::deadline));
  pause(node);
  node.after(5ms);
  node.silent();
  node.can.accept_all();
  node.after(5ms);
  node.tx({"605#030F101112131415", "605#04161718191A1B1C", "605#051D1E1F20212223", "605#8624252627280000"});
  node.rx("585#A2067F0000000000");
  node.tx("605#C9C38B0000000000");
  node.rx("585#A100000000000000");
  node.has_written();
}

TEST_CASE("SDO client: a paused block download does not fill the transmit queue and does not delay other frames [Q4]") {
  SdoClient node(Setup().only_small().tx_queue(4));
  pause(node);
  CHECK(node->TxQueue.Num <= 1);
  node.rx("601#4000100000000000");
  node.can.accept_all();
  for (int i = 0; i < 10; ++i) node.loop();
  const std::vector<std::string> sent = node.frames();
  CHECK(std::count(sent.begin(), sent.end(), "581#4300100091010F00") == 1);
  CHECK(sent.size() == 5);
  CHECK(node.counters().Dropped == 0);
  node.rx("585#A2067F0000000000");
  node.tx("605#C9C38B0000000000");
  node.rx("585#A100000000000000");
  node.has_written();
}

TEST_CASE("SDO client: with a controller that accepts one frame at a time all segments are sent in order [D20]") {
  SdoClient node;
  pause(node);
  std::vector<std::string> sent;
  for (int i = 0; i < 20; ++i) {
    node.can.accept_all();
    node.can.refuse_nth(2);
    node.can.refuse_to += 1000000;
    node.call([&] { CONodeProcess(&node.node); });
    for (const std::string& line : node.frames()) sent.push_back(line);
  }
  node.can.accept_all();
  CHECK(sent == std::vector<std::string>{"605#030F101112131415", "605#04161718191A1B1C", "605#051D1E1F20212223",
                                         "605#8624252627280000"});
  node.rx("585#A2067F0000000000");
  node.tx("605#C9C38B0000000000");
  node.rx("585#A100000000000000");
  node.has_written();
}

TEST_CASE("SDO client: a paused block download that is cancelled sends no segment after the abort") {
  SdoClient node;
  pause(node);
  node.call([&] { CHECK(COCSdoCancel(node.csdo()) == CO_ERR_NONE); });
  node.ended(CO_SDO_ERR_TOS_LOCAL);
  node.can.accept_all();
  for (int i = 0; i < 10; ++i) node.loop();
  const std::vector<std::string> sent = node.frames();
  REQUIRE_FALSE(sent.empty());
  CHECK(sent.back() == "605#8000200521000008");
  CHECK(sent.size() <= 2);
  check_asks(node);
}

TEST_CASE("SDO client: an abort of the server ends a paused block download without further segments") {
  SdoClient node;
  pause(node);
  node.rx("585#8000200505000405");
  node.ended(CO_SDO_ERR_MEM);
  node.can.accept_all();
  for (int i = 0; i < 10; ++i) node.loop();
  CHECK(node.frames().size() <= 1);  // a frame that was in the transmit queue
  check_asks(node);
}

TEST_CASE("SDO client: a repeated answer to the initiate while a block is being sent is ignored") {
  SdoClient node;
  pause(node);
  node.rx("585#A400200504000000");
  node.silent();
  node.goes_on();
  node.can.accept_all();
  for (int i = 0; i < 10; ++i) node.loop();
  node.tx({"605#030F101112131415", "605#04161718191A1B1C", "605#051D1E1F20212223", "605#8624252627280000"});
  node.rx("585#A2067F0000000000");
  node.tx("605#C9C38B0000000000");
  node.rx("585#A100000000000000");
  node.has_written();
}

TEST_CASE("SDO client: a repeated acknowledge of the previous block while a block is being sent is ignored") {
  SdoClient node;
  node.start_download(0x2000, 5, counted(40));
  node.tx("605#C600200528000000");
  node.rx("585#A400200504000000");
  node.tx({"605#0101020304050607", "605#0208090A0B0C0D0E", "605#030F101112131415", "605#04161718191A1B1C"});
  node.can.refuse_all();
  node.rx("585#A204040000000000");
  node.rx("585#A204040000000000");
  node.silent();
  node.goes_on();
  node.can.accept_all();
  for (int i = 0; i < 10; ++i) node.loop();
  node.tx({"605#011D1E1F20212223", "605#8224252627280000"});
  node.rx("585#A202040000000000");
  node.tx("605#C9C38B0000000000");
  node.rx("585#A100000000000000");
  node.has_written();
}

TEST_CASE("SDO client: NMT stop ends a paused block download and withdraws queued segments [N8]") {
  SdoClient node;
  pause(node);
  node.rx("000#0201");
  node.ended(CO_SDO_ERR_TOS_STATE);
  node.can.accept_all();
  for (int i = 0; i < 10; ++i) node.loop();
  node.silent();
}

#endif

TEST_CASE("SDO client: NMT stop withdraws a request that is queued for the controller [N8]") {
  SdoClient node;
  node.can.refuse_all();
  node.start_upload(0x2000, 5, 4);
  node.rx("000#0201");
  node.ended(CO_SDO_ERR_TOS_STATE);
  node.can.accept_all();
  node.loop();
  node.silent();
}

TEST_CASE("SDO client: a time-out ends the transfer also with a full transmit queue") {
  SdoClient node(Setup().only_small().tx_queue(1));
  node.can.refuse_all();
  node.start_upload(0x2000, 5, 4, 100);
  node.after(99ms);
  node.goes_on();
  node.after(1ms);
  node.ended(CO_SDO_ERR_TIMEOUT);
  node.can.accept_all();
  node.loop();
  node.frames();
  check_asks(node);
}

TEST_CASE(
    "SDO client: a segment request refused by a full transmit queue ends the transfer, at the latest by time-out") {
  SdoClient node(Setup().only_small().tx_queue(1));
  node.start_upload(0x2000, 5, 28, 100);
  node.tx("605#4000200500000000");
  node.can.refuse_all();
  CO_IF_FRM urgent = frame("091#01");
  node.call([&] { REQUIRE(COIfCanSend(&node->If, &urgent) == sizeof(CO_IF_FRM)); });
  node.rx("585#4100200508000000");
  node.can.accept_all();
  node.after(100ms);
  node.frames();
  REQUIRE(node.ends.size() == 1);
  CHECK(node.ends.front().code != 0);
  node.ends.clear();
  check_asks(node);
}

}  // namespace

#endif
