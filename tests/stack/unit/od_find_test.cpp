// SPDX-License-Identifier: Apache-2.0
// OD_getSub() for each kind of object, OD_mappable(), OD_rwRestart(), OD_extension_init().

// The dictionary contains C casts, as in firmware.
#pragma GCC diagnostic ignored "-Wold-style-cast"

#include <cstring>

#include "support/logged_stream.hpp"
#include "support/od.hpp"

#if USE_OD

namespace {

using namespace test;

ODR_t no_read(OD_stream_t*, void*, OD_size_t, OD_size_t*) { return ODR_HW; }
ODR_t no_write(OD_stream_t*, const void*, OD_size_t, OD_size_t*) { return ODR_HW; }

std::uint8_t number = 0;
std::uint32_t extensible = 0;

Setup with_extensible() {
  return Setup()
      .only_small()
      .with({CO_KEY(0x3000, 0, CO_OBJ____PRW), OD_TUNSIGNED32, (CO_DATA)(&extensible)})
      .with({CO_KEY(0x3001, 0, CO_OBJ_____RW), OD_TNUMBER, (CO_DATA)(4)})
      .with({CO_KEY(0x3001, 1, CO_OBJ_____RW), OD_TNUMBER, (CO_DATA)(1)})
      .with({CO_KEY(0x3002, 0, CO_OBJ_____RW), OD_TSTREAM, (CO_DATA)(20)})
      .with({CO_KEY(0x3002, 1, CO_OBJ_____RW), OD_TSTREAM, 0})
      .with({CO_KEY(0x3003, 0, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&number)})
      .with({CO_KEY(0x3003, 1, CO_OBJ_____RW), OD_TUNSIGNED8, (CO_DATA)(&number)});
}

// Returns an entry whose object is plain memory.
OD_entry_t memory_entry(unsigned kind, const void* object, std::uint8_t subs = 1) {
  return {0x2000, subs, static_cast<std::uint8_t>(kind), object, nullptr};
}

struct Sub {
  ODR_t result;
  OD_IO_t io;
};

Sub get_sub(const OD_entry_t& entry, std::uint8_t sub) {
  Sub got{};
  std::memset(static_cast<void*>(&got.io), 0xA5, sizeof got.io);
  got.result = OD_getSub(&entry, sub, &got.io, false);
  return got;
}

void check_stream(const OD_stream_t& stream, const void* memory, OD_size_t length, unsigned attribute) {
  CHECK(stream.dataOrig == memory);
  CHECK(stream.dataLength == length);
  CHECK(stream.dataOffset == 0);
  CHECK(stream.object == nullptr);
  CHECK(unsigned{stream.attribute} == attribute);
}

}  // namespace

// Errors --------------------------------------------------------------------------------------------------------------

TEST_CASE("OD_getSub: a null entry or one without object is ODR_IDX_NOT_EXIST") {
  OD_IO_t io;
  const OD_entry_t empty = memory_entry(ODT_VAR, nullptr);
  CHECK(OD_getSub(nullptr, 0, &io, false) == ODR_IDX_NOT_EXIST);
  CHECK(OD_getSub(nullptr, 0, nullptr, false) == ODR_IDX_NOT_EXIST);
  CHECK(OD_getSub(&empty, 0, &io, true) == ODR_IDX_NOT_EXIST);
}

TEST_CASE("OD_getSub: a null OD_IO_t is ODR_DEV_INCOMPAT") {
  Fixture node(with_extensible());
  CHECK(OD_getSub(OD_find(&node.od, 0x2004), 0, nullptr, false) == ODR_DEV_INCOMPAT);
}

TEST_CASE("OD_getSub: a missing sub-index is ODR_SUB_NOT_EXIST") {
  Fixture node(with_extensible());
  OD_IO_t io;
  CHECK(OD_getSub(OD_find(&node.od, 0x2004), 1, &io, false) == ODR_SUB_NOT_EXIST);  // a variable has sub-index 0 only
  CHECK(OD_getSub(OD_find(&node.od, 0x1018), 5, &io, false) == ODR_SUB_NOT_EXIST);  // behind the last sub-index
  CHECK(OD_getSub(OD_find(&node.od, 0x2033), 0, &io, false) == ODR_SUB_NOT_EXIST);  // has sub-index 1 only
  CHECK(OD_getSub(OD_find(&node.od, 0x2033), 1, &io, false) == ODR_OK);
  CHECK(OD_getSub(OD_find(&node.od, 0x2100), 10, &io, false) == ODR_SUB_NOT_EXIST);  // a gap
  CHECK(OD_getSub(OD_find(&node.od, 0x2100), 14, &io, false) == ODR_OK);
  CHECK(OD_getSub(OD_find(&node.od, 0x2100), 255, &io, false) == ODR_SUB_NOT_EXIST);
}

