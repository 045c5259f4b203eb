// SPDX-License-Identifier: Apache-2.0
// Extensions of streams (co_od.h): strings, domains, and data that exist only in the extension, in partial accesses.
#include <cstring>

#include "support/block_frames.hpp"
#include "support/logged_extension.hpp"

#if USE_OD

namespace {

using namespace test;

// Objects 3000h VISIBLE_STRING of 16 bytes, 3001h OCTET_STRING of 12, 3002h UNICODE_STRING of 16 (7 characters and a
// zero), 3003h DOMAIN of 20, 3004h data of the extension of unknown length, 3005h data of the extension of 10 bytes,
// 3006h constant text.
struct Streams {
  std::uint8_t text_memory[16] = {'t', 'e', 'x', 't', 0};
  CO_OBJ_STR_RW text{0, 4, 16, text_memory};
  std::uint8_t octets_memory[12] = {1, 2, 3};
  CO_OBJ_STR_RW octets{0, 3, 12, octets_memory};
  std::uint16_t unicode_memory[8] = {0x0041, 0x0100, 0x20AC, 0};
  CO_OBJ_STR_RW unicode{0, 6, 16, reinterpret_cast<std::uint8_t*>(unicode_memory)};
  Bytes domain_memory = counting(20);
  CO_OBJ_DOM domain{0, 20, domain_memory.data()};
  CO_OBJ_STR constant{0, reinterpret_cast<const std::uint8_t*>("constant")};

  Setup setup() {
    return Setup()
        .only_small()
        .with({CO_KEY(0x3000, 0, CO_OBJ_____RW), OD_TVISIBLE_STRING, CO_DATA(&text)})
        .with({CO_KEY(0x3001, 0, CO_OBJ_____RW), OD_TOCTET_STRING, CO_DATA(&octets)})
        .with({CO_KEY(0x3002, 0, CO_OBJ_____RW), OD_TUNICODE_STRING, CO_DATA(&unicode)})
        .with({CO_KEY(0x3003, 0, CO_OBJ_____RW), OD_TDOMAIN, CO_DATA(&domain)})
        .with({CO_KEY(0x3004, 0, CO_OBJ_____RW), OD_TSTREAM, CO_DATA(0)})
        .with({CO_KEY(0x3005, 0, CO_OBJ_____RW), OD_TSTREAM, CO_DATA(10)})
        .with({CO_KEY(0x3006, 0, CO_OBJ_____R_), OD_TSTRING, CO_DATA(&constant)});
  }
};

struct Node : Streams, Fixture {
  LoggedExtension extension;
  Node() : Fixture(setup()) {}
  explicit Node(std::uint16_t index, Bytes data = {}) : Fixture(setup()) {
    extension.put_at(*this, index);
    extension.data = std::move(data);
  }
};

Bytes bytes_of(const char* text) { return {text, text + std::strlen(text)}; }

Bytes with_zeros(Bytes data, std::size_t zeros) {
  data.insert(data.end(), zeros, std::uint8_t{0});
  return data;
}

bool has_block() { return USE_SDO_BLOCK != 0; }

// Without an extension ----------------------------------------------------------------------------------------------

TEST_CASE("OD extension, stream: without an extension the original types are used") {
  Node node;
  CHECK(node.upload(0x3000, 0) == bytes_of("text"));
  CHECK(node.upload(0x3001, 0) == Bytes{1, 2, 3});
  CHECK(node.upload(0x3002, 0) == Bytes{0x41, 0, 0, 1, 0xAC, 0x20});
  CHECK(node.upload(0x3003, 0) == counting(20));
  CHECK(node.upload(0x3006, 0) == bytes_of("constant"));
  CHECK(node.download(0x3000, 0, bytes_of("a longer one")) == 0);
  CHECK(node.upload(0x3000, 0) == bytes_of("a longer one"));
  CHECK(node.download(0x3003, 0, counting(20, 100)) == 0);
  CHECK(node.domain_memory == counting(20, 100));
  if (has_block()) {
    CHECK(node.block_upload(0x3003, 0).data == counting(20, 100));
    CHECK(node.block_download(0x3001, 0, counting(12)).abort == 0);
    CHECK(node.upload(0x3001, 0) == counting(12));
  }
}

TEST_CASE("OD extension, stream: without an extension an access of the application does not move an SDO transfer") {
  Node node;
  node.ask("601#4003300000000000", "581#4103300014000000");
  std::uint8_t other[20] = {};
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.call([&] { CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x3003, 0), other, 3) == CO_ERR_NONE); });
  node.ask("601#7000000000000000", "581#1008090A0B0C0D0E");
  node.call([&] { CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x3003, 0), other, 20) == CO_ERR_NONE); });
  CHECK(Bytes(other, other + 20) == counting(20));
  node.ask("601#6000000000000000", "581#030F101112131400");
}

