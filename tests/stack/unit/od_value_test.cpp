// SPDX-License-Identifier: Apache-2.0
// Values of a known length: OD_get_…(), OD_set_…(), OD_getPtr().

// The dictionary contains C casts, as in firmware.
#pragma GCC diagnostic ignored "-Wold-style-cast"

#include <limits>

#include "support/od_variables.hpp"

#if USE_OD

namespace {

using namespace test;

struct Extended {
  unsigned reads = 0;
  unsigned writes = 0;
  ODR_t result = ODR_OK;
};

ODR_t counted_read(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* countRead) {
  auto& extended = *static_cast<Extended*>(stream->object);
  ++extended.reads;
  return extended.result != ODR_OK ? extended.result : OD_readOriginal(stream, buf, count, countRead);
}

ODR_t counted_write(OD_stream_t* stream, const void* buf, OD_size_t count, OD_size_t* countWritten) {
  auto& extended = *static_cast<Extended*>(stream->object);
  ++extended.writes;
  return extended.result != ODR_OK ? extended.result : OD_writeOriginal(stream, buf, count, countWritten);
}

template <class T>
using Get = ODR_t (*)(const OD_entry_t*, std::uint8_t, T*, bool_t);
template <class T>
using Set = ODR_t (*)(const OD_entry_t*, std::uint8_t, T, bool_t);

template <class T>
void check_round_trip(const CO_OBJ_TYPE* type, Get<T> get, Set<T> set, T value) {
  CAPTURE(value);
  T memory{};
  Fixture node(Setup().only_small().with({CO_KEY(0x2000, 0, CO_OBJ_____RW), type, (CO_DATA)(&memory)}));
  const OD_entry_t* const entry = OD_find(&node.od, 0x2000);
  T read{};
  CHECK(set(entry, 0, value, false) == ODR_OK);
  CHECK(memory == value);
  CHECK(get(entry, 0, &read, false) == ODR_OK);
  CHECK(read == value);
  CHECK(get(entry, 0, nullptr, false) == ODR_DEV_INCOMPAT);
  CHECK(get(nullptr, 0, &read, false) == ODR_IDX_NOT_EXIST);
  CHECK(set(nullptr, 0, value, false) == ODR_IDX_NOT_EXIST);
  CHECK(get(entry, 1, &read, false) == ODR_SUB_NOT_EXIST);
  CHECK(set(entry, 1, value, false) == ODR_SUB_NOT_EXIST);
}

}  // namespace

TEST_CASE("OD_get_…, OD_set_…: every width and kind of number is read back") {
  check_round_trip<std::int8_t>(CO_TSIGNED8, OD_get_i8, OD_set_i8, -128);
  check_round_trip<std::int16_t>(CO_TSIGNED16, OD_get_i16, OD_set_i16, -0x1234);
  check_round_trip<std::int32_t>(CO_TSIGNED32, OD_get_i32, OD_set_i32, -0x12345678);
  check_round_trip<std::int64_t>(CO_TSIGNED64, OD_get_i64, OD_set_i64, std::numeric_limits<std::int64_t>::min());
  check_round_trip<std::uint8_t>(CO_TUNSIGNED8, OD_get_u8, OD_set_u8, 0xA5);
  check_round_trip<std::uint16_t>(CO_TUNSIGNED16, OD_get_u16, OD_set_u16, 0xA512);
  check_round_trip<std::uint32_t>(CO_TUNSIGNED32, OD_get_u32, OD_set_u32, 0xA5123456);
  check_round_trip<std::uint64_t>(CO_TUNSIGNED64, OD_get_u64, OD_set_u64, 0xA512345678ABCDEF);
  check_round_trip<float>(CO_TREAL32, OD_get_f32, OD_set_f32, -1.5F);
  check_round_trip<double>(CO_TREAL64, OD_get_f64, OD_set_f64, 1e300);
  check_round_trip<float>(CO_TREAL32, OD_get_r32, OD_set_r32, 2.5F);
  check_round_trip<double>(CO_TREAL64, OD_get_r64, OD_set_r64, -1e-300);
}

