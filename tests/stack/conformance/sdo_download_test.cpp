// SPDX-License-Identifier: Apache-2.0
// SDO server: download, expedited and segmented. [301:7.2.4.3.3, 7.2.4.3.4]
#include <random>

#include "support/block_frames.hpp"
#include "support/fixture.hpp"

namespace {

using namespace test;

// Returns the abort frame for a download of the wrong length to 2100h:sub.
CO_IF_FRM abort_of(unsigned sub, bool too_long) {
  CO_IF_FRM frm = frame(too_long ? "581#8000210012000706" : "581#8000210013000706");
  frm.Data[3] = static_cast<std::uint8_t>(sub);
  return frm;
}

TEST_CASE("SDO download: one to four bytes are sent expedited and confirmed with the multiplexer [D2] [D3]") {
  Fixture node;
  node.ask("601#2F012000A5000000", "581#6001200000000000");
  CHECK(node.objects.u8 == 0xA5);
  node.ask("601#2B02200034120000", "581#6002200000000000");
  CHECK(node.objects.u16 == 0x1234);
  node.ask("601#2703200056341200", "581#6003200000000000");
  CHECK(node.objects.u24 == 0x123456);
  node.ask("601#2304200078563412", "581#6004200000000000");
  CHECK(node.objects.u32 == 0x12345678);
}

TEST_CASE("SDO download: unused bytes are ignored [D2]") {
  Fixture node;
  node.ask("601#2F012000A5FFFFFF", "581#6001200000000000");
  CHECK(node.objects.u8 == 0xA5);
  node.ask("601#2B0220003412FFFF", "581#6002200000000000");
  CHECK(node.objects.u16 == 0x1234);
}

TEST_CASE("SDO download: an expedited one without a size has the size of the object [D2]") {
  Fixture node;
  node.ask("601#22012000A5000000", "581#6001200000000000");
  CHECK(node.objects.u8 == 0xA5);
  node.ask("601#2202200034120000", "581#6002200000000000");
  CHECK(node.objects.u16 == 0x1234);
  node.ask("601#2203200056341200", "581#6003200000000000");
  CHECK(node.objects.u24 == 0x123456);
  node.ask("601#2204200078563412", "581#6004200000000000");
  CHECK(node.objects.u32 == 0x12345678);
  node.ask("601#22002103AABBCC00", "581#6000210300000000");
  CHECK(node.objects.memory[3] == Bytes{0xAA, 0xBB, 0xCC});
}

TEST_CASE("SDO download: an expedited one without a size is refused for an object of more than 4 bytes [D2]") {
  Fixture node;
  node.ask("601#2208200078563412", "581#8008200010000706");
  node.ask("601#2200210F78563412", "581#8000210F10000706");
}

TEST_CASE(
    "SDO download: values of up to eight bytes are written in segments with announced size [D4] [SDO 14] [SDO 15]") {
  Fixture node;
  node.ask("601#2117100002000000", "581#6017100000000000");
  node.ask("601#0BE8030000000000", "581#2000000000000000");
  CHECK(node.objects.heartbeat == 1000);
  node.ask("601#2108200008000000", "581#6008200000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  CHECK(node.objects.u64 == 0x8877665544332211);
  node.ask("601#1D08000000000000", "581#3000000000000000");
  CHECK(node.objects.u64 == 0x0807060504030201);
  node.ask("601#2105200005000000", "581#6005200000000000");
  node.ask("601#0501020304050000", "581#2000000000000000");
  CHECK(node.objects.u40 == 0x0504030201);
}

TEST_CASE("SDO download: values are written in segments without announced size [D2] [D4]") {
  Fixture node;
  node.ask("601#2001200000000000", "581#6001200000000000");
  node.ask("601#0D5A000000000000", "581#2000000000000000");
  CHECK(node.objects.u8 == 0x5A);
  node.ask("601#2008200000000000", "581#6008200000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#1D08000000000000", "581#3000000000000000");
  CHECK(node.objects.u64 == 0x0807060504030201);
}

TEST_CASE("SDO download: segments may have fewer than 7 bytes [D4]") {
  Fixture node;
  node.ask("601#2104200004000000", "581#6004200000000000");
  node.ask("601#0C01000000000000", "581#2000000000000000");
  node.ask("601#1C02000000000000", "581#3000000000000000");
  CHECK(node.objects.u32 == 0x44332211);
  node.ask("601#0B03040000000000", "581#2000000000000000");
  CHECK(node.objects.u32 == 0x04030201);
}

TEST_CASE("SDO download: four bytes of unknown size to a longer object are refused without an open transfer [D2]") {
  Fixture node;
  const std::string objects[] = {"052000", "082000", "282000", "262000", "00210F", "102100", "112100"};
  for (const std::string& object : objects) {
    CAPTURE(object);
    node.ask("601#22" + object + "01020304", "581#80" + object + "10000706");
    node.ask("601#0001020304050607", "581#8001020301000405");
    node.ask("601#6001020304050607", "581#8001020301000405");
    node.after(2 * node.sdo_time_out());
    node.silent();
  }
  CHECK(node.objects.u64 == 0x8877665544332211);
  CHECK(node.objects.memory[15][0] == 1);
  CHECK(node.objects.text.Size == 4);
}

TEST_CASE(
    "SDO download: an aborted one does not change a value, and leaves received bytes in a string or domain [D10]") {
  Fixture node;
  node.ask("601#2108200008000000", "581#6008200000000000");
  node.ask("601#00A1A2A3A4A5A6A7", "581#2000000000000000");
  node.rx("601#8008200000000008");
  CHECK(node.objects.u64 == 0x8877665544332211);
  node.ask("601#2110210010000000", "581#6010210000000000");
  node.ask("601#0041424344454647", "581#2000000000000000");
  node.rx("601#8010210000000008");
  node.ask("601#4010210000000000", "581#4110210007000000");
  node.ask("601#6000000000000000", "581#0141424344454647");
  node.ask("601#2100210F0F000000", "581#6000210F00000000");
  node.ask("601#00A1A2A3A4A5A6A7", "581#2000000000000000");
  node.ask("601#0000000000000000", "581#8000210F00000305");
  CHECK(node.objects.memory[15] == Bytes{0xA1, 0xA2, 0xA3, 0xA4, 0xA5, 0xA6, 0xA7, 8, 9, 10, 11, 12, 13, 14, 15});
}

TEST_CASE("SDO download: a value is not written before it is complete [D10]") {
  Fixture node;
  node.ask("601#2108200008000000", "581#6008200000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  CHECK(node.objects.u64 == 0x8877665544332211);
  node.rx("601#8008200000000405");
  node.silent();
  CHECK(node.objects.u64 == 0x8877665544332211);
}

TEST_CASE("SDO download: an announced size that does not fit is refused at once [D5] [SDO 08] [SDO 09]") {
  Fixture node;
  node.ask("601#2104200005000000", "581#8004200012000706");
  node.ask("601#2104200003000000", "581#8004200013000706");
  node.ask("601#2104200000000000", "581#8004200013000706");
  node.ask("601#21042000FFFFFFFF", "581#8004200012000706");
  node.ask("601#2104200000000080", "581#8004200012000706");
  node.ask("601#2108200009000000", "581#8008200012000706");
  node.ask("601#2108200007000000", "581#8008200013000706");
  node.ask("601#2100210500000100", "581#8000210512000706");
  node.ask("601#2100210506000000", "581#8000210512000706");
  node.ask("601#211121000B000000", "581#8011210012000706");
  node.ask("601#0001020304050607", "581#8001020301000405");
}

TEST_CASE("SDO download: an expedited length that does not fit is refused [D5] [SDO 08] [SDO 09]") {
  Fixture node;
  node.ask("601#2301200001000000", "581#8001200012000706");
  node.ask("601#2B01200001000000", "581#8001200012000706");
  node.ask("601#2302200001000000", "581#8002200012000706");
  node.ask("601#2F02200001000000", "581#8002200013000706");
  node.ask("601#2F04200001000000", "581#8004200013000706");
  node.ask("601#2308200001000000", "581#8008200013000706");
  node.ask("601#2300210301020304", "581#8000210312000706");
}

TEST_CASE("SDO download: fewer bytes than announced are refused at the last segment [D5]") {
  Fixture node;
  node.ask("601#2104200004000000", "581#6004200000000000");
  node.ask("601#0901020300000000", "581#8004200013000706");
  CHECK(node.objects.u32 == 0x44332211);
  node.ask("601#2100210508000000", "581#8000210512000706");
  node.ask("601#2100210F08000000", "581#6000210F00000000");
  node.ask("601#0101020304050607", "581#8000210F13000706");
  node.ask("601#1D08000000000000", "581#8008000001000405");
}

TEST_CASE("SDO download: more bytes than announced are refused at the segment that exceeds the size [D5]") {
  Fixture node;
  node.ask("601#2104200004000000", "581#6004200000000000");
  node.ask("601#0501020304050000", "581#8004200012000706");
  CHECK(node.objects.u32 == 0x44332211);
  node.ask("601#2100210F08000000", "581#6000210F00000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#1B08090000000000", "581#8000210F12000706");
}

TEST_CASE(
    "SDO download: n = 0 in the last segment means no size: it contains the rest of the announced size [D4] [D5]") {
  Fixture node;
  node.ask("601#2108200008000000", "581#6008200000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#1108FFFFFFFFFFFF", "581#3000000000000000");
  CHECK(node.objects.u64 == 0x0807060504030201);
  node.ask("601#2104200004000000", "581#6004200000000000");
  node.ask("601#01A1A2A3A4FFFFFF", "581#2000000000000000");
  CHECK(node.objects.u32 == 0xA4A3A2A1);
  node.ask("601#2100210F0F000000", "581#6000210F00000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#1008090A0B0C0D0E", "581#3000000000000000");
  node.ask("601#010FFFFFFFFFFFFF", "581#2000000000000000");
  CHECK(node.objects.memory[15] == Bytes{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15});
}

TEST_CASE("SDO download: n = 0 in the last segment is accepted for each rest; any other n is checked [D5]") {
  for (unsigned size = 1; size <= 9; ++size) {
    for (unsigned n = 0; n < 8; ++n) {
      CAPTURE(size);
      CAPTURE(n);
      Fixture node(Setup().only_small());
      CO_IF_FRM initiate = frame("601#2100210000000000");
      initiate.Data[3] = static_cast<std::uint8_t>(size);
      initiate.Data[4] = static_cast<std::uint8_t>(size);
      node.rx(initiate);
      node.frames();
      const unsigned left = size > 7 ? size - 7 : size;
      if (size > 7) {
        node.ask("601#00A1A2A3A4A5A6A7", "581#2000000000000000");
      }
      CO_IF_FRM last = frame("601#01B1B2B3B4B5B6B7");
      last.Data[0] = static_cast<std::uint8_t>((size > 7 ? 0x11U : 0x01U) | (n << 1));
      node.rx(last);
      const std::string done = size > 7 ? "581#3000000000000000" : "581#2000000000000000";
      const std::string end = n == 0 || 7 - n == left ? done : notation(abort_of(size, 7 - n > left));
      CHECK(node.frames() == std::vector<std::string>{end});
      if (end == done) {
        CHECK(node.objects.memory[size].back() == 0xB0 + left);
      }
    }
  }
}

TEST_CASE(
    "SDO download: n = 0 means 7 bytes if no rest, a longer rest or no size is announced, and in other segments [D5]") {
  Fixture node;
  node.ask("601#2100210000000000", "581#6000210000000000");
  node.ask("601#0101020304050607", "581#8000210012000706");
  node.ask("601#2100210808000000", "581#6000210800000000");
  node.ask("601#0101020304050607", "581#8000210813000706");
  node.ask("601#2100210505000000", "581#6000210500000000");
  node.ask("601#0001020304050607", "581#8000210512000706");
  node.ask("601#2004200000000000", "581#6004200000000000");
  node.ask("601#0101020304050607", "581#8004200012000706");
  CHECK(node.objects.u32 == 0x44332211);
}

TEST_CASE("SDO download: more bytes than announced are refused even before the last segment [D5]") {
  Fixture node;
  node.ask("601#2100210F05000000", "581#6000210F00000000");
  node.ask("601#0001020304050607", "581#8000210F12000706");
}

TEST_CASE("SDO download: without an announced size that of the object is checked [D5]") {
  Fixture node;
  node.ask("601#2004200000000000", "581#6004200000000000");
  node.ask("601#0901020300000000", "581#8004200013000706");
  node.ask("601#2004200000000000", "581#6004200000000000");
  node.ask("601#0501020304050000", "581#8004200012000706");
  node.ask("601#2004200000000000", "581#6004200000000000");
  node.ask("601#0F00000000000000", "581#8004200013000706");
  node.ask("601#2000210500000000", "581#6000210500000000");
  node.ask("601#0001020304050607", "581#8000210512000706");
  CHECK(node.objects.u32 == 0x44332211);
}

TEST_CASE("SDO download: a domain accepts fewer bytes than its memory [D5]") {
  Fixture node;
  node.ask("601#2100210F02000000", "581#6000210F00000000");
  node.ask("601#0BAABB0000000000", "581#2000000000000000");
  node.ask("601#2F002105CC000000", "581#6000210500000000");
  CHECK(node.objects.memory[15][0] == 0xAA);
  CHECK(node.objects.memory[15][1] == 0xBB);
  CHECK(node.objects.memory[15][2] == 3);
  CHECK(node.objects.memory[5][0] == 0xCC);
  CHECK(node.objects.memory[5][1] == 2);
}

TEST_CASE("SDO download: each download of a short domain is written from its beginning [D2]") {
  Fixture node;
  node.ask("601#2B00210211220000", "581#6000210200000000");
  CHECK(node.objects.memory[2] == Bytes{0x11, 0x22});
  node.ask("601#2B00210233440000", "581#6000210200000000");
  CHECK(node.objects.memory[2] == Bytes{0x33, 0x44});
}

TEST_CASE("SDO download: an empty download empties a string or a domain [D19]") {
  Fixture node;
  node.ask("601#2100210500000000", "581#6000210500000000");
  node.ask("601#0F00000000000000", "581#2000000000000000");
  node.ask("601#2111210000000000", "581#6011210000000000");
  node.ask("601#0F00000000000000", "581#2000000000000000");
  CHECK(node.objects.octets.Size == 0);
  node.ask("601#2010210000000000", "581#6010210000000000");
  node.ask("601#0F00000000000000", "581#2000000000000000");
  node.ask("601#4010210000000000", "581#4110210000000000");
  node.ask("601#6000000000000000", "581#0F00000000000000");
  node.ask("601#2100210000000000", "581#6000210000000000");
  node.ask("601#0F00000000000000", "581#2000000000000000");
}

TEST_CASE("SDO download: strings may be shorter than their capacity and are read back with that length [D5]") {
  Fixture node;
  node.ask("601#2110210009000000", "581#6010210000000000");
  node.ask("601#0053686F72746572", "581#2000000000000000");
  node.ask("601#1B2E2E0000000000", "581#3000000000000000");
  node.ask("601#4010210000000000", "581#4110210009000000");
  node.ask("601#6000000000000000", "581#0053686F72746572");
  node.ask("601#7000000000000000", "581#1B2E2E0000000000");
  node.ask("601#2710210041424300", "581#6010210000000000");
  node.ask("601#4010210000000000", "581#4710210041424300");
  node.ask("601#2B12210041000000", "581#6012210000000000");
  node.ask("601#4012210000000000", "581#4B12210041000000");
  CHECK(node.objects.unicode_memory[0] == 0x0041);
}

TEST_CASE("SDO download: half characters of a UNICODE_STRING are refused [D5]") {
  Fixture node;
  node.rx("601#2712210041000000");
  const std::vector<std::string> sent = node.frames();
  REQUIRE(sent.size() == 1);
  CHECK(sent[0].substr(0, 12) == "581#80122100");
  CHECK(sent[0].substr(14) == "000706");
  CHECK(node.objects.unicode.Size == 6);
}

TEST_CASE("SDO download: a string may fill its capacity [D5]") {
  Fixture node;
  const Bytes sixteen{'0', '1', '2', '3', '4', '5', '6', '7', '8', '9', 'a', 'b', 'c', 'd', 'e', 'f'};
  CHECK(node.download(0x2110, 0, sixteen) == 0);
  CHECK(node.upload(0x2110, 0) == sixteen);
  const Bytes ten{0, 1, 0, 3, 4, 5, 0, 7, 8, 0};
  CHECK(node.download(0x2111, 0, ten, false) == 0);
  CHECK(node.upload(0x2111, 0) == ten);
  CHECK(node.download(0x2111, 0, sixteen, false) == 0x06070012);
}

TEST_CASE("SDO download: data of every size are written unchanged, whether announced or not [D4]") {
  Fixture node(Setup().with_70000());
  for (const bool announced : {true, false}) {
    CAPTURE(announced);
    for (const std::uint32_t size : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U, 14U, 15U, 889U, 70000U}) {
      if (size == 70000 && announced && stride(2) > 1) continue;
      CAPTURE(size);
      Bytes data(size);
      for (std::uint32_t i = 0; i < size; ++i) {
        data[i] = static_cast<std::uint8_t>(0xFF - i * 3 - (announced ? 1 : 0));
      }
      const std::uint16_t index = size < 16 ? 0x2100 : size == 889 ? 0x2101 : 0x2102;
      const auto sub = static_cast<std::uint8_t>(size < 16 ? size : 0);
      CHECK(node.download(index, sub, data, announced) == 0);
      CHECK(node.objects.memory[size] == data);
      data.push_back(0);
      CHECK(node.download(index, sub, data, announced) == 0x06070012);
    }
  }
}

TEST_CASE("SDO download: a wrong toggle bit at the first segment is aborted with 0503 0000h [D4]") {
  Fixture node;
  node.ask("601#2108200008000000", "581#6008200000000000");
  node.ask("601#1001020304050607", "581#8008200000000305");
  node.ask("601#0001020304050607", "581#8001020301000405");
}

TEST_CASE("SDO download: a repeated toggle bit is aborted with 0503 0000h [D4]") {
  Fixture node;
  node.ask("601#2108200008000000", "581#6008200000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#0D08000000000000", "581#8008200000000305");
  CHECK(node.objects.u64 == 0x8877665544332211);
}

TEST_CASE("SDO download: a segment without a transfer is aborted with its own bytes 1 to 3 [D7] [D25]") {
  Fixture node;
  node.ask("601#0311223344556677", "581#8011223301000405");
  node.ask("601#1311223344556677", "581#8011223301000405");
  for (int i = 0; i < 300; ++i) {
    node.ask("601#0311223344556677", "581#8011223301000405");
    node.ask("601#1311223344556677", "581#8011223301000405");
  }
}

TEST_CASE("SDO download: a segment after the last one is stray [D7]") {
  Fixture node;
  node.ask("601#2104200004000000", "581#6004200000000000");
  node.ask("601#0701020304000000", "581#2000000000000000");
  node.ask("601#1701020304000000", "581#8001020301000405");
}

TEST_CASE("SDO download: an upload segment request is aborted [D9] [D25]") {
  Fixture node;
  node.ask("601#2108200008000000", "581#6008200000000000");
  node.ask("601#60AABBCC00000000", "581#8008200001000405");
  node.ask("601#0001020304050607", "581#8001020301000405");
}

TEST_CASE("SDO download: a new initiate during a transfer starts a transfer of the new object [D8]") {
  Fixture node;
  node.ask("601#2108200008000000", "581#6008200000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#2104200004000000", "581#6004200000000000");
  node.ask("601#0701020304000000", "581#2000000000000000");
  CHECK(node.objects.u32 == 0x04030201);
  CHECK(node.objects.u64 == 0x8877665544332211);
  node.ask("601#2108200008000000", "581#6008200000000000");
  node.ask("601#2F0120005A000000", "581#6001200000000000");
  node.ask("601#0001020304050607", "581#8001020301000405");
  CHECK(node.objects.u8 == 0x5A);
}

TEST_CASE("SDO download: a refused new initiate ends the previous transfer [D8]") {
  Fixture node;
  node.ask("601#2108200008000000", "581#6008200000000000");
  node.ask("601#4004100000000000", "581#8004100000000206");
  node.ask("601#0001020304050607", "581#8001020301000405");
}

TEST_CASE("SDO download: an abort of the client ends the transfer without an answer [D6]") {
  Fixture node;
  node.ask("601#2108200008000000", "581#6008200000000000");
  node.rx("601#8000000000000405");
  node.silent();
  node.ask("601#0001020304050607", "581#8001020301000405");
}

TEST_CASE("SDO download: announced, sent and possible sizes are checked in every combination [D5]") {
  constexpr std::uint32_t sizes[] = {0, 1, 3, 4, 5, 7, 8, 889, 890};
  Fixture node;
  const auto verdict = [](std::uint32_t object, bool is_value, std::uint32_t number) -> std::uint32_t {
    if (number > object) return 0x06070012;
    return number < object && is_value ? 0x06070013 : 0;
  };
  struct Target {
    std::uint16_t index;
    std::uint8_t sub;
    std::uint32_t size;
    bool is_value;
  };
  constexpr Target targets[] = {{0x2001, 0, 1, true},  {0x2004, 0, 4, true},  {0x2008, 0, 8, true},
                                {0x2100, 1, 1, false}, {0x2100, 8, 8, false}, {0x2101, 0, 889, false}};
  for (const Target& target : targets) {
    for (const std::uint32_t sent : sizes) {
      CAPTURE(target.index);
      CAPTURE(sent);
      CHECK(node.download(target.index, target.sub, Bytes(sent), true) == verdict(target.size, target.is_value, sent));
      CHECK(node.download(target.index, target.sub, Bytes(sent), false) == verdict(target.size, target.is_value, sent));
    }
  }
}

TEST_CASE("SDO download: BOOLEAN accepts 0 and 1 only") {
  Fixture node;
  node.ask("601#2F20200001000000", "581#6020200000000000");
  node.ask("601#2F20200002000000", "581#8020200030000906");
  node.ask("601#2F202000FF000000", "581#8020200030000906");
  node.ask("601#4020200000000000", "581#4F20200001000000");
}

TEST_CASE("SDO download: time of day has six bytes; the four high bits of the milliseconds are not stored") {
  Fixture node;
  node.ask("601#2126200006000000", "581#6026200000000000");
  node.ask("601#0378563412BBAA00", "581#2000000000000000");
  CHECK(node.objects.time_of_day.Ms == 0x02345678);
  CHECK(node.objects.time_of_day.Days == 0xAABB);
}

// SDO server: segments in sequence of a domain, which the server processes without its state machine and without
// type functions. They have the same effect as those of a type that the state machine processes. [301:7.2.4.3]

// Type with the functions of a domain, but at another address: the state machine processes all segments.
const CO_OBJ_TYPE same_functions = COTDomain;

constexpr std::uint32_t domain_bytes = 100;

struct Domain {
  Bytes memory = counting(domain_bytes);
  CO_OBJ_DOM domain{0, domain_bytes, memory.data()};
};

// A node whose object 3100h is a domain of the type.
struct Server : Domain, Fixture {
  explicit Server(const CO_OBJ_TYPE* type, Setup setup = Setup().only_small())
      : Fixture(setup.with({CO_KEY(0x3100, 0, CO_OBJ_____RW), type, CO_DATA(&domain)})) {}
};

// Two nodes that receive the same frames, and whose objects are changed in the same way.
class Pair {
 public:
  void rx(const CO_IF_FRM& request) {
    straight_.rx(request);
    machine_.rx(request);
    compare(notation(request));
  }
  void after(Time time) {
    straight_.after(time);
    machine_.after(time);
    compare("time");
  }
  void resize(std::uint32_t size) {
    straight_.domain.Size = size;
    machine_.domain.Size = size;
  }
  void move(std::uint32_t position) {
    straight_.domain.Offset = position;
    machine_.domain.Offset = position;
  }
  // Takes the memory of the domain away, or gives it back.
  void turn_memory() {
    straight_.domain.Start = straight_.domain.Start == nullptr ? straight_.memory.data() : nullptr;
    machine_.domain.Start = machine_.domain.Start == nullptr ? machine_.memory.data() : nullptr;
  }
  bool is_open() { return straight_->Sdo[0].Flow.State != 0; }
  const std::string& difference() const { return difference_; }

 private:
  void compare(const std::string& what) {
    const bool same = straight_.frames() == machine_.frames() && straight_.memory == machine_.memory &&
                      straight_.domain.Offset == machine_.domain.Offset &&
                      straight_->Sdo[0].Flow.State == machine_->Sdo[0].Flow.State;
    if (!same && difference_.empty()) {
      difference_ = "after " + what;
    }
  }

  Server straight_{CO_TDOMAIN};
  Server machine_{&same_functions};
  std::string difference_;
};

// Sends mostly segments in sequence, and between them everything that ends a sequence.
class Client {
 public:
  explicit Client(unsigned seed) : random_(seed) {}

  void step(Pair& servers) {
    switch (below(40)) {
      case 0: begin(servers, 0x40, 0); break;
      case 1: begin(servers, 0x21, below(4) == 0 ? below(120) : domain_bytes); break;
      case 2: begin(servers, 0x20, 0); break;
      case 3: send(servers, command_ | toggle_ | 0x01); break;  // last segment
      case 4: send(servers, command_ | (toggle_ ^ 0x10U)); break;
      case 5: send(servers, command_ | toggle_ | below(16)); break;
      case 6: send(servers, below(256)); break;
      case 7: servers.after(std::chrono::milliseconds{below(CO_SDO_TIMEOUT)}); break;
      case 8: servers.resize(below(domain_bytes + 1)); break;
      case 9: servers.move(below(domain_bytes + 20)); break;
      case 10: servers.turn_memory(); break;
#if USE_SDO_BLOCK
      case 11: servers.rx(frame("601#A400310005000000")); break;
      case 12: servers.rx(frame("601#A300000000000000")); break;
      case 13: servers.rx(frame("601#A205050000000000")); break;
      case 14: servers.rx(frame("601#C600310064000000")); break;
#endif
      case 15: servers.resize(domain_bytes); break;
      default: segment(servers);
    }
  }

 private:
  unsigned below(unsigned end) { return static_cast<unsigned>(random_() % end); }

  void begin(Pair& servers, unsigned specifier, std::uint32_t size) {
    CO_IF_FRM request = frame("601#0000310000000000");
    request.Data[0] = static_cast<std::uint8_t>(specifier);
    request.Data[4] = static_cast<std::uint8_t>(size);
    command_ = specifier == 0x40 ? 0x60 : 0x00;
    toggle_ = 0;
    number_ = 0;
    servers.rx(request);
  }
  void segment(Pair& servers) {
    number_ = static_cast<std::uint8_t>(number_ + 1);
    send(servers, below(8) == 0 ? number_ : command_ | toggle_);  // number_: segment of a block
    toggle_ ^= 0x10U;
  }
  void send(Pair& servers, unsigned specifier) {
    CO_IF_FRM request = frame("601#0000000000000000");
    request.Data[0] = static_cast<std::uint8_t>(specifier);
    for (unsigned n = 1; n < 8; ++n) {
      request.Data[n] = static_cast<std::uint8_t>(random_());
    }
    servers.rx(request);
  }

  std::mt19937 random_;
  unsigned command_ = 0;
  unsigned toggle_ = 0;
  std::uint8_t number_ = 0;
};

TEST_CASE("SDO server: segments of a domain have the effects of segments of any other type [D3] [D4]") {
  const unsigned transfers = stride(4) == 1 ? 400 : 100;
  unsigned open = 0;
  for (unsigned seed = 0; seed < transfers; ++seed) {
    Pair servers;
    Client client(seed);
    for (unsigned n = 0; n < 60 && servers.difference().empty(); ++n) {
      client.step(servers);
      open += servers.is_open() ? 1U : 0U;
    }
    CAPTURE(seed);
    CHECK(servers.difference() == "");
  }
  CHECK(open > 10 * transfers);  // most frames belong to an open transfer
}

TEST_CASE("SDO server: each segment of a domain restarts the time-out") {
  for (const bool uploads : {true, false}) {
    CAPTURE(uploads);
    Server node(CO_TDOMAIN);
    node.ask(uploads ? "601#4000310000000000" : "601#2100310064000000",
             uploads ? "581#4100310064000000" : "581#6000310000000000");
    for (unsigned n = 0; n < 12; ++n) {
      node.after(std::chrono::milliseconds{CO_SDO_TIMEOUT / 2});
      CO_IF_FRM request = frame(uploads ? "601#6000000000000000" : "601#0001020304050607");
      request.Data[0] = static_cast<std::uint8_t>(request.Data[0] | (n % 2 == 0 ? 0x00 : 0x10));
      node.rx(request);
      CHECK(node.frames().size() == 1);
    }
    CHECK(node->Sdo[0].Flow.Num == 84);
    node.after(node.sdo_time_out());
    node.tx("581#8000310000000405");
  }
}

TEST_CASE("SDO server: a segment for memory that CO_NODE_EXT.Writable refuses aborts the download") {
  bool is_writable = true;
  Server node(CO_TDOMAIN, Setup().only_small().writable([&](const void*, std::uint32_t) { return is_writable; }));
  node.ask("601#2100310064000000", "581#6000310000000000");
  is_writable = false;
  node.ask("601#0001020304050607", "581#8000310000000106");
  CHECK(node.memory == counting(domain_bytes));
}

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG >= 8
TEST_CASE("SDO server: segments of a block beyond the size of the object are not stored") {
  Server node(CO_TDOMAIN);
  node.rx("601#C600310010000000");
  node.frames();
  for (unsigned n = 1; n <= 3; ++n) {
    CO_IF_FRM segment = frame("601#0001020304050607");
    segment.Data[0] = static_cast<std::uint8_t>(n);
    node.rx(segment);
  }
  CHECK(node->Sdo[0].Flow.Fill == 14);
  CHECK(node->Sdo[0].Flow.Seq == 2);
  node.after(node.sdo_time_out());
  node.tx("581#8000310012000706");
}
#endif

}  // namespace
