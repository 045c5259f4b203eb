// SPDX-License-Identifier: Apache-2.0
// Extensions of values (co_od.h): accesses by SDO, PDO and the application call the functions of the extension, and
// their results determine the abort code. Streams are in od_extension_stream_test.cpp, PDOs in od_pdo_test.cpp.
#include <cstring>

#include "support/logged_extension.hpp"

#if USE_OD

namespace {

using namespace test;

// Objects 3000h:0 UNSIGNED32, 300wh:1 numbers of w = 1…8 bytes, 3010h REAL32, 3011h with flag A, 3012h with flag N,
// 3013h with flag D, 3014h a number of 3 bytes that exists only in the extension.
struct Values {
  std::uint32_t word = 0x44332211;
  std::uint8_t u8 = 0;
  std::uint16_t u16 = 0;
  std::uint32_t u24 = 0;
  std::uint32_t u32 = 0;
  std::uint64_t wide[4] = {};
  float real = 0;
  std::uint32_t watched = 0;
  std::uint32_t relative = 0;

  Setup setup() {
    return Setup()
        .only_small()
        .with({CO_KEY(0x3000, 0, CO_OBJ_____RW), OD_TUNSIGNED32, CO_DATA(&word)})
        .with({CO_KEY(0x3001, 1, CO_OBJ_____RW), OD_TUNSIGNED8, CO_DATA(&u8)})
        .with({CO_KEY(0x3002, 1, CO_OBJ_____RW), OD_TUNSIGNED16, CO_DATA(&u16)})
        .with({CO_KEY(0x3003, 1, CO_OBJ_____RW), OD_TUNSIGNED24, CO_DATA(&u24)})
        .with({CO_KEY(0x3004, 1, CO_OBJ_____RW), OD_TUNSIGNED32, CO_DATA(&u32)})
        .with({CO_KEY(0x3005, 1, CO_OBJ_____RW), OD_TUNSIGNED40, CO_DATA(&wide[0])})
        .with({CO_KEY(0x3006, 1, CO_OBJ_____RW), OD_TUNSIGNED48, CO_DATA(&wide[1])})
        .with({CO_KEY(0x3007, 1, CO_OBJ_____RW), OD_TUNSIGNED56, CO_DATA(&wide[2])})
        .with({CO_KEY(0x3008, 1, CO_OBJ_____RW), OD_TUNSIGNED64, CO_DATA(&wide[3])})
        .with({CO_KEY(0x3010, 0, CO_OBJ_____RW), OD_TREAL32, CO_DATA(&real)})
        .with({CO_KEY(0x3011, 0, CO_OBJ___A___ | CO_OBJ____PRW), OD_TUNSIGNED32, CO_DATA(&watched)})
        .with({CO_KEY(0x3012, 0, CO_OBJ__N__RW), OD_TUNSIGNED32, CO_DATA(&relative)})
        .with({CO_KEY(0x3013, 0, CO_OBJ_D___RW), OD_TUNSIGNED32, CO_DATA(0x180)})
        .with({CO_KEY(0x3014, 0, CO_OBJ_____RW), OD_TNUMBER, CO_DATA(3)});
  }
};

struct Node : Values, Fixture {
  Node() : Fixture(setup()) {}

  OD_entry_t* entry(std::uint16_t index) { return OD_find(&od, index); }
  ODR_t extend(std::uint16_t index, OD_extension_t* extension) { return OD_extension_init(entry(index), extension); }
};

std::string hex(const Bytes& data, std::size_t n) {
  std::string text;
  for (std::size_t i = 0; i < n; ++i) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02X", static_cast<unsigned>(i < data.size() ? data[i] : 0));
    text += digits;
  }
  return text;
}

// Accesses that reach the extension --------------------------------------------------------------------------------

TEST_CASE("OD extension, value: without an extension the original type is used") {
  Node node;
  node.ask("601#4000300000000000", "581#4300300011223344");
  node.ask("601#2300300001020304", "581#6000300000000000");
  CHECK(node.word == 0x04030201);
  node.ask("601#2B00300001020000", "581#8000300013000706");
  node.ask("601#2F01300155000000", "581#6001300100000000");
  CHECK(node.u8 == 0x55);
}