// Uploads -----------------------------------------------------------------------------------------------------------

TEST_CASE("OD extension, stream: an upload of unknown length announces none and reads until the function ends") {
  Node node(0x3004, counting(9));
  node.ask("601#4004300000000000", "581#4004300000000000");
  CHECK(node.extension.take_log().empty());
  node.ask("601#6000000000000000", "581#0001020304050607");
  CHECK(node.extension.take_log() == Log{"read 7 at 0 of 0"});
  node.ask("601#7000000000000000", "581#1B08090000000000");
  CHECK(node.extension.take_log() == Log{"read 7 at 7 of 0"});
}

TEST_CASE("OD extension, stream: an upload of known length announces its length and has it") {
  Node node(0x3005, counting(10));
  node.ask("601#4005300000000000", "581#410530000A000000");
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.ask("601#7000000000000000", "581#1908090A00000000");
  CHECK(node.extension.take_log() == Log{"read 7 at 0 of 10", "read 3 at 7 of 10"});
  Node domain(0x3003, counting(20, 50));
  domain.ask("601#4003300000000000", "581#4103300014000000");
  domain.rx("601#8003300000000008");
  CHECK(domain.upload(0x3003, 0) == counting(20, 50));
  CHECK(domain.domain_memory == counting(20));
}

TEST_CASE("OD extension, stream: a function that returns another length than announced is 0604 0047h or 0607 0012h") {
  Node shorter(0x3005, counting(9));
  shorter.ask("601#4005300000000000", "581#410530000A000000");
  shorter.ask("601#6000000000000000", "581#0001020304050607");
  shorter.ask("601#7000000000000000", "581#8005300047000406");
  Node longer(0x3005, counting(11));
  longer.ask("601#4005300000000000", "581#410530000A000000");
  longer.ask("601#6000000000000000", "581#0001020304050607");
  longer.ask("601#7000000000000000", "581#8005300012000706");
}

TEST_CASE("OD extension, stream: uploads of unknown length work for any length, in segments and blocks") {
  for (const std::uint32_t size : {0U, 1U, 6U, 7U, 8U, 13U, 14U, 15U, 888U, 889U, 890U, 1777U, 1778U, 1779U}) {
    CAPTURE(size);
    Node node(0x3004, counting(size));
    CHECK(node.upload(0x3004, 0) == counting(size));
    if (has_block()) {
      CHECK(node.block_upload(0x3004, 0).data == counting(size));
    }
    std::uint8_t buffer[2000];
    node.call([&] {
      CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x3004, 0), buffer, sizeof buffer) == CO_ERR_NONE);
      CHECK(COObjGetSize(node.find(0x3004, 0), &node.node, 0) == size);
    });
    CHECK(Bytes(buffer, buffer + size) == counting(size));
  }
}

TEST_CASE(
    "OD extension, stream: a function that returns fewer bytes than requested is called again until all are read") {
  for (const std::uint32_t at_once : {1U, 2U, 3U, 5U, 6U}) {
    CAPTURE(at_once);
    Node node(0x3004, counting(30));
    node.extension.at_once = at_once;
    CHECK(node.upload(0x3004, 0) == counting(30));
    if (has_block()) {
      CHECK(node.block_upload(0x3004, 0).data == counting(30));
    }
  }
}

TEST_CASE("OD extension, stream: a length that the function sets in the first call is kept for the transfer") {
  Node node(0x3004, counting(20));
  std::vector<OD_size_t> seen;
  node.extension.on_read = [&](OD_stream_t* stream) {
    seen.push_back(stream->dataLength);
    stream->dataLength = 20;
    return ODR_OK;
  };
  CHECK(node.upload(0x3004, 0) == counting(20));
  CHECK(seen == std::vector<OD_size_t>{0, 20, 20});
}

TEST_CASE("OD extension, stream: an error in any call aborts the transfer with its code") {
  for (unsigned good = 0; good < 3; ++good) {
    CAPTURE(good);
    Node node(0x3004, counting(20));
    unsigned calls = 0;
    node.extension.on_read = [&](OD_stream_t*) { return calls++ < good ? ODR_OK : ODR_HW; };
    node.ask("601#4004300000000000", "581#4004300000000000");
    if (good > 0) {
      node.ask("601#6000000000000000", "581#0001020304050607");
    }
    if (good > 1) {
      node.ask("601#7000000000000000", "581#1008090A0B0C0D0E");
    }
    node.ask(good == 1 ? "601#7000000000000000" : "601#6000000000000000", "581#8004300000000606");
    CHECK(node.error() == CO_ERR_SDO_READ);
  }
}

