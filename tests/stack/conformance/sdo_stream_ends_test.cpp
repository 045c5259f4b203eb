// SPDX-License-Identifier: Apache-2.0
// Types with Begin and End (CO_OBJ_TYPE_EX): each Begin that succeeds is followed by one End with the abort code,
// regardless of how the transfer ends.
#include <algorithm>

#include "support/block_frames.hpp"
#include "support/logged_stream.hpp"

#if USE_OBJ_EX

namespace {

using namespace test;

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

}  // namespace

#endif
