// SPDX-License-Identifier: Apache-2.0
// Types with Begin and End (CO_OBJ_TYPE_EX): order and arguments of their functions in transfers that succeed. Failed
// transfers are in sdo_stream_ends_test.cpp.
#include <algorithm>

#include "support/block_frames.hpp"
#include "support/logged_stream.hpp"

#if USE_OBJ_EX

namespace {

using namespace test;

// A node with the objects 3000h (CO_OBJ_TYPE_EX), 3001h (CO_OBJ_TYPE with Reset) and 3002h (CO_OBJ_TYPE without Reset).
struct Streams : LoggedStream, Fixture {
  Streams() : Fixture(Setup().only_small().with(extended(0x3000)).with(plain(0x3001)).with(value(0x3002))) {}
};

// Expedited and segmented ---------------------------------------------------------------------------------------------

TEST_CASE("SDO stream types: an expedited download calls Begin, Write and End") {
  Streams node;
  node.ask("601#2B00300011220000", "581#6000300000000000");
  CHECK(node.take_log() == Log{"begin down 2", "reset 0", "write 2", "end down 0"});
  CHECK(node.data == Bytes{0x11, 0x22});
}

TEST_CASE("SDO stream types: an expedited upload calls Begin, Read and End") {
  Streams node;
  node.data = {1, 2, 3};
  node.ask("601#4000300000000000", "581#4700300001020300");
  CHECK(node.take_log() == Log{"begin up 3", "reset 0", "read 3", "end up 0"});
}

TEST_CASE("SDO stream types: segmented downloads with and without announced size call Begin, Write and End") {
  Streams node;
  for (const bool sized : {true, false}) {
    node.ask(sized ? "601#2100300009000000" : "601#2000300000000000", "581#6000300000000000");
    CHECK(node.take_log() == Log{sized ? "begin down 9" : "begin down ?", "reset 0", "write 0"});
    node.ask("601#0001020304050607", "581#2000000000000000");
    CHECK(node.take_log() == Log{"write 7"});
    node.ask("601#1B08090000000000", "581#3000000000000000");
    CHECK(node.take_log() == Log{"write 2", "end down 0"});
    CHECK(node.data == counting(9));
  }
}

TEST_CASE("SDO stream types: an empty download") {
  Streams node;
  node.data = {1, 2, 3};
  node.ask("601#2100300000000000", "581#6000300000000000");
  node.ask("601#0F00000000000000", "581#2000000000000000");
  CHECK(node.take_log() == Log{"begin down 0", "reset 0", "write 0", "end down 0"});
  CHECK(node.data.empty());
}

TEST_CASE("SDO stream types: a segmented upload") {
  Streams node;
  node.data = counting(9);
  node.ask("601#4000300000000000", "581#4100300009000000");
  CHECK(node.take_log() == Log{"begin up 9", "reset 0", "read 0"});
  node.ask("601#6000000000000000", "581#0001020304050607");
  CHECK(node.take_log() == Log{"read 7"});
  node.ask("601#7000000000000000", "581#1B08090000000000");
  CHECK(node.take_log() == Log{"read 2", "end up 0"});
}

TEST_CASE("SDO stream types: accesses of the application call neither Begin nor End") {
  Streams node;
  node.data = counting(9);
  node.call([&] {
    std::uint8_t bytes[9] = {};
    std::uint32_t word = 0;
    CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x3000, 0), bytes, 9) == CO_ERR_NONE);
    CHECK(CODictWrBuffer(&node->Dict, CO_DEV(0x3000, 0), bytes, 4) == CO_ERR_NONE);
    CHECK(CODictRdLong(&node->Dict, CO_DEV(0x3000, 0), &word) == CO_ERR_NONE);
    CHECK(COObjReset(node.find(0x3000, 0), &node.node, 2) == CO_ERR_NONE);
  });
  for (const std::string& call : node.take_log()) {
    CHECK(call.substr(0, 5) != "begin");
    CHECK(call.substr(0, 3) != "end");
  }
  CHECK(node.position == 2);
}