TEST_CASE("OD extension, stream: an aborted transfer does not change the position of the next one") {
  Node node(0x3004, counting(20));
  for (const char* end : {"601#8004300000000008", "601#4000100000000000", "601#4004300000000000"}) {
    node.ask("601#4004300000000000", "581#4004300000000000");
    node.ask("601#6000000000000000", "581#0001020304050607");
    node.rx(end);
    node.frames();
    node.rx("601#8004300000000008");
    CHECK(node.upload(0x3004, 0) == counting(20));
  }
  node.ask("601#4004300000000000", "581#4004300000000000");
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.after(node.sdo_time_out());
  node.tx("581#8004300000000405");
  CHECK(node.upload(0x3004, 0) == counting(20));
}

// Texts -------------------------------------------------------------------------------------------------------------

TEST_CASE("OD extension, stream: a text ends at its first zero; later bytes of the function are not sent") {
  struct {
    Bytes data, shown;
  } const table[] = {{bytes_of("abc"), bytes_of("abc")},
                     {with_zeros(bytes_of("abc"), 13), bytes_of("abc")},
                     {{'a', 0, 'b', 'c'}, {'a'}},
                     {{0}, {0}},
                     {{0, 'x', 'y'}, {0}},
                     {with_zeros({}, 16), {0}},
                     {{}, {}},
                     {bytes_of("seventh"), bytes_of("seventh")},
                     {with_zeros(bytes_of("seventh"), 1), bytes_of("seventh")},
                     {with_zeros(bytes_of("sevenths"), 8), bytes_of("sevenths")},
                     {bytes_of("sixteen letters!"), bytes_of("sixteen letters!")}};
  for (const auto& row : table) {
    Node node(0x3000, row.data);
    CHECK(node.upload(0x3000, 0) == row.shown);
    if (has_block()) {
      CHECK(node.block_upload(0x3000, 0).data == row.shown);
    }
  }
}

Bytes utf16(std::initializer_list<std::uint16_t> characters) {
  Bytes data;
  for (const std::uint16_t character : characters) {
    data.push_back(static_cast<std::uint8_t>(character));
    data.push_back(static_cast<std::uint8_t>(character >> 8));
  }
  return data;
}

TEST_CASE("OD extension, stream: a UNICODE_STRING ends at a zero character in any piece [301:7.1.6.4]") {
  struct {
    Bytes data, shown;
  } const table[] = {
      {utf16({'a', 'b', 'c'}), utf16({'a', 'b', 'c'})},
      {utf16({'a', 'b', 'c', 0, 'd'}), utf16({'a', 'b', 'c'})},  // the zero is split between two segments
      {utf16({'a', 'b', 'c', 0x0100, 'd'}), utf16({'a', 'b', 'c', 0x0100, 'd'})},
      {utf16({'a', 'b', 'c', 'd', 0x0100, 'e', 0}), utf16({'a', 'b', 'c', 'd', 0x0100, 'e'})},
      {utf16({0x0100, 0x0001, 0x0100, 0x0001, 0x0100, 0}), utf16({0x0100, 0x0001, 0x0100, 0x0001, 0x0100})},
      {utf16({'a', 'b', 'c', 'd', 'e', 'f', 'g', 0}), utf16({'a', 'b', 'c', 'd', 'e', 'f', 'g'})},
      {utf16({'a', 'b', 'c', 'd', 'e', 'f', 'g', 'h'}), utf16({'a', 'b', 'c', 'd', 'e', 'f', 'g', 'h'})},
      {utf16({0, 'x'}), utf16({0})},
      {{'a', 0, 'b'}, {'a', 0, 'b'}},
      {{}, {}}};
  for (const auto& row : table) {
    for (const std::uint32_t at_once : {1U, 3U, 1000U}) {
      Node node(0x3002, row.data);
      node.extension.at_once = at_once;
      CHECK(node.upload(0x3002, 0) == row.shown);
      if (has_block()) {
        CHECK(node.block_upload(0x3002, 0).data == row.shown);
      }
      Bytes single;
      node.call([&] {
        CO_OBJ* const obj = node.find(0x3002, 0);
        std::uint8_t byte = 0;
        CHECK(COObjReset(obj, &node.node, 0) == CO_ERR_NONE);
        while (COObjGetSize(obj, &node.node, 0) == CO_OBJ_SIZE_UNKNOWN) {
          CHECK(COObjRdBufCont(obj, &node.node, &byte, 1) == CO_ERR_NONE);
          const OutsideStack outside;
          single.push_back(byte);
        }
        single.resize(COObjGetSize(obj, &node.node, 0));
      });
      CHECK(single == row.shown);
    }
  }
}