TEST_CASE("OD extension, value: SDO reads and writes by the functions of the extension, not the variable") {
  Node node;
  LoggedExtension extension;
  extension.put_at(node, 0x3000);
  extension.data = number_of({0xA1, 0xA2, 0xA3, 0xA4});
  node.ask("601#4000300000000000", "581#43003000A1A2A3A4");
  CHECK(extension.take_log() == Log{"read 4 at 0 of 4"});
  node.ask("601#2300300001020304", "581#6000300000000000");
  CHECK(extension.take_log() == Log{"write 4 at 0 of 4"});
  CHECK(extension.data == number_of({1, 2, 3, 4}));
  CHECK(node.word == 0x44332211);
}

TEST_CASE("OD extension, value: CODict and COObj functions, OD_get and OD_set use it; odOrig bypasses it") {
  Node node;
  LoggedExtension extension;
  extension.put_at(node, 0x3000);
  extension.data = number_of({0xA1, 0xA2, 0xA3, 0xA4});
  std::uint32_t value = 0;
  node.call([&] { CHECK(CODictRdLong(&node->Dict, CO_DEV(0x3000, 0), &value) == CO_ERR_NONE); });
  CHECK(value == 0xA4A3A2A1);
  node.call([&] { CHECK(CODictWrLong(&node->Dict, CO_DEV(0x3000, 0), 0x04030201) == CO_ERR_NONE); });
  CHECK(extension.data == number_of({1, 2, 3, 4}));
  node.call([&] { CHECK(COObjRdValue(node.find(0x3000, 0), &node.node, &value, 4) == CO_ERR_NONE); });
  CHECK(value == 0x04030201);
  node.call([&] { CHECK(OD_set_u32(node.entry(0x3000), 0, 0x0D0C0B0A, false) == ODR_OK); });
  CHECK(extension.data == number_of({0x0A, 0x0B, 0x0C, 0x0D}));
  node.call([&] { CHECK(OD_get_u32(node.entry(0x3000), 0, &value, false) == ODR_OK); });
  CHECK(value == 0x0D0C0B0A);
  CHECK(extension.take_log().size() == 5);
  node.call([&] { CHECK(OD_get_u32(node.entry(0x3000), 0, &value, true) == ODR_OK); });
  CHECK(value == 0x44332211);
  node.call([&] { CHECK(OD_set_u32(node.entry(0x3000), 0, 7, true) == ODR_OK); });
  CHECK(node.word == 7);
  CHECK(extension.take_log().empty());
}

TEST_CASE("OD extension, value: numbers of every width are passed in one call, expedited or in segments") {
  for (unsigned width = 1; width <= 8; ++width) {
    CAPTURE(width);
    Node node;
    LoggedExtension extension;
    const auto index = static_cast<std::uint16_t>(0x3000 + width);
    extension.put_at(node, index);
    const std::string length = std::to_string(width);
    Bytes data;
    for (unsigned n = 0; n < width; ++n) {
      data.push_back(static_cast<std::uint8_t>(0x11 * (n + 1)));
    }
    CHECK(node.download(index, 1, data) == 0);
    CHECK(extension.take_log() == Log{"write " + length + " at 0 of " + length});
    CHECK(extension.data == number_of(data));
    CHECK(node.upload(index, 1) == data);
    CHECK(extension.take_log() == Log{"read " + length + " at 0 of " + length});
  }
}

TEST_CASE("OD extension, value: a number by block transfer is passed in one call") {
  Node node;
  LoggedExtension extension;
  extension.put_at(node, 0x3008);
  if (USE_SDO_BLOCK != 0) {
    CHECK(node.block_download(0x3008, 1, Bytes{8, 7, 6, 5, 4, 3, 2, 1}).abort == 0);
    CHECK(extension.take_log() == Log{"write 8 at 0 of 8"});
    CHECK(node.block_upload(0x3008, 1).data == Bytes{8, 7, 6, 5, 4, 3, 2, 1});
    CHECK(extension.take_log() == Log{"read 8 at 0 of 8"});
  }
}

