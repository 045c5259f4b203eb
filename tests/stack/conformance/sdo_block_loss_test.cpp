// SPDX-License-Identifier: Apache-2.0
// SDO server: block transfers on a bus that loses, duplicates and delays frames at every position. With a CRC or an
// announced size, the transfer ends with correct data or an abort code, never with wrong data. [T11]
#include <algorithm>

#include "support/block_frames.hpp"

namespace {

using namespace test;

#if USE_SDO_BLOCK

// A node with a domain of \a size bytes at 2106h.
class Target {
 public:
  explicit Target(std::uint32_t size)
      : memory_(counting(size)),
        domain_{0, size, memory_.data()},
        setup_(Setup().only_small().with({CO_KEY(0x2106, 0, CO_OBJ_____RW), CO_TDOMAIN, CO_DATA(&domain_)})) {}

  // Runs a download. Checks that the data are correct after success, and that the server is idle afterwards.
  BlockResult download(const BlockOptions& options) {
    const Bytes data = counting(memory_.size(), 0x80);
    std::fill(memory_.begin(), memory_.end(), std::uint8_t{0});
    Fixture node(setup_);
    const BlockResult result = node.block_download(0x2106, 0, data, options);
    CHECK((result.abort != 0 || memory_ == data));
    check_serves(node);
    return result;
  }

  BlockResult upload(const BlockOptions& options) {
    const Bytes data = counting(memory_.size(), 0x80);
    memory_ = data;
    Fixture node(setup_);
    const BlockResult result = node.block_upload(0x2106, 0, options);
    CHECK((result.abort != 0 || result.data == data));
    check_serves(node);
    return result;
  }

 private:
  static void check_serves(Fixture& node) {
    node.after(node.sdo_time_out());
    node.frames();
    node.ask("601#A3DEADBE00000000", "581#80DEADBE01000405");
    node.ask("601#4000100000000000", "581#4300100091010F00");
  }