TEST_CASE("OD extension, stream: an extension may wrap the original function of a text") {
  Node node;
  OD_extension_t loud{nullptr, nullptr, OD_writeOriginal, {}};
  loud.read = [](OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* passed) {
    const ODR_t result = OD_readOriginal(stream, buf, count, passed);
    auto* const letters = static_cast<std::uint8_t*>(buf);
    for (OD_size_t n = 0; n < *passed; ++n) {
      letters[n] = static_cast<std::uint8_t>(letters[n] >= 'a' ? letters[n] - 32 : letters[n]);
    }
    return result;
  };
  node.call([&] {
    for (const int index : {0x3000, 0x3001, 0x3002, 0x3003, 0x3006}) {
      CHECK(OD_extension_init(OD_find(&node.od, static_cast<std::uint16_t>(index)), &loud) == ODR_OK);
    }
  });
  CHECK(node.upload(0x3000, 0) == bytes_of("TEXT"));
  CHECK(node.upload(0x3006, 0) == bytes_of("CONSTANT"));
  CHECK(node.upload(0x3001, 0) == Bytes{1, 2, 3});
  CHECK(node.upload(0x3002, 0) == utf16({0x41, 0x100, 0x208C}));
  CHECK(node.upload(0x3003, 0) == counting(20));
  for (const char* text : {"", "x", "longer than it", "sixteen letters!"}) {
    CHECK(node.download(0x3000, 0, bytes_of(text)) == 0);
    CHECK(node.text.Size == std::strlen(text));
    CHECK(std::memcmp(node.text_memory, text, std::strlen(text)) == 0);
  }
  CHECK(node.download(0x3002, 0, utf16({'a', 'b'})) == 0);
  CHECK(node.unicode.Size == 4);
  CHECK(node.download(0x3001, 0, counting(5)) == 0);
  CHECK(node.octets.Size == 5);
}

TEST_CASE("OD extension, stream: an extension with both original functions behaves like no extension") {
  Node node;
  OD_extension_t same{nullptr, OD_readOriginal, OD_writeOriginal, {}};
  node.call([&] {
    for (const int index : {0x3000, 0x3001, 0x3002, 0x3003, 0x3006}) {
      CHECK(OD_extension_init(OD_find(&node.od, static_cast<std::uint16_t>(index)), &same) == ODR_OK);
    }
  });
  node.ask("601#4000300000000000", "581#4300300074657874");
  node.ask("601#4006300000000000", "581#4106300008000000");
  node.rx("601#8006300000000008");
  node.ask("601#2F00300061000000", "581#6000300000000000");
  CHECK(node.text.Size == 1);
  CHECK(node.text_memory[1] == 0);
  for (const Bytes& data : {Bytes{}, counting(1), counting(4), counting(5), counting(11), counting(12)}) {
    CHECK(node.download(0x3001, 0, data) == 0);
    CHECK(node.upload(0x3001, 0) == data);
  }
  CHECK(node.download(0x3001, 0, counting(13)) == 0x06070012);
  CHECK(node.upload(0x3002, 0) == utf16({0x41, 0x100, 0x20AC}));
  CHECK(node.upload(0x3003, 0) == counting(20));
}

// Downloads ---------------------------------------------------------------------------------------------------------

TEST_CASE("OD extension, stream: an expedited download is passed in one call with its length") {
  Node node(0x3004);
  node.ask("601#2B04300011220000", "581#6004300000000000");
  CHECK(node.extension.take_log() == Log{"write 2 at 0 of 2"});
  CHECK(node.extension.data == Bytes{0x11, 0x22});
}

TEST_CASE(
    "OD extension, stream: a segmented download passes its length with the last piece, whether announced or not") {
  for (const bool announced : {true, false}) {
    Node node(0x3004);
    node.ask(announced ? "601#2104300009000000" : "601#2004300000000000", "581#6004300000000000");
    CHECK(node.extension.take_log().empty());
    node.ask("601#0001020304050607", "581#2000000000000000");
    CHECK(node.extension.take_log() == Log{"write 7 at 0 of 0"});
    node.ask("601#1B08090000000000", "581#3000000000000000");
    CHECK(node.extension.take_log() == Log{"write 2 at 7 of 9"});
    CHECK(node.extension.data == counting(9));
  }
}

TEST_CASE("OD extension, stream: downloads of any length work in segments and blocks, whether announced or not") {
  for (const std::uint32_t size : {0U, 1U, 4U, 6U, 7U, 8U, 14U, 15U, 888U, 889U, 890U, 1778U, 1779U}) {
    for (const bool announced : {true, false}) {
      CAPTURE(size);
      CAPTURE(announced);
      Node node(0x3004, Bytes{0xEE});
      CHECK(node.download(0x3004, 0, counting(size), announced) == 0);
      CHECK(node.extension.data == counting(size));
      if (has_block()) {
        BlockOptions options;
        options.sized = announced;
        CHECK(node.block_download(0x3004, 0, counting(size, 9), options).abort == 0);
        CHECK(node.extension.data == counting(size, 9));
      }
    }
  }
}

