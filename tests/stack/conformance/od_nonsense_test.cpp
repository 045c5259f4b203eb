// SPDX-License-Identifier: Apache-2.0
// Extensions and SDO clients that violate the contract of co_od.h and the protocol: the node does not hang, returns no
// bytes that were not read, and serves later requests.
#include <cstring>

#include "support/block_frames.hpp"
#include "support/logged_extension.hpp"
#include "support/stride.hpp"

#if USE_OD

namespace {

using namespace test;

// A node with 3000h UNSIGNED32, 3001h of unknown length, 3002h VISIBLE_STRING of 30 bytes, 3003h of 20 bytes, 3004h
// UNICODE_STRING of 30 bytes, 3005h OCTET_STRING of 30 bytes.
struct Node : Fixture {
  std::uint32_t word = 0;
  std::uint8_t memory[3][30] = {};
  CO_OBJ_STR_RW strings[3] = {{0, 0, 30, memory[0]}, {0, 0, 30, memory[1]}, {0, 0, 30, memory[2]}};

  Node()
      : Fixture(Setup()
                    .only_small()
                    .with({CO_KEY(0x3000, 0, CO_OBJ_____RW), OD_TUNSIGNED32, CO_DATA(&word)})
                    .with({CO_KEY(0x3001, 0, CO_OBJ_____RW), OD_TSTREAM, CO_DATA(0)})
                    .with({CO_KEY(0x3002, 0, CO_OBJ_____RW), OD_TVISIBLE_STRING, CO_DATA(&strings[0])})
                    .with({CO_KEY(0x3003, 0, CO_OBJ_____RW), OD_TSTREAM, CO_DATA(20)})
                    .with({CO_KEY(0x3004, 0, CO_OBJ_____RW), OD_TUNICODE_STRING, CO_DATA(&strings[1])})
                    .with({CO_KEY(0x3005, 0, CO_OBJ_____RW), OD_TOCTET_STRING, CO_DATA(&strings[2])})) {}

  void extend(OD_extension_t& extension) {
    for (std::uint16_t index = 0x3000; index <= 0x3005; ++index) {
      call([&] { CHECK(OD_extension_init(OD_find(&od, index), &extension) == ODR_OK); });
    }
  }
};

// Results of a function that may be invalid.
struct Nonsense {
  int result;
  std::int64_t more;
  std::uint32_t offset;  // dataOffset after the call
  std::uint32_t length;
};

ODR_t answer(const Nonsense& nonsense, OD_stream_t* stream, OD_size_t count, OD_size_t* passed) {
  *passed = static_cast<OD_size_t>(nonsense.more + count);
  stream->dataOffset = nonsense.offset;
  stream->dataLength = nonsense.length;
  return static_cast<ODR_t>(nonsense.result);
}

ODR_t read(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* passed) {
  std::memset(buf, 'x', count);
  return answer(*static_cast<const Nonsense*>(stream->object), stream, count, passed);
}
ODR_t write(OD_stream_t* stream, const void*, OD_size_t count, OD_size_t* passed) {
  return answer(*static_cast<const Nonsense*>(stream->object), stream, count, passed);
}

std::vector<Nonsense> all_nonsense() {
  std::vector<Nonsense> all;
  for (const int result : std::initializer_list<int>{-1, 0, -2, 1, 25, 26, 99, INT32_MAX, INT32_MIN}) {
    for (const std::int64_t more : std::initializer_list<std::int64_t>{0, 1, -1, -4, 1000, UINT32_MAX}) {
      for (const std::uint32_t number : std::initializer_list<std::uint32_t>{0, 5, UINT32_MAX}) {
        all.push_back({result, more, number, number});
      }
    }
  }
  return all;
}

// Uploads an object, and aborts after 12 segments, because the extension may never report the end.
void upload(Node& node, std::uint16_t index) {
  const auto low = static_cast<std::uint8_t>(index);
  node.rx(CO_IF_FRM{0x601, {0x40, low, 0x30}, 8});
  std::vector<std::string> sent = node.frames();
  REQUIRE(sent.size() == 1);
  for (unsigned n = 0; n < 12 && sent[0].substr(4, 2) != "80"; ++n) {
    node.rx(n % 2 == 0 ? "601#6000000000000000" : "601#7000000000000000");
    sent = node.frames();
    REQUIRE(sent.size() == 1);
  }
  node.rx("601#8000000000000008");
}

TEST_CASE("OD nonsense: for any result of an extension each request is answered and the node runs") {
  for (Nonsense nonsense : all_nonsense()) {
    CAPTURE(nonsense.result);
    CAPTURE(nonsense.more);
    CAPTURE(nonsense.offset);
    Node node;
    OD_extension_t extension{&nonsense, read, write, {}};
    node.extend(extension);
    std::uint8_t bytes[30] = {};
    for (std::uint16_t index = 0x3000; index <= 0x3005; ++index) {
      upload(node, index);
      node.download(index, 0, counting(4));
      node.download(index, 0, counting(20), false);
      if (USE_SDO_BLOCK != 0) {
        node.rx(CO_IF_FRM{0x601, {0xA4, static_cast<std::uint8_t>(index), 0x30, 0, 5}, 8});
        node.frames();
        node.rx("601#A300000000000000");
        node.frames();
        node.rx("601#A200050000000000");
        node.frames();
        node.rx("601#A205050000000000");
        node.frames();
        node.rx("601#8000000000000008");
        node.block_download(index, 0, counting(20));
      }
      node.call([&] {
        CO_OBJ* const obj = node.find(index, 0);
        COObjRdBufStart(obj, &node.node, bytes, 20);
        COObjRdBufCont(obj, &node.node, bytes, 5);
        COObjReset(obj, &node.node, 3);
        COObjWrBufStart(obj, &node.node, bytes, 20);
        COObjWrBufCont(obj, &node.node, bytes, 5);
        COObjGetSize(obj, &node.node, 0);
      });
    }
    node.rx("601#8000000000000008");
    node.frames();
    node.ask("601#4000100000000000", "581#4300100091010F00");
  }
}

TEST_CASE("OD nonsense: ODR_PARTIAL with no byte or more bytes than requested is 0604 0047h") {
  for (const std::int64_t more : std::initializer_list<std::int64_t>{-7, 1, 1000}) {
    Nonsense nonsense{ODR_PARTIAL, more, 0, 0};
    Node node;
    OD_extension_t extension{&nonsense, read, write, {}};
    node.extend(extension);
    node.ask("601#4001300000000000", "581#4001300000000000");
    node.ask("601#6000000000000000", "581#8001300047000406");
  }
  Nonsense nonsense{ODR_OK, 1, 0, 0};
  Node node;
  OD_extension_t extension{&nonsense, read, write, {}};
  node.extend(extension);
  node.ask("601#4001300000000000", "581#4001300000000000");
  node.ask("601#6000000000000000", "581#8001300047000406");
}

TEST_CASE("OD nonsense: a write that reports another number of bytes is 0604 0047h") {
  for (const int result : {ODR_OK + 0, ODR_PARTIAL + 0}) {
    Nonsense nonsense{result, -1, 0, 0};
    Node node;
    OD_extension_t extension{&nonsense, read, write, {}};
    node.extend(extension);
    node.ask("601#2001300000000000", "581#6001300000000000");
    node.ask("601#0001020304050607", "581#8001300047000406");
    node.ask("601#2301300001020304", "581#8001300047000406");
  }
}

TEST_CASE("OD nonsense: bytes that an extension writes behind its reported length are not sent") {
  Node node;
  OD_extension_t extension{nullptr, nullptr, nullptr, {}};
  extension.read = [](OD_stream_t*, void* buf, OD_size_t count, OD_size_t* passed) {
    std::memset(buf, 'x', count);
    *passed = 3;
    return ODR_OK;
  };
  node.extend(extension);
  CHECK(node.upload(0x3001, 0) == Bytes{'x', 'x', 'x'});
  node.ask("601#4001300000000000", "581#4001300000000000");
  node.ask("601#6000000000000000", "581#0978787800000000");
}

// An extension that counts wrong calls: more bytes than fit, or an offset beyond the length.
struct Watched {
  unsigned calls = 0;
  unsigned faults = 0;
  OD_extension_t extension{this, read, write, {}};

