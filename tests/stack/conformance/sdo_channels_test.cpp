// SPDX-License-Identifier: Apache-2.0
// Several SDO servers, and their COB-IDs. [301:7.5.2.33]
#include "support/block_frames.hpp"
#include "support/fixture.hpp"
#include "support/restricted_ids.hpp"

namespace {

using namespace test;

#if CO_SSDO_N >= 2

// Returns the settings of a node with 1201h on 690h/6A0h and, if configured, 1202h on 691h/6A1h.
Setup channels() {
  return Setup().before_init([](Objects& o) {
    o.sdo2_rx = 0x690;
    o.sdo2_tx = 0x6A0;
    o.sdo3_rx = 0x691;
    o.sdo3_tx = 0x6A1;
  });
}

TEST_CASE("SDO channels: the default server uses 600h and 580h + node-ID [SDO 12] [D16]") {
  Fixture node(Setup().node_id(0x7F));
  node.ask("67F#4000120100000000", "5FF#430012017F060000");
  node.ask("67F#4000120200000000", "5FF#43001202FF050000");
  node.rx("601#4000100000000000");
  node.silent();
}

TEST_CASE("SDO channels: without 1200h the default server exists") {
  Fixture node(Setup().without(0x1200, 0).without(0x1200, 1).without(0x1200, 2));
  node.ask("601#4000100000000000", "581#4300100091010F00");
}

TEST_CASE("SDO channels: a second server uses its own CAN-IDs") {
  Fixture node(channels());
  node.ask("690#4000100000000000", "6A0#4300100091010F00");
  node.ask("601#4000100000000000", "581#4300100091010F00");
  node.ask("690#E0AABBCC00000000", "6A0#80AABBCC01000405");
}

TEST_CASE("SDO channels: a server with bit 31 set in either COB-ID does not answer [D26]") {
  for (const bool rx_valid : {false, true}) {
    CAPTURE(rx_valid);
    Fixture node(Setup().before_init([=](Objects& o) {
      o.sdo2_rx = rx_valid ? 0x690 : 0x80000690;
      o.sdo2_tx = rx_valid ? 0x800006A0 : 0x6A0;
    }));
    const std::uint32_t before = node.counters().Unclaimed;
    node.rx("690#4000100000000000");
    node.silent();
    CHECK(node.counters().Unclaimed == before + 1);
  }
}

TEST_CASE("SDO channels: a server made valid over the network answers from the next frame [D16] [D26]") {
  Fixture node;
  node.ask("601#2301120190060000", "581#6001120100000000");
  node.rx("690#4000100000000000");
  node.silent();
  node.ask("601#23011202A0060000", "581#6001120200000000");
  node.ask("690#4000100000000000", "6A0#4300100091010F00");
  node.ask("601#2301120190060080", "581#6001120100000000");
  node.rx("690#4000100000000000");
  node.silent();
}

TEST_CASE("SDO channels: the CAN-ID can be changed only from and to invalid [D16]") {
  Fixture node(channels());
  node.ask("601#2301120192060000", "581#8001120130000906");
  node.ask("601#23011202A2060000", "581#8001120230000906");
  node.ask("601#2301120190060000", "581#6001120100000000");
  node.ask("601#2301120190060080", "581#6001120100000000");
  node.ask("601#2301120192060080", "581#6001120100000000");
  node.ask("601#2301120192060000", "581#6001120100000000");
  node.ask("692#4000100000000000", "6A0#4300100091010F00");
  node.rx("690#4000100000000000");
  node.silent();
}

TEST_CASE("SDO channels: a server made invalid by its own client answers that request and no later one [Q3] [D16]") {
  Fixture node(channels());
  node.ask("690#2301120190060080", "6A0#6001120100000000");
  node.rx("690#4000100000000000");
  node.silent();
  node.ask("601#2301120190060000", "581#6001120100000000");
  node.ask("690#23011202A0060080", "6A0#6001120200000000");
  node.rx("690#4000100000000000");
  node.silent();
}

TEST_CASE("SDO channels: restricted CAN-IDs are refused, all others accepted [D16] [D26]") {
  Fixture node(Setup().only_small());
  for (const unsigned sub : {1U, 2U}) {
    for (unsigned id = 0; id < 0x800; id += stride(31)) {
      CAPTURE(sub);
      CAPTURE(id);
      CO_IF_FRM write = frame(sub == 1 ? "601#2301120100000000" : "601#2301120200000000");
      CO_SET_LONG(&write, id, 4);
      node.rx(write);
      const std::vector<std::string> sent = node.frames();
      REQUIRE(sent.size() == 1);
      const std::string object = sub == 1 ? "011201" : "011202";
      CHECK(sent[0] == "581#" + (is_forbidden(id) ? "80" + object + "30000906" : "60" + object + "00000000"));
      CO_SET_BYTE(&write, 0x80, 7);
      node.rx(write);
      node.frames();
    }
  }
}

TEST_CASE("SDO channels: a CAN-ID of more than 11 bits needs bit 29 [D16]") {
  Fixture node;
  node.ask("601#2301120190160000", "581#8001120130000906");
  node.ask("601#2301120190160020", "581#6001120100000000");
  node.ask("601#23011202A0160020", "581#6001120200000000");
  node.ask("00001690#4000100000000000", "000016A0#4300100091010F00");
  node.rx("690#4000100000000000");
  node.silent();
}

TEST_CASE("SDO channels: a COB-ID relative to the node-ID is read back as written with unchanged flags [D16]") {
  struct Row {
    const char* bytes;     // COB-ID in bus order
    std::uint32_t stored;  // 127 (the node-ID) is subtracted from the CAN-ID, modulo its width; flags do not change
  };
  const Row rows[] = {
      {"05000080", 0x80000786},  // below the node-ID
      {"00000080", 0x80000781},  // 0
      {"7F000080", 0x80000000},  // the node-ID
      {"7E0000C0", 0xC00007FF},  // dynamic
      {"050000A0", 0xBFFFFF86},  // 29 bits
      {"FF0700C0", 0xC0000780},  // highest 11-bit CAN-ID
      {"FFFFFFBF", 0xBFFFFF80},  // highest 29-bit CAN-ID
      {"90060000", 0x00000611},  // valid
  };
  for (const Row& row : rows) {
    const std::string bytes = row.bytes;
    CAPTURE(bytes);
    std::uint32_t cob_id = 0x80000000;
    Fixture node(Setup().only_small().node_id(127).with({CO_KEY(0x1201, 1, CO_OBJ__N__RW), CO_TSDO_ID, &cob_id}));
    node.ask("67F#4001120100000000", "5FF#430112017F000080");
    node.ask("67F#23011201" + bytes, "5FF#6001120100000000");
    node.ask("67F#4001120100000000", "5FF#43011201" + bytes);
    CHECK(cob_id == row.stored);
    node.rx("000#827F");
    node.tx("77F#00");
    node.ask("67F#4001120100000000", "5FF#43011201" + bytes);
  }
}

TEST_CASE("SDO channels: COB-IDs relative to the node-ID use the CAN-IDs that were written [D16]") {
  std::uint32_t rx = 0x80000000;
  std::uint32_t tx = 0x80000000;
  Fixture node(Setup()
                   .only_small()
                   .node_id(127)
                   .with({CO_KEY(0x1201, 1, CO_OBJ__N__RW), CO_TSDO_ID, &rx})
                   .with({CO_KEY(0x1201, 2, CO_OBJ__N__RW), CO_TSDO_ID, &tx}));
  node.ask("67F#2301120190060000", "5FF#6001120100000000");
  node.ask("67F#2301120280000020", "5FF#6001120200000000");
  node.ask("690#4000100000000000", "00000080#4300100091010F00");
  CHECK(tx == 0x20000001);
}

TEST_CASE("SDO channels: a reset ends transfers in other channels and keeps the COB-IDs [N6]") {
  Fixture node(channels());
  node.ask("690#4008100000000000", "6A0#4108100011000000");
  node.rx("000#8201");
  node.tx("701#00");
  node.ask("690#6001020300000000", "6A0#8001020301000405");
}

TEST_CASE("SDO channels: two transfers of different objects are independent in any interleaving") {
  struct Step {
    const char* request;
    const char* answer;
  };
  const Step one[] = {{"601#4008100000000000", "581#4108100011000000"},
                      {"601#6000000000000000", "581#004C65786963616E"},
                      {"601#7000000000000000", "581#102074657374206E"},
                      {"601#6000000000000000", "581#096F646500000000"}};
  const Step two[] = {{"690#2100210F0F000000", "6A0#6000210F00000000"},
                      {"690#00A1A2A3A4A5A6A7", "6A0#2000000000000000"},
                      {"690#10A8A9AAABACADAE", "6A0#3000000000000000"},
                      {"690#0DAF000000000000", "6A0#2000000000000000"}};
  unsigned interleavings = 0;
  for (unsigned order = 0; order < 256; ++order) {
    if (__builtin_popcount(order) != 4) continue;
    ++interleavings;
    CAPTURE(order);
    Fixture node(channels().only_small());
    std::size_t i = 0;
    std::size_t j = 0;
    for (unsigned step = 0; step < 8; ++step) {
      const Step& next = ((order >> step) & 1U) != 0 ? one[i++] : two[j++];
      node.ask(next.request, next.answer);
    }
    CHECK(node.objects.memory[15][0] == 0xA1);
    CHECK(node.objects.memory[15][14] == 0xAF);
  }
  CHECK(interleavings == 70);
}

TEST_CASE("SDO channels: the same value can be transferred by two channels at once") {
  Fixture node(channels());
  node.ask("601#4008200000000000", "581#4108200008000000");
  node.ask("690#2108200008000000", "6A0#6008200000000000");
  node.ask("690#0001020304050607", "6A0#2000000000000000");
  node.ask("601#6000000000000000", "581#0011223344556677");
  node.ask("690#1D08000000000000", "6A0#3000000000000000");
  node.ask("601#7000000000000000", "581#1D88000000000000");
  CHECK(node.objects.u64 == 0x0807060504030201);
}

TEST_CASE("SDO channels: a stream that is open in one channel is refused to another one with 0800 0022h") {
  Fixture node(channels());
  node.ask("601#4000210F00000000", "581#4100210F0F000000");
  node.ask("690#4000210F00000000", "6A0#8000210F22000008");
  node.ask("690#2100210F0F000000", "6A0#8000210F22000008");
  node.ask("690#2F00210FAA000000", "6A0#8000210F22000008");
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.ask("601#7000000000000000", "581#1008090A0B0C0D0E");
  node.ask("601#6000000000000000", "581#0D0F000000000000");
  node.ask("690#4000210F00000000", "6A0#4100210F0F000000");
}

TEST_CASE("SDO channels: a channel may open its own stream anew [D8]") {
  Fixture node(channels());
  node.ask("601#4000210F00000000", "581#4100210F0F000000");
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.ask("601#4000210F00000000", "581#4100210F0F000000");
  node.ask("601#6000000000000000", "581#0001020304050607");
}

TEST_CASE("SDO channels: each has its own time-out [D18]") {
  Fixture node(channels());
  const Time timeout = node.sdo_time_out();
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.after(timeout / 2);
  node.ask("690#4008200000000000", "6A0#4108200008000000");
  node.after(timeout / 2);
  node.tx("581#8008100000000405");
  node.after(timeout / 2);
  node.tx("6A0#8008200000000405");
}

#if CO_SSDO_N >= 3

TEST_CASE("SDO channels: two channels at the same request CAN-ID both answer") {
  Fixture node(Setup().before_init([](Objects& o) {
    o.sdo2_rx = o.sdo3_rx = 0x690;
    o.sdo2_tx = 0x6A0;
    o.sdo3_tx = 0x6A1;
  }));
  node.frames_per_call(2);
  node.rx("690#4000100000000000");
  node.tx({"6A0#4300100091010F00", "6A1#4300100091010F00"});
}

TEST_CASE("SDO channels: the receive filter contains the request CAN-IDs and follows changes") {
  Fixture node(channels());
  CHECK(node.can.filter == std::vector<std::uint32_t>{0x000, 0x601, 0x690, 0x691, 0x701});
  node.ask("601#2301120190060080", "581#6001120100000000");
  CHECK(node.can.filter == std::vector<std::uint32_t>{0x000, 0x601, 0x691, 0x701});
}

#endif

#endif

// Invalid COB-IDs of SDO servers, in the dictionary or written by the network. [301:7.5.2.33, 7.3.5]

TEST_CASE("SDO COB-ID: 1200h with the CAN-ID 000h switches the default server off, and nothing is sent at 000h") {
  for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}}) {
    CAPTURE(sub);
    Fixture node(Setup().with({CO_KEY(0x1200, sub, CO_OBJ_D___R_), CO_TSDO_ID, 0}));
    node.rx("601#4000100000000000");
    node.rx("000#4000100000000000");
    node.silent();
    CHECK(node.can.filter == std::vector<std::uint32_t>{0x000, 0x701});
    node.rx("000#0101");
    CHECK(node.mode() == CO_OPERATIONAL);
  }
}