TEST_CASE("OD extension, stream: an empty last segment ends a download of any length, also 0 [301:7.2.4.3.4]") {
  Node node(0x3004, Bytes{0xEE});
  node.ask("601#2004300000000000", "581#6004300000000000");
  node.ask("601#0F00000000000000", "581#2000000000000000");
  CHECK(node.extension.take_log() == Log{"write 0 at 0 of 0"});
  CHECK(node.extension.data.empty());
  node.ask("601#2004300000000000", "581#6004300000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  CHECK(node.extension.take_log() == Log{"write 7 at 0 of 0"});
  node.ask("601#1F00000000000000", "581#3000000000000000");
  CHECK(node.extension.take_log() == Log{"write 0 at 7 of 7"});
  CHECK(node.extension.data == counting(7));
}

TEST_CASE("OD extension, stream: an extension that refuses the last piece aborts the download") {
  Node node(0x3004, Bytes{0xEE});
  node.extension.on_write = [](OD_stream_t* stream) { return stream->dataLength != 0 ? ODR_INVALID_VALUE : ODR_OK; };
  node.ask("601#2004300000000000", "581#6004300000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#1F00000000000000", "581#8004300030000906");
  node.ask("601#2004300000000000", "581#6004300000000000");
  node.ask("601#0D01000000000000", "581#8004300030000906");
  node.ask("601#2304300001020304", "581#8004300030000906");
  CHECK(node.extension.data == Bytes{0xEE});
}

TEST_CASE(
    "OD extension, stream: for a download that is too long or too short the function does not get the last piece") {
  Node node(0x3005, counting(10));
  node.ask("601#2105300009000000", "581#8005300013000706");
  node.ask("601#210530000B000000", "581#8005300012000706");
  node.ask("601#2305300001020304", "581#8005300013000706");
  CHECK(node.extension.take_log().empty());
  node.ask("601#2005300000000000", "581#6005300000000000");
  node.ask("601#00A1A2A3A4A5A6A7", "581#2000000000000000");
  node.ask("601#1BA8A90000000000", "581#8005300013000706");
  CHECK(node.extension.take_log() == Log{"write 7 at 0 of 10"});
  node.ask("601#2005300000000000", "581#6005300000000000");
  node.ask("601#00A1A2A3A4A5A6A7", "581#2000000000000000");
  node.ask("601#17A8A9AAAB000000", "581#8005300012000706");
  CHECK(node.extension.take_log() == Log{"write 7 at 0 of 10"});
  node.ask("601#210530000A000000", "581#6005300000000000");
  node.ask("601#00A1A2A3A4A5A6A7", "581#2000000000000000");
  node.ask("601#1BA8A90000000000", "581#8005300013000706");
  CHECK(node.extension.take_log() == Log{"write 7 at 0 of 10", "write 2 at 7 of 10"});
  CHECK(node.extension.data == counting(10));
  CHECK(node.download(0x3005, 0, counting(10, 50)) == 0);
  CHECK(node.extension.data == counting(10, 50));
  if (has_block()) {
    node.extension.take_log();
    BlockOptions options;
    options.sized = false;
    CHECK(node.block_download(0x3005, 0, counting(9), options).abort == 0x06070013);
    CHECK(node.block_download(0x3005, 0, counting(11), options).abort == 0x06070012);
    CHECK(node.extension.take_log().empty());
  }
}

TEST_CASE("OD extension, stream: a function that ends too early is 0607 0012h; one that requires more is 0607 0013h") {
  Node node;
  static OD_size_t wants = 0;
  static OD_size_t has = 0;
  OD_extension_t own{nullptr, nullptr, nullptr, {}};
  own.write = [](OD_stream_t* stream, const void*, OD_size_t count, OD_size_t* passed) {
    has = stream->dataOffset + count;
    stream->dataOffset = has >= wants ? 0 : has;
    *passed = count;
    return has >= wants ? ODR_OK : ODR_PARTIAL;
  };
  node.call([&] { CHECK(OD_extension_init(OD_find(&node.od, 0x3004), &own) == ODR_OK); });
  wants = 7;
  node.ask("601#2004300000000000", "581#6004300000000000");
  node.ask("601#0001020304050607", "581#8004300012000706");
  wants = 10;
  CHECK(node.download(0x3004, 0, counting(9)) == 0x06070013);
  CHECK(node.download(0x3004, 0, counting(10)) == 0);
  CHECK(node.download(0x3004, 0, counting(20)) == 0x06070012);
  wants = 3;
  node.ask("601#2304300001020304", "581#6004300000000000");
  node.ask("601#2B04300001020000", "581#8004300013000706");
}

TEST_CASE("OD extension, stream: a text shorter than its capacity is passed with its zero") {
  for (unsigned size = 0; size <= 16; ++size) {
    CAPTURE(size);
    Node node(0x3000);
    const Bytes text = counting(size, 'a');
    const Bytes expected = with_zeros(text, size < 16 ? 1 : 0);
    for (const bool announced : {true, false}) {
      CHECK(node.download(0x3000, 0, text, announced) == 0);
      CHECK(node.extension.data == expected);
      node.extension.data.clear();
    }
    if (has_block()) {
      CHECK(node.block_download(0x3000, 0, text).abort == 0);
      CHECK(node.extension.data == expected);
    }
    CHECK(node.upload(0x3000, 0) == (size == 0 ? Bytes{0} : text));
  }
  Node node(0x3000);
  CHECK(node.download(0x3000, 0, counting(17)) == 0x06070012);
  CHECK(node.extension.take_log().empty());
}

// Returns all data in one call with ODR_PARTIAL, and ODR_OK without data in the next call.
ODR_t read_with_late_end(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* passed) {
  const OutsideStack outside;
  const auto& self = *static_cast<LoggedExtension*>(stream->object);
  const auto left = static_cast<OD_size_t>(self.data.size()) - stream->dataOffset;
  *passed = std::min(left, count);
  std::copy_n(self.data.data() + stream->dataOffset, *passed, static_cast<std::uint8_t*>(buf));
  stream->dataOffset += *passed;
  return *passed == 0 ? ODR_OK : ODR_PARTIAL;
}

TEST_CASE("OD extension, stream: a UNICODE_STRING with half a character at its end gets no uninitialised byte") {
  for (const bool late : {false, true}) {
    CAPTURE(late);
    Node node(0x3002, {0x41, 0x00, 0x42, 0x00, 0x43, 0x00, 0x44});
    if (late) {
      node.extension.extension.read = read_with_late_end;
    }
    CHECK(node.upload(0x3002, 0) == node.extension.data);
  }
}

TEST_CASE("OD extension, stream: a short UNICODE_STRING is passed with a zero character of two bytes") {
  for (unsigned size = 0; size <= 16; size += 2) {
    CAPTURE(size);
    Node node(0x3002);
    const Bytes text = counting(size, 'a');
    CHECK(node.download(0x3002, 0, text) == 0);
    CHECK(node.extension.data == with_zeros(text, size < 16 ? 2 : 0));
  }
}

TEST_CASE("OD extension, stream: shorter OCTET_STRINGs and domains are passed without terminator") {
  Node octets(0x3001);
  CHECK(octets.download(0x3001, 0, counting(5)) == 0);
  CHECK(octets.extension.data == counting(5));
  CHECK(octets.upload(0x3001, 0) == counting(5));
  octets.ask("601#2F01300077000000", "581#6001300000000000");
  CHECK(octets.extension.data == Bytes{0x77});
  Node domain(0x3003);
  CHECK(domain.download(0x3003, 0, counting(9)) == 0);
  CHECK(domain.extension.data == counting(9));
}

// The application ---------------------------------------------------------------------------------------------------

TEST_CASE("OD extension, stream: the application reads it in pieces by COObj functions and by OD_IO_t") {
  Node node(0x3004, counting(20));
  std::uint8_t buffer[20] = {};
  node.call([&] {
    CO_OBJ* const obj = node.find(0x3004, 0);
    CHECK(COObjRdBufStart(obj, &node.node, buffer, 6) == CO_ERR_NONE);
    CHECK(COObjRdBufCont(obj, &node.node, buffer + 6, 10) == CO_ERR_NONE);
    CHECK(COObjRdBufCont(obj, &node.node, buffer + 16, 4) == CO_ERR_NONE);
  });
  CHECK(Bytes(buffer, buffer + 20) == counting(20));
  CHECK(node.extension.take_log() == Log{"read 6 at 0 of 0", "read 10 at 6 of 0", "read 4 at 16 of 0"});
  OD_IO_t io;
  OD_size_t n = 0;
  node.call([&] {
    REQUIRE(OD_getSub(OD_find(&node.od, 0x3004), 0, &io, false) == ODR_OK);
    CHECK(io.read(&io.stream, buffer, 15, &n) == ODR_PARTIAL);
    CHECK(n == 15);
    CHECK(io.read(&io.stream, buffer, 15, &n) == ODR_OK);
    CHECK(n == 5);
  });
}

TEST_CASE("OD extension, stream: a partial write of the application sets the length where it may vary") {
  Node node(0x3000);
  std::uint8_t text[] = {'a', 'b', 'c'};
  node.call([&] { CHECK(CODictWrBuffer(&node->Dict, CO_DEV(0x3000, 0), text, 3) == CO_ERR_NONE); });
  CHECK(node.extension.take_log() == Log{"write 4 at 0 of 4"});
  CHECK(node.extension.data == Bytes{'a', 'b', 'c', 0});
  node.call([&] { CHECK(COObjWrBufCont(node.find(0x3000, 0), &node.node, text, 3) == CO_ERR_TYPE_WR); });
  Node octets(0x3001);
  octets.call([&] { CHECK(CODictWrBuffer(&octets->Dict, CO_DEV(0x3001, 0), text, 3) == CO_ERR_NONE); });
  CHECK(octets.extension.data == Bytes{'a', 'b', 'c'});
  std::uint8_t many[20] = {};
  octets.call([&] { CHECK(CODictWrBuffer(&octets->Dict, CO_DEV(0x3001, 0), many, 13) == CO_ERR_TYPE_WR); });
  CHECK(octets.extension.data == Bytes{'a', 'b', 'c'});
  Node domain(0x3003);
  domain.call([&] { CHECK(CODictWrBuffer(&domain->Dict, CO_DEV(0x3003, 0), many, 20) == CO_ERR_NONE); });
  CHECK(domain.extension.data == Bytes(20));
}

TEST_CASE("OD extension, stream: an object of fixed length may be written in pieces") {
  Node node(0x3005);
  Bytes data = counting(10);
  node.call([&] {
    CO_OBJ* const obj = node.find(0x3005, 0);
    CHECK(COObjWrBufStart(obj, &node.node, data.data(), 4) == CO_ERR_NONE);
    CHECK(COObjWrBufCont(obj, &node.node, data.data() + 4, 5) == CO_ERR_NONE);
    CHECK(node.extension.data.empty());
    CHECK(COObjWrBufCont(obj, &node.node, data.data() + 9, 1) == CO_ERR_NONE);
    CHECK(COObjWrBufCont(obj, &node.node, data.data(), 1) == CO_ERR_TYPE_WR);
  });
  CHECK(node.extension.data == counting(10));
  CHECK(node.extension.take_log() == Log{"write 4 at 0 of 10", "write 5 at 4 of 10", "write 1 at 9 of 10"});
}

TEST_CASE("OD extension, stream: the application may set the position up to the present one, not beyond") {
  Node node(0x3004, counting(100));
  std::uint8_t buffer[100] = {};
  node.call([&] {
    CO_OBJ* const obj = node.find(0x3004, 0);
    CHECK(COObjReset(obj, &node.node, 1) != CO_ERR_NONE);
    CHECK(COObjRdBufStart(obj, &node.node, buffer, 90) == CO_ERR_NONE);
    CHECK(COObjReset(obj, &node.node, 91) == CO_ERR_TYPE_RESET);
    CHECK(COObjReset(obj, &node.node, 90) == CO_ERR_NONE);
    CHECK(COObjReset(obj, &node.node, 70) == CO_ERR_NONE);
    CHECK(COObjRdBufCont(obj, &node.node, buffer, 5) == CO_ERR_NONE);
  });
  CHECK(Bytes(buffer, buffer + 5) == counting(5, 71));
}

TEST_CASE("OD extension, stream: a continued access without a begin is refused") {
  Node node(0x3004, counting(20));
  node.extension.put_at(node, 0x3005);
  std::uint8_t buffer[20] = {};
  node.call([&] {
    CO_OBJ* const one = node.find(0x3004, 0);
    CO_OBJ* const other = node.find(0x3005, 0);
    CHECK(COObjRdBufCont(one, &node.node, buffer, 5) == CO_ERR_OBJ_STATE);
    CHECK(COObjRdBufStart(one, &node.node, buffer, 5) == CO_ERR_NONE);
    CHECK(COObjWrBufCont(other, &node.node, buffer, 5) == CO_ERR_OBJ_STATE);
    CHECK(COObjRdBufCont(one, &node.node, buffer, 5) == CO_ERR_NONE);
    CHECK(buffer[0] == 6);
    CHECK(COObjRdBufStart(other, &node.node, buffer, 5) == CO_ERR_NONE);
    CHECK(COObjRdBufCont(one, &node.node, buffer, 5) == CO_ERR_OBJ_STATE);
  });
}

TEST_CASE("OD extension, stream: a length found by the application does not change the length of SDO transfers") {
  Node node(0x3000, bytes_of("short"));
  std::uint8_t buffer[20] = {};
  node.call([&] { CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x3000, 0), buffer, 20) == CO_ERR_NONE); });
  node.extension.data = bytes_of("a longer text");
  CHECK(node.upload(0x3000, 0) == bytes_of("a longer text"));
  node.call([&] { CHECK(COObjGetSize(node.find(0x3000, 0), &node.node, 0) == 5); });
  node.call([&] { CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x3000, 0), buffer, 20) == CO_ERR_NONE); });
  node.call([&] { CHECK(COObjGetSize(node.find(0x3000, 0), &node.node, 0) == 13); });
}