TEST_CASE("SDO stream types: all functions except those of CO_OBJ_TYPE may be null") {
  LoggedStream stream;
  const CO_OBJ full = stream.extended(0x3000);
  const CO_OBJ_TYPE_EX bare = {*full.Type, nullptr, nullptr, nullptr};
  Fixture node(Setup().only_small().with({full.Key, &bare.Type, full.Data}));
  CHECK(node.download(0x3000, 0, counting(9)) == 0);
  CHECK(stream.take_log() == Log{"write 0", "write 7", "write 2"});
  node.call([&] { CHECK(COObjReset(node.find(0x3000, 0), &node.node, 0) == CO_ERR_NONE); });
}

TEST_CASE("SDO stream types: COObjTypeExReset with null pointers returns an error") {
  Streams node;
  CHECK(COObjTypeExReset(nullptr, &node.node, 0) == CO_ERR_BAD_ARG);
  CHECK(COObjTypeExReset(node.find(0x3000, 0), nullptr, 0) == CO_ERR_BAD_ARG);
}

// Uploads of unknown size ---------------------------------------------------------------------------------------------

constexpr std::uint32_t sizes[] = {0, 1, 4, 6, 7, 8, 13, 14, 15, 888, 889, 890, 1777, 1778, 1779};

TEST_CASE("SDO stream types: a segmented upload of unknown size announces none [D3]") {
  Streams node;
  node.knows_size = false;
  node.data = counting(9);
  node.ask("601#4000300000000000", "581#4000300000000000");
  CHECK(node.take_log() == Log{"begin up ?", "reset 0", "read 0"});
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.ask("601#7000000000000000", "581#1B08090000000000");
  CHECK(node.take_log() == Log{"read 7", "read 7", "end up 0"});
}

TEST_CASE("SDO stream types: segmented uploads of unknown size work, also with empty and full segments [D3] [D4]") {
  for (const std::uint32_t size : sizes) {
    CAPTURE(size);
    Streams node;
    node.knows_size = false;
    node.data = counting(size);
    CHECK(node.upload(0x3000, 0) == counting(size));
    CHECK(node.log.back() == "end up 0");
    CHECK(std::count(node.log.begin(), node.log.end(), "end up 0") == 1);
  }
}

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

TEST_CASE("SDO stream types: a block upload of unknown size announces none [D12]") {
  Streams node;
  node.knows_size = false;
  node.data = counting(9);
  node.ask("601#A40030007FFF0000", "581#C400300000000000");
  node.rx("601#A300000000000000");
  node.tx({"581#0101020304050607", "581#8208090000000000"});
  CHECK(node.take_log() == Log{"begin up ?", "reset 0", "read 0", "read 889"});
  node.rx("601#A2027F0000000000");
  node.tx(notation(block_end(0x581, counting(9))));
  node.rx("601#A100000000000000");
  CHECK(node.take_log() == Log{"end up 0"});
}

TEST_CASE("SDO stream types: block uploads of unknown size work, also with empty and full segments and buffers [D12]") {
  for (const std::uint32_t size : sizes) {
    for (const Bytes& blksizes : {Bytes{127}, Bytes{1}, Bytes{100, 27}}) {
      CAPTURE(size);
      Streams node;
      node.knows_size = false;
      node.data = counting(size);
      BlockOptions options;
      options.blksizes = blksizes;
      const BlockResult result = node.block_upload(0x3000, 0, options);
      CHECK(result.abort == 0);
      CHECK(result.data == counting(size));
      CHECK(node.log.back() == "end up 0");
      CHECK(std::count(node.log.begin(), node.log.end(), "end up 0") == 1);
    }
  }
}

TEST_CASE("SDO stream types: block uploads of unknown size work with any segment lost [D12] [T11]") {
  for (const std::uint32_t size : {100U, 889U, 1000U}) {
    Streams node;
    node.knows_size = false;
    node.data = counting(size);
    BlockOptions options;
    options.blksizes = {20};
    const unsigned answers = node.block_upload(0x3000, 0, options).answers;
    for (unsigned n = 1; n + 1 < answers; ++n) {
      CAPTURE(size);
      CAPTURE(n);
      options.lost_answers = {n};
      const BlockResult result = node.block_upload(0x3000, 0, options);
      CHECK((result.abort != 0 || result.data == counting(size)));
    }
  }
}

// Block ---------------------------------------------------------------------------------------------------------------