TEST_CASE("SDO COB-ID: 1200h that is 000h with the node-ID added switches the default server off") {
  Fixture node(Setup().with({CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TSDO_ID, 0x7FF}));
  node.rx("601#4000100000000000");
  node.silent();
}

#if CO_SSDO_N >= 2

void check_default_serves(Fixture& node) { node.ask("601#4000100000000000", "581#4300100091010F00"); }

Setup second_server(std::uint32_t rx, std::uint32_t tx) {
  return Setup().before_init([=](Objects& o) {
    o.sdo2_rx = rx;
    o.sdo2_tx = tx;
  });
}

void check_second_off(Fixture& node) {
  node.rx("690#4000100000000000");
  node.rx("000#4000100000000000");
  node.rx("00000000#4000100000000000");
  node.silent();
  CHECK(node.can.filter == std::vector<std::uint32_t>{0x000, 0x601, 0x701});
  check_default_serves(node);
}

TEST_CASE("SDO COB-ID: 1201h with the CAN-ID 000h in the table is off, and nothing is sent at 000h") {
  struct Case {
    std::uint32_t rx;
    std::uint32_t tx;
  };
  const Case cases[] = {{0x690, 0},          {0, 0x6A0},          {0, 0},         {0x690, 0x20000000},
                        {0x20000000, 0x6A0}, {0x690, 0x40000000}, {0x40000000, 0}};
  for (const Case& one : cases) {
    CAPTURE(one.rx);
    CAPTURE(one.tx);
    Fixture node(second_server(one.rx, one.tx));
    check_second_off(node);
    node.rx("000#8201");
    node.tx("701#00");
    check_second_off(node);
  }
}