  static ODR_t read(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* passed) {
    auto& self = *static_cast<Watched*>(stream->object);
    ++self.calls;
    self.faults += count == 0 || count > 889 || stream->dataOffset >= 40 ? 1U : 0U;
    const OD_size_t left = 20 - stream->dataOffset % 20;
    *passed = left < count ? left : count;
    std::memset(buf, 'a', *passed);
    stream->dataOffset = *passed == left ? 0 : stream->dataOffset + *passed;
    return *passed == left ? ODR_OK : ODR_PARTIAL;
  }
  static ODR_t write(OD_stream_t* stream, const void*, OD_size_t count, OD_size_t* passed) {
    auto& self = *static_cast<Watched*>(stream->object);
    ++self.calls;
    const bool last = stream->dataLength == stream->dataOffset + count;
    self.faults +=
        count > 891 || (stream->dataLength != 0 && stream->dataOffset + count > stream->dataLength) ? 1U : 0U;
    stream->dataOffset = last ? 0 : stream->dataOffset + count;
    *passed = count;
    return last ? ODR_OK : ODR_PARTIAL;
  }
};

TEST_CASE("OD nonsense: any command in any state of a transfer of an extended object is handled") {
  const std::vector<std::vector<const char*>> states = {
      {},
      {"601#4001300000000000"},
      {"601#4001300000000000", "601#6000000000000000"},
      {"601#4003300000000000", "601#6000000000000000"},
      {"601#2001300000000000"},
      {"601#2001300000000000", "601#0001020304050607"},
      {"601#2102300014000000", "601#0001020304050607"},
      {"601#2103300014000000", "601#0001020304050607"},
      {"601#A40130007F000000"},
      {"601#A401300002000000", "601#A300000000000000"},
      {"601#C201300014000000"},
      {"601#C001300000000000", "601#0101020304050607"},
      {"601#C201300007000000", "601#8101020304050607"},
  };
  unsigned calls = 0;
  for (const std::vector<const char*>& state : states) {
    Watched watched;
    Node node;
    node.frames_per_call(3);
    node.extend(watched.extension);
    for (unsigned command = 0; command < 256; command += stride(7)) {
      for (const std::uint8_t index : Bytes{0x00, 0x01, 0x02, 0x03, 0xFF}) {
        node.rx("601#8000000000000008");
        node.frames();
        for (const char* text : state) {
          node.rx(text);
          node.frames();
        }
        CO_IF_FRM frm{0x601, {static_cast<std::uint8_t>(command), index, 0x30, 0, 0x14, 0, 0, 0}, 8};
        node.rx(frm);
        node.frames();
        node.rx(frm);
        node.frames();
      }
    }
    node.rx("601#8000000000000008");
    node.frames();
    calls += watched.calls;
    CHECK(watched.faults == 0);
    node.ask("601#4001300000000000", "581#4001300000000000");
    node.ask("601#6000000000000000", "581#0061616161616161");
    node.rx("601#8000000000000008");
  }
  CHECK(calls > 1000 / stride(7));
}

}  // namespace

#endif