// Objects in plain memory ---------------------------------------------------------------------------------------------

TEST_CASE("OD_getSub: a variable in memory has sub-index 0 only") {
  std::uint32_t value = 0;
  const OD_obj_var_t variable = {{&value}, ODA_SDO_RW | ODA_MB, 4};
  const Sub got = get_sub(memory_entry(ODT_VAR, &variable), 0);
  REQUIRE(got.result == ODR_OK);
  check_stream(got.io.stream, &value, 4, ODA_SDO_RW | ODA_MB);
  CHECK(got.io.stream.index == 0x2000);
  CHECK(unsigned{got.io.stream.subIndex} == 0);
  CHECK((got.io.read == OD_readOriginal));
  CHECK((got.io.write == OD_writeOriginal));
  CHECK(get_sub(memory_entry(ODT_VAR, &variable), 1).result == ODR_SUB_NOT_EXIST);
}

TEST_CASE("OD_getSub: an array in memory has its number in a byte and elements at a stride") {
  std::uint8_t last = 2;
  std::uint8_t elements[16] = {};
  const OD_obj_array_t array = {&last, elements, ODA_SDO_R, ODA_SDO_RW, 3, 8};
  const OD_entry_t entry = memory_entry(ODT_ARR, &array, 3);
  check_stream(get_sub(entry, 0).io.stream, &last, 1, ODA_SDO_R);
  check_stream(get_sub(entry, 1).io.stream, elements, 3, ODA_SDO_RW);
  check_stream(get_sub(entry, 2).io.stream, elements + 8, 3, ODA_SDO_RW);
  CHECK(unsigned{get_sub(entry, 2).io.stream.subIndex} == 2);
  CHECK(get_sub(entry, 3).result == ODR_SUB_NOT_EXIST);
}

TEST_CASE("OD_getSub: an array without memory is allowed") {
  std::uint8_t last = 2;
  const OD_obj_array_t array = {&last, nullptr, ODA_SDO_R, ODA_SDO_RW, 4, 4};
  const Sub got = get_sub(memory_entry(ODT_ARR, &array, 3), 2);
  REQUIRE(got.result == ODR_OK);
  check_stream(got.io.stream, nullptr, 4, ODA_SDO_RW);
}

TEST_CASE("OD_getSub: a record in memory may have gaps") {
  std::uint8_t first = 0;
  std::uint16_t fifth = 0;
  const OD_obj_record_t record[] = {{{&first}, 0, ODA_SDO_R, 1}, {{&fifth}, 5, ODA_SDO_RW | ODA_MB, 2}};
  const OD_entry_t entry = memory_entry(ODT_REC, record, 2);
  check_stream(get_sub(entry, 0).io.stream, &first, 1, ODA_SDO_R);
  check_stream(get_sub(entry, 5).io.stream, &fifth, 2, ODA_SDO_RW | ODA_MB);
  for (const std::uint8_t sub : std::initializer_list<std::uint8_t>{1, 4, 6, 255}) {
    CHECK(get_sub(entry, sub).result == ODR_SUB_NOT_EXIST);
  }
}

TEST_CASE("OD_getSub: an object of unknown kind is ODR_DEV_INCOMPAT") {
  const OD_obj_var_t variable = {{nullptr}, 0, 0};
  for (const unsigned kind : {0U, 4U, 5U, 15U, 0x10U, 0x40U}) {
    CAPTURE(kind);
    CHECK(get_sub(memory_entry(kind, &variable), 0).result == ODR_DEV_INCOMPAT);
  }
}

// Attributes in the table ---------------------------------------------------------------------------------------------

TEST_CASE("OD_getSub: a number has its length on the bus, its variable, and ODA_MB from two bytes") {
  Fixture node(with_extensible());
  const struct {
    std::uint16_t index;
    const void* memory;
    OD_size_t length;
  } cases[] = {{0x2001, &node.objects.u8, 1},     {0x2002, &node.objects.u16, 2},    {0x2003, &node.objects.u24, 3},
               {0x2004, &node.objects.u32, 4},    {0x2005, &node.objects.u40, 5},    {0x2006, &node.objects.u48, 6},
               {0x2007, &node.objects.u56, 7},    {0x2008, &node.objects.u64, 8},    {0x2020, &node.objects.boolean, 1},
               {0x2024, &node.objects.real32, 4}, {0x2028, &node.objects.real64, 8}, {0x3000, &extensible, 4}};
  for (const auto& one : cases) {
    CAPTURE(one.index);
    const OD_IO_t io = variable(node, one.index);
    const unsigned many = one.length > 1 ? ODA_MB : 0;
    OD_stream_t without_mapping = io.stream;
    without_mapping.attribute = static_cast<OD_attr_t>(io.stream.attribute & ~(unsigned{ODA_TRPDO} | ODA_TRSRDO));
    check_stream(without_mapping, one.memory, one.length, ODA_SDO_RW | many);
    CHECK(io.stream.index == one.index);
  }
  check_stream(variable(node, 0x2026).stream, nullptr, 6, ODA_SDO_RW | ODA_MB);  // TIME_OF_DAY: not in bus order
}