TEST_CASE("SDO COB-ID: 1201h stays off while one CAN-ID is 000h, for any value of the other") {
  Fixture node(second_server(0x80000000, 0));
  node.ask("601#2301120190060000", "581#6001120100000000");
  check_second_off(node);
  node.ask("601#2301120200000000", "581#6001120200000000");
  check_second_off(node);
  node.ask("601#2301120200000080", "581#6001120200000000");
  node.ask("601#2301120200000000", "581#8001120230000906");
  check_second_off(node);
  node.ask("601#23011202A0060000", "581#6001120200000000");
  node.ask("690#4000100000000000", "6A0#4300100091010F00");
}

TEST_CASE("SDO COB-ID: the application cannot set 1201h to 000h either") {
  Fixture node(second_server(0x690, 0x80000000));
  node.call([&] { CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1201, 2), 0) == CO_ERR_OBJ_RANGE); });
  check_second_off(node);
  CHECK(node.objects.sdo2_tx == 0x80000000);
}

#endif

#if CO_SSDO_N >= 3

TEST_CASE("SDO COB-ID: a CAN-ID above 7FFh without bit 29 in the table disables its own channel only") {
  struct Case {
    std::uint32_t rx;
    std::uint32_t tx;
  };
  const Case cases[] = {{0x1690, 0x16A0}, {0x1690, 0x6A0},          {0x690, 0x16A0},
                        {0x0800, 0x0800}, {0x1FFFFFFF, 0x1FFFFFFF}, {0x1600, 0x1580}};
  for (const Case& one : cases) {
    CAPTURE(one.rx);
    CAPTURE(one.tx);
    Fixture node(Setup().before_init([=](Objects& o) {
      o.sdo2_rx = one.rx;
      o.sdo2_tx = one.tx;
      o.sdo3_rx = 0x691;
      o.sdo3_tx = 0x6A1;
    }));
    for (const char* request : {"690#4000100000000000", "00001690#4000100000000000", "00000800#4000100000000000",
                                "1FFFFFFF#4000100000000000", "00001600#4000100000000000", "600#4000100000000000"}) {
      node.rx(request);
    }
    node.silent();
    CHECK(node.can.filter == std::vector<std::uint32_t>{0x000, 0x601, 0x691, 0x701});
    check_default_serves(node);
    node.ask("691#4000100000000000", "6A1#4300100091010F00");
    node.rx("000#0101");
    CHECK(node.mode() == CO_OPERATIONAL);
  }
}