TEST_CASE("OD_get_value, OD_set_value: another length is ODR_TYPE_MISMATCH and nothing is written") {
  Fixture node(Setup().only_small());
  const OD_entry_t* const entry = OD_find(&node.od, 0x2004);
  std::uint8_t u8 = 0x55;
  std::uint16_t u16 = 0x5555;
  std::uint64_t u64 = 0x5555;
  CHECK(OD_get_u8(entry, 0, &u8, false) == ODR_TYPE_MISMATCH);
  CHECK(OD_get_u16(entry, 0, &u16, true) == ODR_TYPE_MISMATCH);
  CHECK(OD_get_u64(entry, 0, &u64, false) == ODR_TYPE_MISMATCH);
  CHECK(OD_get_value(entry, 0, &u64, 0, false) == ODR_TYPE_MISMATCH);
  CHECK((u8 == 0x55 && u16 == 0x5555 && u64 == 0x5555));
  CHECK(OD_set_u8(entry, 0, 1, false) == ODR_TYPE_MISMATCH);
  CHECK(OD_set_u16(entry, 0, 1, true) == ODR_TYPE_MISMATCH);
  CHECK(OD_set_u64(entry, 0, 1, false) == ODR_TYPE_MISMATCH);
  CHECK(node.objects.u32 == 0x44332211);
  CHECK(OD_set_value(entry, 0, nullptr, 4, false) == ODR_DEV_INCOMPAT);
  CHECK(OD_get_value(entry, 0, nullptr, 4, false) == ODR_DEV_INCOMPAT);
}

TEST_CASE("OD_get_value, OD_set_value: another length is ODR_TYPE_MISMATCH for every kind of variable") {
  Variables variables;
  for (const Variable& one : variables.all()) {
    if (one.io.stream.Entry == nullptr) {
      continue;
    }
    CAPTURE(one.name);
    const OD_entry_t* const entry = OD_find(&variables.node.od, one.io.stream.index);
    const auto size = static_cast<OD_size_t>(one.value.size());
    Bytes data(size + 40U, 0x5A);
    for (const OD_size_t len : {OD_size_t{0}, size - 1, size + 1, size + 33}) {
      CHECK(OD_set_value(entry, one.io.stream.subIndex, data.data(), len, false) == ODR_TYPE_MISMATCH);
      CHECK(OD_get_value(entry, one.io.stream.subIndex, data.data(), len, false) == ODR_TYPE_MISMATCH);
    }
    CHECK(data == Bytes(size + 40U, 0x5A));
    OD_IO_t io = one.io;
    CHECK(read(io, size) == ReadResult{ODR_OK, one.value});
  }
}

TEST_CASE("OD_set_value: an extension that accepts fewer bytes gives ODR_DEV_INCOMPAT") {
  std::uint32_t memory = 1;
  Fixture node(Setup().only_small().with({CO_KEY(0x2000, 0, CO_OBJ_____RW), OD_TUNSIGNED32, (CO_DATA)(&memory)}));
  OD_extension_t extension{nullptr,
                           OD_readOriginal,
                           [](OD_stream_t*, const void*, OD_size_t, OD_size_t* written) {
                             *written = 2;
                             return ODR_OK;
                           },
                           {}};
  REQUIRE(OD_extension_init(OD_find(&node.od, 0x2000), &extension) == ODR_OK);
  CHECK(OD_set_u32(OD_find(&node.od, 0x2000), 0, 5, false) == ODR_DEV_INCOMPAT);
}

TEST_CASE("OD_get_value, OD_set_value: the access rights of the network are not checked") {
  Fixture node(Setup().only_small());
  std::uint32_t value = 0;
  CHECK(OD_set_u32(OD_find(&node.od, 0x2031), 0, 0x12345678, false) == ODR_OK);  // read-only
  CHECK(node.objects.read_only == 0x12345678);
  node.objects.write_only = 0x87654321;
  CHECK(OD_get_u32(OD_find(&node.od, 0x2030), 0, &value, false) == ODR_OK);
  CHECK(value == 0x87654321);
  node.objects.no_access = 5;
  CHECK(OD_get_u32(OD_find(&node.od, 0x2032), 0, &value, false) == ODR_OK);
  CHECK(value == 5);
  CHECK(OD_set_u32(OD_find(&node.od, 0x2032), 0, 6, false) == ODR_OK);
  CHECK(node.objects.no_access == 6);
}