TEST_CASE("OD_getSub: a number with flag D has its address in the table") {
  Fixture node(with_extensible());
  const OD_IO_t io = variable(node, 0x1000);
  const std::uint32_t* const place = static_cast<const std::uint32_t*>(io.stream.dataOrig);
  check_stream(io.stream, place, 4, ODA_SDO_R | ODA_MB);
  REQUIRE(place != nullptr);
  CHECK(*place == 0x000F0191);
}

TEST_CASE("OD_getSub: texts have their capacity and ODA_STR, octets and domains their capacity") {
  Fixture node(with_extensible());
  check_stream(variable(node, 0x2110).stream, node.objects.text_memory, 16, ODA_SDO_RW | ODA_STR);
  check_stream(variable(node, 0x2111).stream, node.objects.octets_memory, 10, ODA_SDO_RW);
  check_stream(variable(node, 0x2112).stream, node.objects.unicode_memory, 8, ODA_SDO_RW | ODA_STR);
  check_stream(variable(node, 0x2100, 15).stream, node.objects.memory[15].data(), 15, ODA_SDO_RW);
  check_stream(variable(node, 0x1008).stream, node.objects.device_name.Start, 17, ODA_SDO_R | ODA_STR);
}

TEST_CASE("OD_getSub: an object of an extension only has a length and no memory") {
  Fixture node(with_extensible());
  check_stream(variable(node, 0x3001, 0).stream, nullptr, 4, ODA_SDO_RW | ODA_MB);
  check_stream(variable(node, 0x3001, 1).stream, nullptr, 1, ODA_SDO_RW);
  check_stream(variable(node, 0x3002, 0).stream, nullptr, 20, ODA_SDO_RW);
  check_stream(variable(node, 0x3002, 1).stream, nullptr, 0, ODA_SDO_RW);
}

TEST_CASE("OD_getSub: an application-defined type has the length of Size, 0 if unknown") {
  LoggedStream stream;
  LoggedStream value;
  stream.data = Bytes(300, 1);
  value.data = Bytes(3, 1);
  Fixture node(Setup().only_small().with(stream.plain(0x4000)).with(value.value(0x4001)));
  check_stream(variable(node, 0x4000).stream, nullptr, 300, ODA_SDO_RW);
  check_stream(variable(node, 0x4001).stream, nullptr, 3, ODA_SDO_RW | ODA_MB);
  stream.knows_size = false;
  check_stream(variable(node, 0x4000).stream, nullptr, 0, ODA_SDO_RW);
}

TEST_CASE("OD_getSub: the attributes are the access rights of the network") {
  constexpr unsigned transmit = CO_SRDO_N > 0 ? ODA_TSRDO : 0;
  constexpr unsigned receive = CO_SRDO_N > 0 ? ODA_RSRDO : 0;
  static std::uint8_t u8 = 0;
  const struct {
    std::uint32_t flags;
    unsigned attribute;
    bool mappable;
  } cases[] = {{0, 0, false},
               {CO_OBJ_____R_, ODA_SDO_R, false},
               {CO_OBJ______W, ODA_SDO_W, false},
               {CO_OBJ_____RW, ODA_SDO_RW, false},
               {CO_OBJ____PR_, ODA_SDO_R | ODA_TPDO | transmit, true},
               {CO_OBJ____P_W, ODA_SDO_W | ODA_RPDO | receive, true},
               {CO_OBJ____PRW, ODA_SDO_RW | ODA_TRPDO | transmit | receive, true},
               {CO_OBJ___APRW, ODA_SDO_RW | ODA_TRPDO | transmit | receive, true},
               {CO_OBJ____P__, 0, false},
               {CO_OBJ__N__RW, ODA_SDO_RW, false}};
  for (const auto& one : cases) {
    CAPTURE(one.flags);
    Fixture node(Setup().only_small().with({CO_KEY(0x2000, 0, one.flags), CO_TUNSIGNED8, (CO_DATA)(&u8)}));
    const OD_IO_t io = variable(node, 0x2000);
    CHECK(unsigned{io.stream.attribute} == one.attribute);
    CHECK(OD_mappable(&io.stream) == one.mappable);
  }
}

TEST_CASE("OD_mappable: returns true for any of the four bits of PDOs and false for a null stream") {
  for (unsigned attribute = 0; attribute <= 0xFF; ++attribute) {
    OD_stream_t stream{};
    stream.attribute = static_cast<OD_attr_t>(attribute);
    CHECK(OD_mappable(&stream) == ((attribute & (0x04U | 0x08U | 0x10U | 0x20U)) != 0));
  }
  CHECK_FALSE(OD_mappable(nullptr));
}