#endif

// Block transfers of several SDO servers at the same time. [301:7.5.2.33]

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127 && CO_SSDO_N >= 2

// Returns the settings of a node whose second SDO server uses 690h/6A0h.
Setup two() {
  return Setup().before_init([](Objects& o) {
    o.sdo2_rx = 0x690;
    o.sdo2_tx = 0x6A0;
  });
}

CO_IF_FRM on_second(CO_IF_FRM frm) {
  frm.Identifier = 0x690;
  return frm;
}

TEST_CASE("SDO block channels: two downloads alternate segment by segment") {
  Fixture node(two());
  const Bytes one = counting(890, 3);
  const Bytes other = counting(889, 200);
  node.ask("601#C60421007A030000", "581#A40421007F000000");
  node.ask("690#C601210079030000", "6A0#A40121007F000000");
  for (unsigned n = 0; n < 126; ++n) {
    node.rx(block_segment(one, n, n + 1));
    node.rx(on_second(block_segment(other, n, n + 1)));
    node.silent();
  }
  node.rx(block_segment(one, 126, 127));
  node.tx("581#A27F7F0000000000");
  node.rx(on_second(block_segment(other, 126, 127)));
  CHECK(node.frames().size() == 1);
  node.rx(block_segment(one, 127, 1));
  expect_last_ack(node, 1);
  node.rx(block_end(0x690, other));
  node.tx("6A0#A100000000000000");
  node.rx(block_end(0x601, one));
  node.tx("581#A100000000000000");
  CHECK(node.objects.memory[890] == one);
  CHECK(node.objects.memory[889] == other);
}