TEST_CASE("OD_get_value, OD_set_value: numbers of 3, 5, 6 and 7 bytes are accessed by their length") {
  Fixture node(Setup().only_small());
  std::uint8_t value[8] = {};
  CHECK(OD_get_value(OD_find(&node.od, 0x2003), 0, value, 3, false) == ODR_OK);
  CHECK(OD_get_value(OD_find(&node.od, 0x2003), 0, value, 4, false) == ODR_TYPE_MISMATCH);
  std::uint64_t other = 0;
  CHECK(OD_get_u64(OD_find(&node.od, 0x2007), 0, &other, false) == ODR_TYPE_MISMATCH);
  std::uint8_t ones[7] = {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};
  CHECK(OD_set_value(OD_find(&node.od, 0x2007), 0, ones, 7, false) == ODR_OK);
  CHECK(node.objects.u56 == 0x00FFFFFFFFFFFFFF);
}

TEST_CASE("OD_get_value, OD_set_value: a value relative to the node-ID has it added [301:7.4.1]") {
  Fixture node(Setup().only_small().node_id(5));
  const OD_entry_t* const entry = OD_find(&node.od, 0x2034);
  std::uint32_t value = 0;
  REQUIRE(OD_get_u32(entry, 0, &value, false) == ODR_OK);
  CHECK(OD_set_u32(entry, 0, value + 1, false) == ODR_OK);
  std::uint32_t after = 0;
  REQUIRE(OD_get_u32(entry, 0, &after, false) == ODR_OK);
  CHECK(after == value + 1);
  const auto* const variable = static_cast<const std::uint32_t*>(OD_getPtr(entry, 0, 4, nullptr));
  REQUIRE(variable != nullptr);
  CHECK(*variable + 5 == after);
}

TEST_CASE("OD_get_value, OD_set_value: extensions are called unless odOrig is set") {
  std::uint32_t memory = 1;
  Fixture node(Setup().only_small().with({CO_KEY(0x2000, 0, CO_OBJ_____RW), OD_TUNSIGNED32, (CO_DATA)(&memory)}));
  Extended extended;
  OD_extension_t extension{};
  extension.object = &extended;
  extension.read = counted_read;
  extension.write = counted_write;
  OD_entry_t* const entry = OD_find(&node.od, 0x2000);
  REQUIRE(OD_extension_init(entry, &extension) == ODR_OK);
  std::uint32_t value = 0;
  CHECK(OD_set_u32(entry, 0, 2, false) == ODR_OK);
  CHECK(OD_get_u32(entry, 0, &value, false) == ODR_OK);
  CHECK(value == 2);
  CHECK(OD_set_u32(entry, 0, 3, true) == ODR_OK);
  CHECK(OD_get_u32(entry, 0, &value, true) == ODR_OK);
  CHECK(value == 3);
  CHECK((extended.reads == 1 && extended.writes == 1));
  extended.result = ODR_VALUE_HIGH;
  CHECK(OD_set_u32(entry, 0, 4, false) == ODR_VALUE_HIGH);
  CHECK(OD_get_u32(entry, 0, &value, false) == ODR_VALUE_HIGH);
  CHECK((memory == 3 && value == 3));
  CHECK((extended.reads == 2 && extended.writes == 2));
}

TEST_CASE("OD_set_value: a refusal of the type is the result") {
  std::uint32_t cob_id = 0x80;
  Fixture node(Setup().only_small().with({CO_KEY(0x1014, 0, CO_OBJ__N__RW), CO_TEMCY_ID, (CO_DATA)(&cob_id)}));
  CHECK(OD_set_u32(OD_find(&node.od, 0x1014), 0, 0x00000000, false) == ODR_INVALID_VALUE);
  CHECK(cob_id == 0x80);
  std::uint8_t letters[17] = "x";
  CHECK(OD_set_value(OD_find(&node.od, 0x1008), 0, letters, 17, false) == ODR_READONLY);
}

