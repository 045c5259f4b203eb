// SPDX-License-Identifier: Apache-2.0
// SDO server, block download: lost, duplicate and reordered segments and answers. [301:7.2.4.3.10]
#include "support/block_frames.hpp"

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

namespace {

using namespace test;

// A node with an initiated block download of 890 bytes to 2104h.
struct Download : Fixture {
  Bytes data = counting(890, 7);

  Download() { ask("601#C60421007A030000", "581#A40421007F000000"); }

  void segments(std::size_t place, std::size_t number, unsigned seqno = 1,
                Where at = {__builtin_FILE(), __builtin_LINE()}) {
    send_segments(*this, data, place, number, seqno, at);
  }

  // Sends the segments from \a place without faults, and checks that the download succeeds.
  void finish(std::size_t place, unsigned blksize, Where at = {__builtin_FILE(), __builtin_LINE()}) {
    if (place + blksize < 128) {
      segments(place, blksize, 1, at);
      place += blksize;
      tx(notation(CO_IF_FRM{0x581, {0xA2, static_cast<std::uint8_t>(blksize), 0x7F}, 8}), at);
    }
    segments(place, 128 - place, 1, at);
    expect_last_ack(*this, static_cast<unsigned>(128 - place), at);
    rx(block_end(0x601, data), at);
    tx("581#A100000000000000", at);
    CHECK(objects.memory[890] == data);
  }
};

// Lost segments ------------------------------------------------------------------------------------------------------

TEST_CASE("SDO block download: with the first segment lost the sub-block counts as empty [D11]") {
  Download node;
  node.segments(1, 126, 2);
  node.tx("581#A2007F0000000000");
  node.finish(0, 127);
}

TEST_CASE("SDO block download: with a middle segment lost the next blksize is the free part of the buffer [D11]") {
  Download node;
  node.segments(0, 2, 1);
  node.segments(3, 124, 4);
  node.tx("581#A2027D0000000000");
  node.finish(2, 125);
}

TEST_CASE("SDO block download: the last but one segment is lost and repeated [D11]") {
  Download node;
  node.segments(0, 125, 1);
  node.segments(126, 1, 127);
  node.tx("581#A27D020000000000");
  node.finish(125, 2);
}

TEST_CASE(
    "SDO block download: with the last segment of a sub-block lost the acknowledge follows after a quarter [D11]") {
  Download node;
  node.segments(0, 126);
  node.after(500ms);
  node.tx_at(500ms, "581#A27E010000000000");
  node.finish(126, 1);
}

TEST_CASE("SDO block download: the last segment of all is lost and repeated [D11]") {
  Download node;
  node.segments(0, 127);
  node.tx("581#A27F7F0000000000");
  node.after(500ms);
  node.tx_at(500ms, "581#A27F7F0000000000");
  node.finish(127, 127);
}

TEST_CASE("SDO block download: the last segment of a short object is lost and repeated [D11]") {
  Fixture node;
  node.ask("601#C600210F0F000000", "581#A400210F7F000000");
  node.rx("601#0101020304050607");
  node.rx("601#0208090A0B0C0D0E");
  node.after(500ms);
  node.tx_at(500ms, "581#A2027D0000000000");
  node.rx("601#810F000000000000");
  expect_last_ack(node, 1);
  node.ask("601#D93D510000000000", "581#A100000000000000");
}

TEST_CASE("SDO block download: a whole sub-block is lost and repeated [D11]") {
  Download node;
  node.after(500ms);
  node.tx_at(500ms, "581#A40421007F000000");
  node.finish(0, 127);
}

TEST_CASE("SDO block download: different segments are lost repeatedly [D11]") {
  Download node;
  node.segments(0, 10);
  node.segments(11, 116, 12);
  node.tx("581#A20A750000000000");
  node.segments(10, 20);
  node.segments(31, 96, 22);
  node.tx("581#A214610000000000");
  node.segments(31, 96, 2);
  node.tx("581#A200610000000000");
  node.segments(30, 96);
  node.after(500ms);
  node.tx_at(500ms, "581#A260010000000000");
  node.finish(126, 1);
}

TEST_CASE("SDO block download: the last flag after a gap ends only the sub-block [D22]") {
  Fixture node;
  node.ask("601#C600210F0F000000", "581#A400210F7F000000");
  node.rx("601#0101020304050607");
  node.rx("601#830F000000000000");
  node.tx("581#A2017E0000000000");
  node.rx("601#0108090A0B0C0D0E");
  node.rx("601#820F000000000000");
  expect_last_ack(node, 2);
  node.ask("601#D93D510000000000", "581#A100000000000000");
  CHECK(node.objects.memory[15] == counting(15));
}

// Repeated and reordered segments ------------------------------------------------------------------------------------

TEST_CASE("SDO block download: repeated segments count once [D11]") {
  Download node;
  for (unsigned n = 0; n < 126; ++n) {
    node.segments(n, 1, n + 1);
    node.segments(n, 1, n + 1);
  }
  node.segments(126, 1, 127);
  node.tx("581#A27F7F0000000000");
  node.finish(127, 127);
}

TEST_CASE("SDO block download: the last segment of a sub-block repeated after its acknowledge is ignored [D11]") {
  Download node;
  node.segments(0, 127);
  node.tx("581#A27F7F0000000000");
  node.segments(126, 1, 127);
  node.silent();
  node.finish(127, 127);
}

TEST_CASE("SDO block download: the repeated last segment of all is ignored for every command byte [D11] [D27]") {
  for (const unsigned segments : {1U, 2U, 0x20U, 0x21U, 0x24U, 0x40U, 0x41U, 0x42U, 0x45U, 0x46U, 0x7FU}) {
    CAPTURE(segments);
    Fixture node;
    const Bytes data = counting(7 * segments - 1, 0x60);
    node.ask("601#C404210000000000", "581#A40421007F000000");
    send_segments(node, data, 0, segments);
    expect_last_ack(node, segments);
    for (int times = 0; times < 3; ++times) {
      send_segments(node, data, segments - 1, 1, segments);
      node.silent();
    }
    node.rx(block_end(0x601, data));
    node.tx("581#A100000000000000");
  }
}

TEST_CASE("SDO block download: an initiate with the command of the last segment starts a new transfer [D8] [D27]") {
  Fixture node;
  const Bytes data = counting(7 * 0x24, 0x60);
  node.ask("601#C404210000000000", "581#A40421007F000000");
  send_segments(node, data, 0, 0x24);
  expect_last_ack(node, 0x24);
  node.ask("601#A40010007F000000", "581#C600100004000000");
  node.ask("601#A300000000000000", "581#8191010F00000000");
}

TEST_CASE("SDO block download: in a wrong order the segments from the gap are not accepted [D11]") {
  Download node;
  node.segments(0, 1, 1);
  node.segments(2, 1, 3);
  node.segments(1, 1, 2);
  node.segments(3, 124, 4);
  node.tx("581#A2027D0000000000");
  node.finish(2, 125);
}

TEST_CASE("SDO block download: with the last two of a sub-block swapped the late one is ignored [D11] [D23]") {
  Download node;
  node.segments(0, 125);
  node.segments(126, 1, 127);
  node.tx("581#A27D020000000000");
  node.segments(125, 1, 126);
  node.silent();
  node.finish(125, 2);
}

TEST_CASE("SDO block download: sequence number 0 and numbers above blksize are ignored [D23]") {
  Download node;
  node.segments(0, 2);
  node.rx("601#0055555555555555");
  node.segments(3, 124, 4);
  node.tx("581#A2027D0000000000");
  node.rx("601#0055555555555555");
  node.rx("601#7E55555555555555");
  node.rx("601#7F55555555555555");
  node.silent();
  node.segments(2, 1);
  node.rx("601#7E55555555555555");
  node.rx("601#7F55555555555555");
  node.silent();
  node.segments(3, 124, 2);
  node.tx("581#A27D7F0000000000");
  node.finish(127, 127);
}

TEST_CASE("SDO block download: a number above blksize with the last flag does not end the sub-block [D22] [D23]") {
  Download node;
  node.segments(0, 2);
  node.segments(3, 124, 4);
  node.tx("581#A2027D0000000000");
  node.segments(2, 1);
  node.rx("601#FE55555555555555");
  node.silent();
  node.rx("601#FF55555555555555");
  node.silent();
  node.segments(3, 124, 2);
  node.tx("581#A27D7F0000000000");
  node.finish(127, 127);
}

TEST_CASE("SDO block download: the only segment of all repeated counts once [D11] [D27]") {
  Fixture node(Setup().only_small());
  node.ask("601#C600210505000000", "581#A40021057F000000");
  node.ask("601#8101020304050000", "581#A2017E0000000000");
  node.rx("601#8101020304050000");
  node.silent();
  node.rx(block_end(0x601, {1, 2, 3, 4, 5}));
  node.tx("581#A100000000000000");
  CHECK(node.objects.memory[5] == Bytes{1, 2, 3, 4, 5});
}

TEST_CASE("SDO block download: a segment without a number repeats the last answer [D11] [D23]") {
  Download node;
  node.rx("601#0055555555555555");
  node.after(500ms);
  node.tx_at(500ms, "581#A40421007F000000");
  node.finish(0, 127);
}

// Lost answers -------------------------------------------------------------------------------------------------------

TEST_CASE("SDO block download: a lost answer to the initiate is repeated [D11]") {
  Download node;
  node.after(1500ms);
  node.tx_at(500ms, "581#A40421007F000000");
  node.tx_at(1000ms, "581#A40421007F000000");
  node.tx_at(1500ms, "581#A40421007F000000");
  node.finish(0, 127);
}

TEST_CASE("SDO block download: a lost acknowledge is repeated [D11]") {
  Download node;
  node.segments(0, 127);
  node.tx("581#A27F7F0000000000");
  node.after(1500ms);
  node.tx_at(500ms, "581#A27F7F0000000000");
  node.tx_at(1000ms, "581#A27F7F0000000000");
  node.tx_at(1500ms, "581#A27F7F0000000000");
  node.finish(127, 127);
}

TEST_CASE("SDO block download: a lost acknowledge after a gap is repeated [D11]") {
  Download node;
  node.segments(0, 2);
  node.segments(3, 124, 4);
  node.tx("581#A2027D0000000000");
  node.after(500ms);
  node.tx_at(500ms, "581#A2027D0000000000");
  node.finish(2, 125);
}

TEST_CASE("SDO block download: a lost acknowledge of no segment is repeated [D11]") {
  Download node;
  node.segments(1, 126, 2);
  node.tx("581#A2007F0000000000");
  node.after(500ms);
  node.tx_at(500ms, "581#A2007F0000000000");
  node.finish(0, 127);
}

TEST_CASE("SDO block download: a lost last acknowledge is repeated even if the end is lost [D11]") {
  Fixture node;
  node.ask("601#C204200004000000", "581#A40420007F000000");
  node.rx("601#8101020304000000");
  const std::string acknowledge = notation(node.can.sent.front().frm);
  expect_last_ack(node, 1);
  node.after(1500ms);
  node.tx_at(500ms, acknowledge);
  node.tx_at(1000ms, acknowledge);
  node.tx_at(1500ms, acknowledge);
  node.ask("601#CD00000000000000", "581#A100000000000000");
  CHECK(node.objects.u32 == 0x04030201);
}

TEST_CASE("SDO block download: after a lost answer to the end the repeated end is stray and changes nothing [D7]") {
  Fixture node;
  node.ask("601#C204200004000000", "581#A40420007F000000");
  node.rx("601#8101020304000000");
  expect_last_ack(node, 1);
  node.ask("601#CD00000000000000", "581#A100000000000000");
  node.ask("601#CD00000000000000", "581#8000000001000405");
  CHECK(node.objects.u32 == 0x04030201);
}

// Time-out -----------------------------------------------------------------------------------------------------------

TEST_CASE("SDO block download: each new segment restarts the time-out, in order or behind a gap [D11] [D18]") {
  Download node;
  for (unsigned n = 0; n < 10; ++n) {
    node.after(250ms);
    node.silent();
    node.segments(n, 1, n + 1);
  }
  for (unsigned n = 11; n < 126; ++n) {  // number 11 is lost
    node.after(250ms);
    node.silent();
    node.segments(n, 1, n + 1);
  }
  node.segments(126, 1, 127);
  node.tx("581#A20A750000000000");
  node.finish(10, 117);
}

TEST_CASE("SDO block download: a repeated segment does not restart the time-out [D11] [D18]") {
  Download node;
  node.segments(0, 10);
  std::vector<std::string> sent;
  for (unsigned n = 0; n < 50 && (sent.empty() || sent.back() != "581#8004210000000405"); ++n) {
    node.segments(4, 1, 5);
    node.after(100ms);
    sent = node.frames();
  }
  REQUIRE_FALSE(sent.empty());
  CHECK(sent.back() == "581#8004210000000405");
}

TEST_CASE("SDO block download: a second sub-block without a segment in order does not restart the time-out [D18]") {
  Download node;
  for (unsigned n = 1; n < 126; ++n) {  // number 1 is lost
    node.after(250ms);
    node.silent();
    node.segments(n, 1, n + 1);
  }
  node.segments(126, 1, 127);
  node.tx("581#A2007F0000000000");
  std::vector<std::string> sent;
  for (unsigned n = 1; n < 10 && (sent.empty() || sent.back() != "581#8004210000000405"); ++n) {
    node.after(250ms);
    sent = node.frames();
    if (sent.empty() || sent.back() != "581#8004210000000405") {
      node.segments(n, 1, n + 1);
    }
  }
  REQUIRE_FALSE(sent.empty());
  CHECK(sent.back() == "581#8004210000000405");
}

TEST_CASE("SDO block download: after the acknowledge for a silence the sequence number restarts at 1 [D11]") {
  Download node;
  node.segments(0, 5);
  node.after(600ms);
  node.tx_at(500ms, "581#A2057A0000000000");
  node.segments(5, 5);
  node.after(600ms);
  node.tx_at(400ms, "581#A205750000000000");
  node.finish(10, 117);
}

TEST_CASE("SDO block download: silence after a gap is answered with the last segment in order") {
  Download node;
  node.segments(0, 127);
  node.tx("581#A27F7F0000000000");
  node.rx("601#0255555555555555");
  node.after(500ms);
  node.tx_at(500ms, "581#A2007F0000000000");
  node.finish(127, 127);
}

}  // namespace

#endif