// Types of the application with Begin and End ------------------------------------------------------------------------

struct Image {
  Log log;
  Bytes data;
  std::uint32_t position = 0;
  CO_ERR end = CO_ERR_NONE;
} image;

void note(const char* what, std::uint32_t number) {
  const OutsideStack outside;
  image.log.push_back(std::string(what) + " " + std::to_string(number));
}

uint32_t image_size(CO_OBJ*, CO_NODE*, uint32_t width) {
  return width != 0 ? width : static_cast<uint32_t>(image.data.size());
}
CO_ERR image_read(CO_OBJ*, CO_NODE*, void* buffer, uint32_t size) {
  note("read", size);
  std::copy_n(image.data.data() + image.position, size, static_cast<uint8_t*>(buffer));
  image.position += size;
  return CO_ERR_NONE;
}
CO_ERR image_write(CO_OBJ*, CO_NODE*, void* buffer, uint32_t size) {
  note("write", size);
  const OutsideStack outside;
  const auto* const bytes = static_cast<const uint8_t*>(buffer);
  image.data.resize(image.position);
  image.data.insert(image.data.end(), bytes, bytes + size);
  image.position += size;
  return CO_ERR_NONE;
}
CO_ERR image_seek(CO_OBJ*, CO_NODE*, uint32_t position) {
  image.position = position;
  return CO_ERR_NONE;
}
CO_ERR image_begin(CO_OBJ*, CO_NODE*, CO_OBJ_TRANSFER, uint32_t) {
  note("begin", 0);
  return CO_ERR_NONE;
}
CO_ERR image_end(CO_OBJ*, CO_NODE*, CO_OBJ_TRANSFER, uint32_t abort) {
  note("end", abort);
  return image.end;
}
const CO_OBJ_TYPE_EX image_type = {
    {image_size, nullptr, image_read, image_write, COObjTypeExReset}, image_seek, image_begin, image_end};