TEST_CASE("SDO stream types: a block download that fits into the buffer is written in one piece after its end [D10]") {
  for (const std::uint32_t size : {1U, 7U, 9U, 888U, 889U}) {
    for (const bool sized : {true, false}) {
      CAPTURE(size);
      Streams node;
      const Bytes data = counting(size);
      const std::size_t segments = (size + 6) / 7;
      CO_IF_FRM initiate = frame(sized ? "601#C600300000000000" : "601#C400300000000000");
      CO_SET_LONG(&initiate, sized ? size : 0, 4);
      node.rx(initiate);
      node.tx("581#A40030007F000000");
      REQUIRE_FALSE(node.log.empty());
      CHECK(node.log.front() == (sized ? "begin down " + std::to_string(size) : "begin down ?"));
      send_segments(node, data, 0, segments);
      expect_last_ack(node, static_cast<unsigned>(segments));
      const std::string piece = "write " + std::to_string(size);
      CHECK(std::count(node.log.begin(), node.log.end(), piece) == 0);
      node.rx(block_end(0x601, data));
      node.tx("581#A100000000000000");
      Log log = node.take_log();
      log.erase(log.begin());
      CHECK(log == Log{"reset 0", "write 0", piece, "end down 0"});
      CHECK(node.data == data);
    }
  }
}

TEST_CASE("SDO stream types: a longer block download is written when the buffer is full and at the end") {
  Streams node;
  const Bytes data = counting(1900);
  node.ask("601#C60030006C070000", "581#A40030007F000000");
  send_segments(node, data, 0, 127);
  node.tx("581#A27F7F0000000000");
  CHECK(node.take_log() == Log{"begin down 1900", "reset 0", "write 0", "write 889"});
  send_segments(node, data, 127, 127);
  node.tx("581#A27F7F0000000000");
  CHECK(node.take_log() == Log{"write 889"});
  send_segments(node, data, 254, 18);
  expect_last_ack(node, 18);
  CHECK(node.take_log().empty());
  node.rx(block_end(0x601, data));
  node.tx("581#A100000000000000");
  CHECK(node.take_log() == Log{"write 122", "end down 0"});
  CHECK(node.data == data);
}

TEST_CASE("SDO stream types: an empty block download") {
  Streams node;
  node.data = {1, 2, 3};
  CHECK(node.block_download(0x3000, 0, {}).abort == 0);
  CHECK(node.take_log() == Log{"begin down 0", "reset 0", "write 0", "end down 0"});
  CHECK(node.data.empty());
}

TEST_CASE("SDO stream types: after a gap of a block download no byte is written twice") {
  Streams node;
  const Bytes data = counting(1900, 5);
  BlockOptions options;
  options.lost_requests = {3, 200};
  CHECK(node.block_download(0x3000, 0, data, options).abort == 0);
  CHECK(node.take_log() ==
        Log{"begin down 1900", "reset 0", "write 0", "write 889", "write 889", "write 122", "end down 0"});
  CHECK(node.data == data);
}

TEST_CASE("SDO stream types: a block upload is read in pieces of the buffer; End follows the client's confirmation") {
  Streams node;
  node.data = counting(890);
  node.ask("601#A40030007F000000", "581#C60030007A030000");
  CHECK(node.take_log() == Log{"begin up 890", "reset 0", "read 0"});
  node.rx("601#A300000000000000");
  expect_segments(node, node.data, 0, 127);
  CHECK(node.take_log() == Log{"read 889"});
  node.rx("601#A27F7F0000000000");
  expect_segments(node, node.data, 127, 1);
  CHECK(node.take_log() == Log{"read 1"});
  node.rx("601#A2017F0000000000");
  node.tx(notation(block_end(0x581, node.data)));
  CHECK(node.take_log().empty());
  node.rx("601#A100000000000000");
  CHECK(node.take_log() == Log{"end up 0"});
}

TEST_CASE("SDO stream types: a block upload below the pst is a normal one [D13]") {
  Streams node;
  node.data = counting(9);
  node.ask("601#A40030007F090000", "581#4100300009000000");
  CHECK(node.take_log() == Log{"begin up 9", "reset 0", "read 0"});
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.ask("601#7000000000000000", "581#1B08090000000000");
  CHECK(node.take_log() == Log{"read 7", "read 2", "end up 0"});
  node.data = counting(3);
  node.ask("601#A40030007F090000", "581#4700300001020300");
  CHECK(node.take_log() == Log{"begin up 3", "reset 0", "read 3", "end up 0"});
}