  Bytes memory_;
  CO_OBJ_DOM domain_;
  Setup setup_;
};

using Faults = std::set<unsigned> BlockOptions::*;
using Transfer = BlockResult (Target::*)(const BlockOptions&);

// Repeats the transfer with a fault in each of its frames in turn. Returns the number of aborted transfers.
unsigned aborts(Target& target, Transfer transfer, Faults faults, BlockOptions options = {}) {
  const BlockResult undisturbed = (target.*transfer)(options);
  REQUIRE(undisturbed.abort == 0);
  const bool by_client = faults != &BlockOptions::lost_answers;
  const unsigned frames = by_client ? undisturbed.requests : undisturbed.answers;
  unsigned aborted = 0;
  for (unsigned n = 0; n<frames; n += frames> 20 ? stride(37) : 1) {
    CAPTURE(n);
    options.*faults = {n};
    const BlockResult result = (target.*transfer)(options);
    aborted += result.abort != 0 ? 1U : 0U;
  }
  return aborted;
}

constexpr std::uint32_t sizes[] = {1, 7, 8, 888, 889, 890, 891, 900, 1800};

// In blocks of one segment, a repeated segment cannot be distinguished from the next one.
#if CO_SDO_BUF_SEG > 1

// Returns the number of aborts that are possible because of a last block of one or two segments: after a loss in it,
// the server cannot distinguish the remaining segment from a repeated one.
unsigned lonely(std::uint32_t size) {
  const std::uint32_t segments = (size + 6) / 7;
  const std::uint32_t rest = segments % CO_SDO_BUF_SEG;
  return segments > CO_SDO_BUF_SEG && (rest == 1 || rest == 2) ? 1 : 0;
}

TEST_CASE("SDO block download: any lost frame of the client except the initiate is repeated [T11]") {
  for (const std::uint32_t size : sizes) {
    CAPTURE(size);
    Target target(size);
    CHECK(aborts(target, &Target::download, &BlockOptions::lost_requests) <= 1 + lonely(size));
  }
}

TEST_CASE("SDO block download: any lost frame of the server except the last one is repeated [T11]") {
  for (const std::uint32_t size : sizes) {
    CAPTURE(size);
    Target target(size);
    CHECK(aborts(target, &Target::download, &BlockOptions::lost_answers) <= 1);
  }
}

TEST_CASE("SDO block download: any frame may be doubled or swapped with the next one [T11]") {
  for (const std::uint32_t size : sizes) {
    CAPTURE(size);
    Target target(size);
    CHECK(aborts(target, &Target::download, &BlockOptions::doubled_requests) == 0);
    CHECK(aborts(target, &Target::download, &BlockOptions::late_requests) == 0);
  }
}

TEST_CASE("SDO block download: faults without CRC are detected by the size, without size by the CRC [T11]") {
  for (const bool crc : {false, true}) {
    BlockOptions options;
    options.crc = crc;
    options.sized = !crc;
    for (const std::uint32_t size : {8U, 100U, 890U}) {
      CAPTURE(size);
      Target target(size);
      CHECK(aborts(target, &Target::download, &BlockOptions::lost_requests, options) <= 1 + lonely(size));
      CHECK(aborts(target, &Target::download, &BlockOptions::lost_answers, options) <= 1);
      CHECK(aborts(target, &Target::download, &BlockOptions::late_requests, options) == 0);
    }
  }
}

#endif

TEST_CASE("SDO block upload: any lost acknowledge or end of the client is repeated [T11]") {
  for (const std::uint32_t size : sizes) {
    CAPTURE(size);
    Target target(size);
    CHECK(aborts(target, &Target::upload, &BlockOptions::lost_requests) <= 2);
  }
}

TEST_CASE("SDO block upload: any lost segment of the server is repeated [T11]") {
  for (const std::uint32_t size : sizes) {
    CAPTURE(size);
    Target target(size);
    CHECK(aborts(target, &Target::upload, &BlockOptions::lost_answers) <= 2 + ((size + 6) / 7 == 128 ? 1U : 0U));
  }
}

TEST_CASE("SDO block upload: with small blocks any frame may be lost, doubled or swapped with the next one [T11]") {
  for (const Bytes& blksizes : {Bytes{5}, Bytes{2, 9}, Bytes{31}}) {
    BlockOptions options;
    options.blksizes = blksizes;
    for (const std::uint32_t size : {100U, 210U, 889U}) {
      CAPTURE(size);
      Target target(size);
      CHECK(aborts(target, &Target::upload, &BlockOptions::lost_requests, options) <= 2);
      CHECK(aborts(target, &Target::upload, &BlockOptions::lost_answers, options) <= 3);
      aborts(target, &Target::upload, &BlockOptions::doubled_requests, options);
      aborts(target, &Target::upload, &BlockOptions::late_requests, options);
    }
  }
}

TEST_CASE("SDO block: any two frames of up to 30 segments may be lost [T11]") {
  for (const std::uint32_t size : {15U, 210U}) {
    Target target(size);
    for (const Transfer transfer : {&Target::download, &Target::upload}) {
      const BlockResult undisturbed = (target.*transfer)({});
      for (unsigned first = 0; first < undisturbed.requests; ++first) {
        CAPTURE(size);
        CAPTURE(first);
        BlockOptions options;
        for (unsigned second = first + 1; second < undisturbed.requests; second += stride(11)) {
          options.lost_requests = {first, second};
          (target.*transfer)(options);
        }
        for (unsigned second = 0; second < undisturbed.answers; second += stride(11)) {
          options.lost_requests = {first};
          options.lost_answers = {second};
          (target.*transfer)(options);
        }
      }
    }
  }
}

TEST_CASE("SDO block upload: any two frames of the server of up to 30 segments may be lost [T11]") {
  Target target(210);
  for (const Bytes& blksizes : {Bytes{127}, Bytes{7}}) {
    BlockOptions options;
    options.blksizes = blksizes;
    const unsigned frames = target.upload(options).answers;
    for (unsigned first = 0; first < frames; ++first) {
      for (unsigned second = first + 1; second < frames; second += stride(11)) {
        CAPTURE(first);
        CAPTURE(second);
        options.lost_answers = {first, second};
        target.upload(options);
      }
    }
  }
}

#endif

// SDO server, block download: lost, duplicate and reordered segments and answers. [301:7.2.4.3.10]

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

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

#endif

// SDO server, block upload: repetition of segments that the client has not received. [301:7.2.4.3.13, 7.2.4.3.14]

#if USE_SDO_BLOCK

CO_IF_FRM ack(unsigned ackseq, unsigned blksize) {
  return CO_IF_FRM{0x601, {0xA2, static_cast<std::uint8_t>(ackseq), static_cast<std::uint8_t>(blksize)}, 8};
}

// A node with an upload of 2104h (890 bytes) whose first block was sent.
struct Upload : Fixture {
  Bytes data = counting(890);

  explicit Upload(std::uint8_t blksize) {
    rx(CO_IF_FRM{0x601, {0xA4, 0x04, 0x21, 0x00, blksize}, 8});
    tx("581#C60421007A030000");
    rx("601#A300000000000000");
    segments(0, blksize);
  }

  void segments(std::size_t place, std::size_t number, Where at = {__builtin_FILE(), __builtin_LINE()}) {
    expect_segments(*this, data, place, number, at);
  }