TEST_CASE("OD extension, value: its arguments contain the variable") {
  Node node;
  LoggedExtension extension;
  OD_stream_t seen{};
  extension.on_read = [&](OD_stream_t* stream) {
    seen = *stream;
    return ODR_OK;
  };
  extension.put_at(node, 0x3003);
  extension.data = number_of({1, 2, 3});
  node.ask("601#4003300100000000", "581#4703300101020300");
  CHECK(seen.dataOrig == &node.u24);
  CHECK(seen.object == &extension);
  CHECK(seen.dataLength == 3);
  CHECK(seen.dataOffset == 0);
  CHECK(seen.index == 0x3003);
  CHECK(seen.subIndex == 1);
  CHECK(seen.attribute == (ODA_SDO_RW | ODA_MB));
}

TEST_CASE("OD extension, value: a transfer of a wrong length is refused before it is called [301:7.2.4.3.17]") {
  Node node;
  LoggedExtension extension;
  extension.put_at(node, 0x3000);
  node.ask("601#2B00300001020000", "581#8000300013000706");
  node.ask("601#2100300005000000", "581#8000300012000706");
  node.ask("601#2000300000000000", "581#6000300000000000");
  node.ask("601#0B01020000000000", "581#8000300013000706");
  CHECK(extension.take_log().empty());
  std::uint16_t half = 0;
  node.call([&] {
    CHECK(CODictRdWord(&node->Dict, CO_DEV(0x3000, 0), &half) == CO_ERR_OBJ_SIZE);
    CHECK(COObjWrValue(node.find(0x3000, 0), &node.node, &half, 2) == CO_ERR_BAD_ARG);
    CHECK(COObjRdValue(node.find(0x3000, 0), &node.node, &half, 2) == CO_ERR_BAD_ARG);
  });
  CHECK(extension.take_log().empty());
}

// Results of the extension -------------------------------------------------------------------------------------------

// Enumerations have the smallest possible size on Arm.
constexpr int largest = sizeof(ODR_t) == 1 ? INT8_MAX : INT32_MAX;

struct Row {
  int result;
  const char* code;  // abort code in bus order
};
constexpr Row rows[] = {{1, "05000405"},  {2, "00000106"},  {3, "01000106"},  {4, "02000106"},      {5, "00000206"},
                        {6, "41000406"},  {7, "42000406"},  {8, "43000406"},  {9, "47000406"},      {10, "00000606"},
                        {11, "10000706"}, {12, "12000706"}, {13, "13000706"}, {14, "11000906"},     {15, "30000906"},
                        {16, "31000906"}, {17, "32000906"}, {18, "36000906"}, {19, "23000A06"},     {20, "00000008"},
                        {21, "20000008"}, {22, "21000008"}, {23, "22000008"}, {24, "23000008"},     {25, "24000008"},
                        {26, "47000406"}, {99, "47000406"}, {-2, "47000406"}, {largest, "47000406"}};

TEST_CASE("OD extension, value: each result except ODR_OK aborts uploads and downloads with its code") {
  for (const Row& row : rows) {
    CAPTURE(row.result);
    Node node;
    LoggedExtension extension;
    extension.put_at(node, 0x3000);
    extension.put_at(node, 0x3008);
    extension.data = number_of({1, 2, 3, 4});
    extension.answer = static_cast<ODR_t>(row.result);
    const std::string code = row.code;
    node.ask("601#4000300000000000", "581#80003000" + code);
    node.ask("601#2300300001020304", "581#80003000" + code);
    CHECK(node.error() == (code == "00000606" ? CO_ERR_SDO_WRITE : CO_ERR_NONE));
    node.ask("601#4008300100000000", "581#80083001" + code);
    node.ask("601#2108300108000000", "581#6008300100000000");
    node.ask("601#0001020304050607", "581#2000000000000000");
    node.ask("601#1D08000000000000", "581#80083001" + code);
    CHECK(extension.data == number_of({1, 2, 3, 4}));
    extension.answer = ODR_OK;
    node.ask("601#4000300000000000", "581#4300300001020304");
  }
}

TEST_CASE("OD extension, value: ODR_PARTIAL for a number is 0604 0047h in uploads and 0607 0013h in downloads") {
  Node node;
  LoggedExtension extension;
  extension.put_at(node, 0x3000);
  extension.answer = ODR_PARTIAL;
  node.ask("601#4000300000000000", "581#8000300047000406");
  node.ask("601#2300300001020304", "581#8000300013000706");
}