TEST_CASE("OD_get_value: a stream that ends before its length is ODR_DATA_SHORT") {
  Fixture node(Setup().only_small());
  std::uint8_t octets[10] = {};
  CHECK(OD_get_value(OD_find(&node.od, 0x2111), 0, octets, 10, false) == ODR_DATA_SHORT);
  node.objects.octets.Size = 10;
  CHECK(OD_get_value(OD_find(&node.od, 0x2111), 0, octets, 10, false) == ODR_OK);
}

// OD_getPtr -----------------------------------------------------------------------------------------------------------

TEST_CASE("OD_getPtr: returns the variable of each object with memory if its length is checked or not") {
  Fixture node(Setup().only_small());
  const struct {
    std::uint16_t index;
    const void* memory;
    OD_size_t length;
  } cases[] = {{0x2001, &node.objects.u8, 1},
               {0x2004, &node.objects.u32, 4},
               {0x2028, &node.objects.real64, 8},
               {0x2110, node.objects.text_memory, 16},
               {0x2111, node.objects.octets_memory, 10}};
  for (const auto& one : cases) {
    CAPTURE(one.index);
    const OD_entry_t* const entry = OD_find(&node.od, one.index);
    ODR_t result = ODR_HW;
    CHECK(OD_getPtr(entry, 0, one.length, &result) == one.memory);
    CHECK(result == ODR_OK);
    CHECK(OD_getPtr(entry, 0, 0, &result) == one.memory);
    CHECK(OD_getPtr(entry, 0, one.length, nullptr) == one.memory);
    CHECK(OD_getPtr(entry, 0, one.length + 1, &result) == nullptr);
    CHECK(result == ODR_TYPE_MISMATCH);
    CHECK(OD_getPtr(entry, 0, one.length + 1, nullptr) == nullptr);
  }
}

TEST_CASE("OD_getPtr: an object without memory or with length 0 is ODR_DEV_INCOMPAT") {
  std::uint8_t byte = 0;
  CO_OBJ_DOM empty{0, 0, &byte};
  Fixture node(Setup()
                   .only_small()
                   .with({CO_KEY(0x2000, 0, CO_OBJ_____RW), OD_TNUMBER, (CO_DATA)(4)})
                   .with({CO_KEY(0x2000, 1, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&empty)}));
  for (const std::uint8_t sub : std::initializer_list<std::uint8_t>{0, 1}) {
    for (const OD_size_t length : {0U, 4U}) {
      ODR_t result = ODR_HW;
      CHECK(OD_getPtr(OD_find(&node.od, 0x2000), sub, length, &result) == nullptr);
      CHECK(result == ODR_DEV_INCOMPAT);
    }
  }
}

TEST_CASE("OD_getPtr: has the errors of OD_getSub") {
  Fixture node(Setup().only_small());
  ODR_t result = ODR_HW;
  CHECK(OD_getPtr(nullptr, 0, 4, &result) == nullptr);
  CHECK(result == ODR_IDX_NOT_EXIST);
  CHECK(OD_getPtr(OD_find(&node.od, 0x2004), 1, 4, &result) == nullptr);
  CHECK(result == ODR_SUB_NOT_EXIST);
}

TEST_CASE("OD_getPtr: ignores extensions") {
  std::uint32_t memory = 1;
  Fixture node(Setup().only_small().with({CO_KEY(0x2000, 0, CO_OBJ_____RW), OD_TUNSIGNED32, (CO_DATA)(&memory)}));
  OD_extension_t extension{};
  REQUIRE(OD_extension_init(OD_find(&node.od, 0x2000), &extension) == ODR_OK);
  CHECK(OD_getPtr(OD_find(&node.od, 0x2000), 0, 4, nullptr) == &memory);
}

#endif
