// SPDX-License-Identifier: Apache-2.0
// SDO server: block download. [301:7.2.4.3.9, 7.2.4.3.10, 7.2.4.3.11]
#include <algorithm>

#include "support/block_frames.hpp"

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

namespace {

using namespace test;

TEST_CASE("SDO block download: two bytes without CRC [D11] [SDO 20] [SDO 21]") {
  Fixture node;
  node.ask("601#C217100002000000", "581#A41710007F000000");
  node.rx("601#81E8030000000000");
  expect_last_ack(node, 1);
  node.ask("601#D500000000000000", "581#A100000000000000");
  CHECK(node.objects.heartbeat == 1000);
}

TEST_CASE("SDO block download: two bytes with CRC, which is 0 for the value 0 [D14] [SDO 24] [SDO 25]") {
  Fixture node;
  node.ask("601#C617100002000000", "581#A41710007F000000");
  node.rx("601#8100000000000000");
  expect_last_ack(node, 1);
  node.ask("601#D500000000000000", "581#A100000000000000");
  node.ask("601#C617100002000000", "581#A41710007F000000");
  node.rx("601#81E8030000000000");
  expect_last_ack(node, 1);
  node.ask("601#D578A90000000000", "581#A100000000000000");
  CHECK(node.objects.heartbeat == 1000);
}

TEST_CASE("SDO block download: the CRC of 123456789 is 31C3h, low byte first [D14]") {
  struct Row {
    const char* end;
    const char* answer;
  };
  const Row rows[] = {
      {"601#D5C3310000000000", "581#A100000000000000"},
      {"601#D531C30000000000", "581#8010210004000405"},
      {"601#D5C3300000000000", "581#8010210004000405"},
      {"601#D500000000000000", "581#8010210004000405"},
  };
  for (const Row& row : rows) {
    CAPTURE(std::string(row.end));
    Fixture node;
    const bool right = row.answer[4] == 'A';
    node.ask("601#C610210009000000", "581#A41021007F000000");
    node.rx("601#0131323334353637");
    node.rx("601#8238390000000000");
    expect_last_ack(node, 2);
    node.ask(row.end, row.answer);
    CHECK(node.objects.text.Size == (right ? 9 : 4));
    CHECK(node.objects.text_memory[0] == (right ? '1' : 't'));
  }
}

TEST_CASE("SDO block download: it succeeds with the four forms of the initiate (CRC yes/no size yes/no) [D11] [D14]") {
  struct Row {
    const char* initiate;
    const char* end;
  };
  const Row rows[] = {
      {"601#C004200000000000", "601#CD00000000000000"},
      {"601#C204200004000000", "601#CD00000000000000"},
      {"601#C404200000000000", "601#CDFAD00000000000"},
      {"601#C604200004000000", "601#CDFAD00000000000"},
  };
  for (const Row& row : rows) {
    CAPTURE(std::string(row.initiate));
    Fixture node;
    node.ask(row.initiate, "581#A40420007F000000");
    node.rx("601#8178563412000000");
    expect_last_ack(node, 1);
    CHECK(node.objects.u32 == 0x44332211);
    node.ask(row.end, "581#A100000000000000");
    CHECK(node.objects.u32 == 0x12345678);
  }
}

TEST_CASE("SDO block download: the CRC of a client without CRC is ignored [D14]") {
  Fixture node;
  for (const char* initiate : {"601#C004200000000000", "601#C204200004000000"}) {
    node.ask(initiate, "581#A40420007F000000");
    node.rx("601#8178563412000000");
    expect_last_ack(node, 1);
    node.ask("601#CDFFFF0000000000", "581#A100000000000000");
  }
  CHECK(node.objects.u32 == 0x12345678);
}

TEST_CASE("SDO block download: reserved bytes are ignored [D11]") {
  Fixture node;
  node.ask("601#C0042000FFFFFFFF", "581#A40420007F000000");
  node.rx("601#8178563412FFFFFF");
  expect_last_ack(node, 1);
  node.ask("601#CD0000FFFFFFFFFF", "581#A100000000000000");
  CHECK(node.objects.u32 == 0x12345678);
}

TEST_CASE("SDO block download: the CRC excludes the unused bytes of the last segment [D14] [D24]") {
  Fixture node;
  node.ask("601#C604200004000000", "581#A40420007F000000");
  node.rx("601#8178563412AABBCC");
  expect_last_ack(node, 1);
  node.ask("601#CDFAD00000000000", "581#A100000000000000");
}

// Objects -------------------------------------------------------------------------------------------------------------

TEST_CASE("SDO block download: numbers of one to eight bytes, lowest byte first") {
  Fixture node(Setup().only_small());
  for (unsigned width = 1; width <= 8; ++width) {
    for (const bool crc : {false, true}) {
      CAPTURE(width);
      BlockOptions options;
      options.crc = crc;
      CHECK(node.block_download(static_cast<std::uint16_t>(0x2000 + width), 0, counting(width), options).abort == 0);
    }
  }
  CHECK(node.objects.u8 == 0x01);
  CHECK(node.objects.u16 == 0x0201);
  CHECK(node.objects.u24 == 0x030201);
  CHECK(node.objects.u32 == 0x04030201);
  CHECK(node.objects.u40 == 0x0504030201);
  CHECK(node.objects.u48 == 0x060504030201);
  CHECK(node.objects.u56 == 0x07060504030201);
  CHECK(node.objects.u64 == 0x0807060504030201);
}

TEST_CASE("SDO block download: an eight byte value in two segments") {
  Fixture node;
  node.ask("601#C608200008000000", "581#A40820007F000000");
  node.rx("601#0101020304050607");
  node.rx("601#8208000000000000");
  expect_last_ack(node, 2);
  CHECK(node.objects.u64 == 0x8877665544332211);
  node.ask("601#D9AC760000000000", "581#A100000000000000");
  CHECK(node.objects.u64 == 0x0807060504030201);
}

TEST_CASE("SDO block download: objects of every basic type are written and flag N subtracts the node-ID") {
  Fixture node(Setup().only_small().node_id(1));
  CHECK(node.block_download(0x2024, 0, {0x00, 0x00, 0x20, 0x41}).abort == 0);
  CHECK(node.objects.real32 == 10.0F);
  CHECK(node.block_download(0x2028, 0, {0, 0, 0, 0, 0, 0, 0x24, 0x40}).abort == 0);
  CHECK(node.objects.real64 == 10.0);
  CHECK(node.block_download(0x2020, 0, {1}).abort == 0);
  CHECK(node.objects.boolean == 1);
  CHECK(node.block_download(0x2026, 0, {0x78, 0x56, 0x34, 0x02, 0xBB, 0xAA}).abort == 0);
  CHECK(node.objects.time_of_day.Ms == 0x02345678);
  CHECK(node.objects.time_of_day.Days == 0xAABB);
  CHECK(node.block_download(0x2034, 0, {0x05, 0x02, 0, 0}).abort == 0);
  node.ask("601#4034200000000000", "581#4334200005020000");
}

TEST_CASE("SDO block download: strings may be shorter than their capacity, and empty [D5] [D19]") {
  Fixture node(Setup().only_small());
  for (const std::size_t size : {0U, 1U, 6U, 7U, 8U, 14U, 15U, 16U}) {
    CAPTURE(size);
    CHECK(node.block_download(0x2110, 0, Bytes(size, 'x')).abort == 0);
    CHECK(node.block_upload(0x2110, 0).data == Bytes(size, 'x'));
  }
  CHECK(node.block_download(0x2111, 0, counting(10)).abort == 0);
  CHECK(node.upload(0x2111, 0) == counting(10));
  CHECK(node.block_download(0x2112, 0, {0xE4, 0x00, 0xAC, 0x20}).abort == 0);
  CHECK(node.objects.unicode_memory[0] == 0x00E4);
  CHECK(node.objects.unicode_memory[1] == 0x20AC);
}

TEST_CASE("SDO block download: an empty object is one segment without data [D19]") {
  Fixture node;
  node.ask("601#C611210000000000", "581#A41121007F000000");
  node.rx("601#8100000000000000");
  expect_last_ack(node, 1);
  node.ask("601#DD00000000000000", "581#A100000000000000");
  CHECK(node.objects.octets.Size == 0);
  node.ask("601#C600210000000000", "581#A40021007F000000");
  node.rx("601#8100000000000000");
  expect_last_ack(node, 1);
  node.ask("601#DD00000000000000", "581#A100000000000000");
}

// Sizes and blocks ----------------------------------------------------------------------------------------------------

TEST_CASE("SDO block download: data of every size are written unchanged, with and without CRC and size [D11]") {
  for (const std::uint32_t size : {0U, 1U, 4U, 7U, 8U, 14U, 15U, 888U, 889U, 890U, 70000U}) {
    CAPTURE(size);
    for (unsigned form = 0; form<4; form += size> 1000 ? stride(4) : 1) {
      CAPTURE(form);
      Fixture node(Setup().with_70000());
      BlockOptions options;
      options.crc = (form & 1U) != 0;
      options.sized = (form & 2U) != 0;
      const Bytes data = counting(size, 100 + form);
      CHECK(node.block_download(domain_of(size).index, domain_of(size).sub, data, options).abort == 0);
      CHECK((size == 0 || node.objects.memory[size] == data));
    }
  }
}

TEST_CASE("SDO block download: one mebibyte is written [D11]") {
  Fixture node(Setup().only_small().with_mebibyte());
  Bytes data(mebibyte / stride(16));
  for (std::uint32_t i = 0; i < data.size(); ++i) {
    data[i] = static_cast<std::uint8_t>(i ^ (i >> 8) ^ (i >> 16));
  }
  CHECK(node.block_download(0x2105, 0, data).abort == 0);
  CHECK(std::equal(data.begin(), data.end(), node.objects.memory[mebibyte].begin()));
}

TEST_CASE("SDO block download: each length of the last segment works after each number of segments [D11]") {
  Fixture node;
  for (std::uint32_t size = 1; size <= 890; size += stride(37)) {
    CAPTURE(size);
    const Bytes data = counting(size, size);
    CHECK(node.block_download(0x2104, 0, data).abort == 0);
    CHECK(std::equal(data.begin(), data.end(), node.objects.memory[890].begin()));
  }
}

TEST_CASE("SDO block download: an end that resembles the last segment is processed as an end [D27]") {
  for (unsigned unused = 0; unused < 7; ++unused) {
    CAPTURE(unused);
    Fixture node;
    const unsigned segments = 0x41 + 4 * unused;  // C1h, C5h, …: number of the last segment with bit 7
    const Bytes data = counting(7 * segments - unused);
    node.ask("601#C404210000000000", "581#A40421007F000000");
    send_segments(node, data, 0, segments);
    expect_last_ack(node, segments);
    node.rx(block_end(0x601, data));
    node.tx("581#A100000000000000");
  }
}

TEST_CASE("SDO block download: a last block that fills the buffer is not written before the end [D10] [D11]") {
  Fixture node;
  const Bytes data = counting(889, 7);
  node.ask("601#C601210079030000", "581#A40121007F000000");
  send_segments(node, data, 0, 127);
  expect_last_ack(node, 127);
  CHECK(node.objects.memory[889] == counting(889));
  node.rx(block_end(0x601, data));
  node.tx("581#A100000000000000");
  CHECK(node.objects.memory[889] == data);
}

TEST_CASE("SDO block download: one byte more than the buffer is sent in a second block [D11]") {
  Fixture node;
  const Bytes data = counting(890, 7);
  node.ask("601#C60421007A030000", "581#A40421007F000000");
  send_segments(node, data, 0, 127);
  node.tx("581#A27F7F0000000000");
  send_segments(node, data, 127, 1);
  expect_last_ack(node, 1);
  node.rx(block_end(0x601, data));
  node.tx("581#A100000000000000");
  CHECK(node.objects.memory[890] == data);
}

TEST_CASE("SDO block download: data that fit into the buffer are written after the end [D10]") {
  Fixture node;
  node.ask("601#C400210F00000000", "581#A400210F7F000000");
  node.rx("601#01A1A2A3A4A5A6A7");
  node.rx("601#82A8A90000000000");
  expect_last_ack(node, 2);
  CHECK(node.objects.memory[15] == counting(15));
  node.rx("601#8000210F00000008");
  CHECK(node.objects.memory[15] == counting(15));
}

TEST_CASE("SDO block download: an access of the application does not move the position") {
  Fixture node;
  const Bytes data = counting(890, 7);
  node.ask("601#C40421007A030000", "581#A40421007F000000");
  send_segments(node, data, 0, 127);
  node.tx("581#A27F7F0000000000");
  node.call([&] {
    std::uint32_t first = 0;
    CHECK(CODictRdLong(&node->Dict, CO_DEV(0x2104, 0), &first) == CO_ERR_NONE);
  });
  send_segments(node, data, 127, 1);
  expect_last_ack(node, 1);
  node.rx(block_end(0x601, data));
  node.tx("581#A100000000000000");
  CHECK(node.objects.memory[890] == data);
}

TEST_CASE("SDO block download: the checks of the initiate have their order and abort codes [SDO 03]") {
  Fixture node;
  for (const std::string command : {"C0", "C2", "C4", "C6"}) {
    node.ask("601#" + command + "04100004000000", "581#8004100000000206");
    node.ask("601#" + command + "00100104000000", "581#8000100111000906");
    node.ask("601#" + command + "33200004000000", "581#8033200011000906");
    node.ask("601#" + command + "0110FF04000000", "581#800110FF11000906");
    node.ask("601#" + command + "00100004000000", "581#8000100002000106");
    node.ask("601#" + command + "31200009000000", "581#8031200002000106");
    node.ask("601#" + command + "32200009000000", "581#8032200000000106");
    node.ask("601#01DEADBEEF000000", "581#80DEADBE01000405");
  }
}

TEST_CASE("SDO block download: a write-only object is written") {
  Fixture node;
  CHECK(node.block_download(0x2030, 0, {1, 2, 3, 4}).abort == 0);
  CHECK(node.objects.write_only == 0x04030201);
}

TEST_CASE("SDO block download: memory that must not be written is checked at the end at the latest") {
  Fixture node(Setup().writable([](const void*, std::uint32_t) { return false; }));
  CHECK(node.block_download(0x2004, 0, {1, 2, 3, 4}).abort == 0x06010000);
  CHECK(node.block_download(0x2100, 15, counting(15)).abort == 0x06010000);
  CHECK(node.block_download(0x2104, 0, counting(890)).abort == 0x06010000);
}

// SDO server, block download: within a block, requests of a client that polls are treated as segments. Only frames
// that belong to the transfer restart its time-out. [301:7.2.4.3.10] [D18]

// Returns true if the server has aborted: after the time-out, or because the data exceed the size.
bool has_ended(Fixture& node) {
  const std::vector<std::string> sent = node.frames();
  return std::any_of(sent.begin(), sent.end(), [](const std::string& text) {
    return text == "581#8000210F00000405" || text == "581#8000210F12000706";
  });
}

// Sends one of the frames every 100 ms until the server has aborted. Returns the time that has passed.
Time poll(Fixture& node, const std::vector<CO_IF_FRM>& requests, Time limit) {
  Time passed{0};
  for (std::size_t n = 0; passed < limit; ++n) {
    node.after(100ms);
    passed += 100ms;
    if (has_ended(node)) {
      return passed;
    }
    node.rx(requests[n % requests.size()]);
    node.frames();
  }
  return limit;
}

void open_block_download(Fixture& node) { node.ask("601#C600210F0F000000", "581#A400210F7F000000"); }

TEST_CASE("SDO block download: a client that polls faster than the time-out with any request does not keep it open") {
  for (unsigned command = 0; command < 256; ++command) {
    if (command == 0x80) {
      continue;
    }
    CAPTURE(command);
    Fixture node(Setup().only_small());
    open_block_download(node);
    CO_IF_FRM request = frame("601#0000100000000000");
    request.Data[0] = static_cast<std::uint8_t>(command);
    CHECK(poll(node, {request}, 10s) <= 2 * node.sdo_time_out());
    node.ask("601#4000100000000000", "581#4300100091010F00");
  }
}

TEST_CASE("SDO block download: a client that polls with several requests does not keep it open") {
  const char* const polls[][4] = {
      {"601#4000100000000000", "601#4001100000000000", "601#6000000000000000", "601#7000000000000000"},
      {"601#2317100000000000", "601#4017100000000000", "601#2B17100000000000", "601#4000100000000000"},
      {"601#A40810007F000000", "601#A300000000000000", "601#A2017F0000000000", "601#A100000000000000"},
      {"601#A00810007F000000", "601#C000210000000000", "601#4000100000000000", "601#C100000000000000"},
      {"601#7F00000000000000", "601#FF00000000000000", "601#0200000000000000", "601#8200000000000000"}};
  for (const auto& some : polls) {
    CAPTURE(some[0]);
    Fixture node(Setup().only_small());
    open_block_download(node);
    std::vector<CO_IF_FRM> requests;
    for (const char* text : some) {
      requests.push_back(frame(text));
    }
    CHECK(poll(node, requests, 10s) <= 2 * node.sdo_time_out());
    node.ask("601#4000100000000000", "581#4300100091010F00");
  }
}

TEST_CASE("SDO block download: a repeated last segment without an end does not keep it open [D27]") {
  Fixture node(Setup().only_small());
  open_block_download(node);
  node.rx("601#0101020304050607");
  node.rx("601#0208090A0B0C0D0E");
  node.ask("601#830F000000000000", "581#A2037C0000000000");
  CHECK(poll(node, {frame("601#830F000000000000")}, 10s) <= node.sdo_time_out() + 100ms);
}

// The server acknowledges after a time without segments, so that each segment is the first of a block.
TEST_CASE("SDO block download: a client that sends a segment every 1.5 s completes the transfer [D18]") {
  Fixture node(Setup().only_small());
  const Bytes data = counting(15, 0x21);
  open_block_download(node);
  for (std::size_t place = 0; place < 3; ++place) {
    node.after(1500ms);
    CHECK_FALSE(has_ended(node));
    node.rx(block_segment(data, place, 1));
  }
  node.frames();
  node.after(1500ms);
  node.frames();
  node.rx(block_end(0x601, data));
  node.tx("581#A100000000000000");
  CHECK(node.objects.memory[15] == data);
}

}  // namespace

#endif