TEST_CASE("OD extension, value: ODR_OK with another number of bytes is 0604 0047h") {
  Node node;
  LoggedExtension extension;
  extension.put_at(node, 0x3000);
  for (const Bytes& data : {Bytes{}, Bytes{1}, Bytes{1, 2, 3}}) {
    extension.data = data;
    node.ask("601#4000300000000000", "581#8000300047000406");
  }
  extension.data = {1, 2, 3, 4, 5};  // ODR_PARTIAL
  node.ask("601#4000300000000000", "581#8000300047000406");
}

TEST_CASE("OD extension, value: its arguments in calls of the application") {
  struct {
    ODR_t result;
    CO_ERR read, write;
  } const table[] = {{ODR_UNSUPP_ACCESS, CO_ERR_OBJ_ACC, CO_ERR_OBJ_ACC},
                     {ODR_WRITEONLY, CO_ERR_OBJ_ACC, CO_ERR_OBJ_ACC},
                     {ODR_READONLY, CO_ERR_OBJ_ACC, CO_ERR_OBJ_ACC},
                     {ODR_INVALID_VALUE, CO_ERR_OBJ_RANGE, CO_ERR_OBJ_RANGE},
                     {ODR_VALUE_HIGH, CO_ERR_OBJ_RANGE, CO_ERR_OBJ_RANGE},
                     {ODR_VALUE_LOW, CO_ERR_OBJ_RANGE, CO_ERR_OBJ_RANGE},
                     {ODR_DATA_DEV_STATE, CO_ERR_OBJ_STATE, CO_ERR_OBJ_STATE},
                     {ODR_NO_DATA, CO_ERR_OBJ_NO_DATA, CO_ERR_OBJ_NO_DATA},
                     {ODR_HW, CO_ERR_TYPE_RD, CO_ERR_TYPE_WR}};
  for (const auto& row : table) {
    Node node;
    LoggedExtension extension;
    extension.put_at(node, 0x3000);
    extension.answer = row.result;
    std::uint32_t value = 0;
    node.call([&] {
      CHECK(CODictRdLong(&node->Dict, CO_DEV(0x3000, 0), &value) == row.read);
      CHECK(CODictWrLong(&node->Dict, CO_DEV(0x3000, 0), value) == row.write);
      CHECK(OD_get_u32(node.entry(0x3000), 0, &value, false) == row.result);
      CHECK(OD_set_u32(node.entry(0x3000), 0, value, false) == row.result);
    });
  }
}

TEST_CASE("OD extension, value: a null function refuses with 0601 0000h") {
  Node node;
  OD_extension_t nothing{};
  node.call([&] { CHECK(node.extend(0x3000, &nothing) == ODR_OK); });
  node.ask("601#4000300000000000", "581#8000300000000106");
  node.ask("601#2300300001020304", "581#8000300000000106");
  std::uint32_t value = 0;
  node.call([&] {
    CHECK(OD_get_u32(node.entry(0x3000), 0, &value, false) == ODR_UNSUPP_ACCESS);
    CHECK(OD_set_u32(node.entry(0x3000), 0, value, false) == ODR_UNSUPP_ACCESS);
    CHECK(CODictRdLong(&node->Dict, CO_DEV(0x3000, 0), &value) == CO_ERR_OBJ_ACC);
  });
  CHECK(node.word == 0x44332211);
}

TEST_CASE("OD extension, value: access rights are checked before it is called") {
  Values values;
  Fixture node(values.setup()
                   .with({CO_KEY(0x3000, 0, CO_OBJ_____R_), OD_TUNSIGNED32, CO_DATA(&values.word)})
                   .with({CO_KEY(0x3001, 1, CO_OBJ______W), OD_TUNSIGNED8, CO_DATA(&values.u8)})
                   .with({CO_KEY(0x3002, 1, CO_OBJ_______), OD_TUNSIGNED16, CO_DATA(&values.u16)}));
  LoggedExtension extension;
  extension.put_at(node, 0x3000);
  extension.put_at(node, 0x3001);
  extension.put_at(node, 0x3002);
  node.ask("601#2300300001020304", "581#8000300002000106");
  node.ask("601#4001300100000000", "581#8001300101000106");
  node.ask("601#4002300100000000", "581#8002300100000106");
  CHECK(extension.take_log().empty());
  node.call([&] { CHECK(OD_set_u32(OD_find(&node.od, 0x3000), 0, 5, false) == ODR_OK); });
  CHECK(extension.data == number_of({5, 0, 0, 0}));
}