TEST_CASE("SDO stream types: a block upload is repeated by Reset to the first lost segment [D12]") {
  Streams node;
  node.data = counting(2000);
  node.ask("601#A40030007F000000", "581#C6003000D0070000");
  node.rx("601#A300000000000000");
  expect_segments(node, node.data, 0, 127);
  node.rx("601#A2327F0000000000");
  expect_segments(node, node.data, 50, 127);
  node.rx("601#A20A7F0000000000");
  expect_segments(node, node.data, 60, 127);
  node.rx("601#A27F7F0000000000");
  expect_segments(node, node.data, 187, 99);
  node.rx("601#A2637F0000000000");
  node.tx(notation(block_end(0x581, node.data)));
  node.rx("601#A100000000000000");
  const Log log = node.take_log();
  CHECK(log.front() == "begin up 2000");
  CHECK(log.back() == "end up 0");
  CHECK(std::count_if(log.begin(), log.end(), [](const std::string& call) { return call[0] == 'e'; }) == 1);
}

// Types without Begin and End -----------------------------------------------------------------------------------------

TEST_CASE("SDO stream types: a type with Reset is called for each segment, in block transfers for each full buffer") {
  Streams node;
  node.ask("601#2B01300011220000", "581#6001300000000000");
  CHECK(node.take_log() == Log{"reset 0", "write 2"});
  CHECK(node.download(0x3001, 0, counting(9)) == 0);
  CHECK(node.take_log() == Log{"reset 0", "write 0", "write 7", "write 2"});
  CHECK(node.upload(0x3001, 0) == counting(9));
  CHECK(node.take_log() == Log{"reset 0", "read 0", "read 7", "read 2"});
  CHECK(node.block_download(0x3001, 0, counting(890)).abort == 0);
  CHECK(node.take_log() == Log{"reset 0", "write 0", "write 889", "write 1"});
  CHECK(node.block_upload(0x3001, 0).data == counting(890));
  CHECK(node.take_log() == Log{"reset 0", "read 0", "read 889", "read 1"});
}

TEST_CASE("SDO stream types: a type without Reset gets up to eight bytes in one piece in every transfer") {
  Streams node;
  node.data = Bytes(8);
  CHECK(node.download(0x3002, 0, counting(8)) == 0);
  CHECK(node.take_log() == Log{"write 8"});
  node.position = 0;
  CHECK(node.upload(0x3002, 0) == counting(8));
  CHECK(node.take_log() == Log{"read 8"});
  node.position = 0;
  CHECK(node.block_download(0x3002, 0, counting(8, 9)).abort == 0);
  CHECK(node.take_log() == Log{"write 8"});
  node.position = 0;
  CHECK(node.block_upload(0x3002, 0).data == counting(8, 9));
  CHECK(node.take_log() == Log{"read 8"});
}

TEST_CASE("SDO stream types: a longer type without Reset must fit into the buffer for a block upload") {
  Streams node;
  node.data = counting(889);
  node.ask("601#A40030007F000000", "581#C600300079030000");
  node.rx("601#8000300000000008");
  node.take_log();
  BlockOptions options;
  options.lost_answers = {5, 50};
  CHECK(node.block_upload(0x3002, 0, options).data == counting(889));
  CHECK(node.take_log() == Log{"read 0", "read 889"});
  node.data = counting(890);
  node.ask("601#A40230007F000000", "581#8002300001000405");
  CHECK(node.take_log().empty());
  node.position = 0;
  CHECK(node.upload(0x3002, 0) == counting(890));
}

#endif

}  // namespace

#else

namespace {

using namespace test;

TEST_CASE("SDO stream types: without USE_OBJ_EX an object of unknown length cannot be read") {
  struct Stream : LoggedStream, Fixture {
    Stream() : Fixture(Setup().only_small().with(plain(0x3001))) {}
  } node;
  node.data = {1, 2, 3};
  node.ask("601#4001300000000000", "581#4701300001020300");
  node.knows_size = false;
  node.take_log();
  node.ask("601#4001300000000000", "581#8001300020000008");
  CHECK(node.take_log().empty());
}

}  // namespace

#endif