TEST_CASE("SDO block channels: a download is possible during a paused upload [D20]") {
  Fixture node(two());
  const Bytes other = counting(889, 200);
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.accept_next(40);
  node.rx("601#A300000000000000");
  expect_segments(node, counting(890), 0, 40);
  node.rx("690#C601210079030000");
  node.can.accept_all();
  node.loop();
  std::vector<std::string> sent = node.frames();
  REQUIRE(sent.size() == 88);
  CHECK(sent.front() == "6A0#A40121007F000000");
  CHECK(sent[1].substr(0, 6) == "581#29");
  CHECK(sent.back().substr(0, 6) == "581#7F");
  for (unsigned n = 0; n < 127; ++n) {
    node.silent();
    node.rx(on_second(block_segment(other, n, n + 1)));
  }
  CHECK(node.frames().size() == 1);
  node.rx(block_end(0x690, other));
  node.tx("6A0#A100000000000000");
  CHECK(node.objects.memory[889] == other);
  node.rx("601#A27F7F0000000000");
  expect_segments(node, counting(890), 127, 1);
  node.rx("601#A2017F0000000000");
  node.tx(notation(block_end(0x581, counting(890))));
  node.rx("601#A100000000000000");
}

TEST_CASE("SDO block channels: two paused uploads both resume [D20]") {
  Fixture node(two());
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.ask("690#A40121007F000000", "6A0#C601210079030000");
  node.can.refuse_all();
  node.rx("601#A300000000000000");
  node.rx("690#A300000000000000");
  std::vector<std::string> first;
  std::vector<std::string> second;
  for (unsigned calls = 0; calls < 300 && first.size() + second.size() < 254; ++calls) {
    node.can.accept_next(1);
    node.loop();
    for (const std::string& sent : node.frames()) {
      (sent[0] == '5' ? first : second).push_back(sent);
    }
  }
  CHECK(first.size() == 127);
  CHECK(second.size() == 127);
  node.can.accept_all();
  node.rx("601#A2007F0000000000");
  expect_segments(node, counting(890), 0, 127);
  node.rx("690#A27F7F0000000000");
  CO_IF_FRM end = block_end(0x6A0, counting(889));
  node.tx(notation(end));
}