// Extensions that call the original functions -----------------------------------------------------------------------

// An extension that stores only even numbers up to its limit, with OD_writeOriginal().
struct Even {
  std::uint32_t limit = 100;
  OD_extension_t extension{this, OD_readOriginal, write, {}};

  static ODR_t write(OD_stream_t* stream, const void* buf, OD_size_t count, OD_size_t* passed) {
    std::uint32_t value = 0;
    std::memcpy(&value, buf, sizeof value);
    if (value > static_cast<Even*>(stream->object)->limit) {
      return ODR_VALUE_HIGH;
    }
    return value % 2 != 0 ? ODR_INVALID_VALUE : OD_writeOriginal(stream, buf, count, passed);
  }
};

TEST_CASE("OD extension, value: it may check a value and then call the original function") {
  Node node;
  Even even;
  node.call([&] { CHECK(node.extend(0x3000, &even.extension) == ODR_OK); });
  node.word = 4;
  node.ask("601#2300300065000000", "581#8000300031000906");
  node.ask("601#2300300007000000", "581#8000300030000906");
  CHECK(node.word == 4);
  node.ask("601#2300300008000000", "581#6000300000000000");
  CHECK(node.word == 8);
  even.limit = 200;
  node.ask("601#23003000C8000000", "581#6000300000000000");
  node.ask("601#4000300000000000", "581#43003000C8000000");
  node.call([&] {
    CHECK(OD_set_u32(node.entry(0x3000), 0, 300, false) == ODR_VALUE_HIGH);
    CHECK(CODictWrLong(&node->Dict, CO_DEV(0x3000, 0), 300) == CO_ERR_OBJ_RANGE);
  });
  CHECK(node.word == 200);
}

ODR_t read_doubled(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* passed) {
  const ODR_t result = OD_readOriginal(stream, buf, count, passed);
  std::uint32_t value = 0;
  std::memcpy(&value, buf, sizeof value);
  value *= 2;
  std::memcpy(buf, &value, sizeof value);
  return result;
}

TEST_CASE("OD extension, value: the original functions handle flag N (node-ID) and flag D (value in the entry)") {
  Node node;
  OD_extension_t doubled{nullptr, read_doubled, OD_writeOriginal, {}};
  node.call([&] {
    CHECK(node.extend(0x3012, &doubled) == ODR_OK);
    CHECK(node.extend(0x3013, &doubled) == ODR_OK);
  });
  node.ask("601#2312300005000000", "581#6012300000000000");
  CHECK(node.relative == 4);
  node.ask("601#4012300000000000", "581#431230000A000000");
  node.ask("601#4013300000000000", "581#4313300000030000");
  node.ask("601#2313300009000000", "581#6013300000000000");
  node.ask("601#4013300000000000", "581#4313300012000000");
}

// Refuses with an abort code of the application.
CO_ERR refuse(CO_OBJ* obj, CO_NODE* node) {
  COObjTypeUserSDOAbort(obj, node, 0x05040004);
  return CO_ERR_TYPE_WR;
}
CO_ERR own_read(CO_OBJ* obj, CO_NODE* node, void*, uint32_t) { return refuse(obj, node); }
CO_ERR own_write(CO_OBJ* obj, CO_NODE* node, void*, uint32_t) { return refuse(obj, node); }
uint32_t own_size(CO_OBJ*, CO_NODE*, uint32_t) { return 2; }
const CO_OBJ_TYPE own_type = {own_size, nullptr, own_read, own_write, nullptr};
const OD_TYPE own_extensible = OD_VALUE(&own_type, OD_ORIGINAL);