TEST_CASE("OD_rwRestart: the next call starts at the beginning; a null stream is accepted") {
  OD_stream_t stream{};
  stream.dataOffset = 5;
  stream.dataLength = 9;
  OD_rwRestart(&stream);
  CHECK(stream.dataOffset == 0);
  CHECK(stream.dataLength == 9);
  OD_rwRestart(nullptr);
}

// Extensions ----------------------------------------------------------------------------------------------------------

TEST_CASE("OD_extension_init: OD_getSub returns the functions of the extension unless odOrig is set") {
  Fixture node(with_extensible());
  int object = 0;
  OD_extension_t extension{};
  extension.object = &object;
  extension.read = no_read;
  extension.write = no_write;
  OD_entry_t* const entry = OD_find(&node.od, 0x3000);
  REQUIRE(OD_extension_init(entry, &extension) == ODR_OK);
  const OD_IO_t extended = variable(node, 0x3000);
  CHECK(extended.stream.object == &object);
  CHECK(extended.stream.dataOrig == &extensible);
  CHECK(extended.stream.dataLength == 4);
  CHECK((extended.read == no_read));
  CHECK((extended.write == no_write));
  const OD_IO_t original = variable(node, 0x3000, 0, true);
  CHECK(original.stream.object == nullptr);
  CHECK((original.read == OD_readOriginal));
  CHECK((original.write == OD_writeOriginal));
  REQUIRE(OD_extension_init(entry, nullptr) == ODR_OK);
  CHECK(variable(node, 0x3000).stream.object == nullptr);
  CHECK((variable(node, 0x3000).read == OD_readOriginal));
}

TEST_CASE("OD_extension_init: a null function refuses with ODR_UNSUPP_ACCESS") {
  Fixture node(with_extensible());
  OD_extension_t extension{};
  REQUIRE(OD_extension_init(OD_find(&node.od, 0x3000), &extension) == ODR_OK);
  OD_IO_t io = variable(node, 0x3000);
  extensible = 7;
  CHECK(read(io, 4) == ReadResult{ODR_UNSUPP_ACCESS, {}});
  CHECK(write(io, {1, 2, 3, 4}) == ODR_UNSUPP_ACCESS);
  CHECK(extensible == 7);
}

TEST_CASE("OD_extension_init: a null entry is ODR_IDX_NOT_EXIST") {
  OD_extension_t extension{};
  CHECK(OD_extension_init(nullptr, &extension) == ODR_IDX_NOT_EXIST);
  CHECK(OD_extension_init(nullptr, nullptr) == ODR_IDX_NOT_EXIST);
}

TEST_CASE("OD_extension_init: an object that cannot be extended accepts only an extension without effect") {
  Fixture node(with_extensible());
  OD_extension_t extension{};
  extension.read = no_read;
  OD_entry_t* const entry = OD_find(&node.od, 0x2004);
  CHECK(OD_extension_init(entry, &extension) == ODR_UNSUPP_ACCESS);
  CHECK(entry->extension == nullptr);
  extension.read = OD_readOriginal;
  CHECK(OD_extension_init(entry, &extension) == ODR_UNSUPP_ACCESS);
  extension.write = OD_writeOriginal;
  CHECK(OD_extension_init(entry, &extension) == ODR_OK);
  CHECK(variable(node, 0x2004).stream.object == nullptr);
  CHECK(OD_extension_init(entry, nullptr) == ODR_OK);
  CHECK(entry->extension == nullptr);
}

TEST_CASE("OD_extension_init: for an object with several variables it applies to entries of extensible types") {
  Fixture node(with_extensible());
  OD_extension_t extension{};
  extension.read = no_read;
  extension.write = no_write;
  REQUIRE(OD_extension_init(OD_find(&node.od, 0x3003), &extension) == ODR_OK);
  CHECK((variable(node, 0x3003, 0).read == OD_readOriginal));
  CHECK((variable(node, 0x3003, 1).read == no_read));
}

TEST_CASE("OD_extension_init: an object in memory without a table can be extended") {
  std::uint32_t value = 0;
  const OD_obj_var_t variable = {{&value}, ODA_SDO_RW | ODA_MB, 4};
  OD_entry_t entry = memory_entry(ODT_VAR, &variable);
  OD_extension_t extension{};
  extension.object = &value;
  extension.read = no_read;
  REQUIRE(OD_extension_init(&entry, &extension) == ODR_OK);
  const Sub got = get_sub(entry, 0);
  CHECK((got.io.read == no_read));
  CHECK(got.io.stream.object == &value);
}

#endif