const OD_TYPE image_extensible = OD_STREAM(&image_type.Type, OD_ORIGINAL);

struct ImageNode : Fixture {
  ImageNode()
      : Fixture(Setup().only_small().with({CO_KEY(0x3000, 0, CO_OBJ_____RW), &image_extensible.Ex.Type, CO_DATA(1)})) {
    image = Image{};
  }
};

TEST_CASE("OD extension, stream: an application-defined type gets the whole transfer, whether extended or not") {
  ImageNode node;
  image.data = counting(9);
  CHECK(node.upload(0x3000, 0) == counting(9));
  CHECK(image.log == Log{"begin 0", "read 0", "read 7", "read 2", "end 0"});
  image.log.clear();
  CHECK(node.download(0x3000, 0, counting(10, 3)) == 0);
  CHECK(image.log == Log{"begin 0", "write 0", "write 7", "write 3", "end 0"});
  CHECK(image.data == counting(10, 3));
  LoggedExtension extension;
  extension.put_at(node, 0x3000);
  image.log.clear();
  CHECK(node.download(0x3000, 0, counting(10, 7)) == 0);
  CHECK(image.log == Log{"begin 0", "end 0"});
  CHECK(extension.data == counting(10, 7));
  CHECK(image.data == counting(10, 3));
}