TEST_CASE("OD extension, value: an abort code of the original type is sent to the client through the extension") {
  Fixture node(Setup().only_small().with({CO_KEY(0x3000, 0, CO_OBJ_____RW), &own_extensible.Ex.Type, CO_DATA(1)}));
  node.ask("601#4000300000000000", "581#8000300004000405");
  OD_extension_t extension{nullptr, OD_readOriginal, OD_writeOriginal, {}};
  node.call([&] { CHECK(OD_extension_init(OD_find(&node.od, 0x3000), &extension) == ODR_OK); });
  node.ask("601#4000300000000000", "581#8000300004000405");
  node.ask("601#2B00300001020000", "581#8000300004000405");
  extension.write = [](OD_stream_t* stream, const void* buf, OD_size_t count, OD_size_t* passed) {
    CHECK(OD_writeOriginal(stream, buf, count, passed) == ODR_GENERAL);
    return ODR_HW;
  };
  node.ask("601#2B00300001020000", "581#8000300000000606");
  extension.write = [](OD_stream_t* stream, const void* buf, OD_size_t count, OD_size_t* passed) {
    CHECK(OD_writeOriginal(stream, buf, count, passed) == ODR_GENERAL);
    *passed = count;
    return ODR_OK;
  };
  node.ask("601#2B00300001020000", "581#6000300000000000");
}

// Adding and removing extensions ------------------------------------------------------------------------------------

TEST_CASE("OD extension, value: it applies from the next access until it is removed or replaced") {
  Node node;
  LoggedExtension one;
  LoggedExtension other;
  one.data = {1, 1, 1, 1};
  other.data = {2, 2, 2, 2};
  one.put_at(node, 0x3000);
  node.ask("601#4000300000000000", "581#4300300001010101");
  other.put_at(node, 0x3000);
  node.ask("601#4000300000000000", "581#4300300002020202");
  node.call([&] { CHECK(node.extend(0x3000, nullptr) == ODR_OK); });
  node.ask("601#4000300000000000", "581#4300300011223344");
}

TEST_CASE("OD extension, value: one for several objects and all sub-indices gets index and sub-index") {
  Node node;
  LoggedExtension extension;
  std::vector<std::uint32_t> seen;
  extension.on_read = [&](OD_stream_t* stream) {
    seen.push_back(CO_DEV(stream->index, stream->subIndex));
    return ODR_NO_DATA;
  };
  for (const std::uint16_t index : std::initializer_list<std::uint16_t>{0x3000, 0x3001, 0x3008}) {
    extension.put_at(node, index);
  }
  node.ask("601#4008300100000000", "581#8008300124000008");
  node.ask("601#4000300000000000", "581#8000300024000008");
  node.ask("601#4001300100000000", "581#8001300124000008");
  CHECK(seen == std::vector<std::uint32_t>{CO_DEV(0x3008, 1), CO_DEV(0x3000, 0), CO_DEV(0x3001, 1)});
}

TEST_CASE("OD extension, value: objects that cannot be extended are refused, unless nothing would change") {
  Node node;
  LoggedExtension extension;
  OD_extension_t original{nullptr, OD_readOriginal, OD_writeOriginal, {}};
  node.call([&] {
    CHECK(node.extend(0x2004, &extension.extension) == ODR_UNSUPP_ACCESS);
    CHECK(node.extend(0x2004, &original) == ODR_OK);
    CHECK(node.extend(0x2004, nullptr) == ODR_OK);
    CHECK(OD_extension_init(nullptr, &extension.extension) == ODR_IDX_NOT_EXIST);
  });
  node.ask("601#4004200000000000", "581#4304200011223344");
}

TEST_CASE("OD extension, value: a REAL32 has CPU byte order in the function, little-endian on the bus [301:7.1.6.8]") {
  Node node;
  static float seen = 0;
  OD_extension_t extension{nullptr, nullptr, nullptr, {}};
  extension.write = [](OD_stream_t*, const void* buf, OD_size_t count, OD_size_t* passed) {
    std::memcpy(&seen, buf, sizeof seen);
    *passed = count;
    return ODR_OK;
  };
  node.call([&] { CHECK(node.extend(0x3010, &extension) == ODR_OK); });
  node.ask("601#231030000000C03F", "581#6010300000000000");
  CHECK(seen == 1.5F);
}

TEST_CASE("OD extension, value: all 26 results and abort codes are translated") {
  static_assert(ODR_COUNT == 26);
  for (const Row& row : rows) {
    const std::uint32_t code = OD_getSDOabCode(static_cast<ODR_t>(row.result));
    const Bytes bytes = {static_cast<std::uint8_t>(code), static_cast<std::uint8_t>(code >> 8),
                         static_cast<std::uint8_t>(code >> 16), static_cast<std::uint8_t>(code >> 24)};
    CHECK(hex(bytes, 4) == row.code);
  }
}

}  // namespace

#endif
