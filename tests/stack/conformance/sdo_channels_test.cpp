// SPDX-License-Identifier: Apache-2.0
// Several SDO servers, and their COB-IDs. [301:7.5.2.33]
#include "support/fixture.hpp"
#include "support/restricted_ids.hpp"

#if CO_SSDO_N >= 2

namespace {

using namespace test;

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

}  // namespace

#endif
