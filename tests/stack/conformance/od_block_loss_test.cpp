// SPDX-License-Identifier: Apache-2.0
// Block transfers of extended streams (co_od.h) with lost frames. An upload repeats segments; if they are no longer in
// the buffer, the extension is read again from its beginning. A download requests the lost segments.
// [301:7.2.4.3.9-15]
#include "support/block_frames.hpp"
#include "support/logged_extension.hpp"

#if USE_OD && USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

namespace {

using namespace test;

// 3000h of unknown length, 3001h a domain of 2000 bytes, 3002h a text of up to 2000.
struct Node : Fixture {
  Bytes domain_memory = Bytes(2000);
  CO_OBJ_DOM domain{0, 2000, domain_memory.data()};
  Bytes text_memory = Bytes(2000);
  CO_OBJ_STR_RW text{0, 0, 2000, text_memory.data()};
  LoggedExtension extension;

  Node()
      : Fixture(Setup()
                    .only_small()
                    .with({CO_KEY(0x3000, 0, CO_OBJ_____RW), OD_TSTREAM, CO_DATA(0)})
                    .with({CO_KEY(0x3001, 0, CO_OBJ_____RW), OD_TDOMAIN, CO_DATA(&domain)})
                    .with({CO_KEY(0x3002, 0, CO_OBJ_____RW), OD_TVISIBLE_STRING, CO_DATA(&text)})) {
    for (std::uint16_t index = 0x3000; index <= 0x3002; ++index) {
      extension.put_at(*this, index);
    }
  }
};

// Returns bytes that are not 0.
Bytes letters(std::size_t size) {
  Bytes data = counting(size);
  for (std::uint8_t& byte : data) {
    byte = static_cast<std::uint8_t>(byte | 0x80U);
  }
  return data;
}

TEST_CASE(
    "OD block loss: an upload that repeats data beyond the buffer restarts the function and discards known bytes") {
  Node node;
  node.extension.data = counting(1000);
  node.ask("601#A400300064000000", "581#C400300000000000");
  CHECK(node.extension.take_log().empty());
  node.rx("601#A300000000000000");
  expect_segments(node, counting(1000), 0, 100);
  CHECK(node.extension.take_log() == Log{"read 889 at 0 of 0"});
  node.rx("601#A2641E0000000000");
  expect_segments(node, counting(1000), 100, 30);
  CHECK(node.extension.take_log() == Log{"read 889 at 889 of 0"});
  node.rx("601#A2057F0000000000");  // all segments from byte 735 are lost
  Log log = node.extension.take_log();
  CHECK(log.size() == 735 / 32 + 2);
  CHECK(log.front() == "read 32 at 0 of 0");
  CHECK(log[735 / 32] == "read 31 at 704 of 0");
  CHECK(log.back() == "read 265 at 735 of 0");  // the length is known now
  expect_segments(node, counting(1000), 105, 38);
  node.rx("601#A2267F0000000000");
  node.tx(notation(block_end(0x581, counting(1000))));
  node.rx("601#A100000000000000");
  CHECK(node.extension.take_log().empty());
}

// Returns the number of bytes that were requested from the extension since the last call.
std::uint32_t bytes_read(LoggedExtension& extension) {
  std::uint32_t bytes = 0;
  for (const std::string& line : extension.take_log()) {
    bytes += line.substr(0, 5) == "read " ? static_cast<std::uint32_t>(std::stoul(line.substr(5))) : 0;
  }
  return bytes;
}

// Runs an upload of 20000 bytes until segment 2700, so that a repetition has to read 17780 bytes again.
void upload_to_the_end(Node& node, const Bytes& data) {
  node.extension.data = data;
  node.ask("601#A400300064000000", "581#C400300000000000");
  node.rx("601#A300000000000000");
  unsigned segment = 0;
  for (; segment < 2600; segment += 100) {
    expect_segments(node, data, segment, 100);
    node.rx("601#A264640000000000");
  }
  node.frames();  // segments 2601 to 2700
  node.extension.take_log();
}

TEST_CASE("OD block loss: a call of CONodeProcess() repeats at most one block of reads, for any length of the stream") {
  Node node;
  const Bytes data = letters(20000);
  upload_to_the_end(node, data);
  node.calls(1);
  node.rx("601#A2017F0000000000");  // all segments from byte 18207 are lost; the buffer begins at 18669
  unsigned calls = 0;
  while (node->Transmit.Paused != 0 && node.can.sent.empty()) {
    CHECK(bytes_read(node.extension) <= 2 * CO_SDO_BUF_BYTE);
    node.loop();
    ++calls;
  }
  CHECK(calls == 18207 / CO_SDO_BUF_BYTE);
  node.calls(Fixture::enough_calls);
  node.loop();
  expect_segments(node, data, 2601, 127);
  node.rx("601#8000300000000008");
}

TEST_CASE("OD block loss: during repeated reads other channels, the application and new requests are served") {
  Node node;
  const Bytes data = letters(20000);
  upload_to_the_end(node, data);
  node.calls(1);
  node.rx("601#A2007F0000000000");
  REQUIRE(node.can.sent.empty());
  node.call([&] {
    std::uint8_t bytes[5] = {};
    CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x3000, 0), bytes, 5) == CO_ERR_NONE);
    CHECK(std::equal(bytes, bytes + 5, data.data()));
  });
  node.calls(Fixture::enough_calls);
  node.loop();
  expect_segments(node, data, 2600, 127);
  node.rx("601#8000300000000008");
  node.extension.data = counting(20);
  CHECK(node.upload(0x3000, 0) == counting(20));
}

