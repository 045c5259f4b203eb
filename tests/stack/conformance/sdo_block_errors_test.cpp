// SPDX-License-Identifier: Apache-2.0
// SDO server: errors of block transfers and their abort codes. [301:7.2.4.3.17]
#include "support/block_frames.hpp"
#include "support/block_states.hpp"
#include "support/fixture.hpp"

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

namespace {

using namespace test;

constexpr std::uint32_t too_long = 0x06070012;
constexpr std::uint32_t too_short = 0x06070013;

// Checks that the server is idle.
void check_idle(Fixture& node) {
  node.ask("601#A1DEADBE00000000", "581#80DEADBE01000405");
  node.ask("601#4000100000000000", "581#4300100091010F00");
}

// 0504 0001h ---------------------------------------------------------------------------------------------------------

TEST_CASE("SDO block: commands outside of a block transfer are aborted with their own bytes [D7] [D25]") {
  Fixture node;
  for (const std::string command : {"A1", "A2", "A3", "C1", "C5", "C9", "CD", "D1", "D5", "D9", "DD"}) {
    node.ask("601#" + command + "11223300000000", "581#8011223301000405");
  }
}

TEST_CASE("SDO block: commands with reserved bits set are unknown [D7]") {
  Fixture node;
  for (const std::string command : {"A5", "A6", "A7", "A8", "AC", "B0", "B4", "BF", "C3", "C8", "CA", "CC", "CE",
                                    "D0", "D2", "D4", "D6", "D8", "DA", "DC", "DE", "C7", "CB", "DF", "E0", "FF"}) {
    CAPTURE(command);
    node.ask("601#" + command + "00100004000000", "581#8000100001000405");
  }
}

TEST_CASE("SDO block: without a buffer block transfers are refused and others work") {
  Fixture node(Setup().without_sdo_buffer());
  for (const std::string command : {"A0", "A4", "C0", "C2", "C4", "C6"}) {
    node.ask("601#" + command + "042000047F0000", "581#8004200001000405");
  }
  node.ask("601#A40420007FFF0000", "581#8004200001000405");
  node.ask("601#2304200078563412", "581#6004200000000000");
  node.ask("601#4004200000000000", "581#4304200078563412");
  CHECK(node.download(0x2104, 0, counting(890, 3)) == 0);
  CHECK(node.upload(0x2104, 0) == counting(890, 3));
}

TEST_CASE("SDO block download: commands other than the end after the last segment are aborted [D25]") {
  for (const std::string command : {"00", "01", "60", "70", "A1", "A2", "A3", "C3", "E0"}) {
    CAPTURE(command);
    Fixture node;
    node.ask("601#C600210F08000000", "581#A400210F7F000000");
    node.rx("601#0101020304050607");
    node.rx("601#8208000000000000");
    expect_last_ack(node, 2);
    node.ask("601#" + command + "11223344556677", "581#8000210F01000405");
    CHECK(node.objects.memory[15] == counting(15));
    check_idle(node);
  }
}

TEST_CASE("SDO block upload: commands other than the start after the initiate are aborted [D25]") {
  for (const std::string command : {"00", "01", "60", "70", "A1", "A2", "C1", "DD", "E0"}) {
    CAPTURE(command);
    Fixture node;
    node.ask("601#A400210F7F000000", "581#C600210F0F000000");
    node.ask("601#" + command + "00000000000000", "581#8000210F01000405");
    check_idle(node);
  }
}

TEST_CASE("SDO block upload: commands other than an acknowledge after a block are aborted [D25]") {
  for (const std::string command : {"00", "01", "60", "70", "A1", "A3", "C1", "DD", "E0"}) {
    CAPTURE(command);
    Fixture node;
    node.ask("601#A400210F01000000", "581#C600210F0F000000");
    node.ask("601#A300000000000000", "581#0101020304050607");
    node.ask("601#" + command + "00000000000000", "581#8000210F01000405");
    check_idle(node);
  }
}

TEST_CASE("SDO block upload: commands other than the confirmation after the end are aborted [D25]") {
  for (const std::string command : {"00", "01", "60", "70", "A3", "C1", "DD", "E0"}) {
    CAPTURE(command);
    Fixture node;
    node.ask("601#A40010007F000000", "581#C600100004000000");
    node.ask("601#A300000000000000", "581#8191010F00000000");
    node.ask("601#A2017F0000000000", "581#CD25970000000000");
    node.ask("601#" + command + "017F0000000000", "581#8000100001000405");
    check_idle(node);
  }
}

// 0504 0002h, 0504 0003h ---------------------------------------------------------------------------------------------

TEST_CASE("SDO block upload: a blksize of 0 or above 127 in the initiate is refused [D12] [SDO 26]") {
  Fixture node;
  for (const std::string blksize : {"00", "80", "81", "FF"}) {
    node.ask("601#A0081000" + blksize + "000000", "581#8008100002000405");
    node.ask("601#A4081000" + blksize + "000000", "581#8008100002000405");
    check_idle(node);
  }
}

TEST_CASE("SDO block upload: a blksize of 0 or above 127 in an acknowledge is refused [D12]") {
  for (const std::string blksize : {"00", "80", "FF"}) {
    for (const std::string ackseq : {"00", "01", "02"}) {
      Fixture node;
      node.ask("601#A400210F02000000", "581#C600210F0F000000");
      node.rx("601#A300000000000000");
      node.tx({"581#0101020304050607", "581#0208090A0B0C0D0E"});
      node.ask("601#A2" + ackseq + blksize + "0000000000", "581#8000210F02000405");
      check_idle(node);
    }
  }
}

TEST_CASE("SDO block upload: an acknowledge of more segments than sent, also 128, is refused [D12] [SDO 27]") {
  for (const std::string ackseq : {"03", "04", "7F", "80", "FF"}) {
    for (const std::string blksize : {"7F", "00", "80"}) {
      Fixture node;
      node.ask("601#A400210F02000000", "581#C600210F0F000000");
      node.rx("601#A300000000000000");
      node.tx({"581#0101020304050607", "581#0208090A0B0C0D0E"});
      node.ask("601#A2" + ackseq + blksize + "0000000000", "581#8000210F03000405");
      check_idle(node);
    }
  }
}

TEST_CASE("SDO block upload: an acknowledge of more segments than the last block had is refused") {
  Fixture node;
  node.ask("601#A400210F02000000", "581#C600210F0F000000");
  node.rx("601#A300000000000000");
  node.tx({"581#0101020304050607", "581#0208090A0B0C0D0E"});
  node.ask("601#A202020000000000", "581#810F000000000000");
  node.ask("601#A202020000000000", "581#8000210F03000405");
}

// 0504 0004h, lengths ------------------------------------------------------------------------------------------------

TEST_CASE("SDO block download: a wrong CRC changes nothing, for each wrong bit [D14]") {
  Fixture node;
  for (unsigned bit = 0; bit < 16; bit += stride(5)) {
    CAPTURE(bit);
    BlockOptions options;
    options.crc_error = static_cast<std::uint16_t>(1U << bit);
    for (const std::uint32_t size : {1U, 8U, 889U}) {
      const Bytes before = node.objects.memory[size];
      CHECK(node.block_download(domain_of(size).index, domain_of(size).sub, Bytes(size, 0xEE), options).abort ==
            0x05040004);
      CHECK(node.objects.memory[size] == before);
    }
    CHECK(node.block_download(0x2008, 0, counting(8), options).abort == 0x05040004);
    CHECK(node.block_download(0x2104, 0, Bytes(890, 0xEE), options).abort == 0x05040004);
  }
  CHECK(node.objects.u64 == 0x8877665544332211);
}

TEST_CASE("SDO block download: the number of bytes is checked before the CRC") {
  Fixture node;
  BlockOptions options;
  options.crc_error = 1;
  options.announced_more = 1;
  CHECK(node.block_download(0x2100, 15, counting(14), options).abort == too_short);
  options.announced_more = 0xFFFFFFFF;
  CHECK(node.block_download(0x2100, 15, counting(15), options).abort == too_long);
}

TEST_CASE("SDO block download: an announced size that does not fit is refused at once [D5] [SDO 08] [SDO 09]") {
  Fixture node;
  for (const std::string command : {"C2", "C6"}) {
    node.ask("601#" + command + "04200005000000", "581#8004200012000706");
    node.ask("601#" + command + "04200003000000", "581#8004200013000706");
    node.ask("601#" + command + "04200000000000", "581#8004200013000706");
    node.ask("601#" + command + "042000FFFFFFFF", "581#8004200012000706");
    node.ask("601#" + command + "04200004000080", "581#8004200012000706");
    node.ask("601#" + command + "00210506000000", "581#8000210512000706");
    node.ask("601#" + command + "00210000000080", "581#8000210012000706");
    node.ask("601#" + command + "1121000B000000", "581#8011210012000706");
    node.ask("601#" + command + "0121007A030000", "581#8001210012000706");
    check_idle(node);
  }
}

TEST_CASE("SDO block download: one byte less or more than announced is refused [D5]") {
  Fixture node;
  node.ask("601#C204200004000000", "581#A40420007F000000");
  node.rx("601#8101020300000000");
  expect_last_ack(node, 1);
  node.ask("601#D100000000000000", "581#8004200013000706");
  node.ask("601#C204200004000000", "581#A40420007F000000");
  node.rx("601#8101020304050000");
  expect_last_ack(node, 1);
  node.ask("601#C900000000000000", "581#8004200012000706");
  CHECK(node.objects.u32 == 0x44332211);
  check_idle(node);
}

TEST_CASE("SDO block download: announced, sent and possible sizes are checked in every combination [D5]") {
  struct Target {
    std::uint16_t index;
    std::uint8_t sub;
    std::uint32_t size;
    bool is_value;
  };
  constexpr Target targets[] = {{0x2001, 0, 1, true},    {0x2004, 0, 4, true},   {0x2008, 0, 8, true},
                                {0x2100, 0, 0, false},   {0x2100, 1, 1, false},  {0x2100, 8, 8, false},
                                {0x2101, 0, 889, false}, {0x2104, 0, 890, false}};
  const auto fits = [](const Target& target, std::uint32_t number) -> std::uint32_t {
    if (number > target.size) return too_long;
    return number < target.size && target.is_value ? too_short : 0;
  };
  const auto verdict = [&](const Target& target, bool sized, std::uint32_t announced, std::uint32_t sent) {
    const std::uint32_t at_once = sized ? fits(target, announced) : 0;
    const std::uint32_t later = announced == sent ? 0 : sent > announced ? too_long : too_short;
    return at_once != 0 ? at_once : sized ? later : fits(target, sent);
  };
  Fixture node;
  for (const Target& target : targets) {
    for (const std::uint32_t sent : {0U, 1U, 3U, 4U, 5U, 7U, 8U, 889U, 890U, 1800U}) {
      for (const std::uint32_t announced : {0U, 1U, 3U, 4U, 5U, 7U, 8U, 889U, 890U, 0x80000000U, 0xFFFFFFFFU}) {
        CAPTURE(target.index);
        CAPTURE(sent);
        CAPTURE(announced);
        BlockOptions options;
        options.announced_more = announced - sent;
        CHECK(node.block_download(target.index, target.sub, Bytes(sent), options).abort ==
              verdict(target, true, announced, sent));
      }
      BlockOptions options;
      options.sized = false;
      CHECK(node.block_download(target.index, target.sub, Bytes(sent), options).abort ==
            verdict(target, false, 0, sent));
    }
  }
}

TEST_CASE("SDO block download: errors detected within a sub-block are reported at its end [D21]") {
  Fixture node;
  node.ask("601#C004210000000000", "581#A40421007F000000");
  const Bytes data = counting(2000);
  send_segments(node, data, 0, 127);
  node.tx("581#A27F7F0000000000");
  send_segments(node, data, 127, 127);
  node.tx("581#8004210012000706");
  check_idle(node);
}

TEST_CASE("SDO block download: after an error no segment is processed as a command [D21]") {
  Fixture node;
  node.ask("601#C000210100000000", "581#A40021017F000000");
  for (unsigned seqno = 1; seqno < 0x50; ++seqno) {
    node.rx(CO_IF_FRM{0x601, {static_cast<std::uint8_t>(seqno), 0x01, 0x20, 0x00, 0xA5}, 8});
    node.silent();
  }
  CHECK(node.objects.u8 == 0x11);
  node.ask("601#D001200000000000", "581#8000210112000706");
  CHECK(node.objects.memory[1] == Bytes{1});
  check_idle(node);
}

// Errors of objects --------------------------------------------------------------------------------------------------

TEST_CASE("SDO block download: a refused value is reported by the last answer [D10]") {
  Fixture node;
  node.ask("601#C620200001000000", "581#A42020007F000000");
  node.rx("601#8102000000000000");
  expect_last_ack(node, 1);
  node.ask("601#D942200000000000", "581#8020200030000906");
  CHECK(node.objects.boolean == 0);
  check_idle(node);
}

TEST_CASE("SDO block: a table that is moved during a transfer aborts it with 0800 0022h") {
  std::vector<CO_OBJ> other;
  const auto move = [&](Fixture& node) {
    other.assign(node->Dict.Root, node->Dict.Root + node->Dict.Num);
    node.call([&] { CODictInit(&node->Dict, &node.node, other.data(), node->Dict.Num); });
  };
  Fixture up;
  up.ask("601#A40421007F000000", "581#C60421007A030000");
  move(up);
  up.ask("601#A300000000000000", "581#8004210022000008");
  check_idle(up);
  Fixture down;
  down.ask("601#C604200004000000", "581#A40420007F000000");
  move(down);
  down.rx("601#8101020304000000");
  if (down.can.sent.front().frm.Data[0] == 0xA2) {
    expect_last_ack(down, 1);
    down.rx(block_end(0x601, {1, 2, 3, 4}));
  }
  down.tx("581#8004200022000008");
  check_idle(down);
  CHECK(down.objects.u32 == 0x44332211);
}

// SDO server: ends of a block transfer in every state, by the client's abort, a new initiate, time-out or NMT state.

// Calls the function with a fixture in each state of a block transfer.
template <class Function>
void in_every_state(Function function, Setup setup = {}) {
  for (const BlockState& state : block_states()) {
    CAPTURE(state.name);
    Fixture node(setup);
    state.enter(node);
    function(node, state);
  }
}

// Client -------------------------------------------------------------------------------------------------------------

TEST_CASE("SDO block: an abort of the client ends the transfer in every state without an answer [D6]") {
  in_every_state([](Fixture& node, const BlockState& state) {
    node.rx("601#80" + state.multiplexer + "00000008");
    let_go_on(node);
    node.silent();
    check_all_transfers(node);
  });
}

TEST_CASE("SDO block: an abort with another multiplexer and without a code ends the transfer [D6]") {
  in_every_state([](Fixture& node, const BlockState&) {
    node.rx("601#8000000000000000");
    let_go_on(node);
    node.silent();
    check_all_transfers(node);
  });
}

TEST_CASE("SDO block: 81h to 9Fh are aborts except for segments within a sub-block [D23]") {
  in_every_state([](Fixture& node, const BlockState& state) {
    if (state.in_sub_block) return;
    node.rx("601#9F" + state.multiplexer + "00000008");
    let_go_on(node);
    node.silent();
    check_all_transfers(node);
  });
  Fixture node;
  node.ask("601#C600210F05000000", "581#A400210F7F000000");
  node.rx("601#8101020304050000");
  expect_last_ack(node, 1);
}

TEST_CASE("SDO block: an initiate starts a new transfer in every state except within a sub-block [D8]") {
  struct Row {
    const char* request;
    const char* answer;
  };
  const Row rows[] = {
      {"601#4000100000000000", "581#4300100091010F00"}, {"601#4008100000000000", "581#4108100011000000"},
      {"601#2F012000A5000000", "581#6001200000000000"}, {"601#2108200008000000", "581#6008200000000000"},
      {"601#A408100014000000", "581#C608100011000000"}, {"601#A000100014040000", "581#4300100091010F00"},
      {"601#C604200004000000", "581#A40420007F000000"}, {"601#C004200000000000", "581#A40420007F000000"},
      {"601#4004100000000000", "581#8004100000000206"}, {"601#C600100004000000", "581#8000100002000106"},
      {"601#A408100000000000", "581#8008100002000405"},
  };
  unsigned round = 0;
  for (const Row& row : rows) {
    if (round++ % stride(3) != 0) continue;
    CAPTURE(std::string(row.request));
    in_every_state([&](Fixture& node, const BlockState& state) {
      if (state.in_sub_block) return;
      node.rx(row.request);
      let_go_on(node);
      node.tx(row.answer);
      node.rx("601#80FFFFFF00000008");
      check_all_transfers(node);
    });
  }
}

TEST_CASE("SDO block: a transfer whose initiate interrupted another one can be completed [D8]") {
  in_every_state([](Fixture& node, const BlockState& state) {
    if (state.in_sub_block) return;
    let_go_on(node);
    node.frames();
    const Bytes data = counting(888, 55);
    CHECK(node.block_download(0x2103, 0, data).abort == 0);
    CHECK(node.objects.memory[888] == data);
    CHECK(node.objects.u64 == 0x8877665544332211);
  });
  in_every_state([](Fixture& node, const BlockState& state) {
    if (state.in_sub_block) return;
    let_go_on(node);
    node.frames();
    CHECK(node.block_upload(0x2101, 0).data == counting(889));
  });
}

TEST_CASE("SDO block download: within a sub-block an initiate is a segment out of order [D21]") {
  Fixture node;
  node.ask("601#C60421007A030000", "581#A40421007F000000");
  for (const char* request : {"601#4000100000000000", "601#2F012000A5000000", "601#6000000000000000"}) {
    node.rx(request);
    node.silent();
  }
  node.ask("601#A408100014000000", "581#A2007F0000000000");
  node.rx("601#C604200004000000");
  node.silent();
  CHECK(node.objects.u8 == 0x11);
  node.rx("601#8004210000000008");
  check_all_transfers(node);
}

TEST_CASE("SDO block: frames of a wrong length are ignored and counted in every state [D1]") {
  in_every_state([](Fixture& node, const BlockState&) {
    const std::uint32_t before = node.counters().Malformed;
    for (const char* request : {"601#80", "601#A2017F00000000", "601#C1", "601#", "601#03010203040506"}) {
      node.rx(request);
      node.silent();
    }
    CHECK(node.counters().Malformed == before + 5);
    node.rx("601#8000000000000000");
    let_go_on(node);
    node.silent();
    check_all_transfers(node);
  });
}

// Time-out -----------------------------------------------------------------------------------------------------------

TEST_CASE("SDO block: the transfer of a silent client is aborted after the time-out in every state [D18]") {
  in_every_state([](Fixture& node, const BlockState& state) {
    let_go_on(node);
    node.frames();
    node.after(node.sdo_time_out());
    std::vector<std::string> sent = node.trace();
    REQUIRE_FALSE(sent.empty());
    CHECK(sent.back() == "2000 581#80" + state.multiplexer + "00000405");
    sent.pop_back();
    if (state.reminder.empty()) {
      CHECK(sent.empty());
    } else {
      REQUIRE(sent.size() == 3);
      CHECK(sent[0].substr(0, 4 + state.reminder.size()) == "500 " + state.reminder);
      CHECK(sent[1] == "1000" + sent[0].substr(3));
      CHECK(sent[2] == "1500" + sent[0].substr(3));
    }
    node.after(2 * node.sdo_time_out());
    node.silent();
    check_all_transfers(node);
  });
}

TEST_CASE("SDO block: a late main loop sends one repetition or abort [Q8] [D18]") {
  in_every_state([](Fixture& node, const BlockState&) {
    let_go_on(node);
    node.frames();
    node.jump(10s);
    CHECK(node.frames().size() <= 1);
    node.after(node.sdo_time_out());
    node.frames();
    check_all_transfers(node);
  });
}

TEST_CASE("SDO block upload: each frame of the client restarts the time-out [D18]") {
  Fixture node;
  node.ask("601#A400210F01000000", "581#C600210F0F000000");
  node.after(1700ms);
  node.ask("601#A300000000000000", "581#0101020304050607");
  node.after(1700ms);
  node.ask("601#A201010000000000", "581#0108090A0B0C0D0E");
  node.after(1700ms);
  node.ask("601#A201010000000000", "581#810F000000000000");
  node.after(1700ms);
  node.ask("601#A201010000000000", "581#D93D510000000000");
  node.after(1700ms);
  node.rx("601#A100000000000000");
  node.after(2 * node.sdo_time_out());
  node.silent();
}

// NMT state ----------------------------------------------------------------------------------------------------------

TEST_CASE("SDO block: stop ends the transfer in every state without a frame; the next one works [N8] [D17] [T14]") {
  for (const std::string on : {"000#8001", "000#0101"}) {
    in_every_state([&](Fixture& node, const BlockState&) {
      node.rx("000#0201");
      let_go_on(node);
      node.silent();
      CHECK(node.armed_timers() == 0);
      node.after(2 * node.sdo_time_out());
      for (const char* request : {"601#A20A7F0000000000", "601#C100000000000000", "601#0101020304050607"}) {
        node.rx(request);
        node.silent();
      }
      node.rx(on);
      node.silent();
      check_all_transfers(node);
    });
  }
}

TEST_CASE("SDO block: a reset in every state of a transfer gives the state after power-on [N8] [T14]") {
  Fixture fresh;
  for (const std::string reset : {"000#8101", "000#8201"}) {
    in_every_state([&](Fixture& node, const BlockState&) {
      node.rx(reset);
      let_go_on(node);
      node.tx("701#00");
      CHECK(node.difference(fresh) == "");
      node.after(2 * node.sdo_time_out());
      node.silent();
      check_all_transfers(node);
    });
  }
}

TEST_CASE("SDO block: a reset by the application ends the transfer in every state [T14]") {
  Fixture fresh;
  in_every_state([&](Fixture& node, const BlockState&) {
    node.call([&] { CONmtReset(&node->Nmt, CO_RESET_COM); });
    let_go_on(node);
    node.tx("701#00");
    CHECK(node.difference(fresh) == "");
    check_all_transfers(node);
  });
}

TEST_CASE("SDO block: CONodeStop in every state ends the transfer; CONodeInit gives the state after power-on [T14]") {
  Fixture fresh;
  in_every_state([&](Fixture& node, const BlockState&) {
    node.call([&] { CONodeStop(&node.node); });
    let_go_on(node);
    node.after(node.sdo_time_out());
    node.silent();
    CHECK(node.armed_timers() == 0);
    node.init_again();
    node.call([&] { CONodeStart(&node.node); });
    node.tx("701#00");
    CHECK(node.difference(fresh) == "");
    check_all_transfers(node);
  });
}

TEST_CASE("SDO block: traces do not depend on the start of the clock, in ticks of 1 ms and 1 us [T15]") {
  for (const std::uint32_t rate : {1000U, 1000000U}) {
    for (const std::uint32_t start : clock_starts) {
      CAPTURE(rate);
      CAPTURE(start);
      in_every_state(
          [](Fixture& node, const BlockState& state) {
            let_go_on(node);
            node.frames();
            node.after(2500ms);
            const std::vector<std::string> sent = node.trace();
            CHECK(sent.size() == (state.reminder.empty() ? 1 : 4));
            CHECK(sent.back() == "2000 581#80" + state.multiplexer + "00000405");
          },
          Setup().rate(rate).clock(start));
    }
  }
}

// SDO server, block download: segments that arrive after the time-out. Only the state of the server distinguishes
// segments from requests; as the server is idle, it treats them as requests. [301:7.2.4.3.10]

// A block download of 15 bytes to 2100h:0F that has timed out after its first segment.
struct TimedOut : Fixture {
  TimedOut() : Fixture(Setup().only_small()) {
    ask("601#C600210F0F000000", "581#A400210F7F000000");
    rx("601#0101020304050607");
    after(sdo_time_out());
    const std::vector<std::string> sent = frames();
    REQUIRE_FALSE(sent.empty());
    CHECK(sent.back() == "581#8000210F00000405");
  }
};

void check_object_untouched(Fixture& node) {
  Bytes before(15);
  for (std::size_t n = 0; n < before.size(); ++n) before[n] = static_cast<std::uint8_t>(n + 1);
  CHECK(node.objects.memory[15] == before);
}

TEST_CASE("SDO block download: segments 1 to 31 after the time-out are unknown requests [D7] [D18]") {
  for (unsigned seqno = 1; seqno < 32; ++seqno) {
    CAPTURE(seqno);
    TimedOut node;
    CO_IF_FRM frm = frame("601#0008090A0B0C0D0E");
    frm.Data[0] = static_cast<std::uint8_t>(seqno);
    node.rx(frm);
    node.tx("581#8008090A01000405");
    check_object_untouched(node);
  }
}

TEST_CASE("SDO block download: segments 34 and 35 after the time-out write the object that their data contain") {
  for (const char* segment : {"601#22042000AABBCCDD", "601#23042000AABBCCDD"}) {
    TimedOut node;
    node.ask(segment, "581#6004200000000000");
    CHECK(node.objects.u32 == 0xDDCCBBAA);
    check_object_untouched(node);
  }
}

TEST_CASE("SDO block download: segment 47 after the time-out writes only an object of one byte [D5]") {
  TimedOut node;
  node.ask("601#2F042000AABBCCDD", "581#8004200013000706");
  CHECK(node.objects.u32 == 0x44332211);
  node.ask("601#2F012000AABBCCDD", "581#6001200000000000");
  CHECK(node.objects.u8 == 0xAA);
}

TEST_CASE("SDO block download: segment 64 after the time-out reads; with bit 7 it begins a download") {
  TimedOut node;
  node.ask("601#40042000AABBCCDD", "581#4304200011223344");
  node.ask("601#C0042000AABBCCDD", "581#A40420007F000000");
  node.rx("601#8000000000000000");
  node.silent();
}

TEST_CASE("SDO block download: after the time-out every frame is processed as without a previous transfer [D18]") {
  for (unsigned command = 0; command < 256; ++command) {
    CAPTURE(command);
    TimedOut late;
    Fixture fresh(Setup().only_small());
    CO_IF_FRM frm = frame("601#00042000AABBCCDD");
    frm.Data[0] = static_cast<std::uint8_t>(command);
    late.rx(frm);
    fresh.rx(frm);
    CHECK(late.frames() == fresh.frames());
    CHECK(late.objects.u32 == fresh.objects.u32);
    check_object_untouched(late);
  }
}

}  // namespace

#endif
