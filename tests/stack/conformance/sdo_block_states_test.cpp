// SPDX-License-Identifier: Apache-2.0
// SDO server: ends of a block transfer in every state, by the client's abort, a new initiate, time-out or NMT state.
#include "support/block_states.hpp"

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

namespace {

using namespace test;

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

}  // namespace

#endif
