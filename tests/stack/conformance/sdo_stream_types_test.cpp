// SPDX-License-Identifier: Apache-2.0
// Types with Begin and End (CO_OBJ_TYPE_EX): order and arguments of their functions in transfers that succeed.
#include <algorithm>

#include "support/block_frames.hpp"
#include "support/logged_stream.hpp"

namespace {

using namespace test;

#if USE_OBJ_EX

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

#endif

#if !USE_OBJ_EX

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

#endif

// Types with Begin and End (CO_OBJ_TYPE_EX): each Begin that succeeds is followed by one End with the abort code,
// regardless of how the transfer ends.

#if USE_OBJ_EX

struct Stream : LoggedStream, Fixture {
  explicit Stream(std::uint32_t size = 890) : Fixture(Setup().only_small().with(extended(0x3000))) {
    data = counting(size);
  }
};

// A state of an open transfer, and the requests that lead to it.
struct State {
  std::string name;
  std::string direction;  // "up" or "down", as in the log
  bool in_sub_block;      // within the sub-block of a download, where all commands but 80h are segments
  std::vector<std::string> requests;
};

// Returns the initiate of a block download of 890 bytes and its first segments.
[[maybe_unused]] std::vector<std::string> block_of(const char* initiate, std::size_t segments) {
  std::vector<std::string> requests = {initiate};
  for (std::size_t n = 0; n < segments; ++n) {
    requests.push_back(notation(block_segment(counting(890), n, static_cast<unsigned>(n % 127 + 1))));
  }
  return requests;
}

std::vector<State> states() {
  std::vector<State> all = {
      {"segmented download", "down", false, {"601#2100300014000000"}},
      {"segmented download after one segment", "down", false, {"601#2100300014000000", "601#0001020304050607"}},
      {"segmented upload", "up", false, {"601#4000300000000000"}},
      {"segmented upload after one segment", "up", false, {"601#4000300000000000", "601#6000000000000000"}},
  };
#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127
  const char* const download = "601#C60030007A030000";
  const std::vector<State> block = {
      {"block download", "down", true, {download}},
      {"block download after one segment", "down", true, block_of(download, 1)},
      {"block download after one sub-block", "down", true, block_of(download, 127)},
      {"block download before its end request", "down", false, block_of(download, 128)},
      {"block upload", "up", false, {"601#A40030007F000000"}},
      {"block upload after one sub-block", "up", false, {"601#A40030007F000000", "601#A300000000000000"}},
      {"block upload before the end is confirmed",
       "up",
       false,
       {"601#A40030007F000000", "601#A300000000000000", "601#A27F7F0000000000", "601#A2017F0000000000"}},
  };
  all.insert(all.end(), block.begin(), block.end());
#endif
  return all;
}

enum class States { all, outside_of_sub_blocks };

// Calls \a cause in each state. Checks that End is then called once, with the abort code (eight hexadecimal digits).
template <class Cause>
void each_ends_with(const std::string& code, Cause cause, States which = States::all) {
  for (const State& state : states()) {
    if (state.in_sub_block && which == States::outside_of_sub_blocks) continue;
    CAPTURE(state.name);
    Stream node;
    for (const std::string& request : state.requests) {
      node.rx(request);
      node.frames();
    }
    const Log before = node.take_log();
    CHECK(before.front().substr(0, 5) == "begin");
    CHECK(before.back().substr(0, 3) != "end");
    cause(node);
    node.frames();
    CHECK(node.take_log() == Log{"end " + state.direction + " " + code});
    node.after(2 * node.sdo_time_out());
    node.frames();
    CHECK(node.take_log().empty());
  }
}

// Causes of the end of a transfer ------------------------------------------------------------------------------------

TEST_CASE("SDO stream types: End gets the code of an abort by the client [D6]") {
  each_ends_with("08000000", [](Fixture& node) { node.rx("601#8000300000000008"); });
  each_ends_with("12345678", [](Fixture& node) { node.rx("601#8000300078563412"); });
}

TEST_CASE("SDO stream types: End gets a code other than 0 after an abort by the client with the code 0") {
  for (const State& state : states()) {
    CAPTURE(state.name);
    Stream node;
    for (const std::string& request : state.requests) {
      node.rx(request);
      node.frames();
    }
    node.take_log();
    node.rx("601#8000300000000000");
    REQUIRE(node.log.size() == 1);
    CHECK(node.log[0].substr(0, 4) == "end ");
    CHECK(node.log[0] != "end " + state.direction + " 0");
  }
}

TEST_CASE("SDO stream types: End is called after an unknown command [D7]") {
  each_ends_with(
      "05040001", [](Fixture& node) { node.rx("601#E000000000000000"); }, States::outside_of_sub_blocks);
}

TEST_CASE("SDO stream types: End is called after a time-out [D18]") {
  each_ends_with("05040000", [](Fixture& node) { node.after(node.sdo_time_out()); });
}

TEST_CASE("SDO stream types: End is called at a new initiate that is accepted or refused [D8]") {
  each_ends_with(
      "08000022", [](Fixture& node) { node.ask("601#4000100000000000", "581#4300100091010F00"); },
      States::outside_of_sub_blocks);
  each_ends_with(
      "08000022", [](Fixture& node) { node.ask("601#4004100000000000", "581#8004100000000206"); },
      States::outside_of_sub_blocks);
}

TEST_CASE("SDO stream types: a new initiate of the same object calls End before Begin [D8]") {
  for (const State& state : states()) {
    if (state.in_sub_block) continue;
    CAPTURE(state.name);
    Stream node;
    for (const std::string& request : state.requests) {
      node.rx(request);
      node.frames();
    }
    node.take_log();
    node.ask("601#2B00300011220000", "581#6000300000000000");
    CHECK(node.take_log() ==
          Log{"end " + state.direction + " 08000022", "begin down 2", "reset 0", "write 2", "end down 0"});
  }
}

TEST_CASE("SDO stream types: End is called when the NMT state forbids SDO [N8]") {
  each_ends_with("08000022", [](Fixture& node) { node.rx("000#0201"); });
  each_ends_with("08000022", [](Fixture& node) { node.call([&] { CONmtSetMode(&node->Nmt, CO_STOP); }); });
}

TEST_CASE("SDO stream types: End is called at every NMT reset and by CONodeStop [N8] [T14]") {
  each_ends_with("08000022", [](Fixture& node) { node.rx("000#8101"); });
  each_ends_with("08000022", [](Fixture& node) { node.rx("000#8201"); });
  each_ends_with("08000022", [](Fixture& node) { node.call([&] { CONmtReset(&node->Nmt, CO_RESET_NODE); }); });
  each_ends_with("08000022", [](Fixture& node) { node.call([&] { CONodeStop(&node.node); }); });
}

TEST_CASE("SDO stream types: End is not called if the NMT state changes and the new state permits SDO [N8]") {
  Stream node;
  node.ask("601#4000300000000000", "581#410030007A030000");
  node.take_log();
  node.rx("000#0101");
  CHECK(node.log.empty());
  node.ask("601#6000000000000000", "581#0001020304050607");
}

TEST_CASE("SDO stream types: End is called after a wrong toggle bit [D4]") {
  Stream node;
  node.ask("601#2100300014000000", "581#6000300000000000");
  node.ask("601#1001020304050607", "581#8000300000000305");
  CHECK(node.log.back() == "end down 05030000");
  node.data = counting(9);
  node.ask("601#4000300000000000", "581#4100300009000000");
  node.ask("601#7000000000000000", "581#8000300000000305");
  CHECK(node.log.back() == "end up 05030000");
}

TEST_CASE("SDO stream types: End is called after a wrong number of bytes [D5]") {
  Stream node;
  node.ask("601#2100300014000000", "581#6000300000000000");
  node.ask("601#0101020304050607", "581#8000300013000706");
  CHECK(node.log.back() == "end down 06070013");
  node.ask("601#2100300002000000", "581#6000300000000000");
  node.ask("601#0301020304050607", "581#8000300012000706");
  CHECK(node.log.back() == "end down 06070012");
}

TEST_CASE("SDO stream types: a size that does not fit is refused before Begin [D5]") {
  Stream node;
  node.ask("601#21003000D1070000", "581#8000300012000706");
  CHECK(node.log.empty());
}

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

TEST_CASE(
    "SDO stream types: after a CRC error End is called and a block that fits into the buffer is not written [D14]") {
  Stream node;
  BlockOptions options;
  options.crc_error = 0x8000;
  CHECK(node.block_download(0x3000, 0, Bytes(889, 0xEE), options).abort == 0x05040004);
  CHECK(node.log.front() == "begin down 889");
  CHECK(node.log.back() == "end down 05040004");
  CHECK(std::count(node.log.begin(), node.log.end(), "write 889") == 0);
  node.take_log();
  CHECK(node.block_download(0x3000, 0, Bytes(890, 0xEE), options).abort == 0x05040004);
  CHECK(node.take_log() == Log{"begin down 890", "reset 0", "write 0", "write 889", "end down 05040004"});
}

TEST_CASE("SDO stream types: End is called after a wrong number of bytes in blocks and wrong acknowledges [D5] [D12]") {
  Stream node;
  BlockOptions options;
  options.announced_more = 1;
  CHECK(node.block_download(0x3000, 0, counting(9), options).abort == 0x06070013);
  CHECK(node.log.back() == "end down 06070013");
  options.announced_more = 0xFFFFFFFF;
  CHECK(node.block_download(0x3000, 0, counting(9), options).abort == 0x06070012);
  CHECK(node.log.back() == "end down 06070012");
  node.data = counting(9);
  node.take_log();
  for (const std::string acknowledge : {"037F", "0100"}) {
    node.ask("601#A40030007F000000", "581#C600300009000000");
    node.rx("601#A300000000000000");
    node.tx({"581#0101020304050607", "581#8208090000000000"});
    const std::string code = acknowledge == "037F" ? "3" : "2";
    node.ask("601#A2" + acknowledge + "0000000000", "581#800030000" + code + "000405");
    CHECK(node.log.back() == "end up 0504000" + code);
  }
  CHECK(std::count_if(node.log.begin(), node.log.end(), [](const auto& call) { return call[0] == 'e'; }) == 2);
}

TEST_CASE("SDO stream types: End of a block upload is not called before the client confirms the end [D12]") {
  Stream node(9);
  node.ask("601#A40030007F000000", "581#C600300009000000");
  node.rx("601#A300000000000000");
  node.tx({"581#0101020304050607", "581#8208090000000000"});
  node.rx("601#A2027F0000000000");
  node.tx(notation(block_end(0x581, counting(9))));
  node.take_log();
  node.after(node.sdo_time_out());
  node.tx("581#8000300000000405");
  CHECK(node.take_log() == Log{"end up 05040000"});
}

#endif

// Results of the type functions ---------------------------------------------------------------------------------------

// Results of type functions: an error, an error with an abort code of the application, an abort code without an error.
const auto refuse = [](CO_OBJ*, CO_NODE*) { return CO_ERR_OBJ_RANGE; };
const auto refuse_with_code = [](CO_OBJ* obj, CO_NODE* node) {
  COObjTypeUserSDOAbort(obj, node, 0x12345678);
  return CO_ERR_TYPE_WR;
};
const auto only_set_code = [](CO_OBJ* obj, CO_NODE* node) {
  COObjTypeUserSDOAbort(obj, node, 0x12345678);
  return CO_ERR_NONE;
};

struct Initiate {
  std::string request;
  bool is_short;  // the object has 2 bytes, else 890
  std::string direction;
};

std::vector<Initiate> initiates() {
  std::vector<Initiate> all = {{"601#2B00300011220000", true, "down"},
                               {"601#2100300014000000", false, "down"},
                               {"601#2000300000000000", false, "down"},
                               {"601#4000300000000000", true, "up"},
                               {"601#4000300000000000", false, "up"}};
#if USE_SDO_BLOCK
  all.push_back({"601#C600300014000000", false, "down"});
  all.push_back({"601#C000300000000000", false, "down"});
  all.push_back({"601#A40030007F000000", false, "up"});
  all.push_back({"601#A40030007F040000", true, "up"});
#endif
  return all;
}

TEST_CASE("SDO stream types: if Begin fails the transfer is refused and End is not called") {
  for (const Initiate& initiate : initiates()) {
    CAPTURE(initiate.request);
    Stream node(initiate.is_short ? 2 : 890);
    node.on_begin = refuse;
    node.ask(initiate.request, "581#8000300030000906");
    node.on_begin = refuse_with_code;
    node.ask(initiate.request, "581#8000300078563412");
    CHECK(node.log.size() == 2);
    CHECK(node.log[1].substr(0, 6 + initiate.direction.size()) == "begin " + initiate.direction);
    node.after(2 * node.sdo_time_out());
    node.silent();
    CHECK(node.log.size() == 2);
  }
}

TEST_CASE("SDO stream types: an abort code that Begin sets without an error has no effect") {
  for (const Initiate& initiate : initiates()) {
    CAPTURE(initiate.request);
    Stream node(initiate.is_short ? 2 : 890);
    node.on_begin = only_set_code;
    node.rx(initiate.request);
    const std::vector<std::string> sent = node.frames();
    REQUIRE(sent.size() == 1);
    CHECK(sent[0].substr(0, 6) != "581#80");
  }
}

TEST_CASE("SDO stream types: if Reset fails after Begin then End gets its abort code") {
  for (const Initiate& initiate : initiates()) {
    if (initiate.request[4] == 'C') continue;  // Reset is called only at its end
    CAPTURE(initiate.request);
    Stream node(initiate.is_short ? 2 : 890);
    node.on_reset = refuse;
    node.ask(initiate.request, "581#8000300030000906");
    REQUIRE(node.log.size() == 3);
    CHECK(node.log[1] == "reset 0");
    CHECK(node.log[2] == "end " + initiate.direction + " 06090030");
  }
}

TEST_CASE("SDO stream types: if a piece cannot be written or read then End gets its abort code") {
  for (const bool own_code : {false, true}) {  // true: the application sets the abort code
    const std::string code = own_code ? "12345678" : "06090030";
    const std::string bytes = own_code ? "78563412" : "30000906";
    Stream node;
    if (own_code) {
      node.on_piece = refuse_with_code;
    } else {
      node.on_piece = refuse;
    }
    node.ask("601#2B00300011220000", "581#80003000" + bytes);
    CHECK(node.take_log() == Log{"begin down 2", "reset 0", "write 2", "end down " + code});
    node.ask("601#2100300014000000", "581#6000300000000000");
    node.ask("601#0001020304050607", "581#80003000" + bytes);
    CHECK(node.take_log() == Log{"begin down 20", "reset 0", "write 0", "write 7", "end down " + code});
    node.data = counting(9);
    node.ask("601#4000300000000000", "581#4100300009000000");
    node.ask("601#6000000000000000", "581#80003000" + bytes);
    CHECK(node.take_log() == Log{"begin up 9", "reset 0", "read 0", "read 7", "end up " + code});
#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127
    node.ask("601#A40030007F000000", "581#C600300009000000");
    node.ask("601#A300000000000000", "581#80003000" + bytes);
    CHECK(node.take_log() == Log{"begin up 9", "reset 0", "read 0", "read 9", "end up " + code});
    CHECK(node.block_download(0x3000, 0, counting(9)).abort == (own_code ? 0x12345678 : 0x06090030));
    CHECK(node.take_log() == Log{"begin down 9", "reset 0", "write 0", "write 9", "end down " + code});
    CHECK(node.block_download(0x3000, 0, counting(1000)).abort == (own_code ? 0x12345678 : 0x06090030));
    CHECK(node.take_log() == Log{"begin down 1000", "reset 0", "write 0", "write 889", "end down " + code});
#endif
  }
}

TEST_CASE("SDO stream types: if End fails after a download the last request is answered with its abort code") {
  for (const bool own_code : {false, true}) {  // true: the application sets the abort code
    const std::string bytes = own_code ? "78563412" : "30000906";
    const std::uint32_t code = own_code ? 0x12345678 : 0x06090030;
    Stream node;
    if (own_code) {
      node.on_end = refuse_with_code;
    } else {
      node.on_end = refuse;
    }
    node.ask("601#2B00300011220000", "581#80003000" + bytes);
    CHECK(node.take_log() == Log{"begin down 2", "reset 0", "write 2", "end down 0"});
    CHECK(node.download(0x3000, 0, counting(9)) == code);
    CHECK(node.take_log().back() == "end down 0");
#if USE_SDO_BLOCK
    CHECK(node.block_download(0x3000, 0, counting(9)).abort == code);
    CHECK(node.take_log().back() == "end down 0");
    CHECK(node.block_download(0x3000, 0, counting(900)).abort == code);
    CHECK(node.take_log().back() == "end down 0");
#endif
    CHECK(node.error() == CO_ERR_NONE);
    node.ask("601#6000000000000000", "581#8000000001000405");
  }
}

TEST_CASE("SDO stream types: a failure of End after an upload or after an abort has no effect") {
  Stream node(9);
  node.on_end = refuse_with_code;
  CHECK(node.upload(0x3000, 0) == counting(9));
#if USE_SDO_BLOCK
  CHECK(node.block_upload(0x3000, 0).data == counting(9));
#endif
  node.ask("601#2100300014000000", "581#6000300000000000");
  node.rx("601#8000300000000008");
  node.silent();
  node.ask("601#2100300014000000", "581#6000300000000000");
  node.ask("601#1001020304050607", "581#8000300000000305");
  node.ask("601#2100300014000000", "581#6000300000000000");
  node.after(node.sdo_time_out());
  node.tx("581#8000300000000405");
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("SDO stream types: an abort code that End sets without an error has no effect then or later") {
  Stream node;
  node.on_end = only_set_code;
  node.ask("601#2B00300011220000", "581#6000300000000000");
  node.ask("601#4004100000000000", "581#8004100000000206");
  node.on_end = refuse;
  node.ask("601#2B00300011220000", "581#8000300030000906");
}

#endif

// SDO server: type functions that move the dictionary or change the size of the object of an open transfer, and the
// timer that monitors transfers.

// A node whose object 3100h has a type that tries to move the dictionary.
struct MovingStream : LoggedStream, Fixture {
  std::vector<CO_OBJ> table;

  explicit MovingStream(std::uint32_t size) : Fixture(Setup().only_small().with(plain(0x3100))) {
    data = counting(size);
  }

  std::function<CO_ERR(CO_OBJ*, CO_NODE*)> move() {
    return [this](CO_OBJ*, CO_NODE* of) {
      if (table.empty()) {
        table.assign(of->Dict.Root, of->Dict.Root + of->Dict.Num);
        CHECK(CODictInit(&of->Dict, of, table.data(), of->Dict.Num) == -1);
      }
      return CO_ERR_NONE;
    };
  }
};

TEST_CASE("SDO stream types: CODictInit() in a type function is refused and the transfer continues") {
  MovingStream node(0);
  node.on_open = node.move();
  node.ask("601#2100310003000000", "581#6000310000000000");
  node.ask("601#0901020300000000", "581#2000000000000000");
  CHECK(node.error() == CO_ERR_DICT_BUSY);
}

#if USE_OBJ_EX  // objects of unknown size
TEST_CASE(
    "SDO stream types: an object of unknown size that becomes shorter than the read part is aborted with 0604 0047h") {
  MovingStream node(20);
  node.knows_size = false;
  node.ask("601#4000310000000000", "581#4000310000000000");
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.on_piece = [&](CO_OBJ*, CO_NODE*) {
    node.data.resize(3);
    node.at_end = true;
    return CO_ERR_NONE;
  };
  node.ask("601#7000000000000000", "581#8000310047000406");
}

#endif

// Time-out of transfers ---------------------------------------------------------------------------------------------

#if CO_SDO_TIMEOUT != 0
TEST_CASE("SDO server: the timer of the time-outs stops when no transfer is open [D18]") {
  for (const char* end : {"601#8008100000000000", "601#4000100000000000", "601#E000000000000000"}) {
    CAPTURE(std::string(end));
    Fixture node;
    node.rx("601#4008100000000000");
    node.frames();
    CHECK(node.armed_timers() == 1);
    node.rx(end);
    node.frames();
    node.after(node.sdo_time_out());
    CHECK(node.armed_timers() == 0);
    CHECK(CONodeNextDeadline(&node.node) == 0xFFFFFFFF);
  }
}

TEST_CASE("SDO server: the timer of the time-outs stops at a reset and in states without SDO") {
  for (const char* command : {"000#0201", "000#8201"}) {
    CAPTURE(std::string(command));
    Fixture node;
    node.rx("601#4008100000000000");
    node.frames();
    CHECK(node.armed_timers() == 1);
    node.rx(command);
    node.frames();
    CHECK(node.armed_timers() == 0);
  }
}
#endif

}  // namespace
