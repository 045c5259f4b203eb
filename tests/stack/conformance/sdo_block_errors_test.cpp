// SPDX-License-Identifier: Apache-2.0
// SDO server: errors of block transfers and their abort codes. [301:7.2.4.3.17]
#include "support/block_frames.hpp"

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

}  // namespace

#endif