TEST_CASE("OD block loss: COObjReset() by the application restarts the stream at once") {
  Node node;
  node.extension.data = letters(5000);
  Bytes bytes(5000);
  CO_OBJ* const obj = node.find(0x3000, 0);
  node.call([&] {
    CHECK(COObjRdBufStart(obj, &node.node, bytes.data(), 5000) == CO_ERR_NONE);
    CHECK(COObjReset(obj, &node.node, 4000) == CO_ERR_NONE);
    CHECK(COObjRdBufCont(obj, &node.node, bytes.data(), 2) == CO_ERR_NONE);
  });
  CHECK(bytes[0] == letters(5000)[4000]);
}

TEST_CASE("OD block loss: uploads that lose any one frame have the right bytes or are aborted") {
  for (const std::uint16_t index : std::initializer_list<std::uint16_t>{0x3000, 0x3001, 0x3002}) {
    for (const std::uint8_t blksize : std::initializer_list<std::uint8_t>{20, 100, 127}) {
      Node node;
      node.extension.data = letters(2000);
      BlockOptions options;
      options.blksizes = {blksize};
      const unsigned answers = node.block_upload(index, 0, options).answers;
      CHECK(answers > 280);
      for (unsigned n = 1; n + 4 < answers; n += 3) {
        CAPTURE(index);
        CAPTURE(n);
        options.lost_answers = {n, n + 2};
        const BlockResult result = node.block_upload(index, 0, options);
        CHECK(result.abort == 0);
        CHECK(result.data == letters(2000));
      }
    }
  }
}

TEST_CASE("OD block loss: an extension that returns other bytes in a repeated read is detected by the CRC") {
  Node node;
  node.extension.data = letters(1000);
  node.ask("601#A404300064000000", "581#8004300000000206");
  node.ask("601#A400300064000000", "581#C400300000000000");
  node.rx("601#A300000000000000");
  expect_segments(node, letters(1000), 0, 100);
  node.rx("601#A2641E0000000000");
  expect_segments(node, letters(1000), 100, 30);
  node.extension.data = counting(1000, 3);
  node.rx("601#A2057F0000000000");
  expect_segments(node, counting(1000, 3), 105, 38);
  node.rx("601#A2267F0000000000");
  CHECK(node.frames().size() == 1);
  node.rx("601#8000300004000405");
}

TEST_CASE("OD block loss: a function that returns fewer bytes than before or refuses the restart aborts the upload") {
  for (const bool shorter : {true, false}) {
    Node node;
    node.extension.data = counting(1000);
    node.ask("601#A400300064000000", "581#C400300000000000");
    node.rx("601#A300000000000000");
    expect_segments(node, counting(1000), 0, 100);
    node.rx("601#A2641E0000000000");
    expect_segments(node, counting(1000), 100, 30);
    if (shorter) {
      node.extension.data = counting(500);
    } else {
      node.extension.answer = ODR_DATA_LOC_CTRL;
    }
    node.rx("601#A2057F0000000000");
    node.tx(shorter ? "581#8000300022000008" : "581#8000300021000008");
    node.extension.answer = ODR_OK;
    node.extension.data = counting(20);
    CHECK(node.upload(0x3000, 0) == counting(20));
  }
}

TEST_CASE("OD block loss: downloads that lose any one frame reach the extension once, complete and in order") {
  for (const bool announced : {true, false}) {
    Node node;
    const Bytes data = counting(1900, 5);
    BlockOptions options;
    options.sized = announced;
    for (unsigned n = 1; n < 280; n += 9) {
      CAPTURE(n);
      options.lost_requests = {n};
      node.extension.take_log();
      CHECK(node.block_download(0x3000, 0, data, options).abort == 0);
      CHECK(node.extension.data == data);
      CHECK(node.extension.take_log() ==
            Log{"write 889 at 0 of 0", "write 889 at 889 of 0", "write 122 at 1778 of 1900"});
    }
  }
}

TEST_CASE("OD block loss: after a wrong CRC or length the extension is not called with the last piece") {
  Node node;
  node.extension.data = {1};
  BlockOptions options;
  options.crc_error = 1;
  CHECK(node.block_download(0x3000, 0, counting(1000), options).abort == 0x05040004);
  CHECK(node.extension.take_log() == Log{"write 889 at 0 of 0"});
  options.crc_error = 0;
  options.announced_more = 5;
  CHECK(node.block_download(0x3000, 0, counting(1000), options).abort == 0x06070013);
  CHECK(node.extension.data == Bytes{1});
}

}  // namespace

#endif