TEST_CASE("OD extension, stream: the extension may call the original functions of an application-defined type") {
  ImageNode node;
  OD_extension_t counted{nullptr, nullptr, nullptr, {}};
  static unsigned calls = 0;
  calls = 0;
  counted.read = [](OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* passed) {
    ++calls;
    return OD_readOriginal(stream, buf, count, passed);
  };
  counted.write = [](OD_stream_t* stream, const void* buf, OD_size_t count, OD_size_t* passed) {
    ++calls;
    return OD_writeOriginal(stream, buf, count, passed);
  };
  node.call([&] { CHECK(OD_extension_init(OD_find(&node.od, 0x3000), &counted) == ODR_OK); });
  CHECK(node.download(0x3000, 0, counting(20)) == 0);
  CHECK(image.data == counting(20));
  CHECK(calls == 3);
  CHECK(node.upload(0x3000, 0) == counting(20));
  CHECK(calls == 6);
  image.end = CO_ERR_OBJ_STATE;
  CHECK(node.download(0x3000, 0, counting(20)) == 0x08000022);
}

TEST_CASE(
    "OD extension, stream: an empty download through the original functions empties an application-defined type") {
  ImageNode node;
  OD_extension_t original{nullptr, OD_readOriginal, OD_writeOriginal, {}};
  node.call([&] { CHECK(OD_extension_init(OD_find(&node.od, 0x3000), &original) == ODR_OK); });
  for (const bool announced : {true, false}) {
    image.data = counting(9);
    CHECK(node.download(0x3000, 0, {}, announced) == 0);
    CHECK(image.data.empty());
  }
}

TEST_CASE(
    "OD extension, stream: a last piece that the extension refuses calls End of the original type with an abort") {
  ImageNode node;
  LoggedExtension extension;
  extension.put_at(node, 0x3000);
  extension.on_write = [](OD_stream_t* stream) { return stream->dataLength == 7 ? ODR_HW : ODR_OK; };
  node.ask("601#2000300000000000", "581#6000300000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#1F00000000000000", "581#8000300000000606");
  CHECK(image.log == Log{"begin 0", "end " + std::to_string(0x06060000)});
}

}  // namespace

#endif
