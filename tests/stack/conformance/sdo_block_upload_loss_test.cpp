// SPDX-License-Identifier: Apache-2.0
// SDO server, block upload: repetition of segments that the client has not received. [301:7.2.4.3.13, 7.2.4.3.14]
#include "support/block_frames.hpp"

#if USE_SDO_BLOCK

namespace {

using namespace test;

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

}  // namespace

#endif