TEST_CASE("SDO block channels: a stream open in one channel is refused to the second with 0800 0022h") {
  for (const char* first :
       {"601#C60421007A030000", "601#A40421007F000000", "601#210421007A030000", "601#4004210000000000"}) {
    CAPTURE(std::string(first));
    Fixture node(two());
    node.rx(first);
    CHECK(node.frames().size() == 1);
    for (const char* second : {"690#C60421007A030000", "690#A40421007F000000", "690#210421007A030000",
                               "690#4004210000000000", "690#2304210001020304"}) {
      node.ask(second, "6A0#8004210022000008");
    }
    node.rx("601#8004210000000008");
    node.ask("690#A40421007F000000", "6A0#C60421007A030000");
  }
}

TEST_CASE("SDO block channels: a value may be downloaded by both; the last end determines it") {
  Fixture node(two());
  node.ask("601#C604200004000000", "581#A40420007F000000");
  node.ask("690#C604200004000000", "6A0#A40420007F000000");
  node.rx("601#8101010101000000");
  expect_last_ack(node, 1);
  node.rx("690#8102020202000000");
  CHECK(node.frames().size() == 1);
  node.rx(block_end(0x690, Bytes{2, 2, 2, 2}));
  node.tx("6A0#A100000000000000");
  CHECK(node.objects.u32 == 0x02020202);
  node.rx(block_end(0x601, Bytes{1, 1, 1, 1}));
  node.tx("581#A100000000000000");
  CHECK(node.objects.u32 == 0x01010101);
}

TEST_CASE("SDO block channels: silence is monitored and answered separately on each channel [D11] [D18]") {
  Fixture node(two());
  node.ask("601#C60421007A030000", "581#A40421007F000000");
  node.ask("690#A40121007F000000", "6A0#C601210079030000");
  node.after(1000ms);
  CHECK(node.trace() == std::vector<std::string>{"500 581#A40421007F000000", "1000 581#A40421007F000000"});
  node.rx("601#0155555555555555");
  node.after(1000ms);
  CHECK(node.trace() ==
        std::vector<std::string>{"500 581#A2017E0000000000", "1000 581#A2017E0000000000", "1000 6A0#8001210000000405"});
}

TEST_CASE("SDO block channels: changing the COB-ID of a channel ends its transfer; the other one continues [D16]") {
  Fixture node(two());
  node.ask("690#C60421007A030000", "6A0#A40421007F000000");
  node.ask("601#A40121007F000000", "581#C601210079030000");
  node.ask("601#2301120190060080", "581#6001120100000000");
  node.rx("690#0155555555555555");
  node.silent();
  node.after(node.sdo_time_out());
  node.silent();
  CHECK(node.block_download(0x2104, 0, counting(890, 9)).abort == 0);
}

TEST_CASE("SDO block channels: each channel has its own part of the buffer") {
  Fixture node(two());
  const Bytes one(889, 0x11);
  const Bytes other(888, 0x22);
  node.ask("601#C601210079030000", "581#A40121007F000000");
  node.ask("690#C603210078030000", "6A0#A40321007F000000");
  send_segments(node, one, 0, 127);
  expect_last_ack(node, 127);
  for (unsigned n = 0; n < 127; ++n) {
    node.rx(on_second(block_segment(other, n, n + 1)));
  }
  CHECK(node.frames().size() == 1);
  node.rx(block_end(0x601, one));
  node.tx("581#A100000000000000");
  node.rx(block_end(0x690, other));
  node.tx("6A0#A100000000000000");
  CHECK(node.objects.memory[889] == one);
  CHECK(node.objects.memory[888] == other);
}

#endif

}  // namespace