  void finish(unsigned ackseq, Where at = {__builtin_FILE(), __builtin_LINE()}) {
    rx(ack(ackseq, 1), at);
    tx(notation(block_end(0x581, data)), at);
    rx("601#A100000000000000", at);
    silent(at);
  }
};

TEST_CASE("SDO block upload: with the first segment lost the whole block is repeated [D12]") {
  Upload node(127);
  node.rx(ack(0, 127));
  node.segments(0, 127);
  node.rx(ack(127, 127));
  node.segments(127, 1);
  node.finish(1);
}

TEST_CASE("SDO block upload: after the loss of a middle segment the others are repeated with numbers from 1 [D12]") {
  Upload node(127);
  node.rx(ack(50, 127));
  node.segments(50, 78);
  node.finish(78);
}

TEST_CASE("SDO block upload: the last segment of a block is lost and repeated [D12]") {
  Upload node(127);
  node.rx(ack(126, 127));
  node.segments(126, 2);
  node.finish(2);
}

TEST_CASE("SDO block upload: repeated segments use the new blksize [D12]") {
  Upload node(127);
  node.rx(ack(100, 10));
  node.segments(100, 10);
  node.rx(ack(5, 3));
  node.segments(105, 3);
  node.rx(ack(0, 1));
  node.segments(105, 1);
  node.rx(ack(1, 127));
  node.segments(106, 22);
  node.finish(22);
}

TEST_CASE("SDO block upload: the last segment of all is lost repeatedly and repeated [D12]") {
  Upload node(127);
  node.rx(ack(127, 127));
  for (int times = 0; times < 5; ++times) {
    node.segments(127, 1);
    node.rx(ack(0, 127));
  }
  node.segments(127, 1);
  node.finish(1);
}

TEST_CASE("SDO block upload: in a repeated part of the last block the CRC counts each byte once [D12] [D14]") {
  Upload node(100);
  node.rx(ack(100, 127));
  node.segments(100, 28);
  node.rx(ack(7, 127));
  node.segments(107, 21);
  node.rx(ack(20, 127));
  node.segments(127, 1);
  node.finish(1);
}

TEST_CASE("SDO block upload: a block whose segments are always lost is repeated [D12]") {
  Upload node(4);
  for (int times = 0; times < 300; ++times) {
    node.rx(ack(0, 4));
    node.segments(0, 4);
  }
  node.rx(ack(4, 127));
  node.segments(4, 124);
  node.finish(124);
}

TEST_CASE("SDO block upload: repeated segments of a value or a short object are identical") {
  Fixture node;
  node.ask("601#A408200002000000", "581#C608200008000000");
  for (int times = 0; times < 3; ++times) {
    node.rx(times == 0 ? frame("601#A300000000000000") : ack(0, 2));
    node.tx({"581#0111223344556677", "581#8288000000000000"});
  }
  node.ask("601#A201020000000000", "581#8188000000000000");
  node.ask("601#A201020000000000", "581#D98B6C0000000000");
  node.rx("601#A100000000000000");
}

TEST_CASE("SDO block upload: an empty segment is repeated [D19]") {
  Fixture node;
  node.ask("601#A40021007F000000", "581#C600210000000000");
  node.ask("601#A300000000000000", "581#8100000000000000");
  node.ask("601#A2007F0000000000", "581#8100000000000000");
  node.ask("601#A2017F0000000000", "581#DD00000000000000");
  node.rx("601#A100000000000000");
  node.silent();
}

TEST_CASE("SDO block upload: at most the last block is repeated [D12]") {
  Upload node(20);
  node.rx(ack(20, 20));
  node.segments(20, 20);
  node.rx(ack(0, 127));
  node.segments(20, 108);
  node.finish(108);
}

TEST_CASE("SDO block upload: after a lost acknowledge the server waits for its repetition by the client [D12] [D18]") {
  Upload node(127);
  node.after(1700ms);
  node.silent();
  node.rx(ack(127, 127));
  node.segments(127, 1);
  node.after(1700ms);
  node.silent();
  node.finish(1);
}

TEST_CASE("SDO block upload: a doubled acknowledge also acknowledges the next block") {
  Upload node(20);
  node.rx(ack(20, 20));
  node.segments(20, 20);
  node.rx(ack(20, 20));
  node.segments(40, 20);
}

TEST_CASE("SDO block upload: a doubled acknowledge of more segments than the next block has is aborted [D12]") {
  Upload node(127);
  node.rx(ack(127, 127));
  node.segments(127, 1);
  node.rx(ack(127, 127));
  node.tx("581#8004210003000405");
}

#endif

}  // namespace
