// SPDX-License-Identifier: Apache-2.0
// OD_writeOriginal(): variables of every kind in pieces of every length.

// The dictionary contains C casts, as in firmware.
#pragma GCC diagnostic ignored "-Wold-style-cast"

#include "support/od_variables.hpp"

#if USE_OD

namespace {

using namespace test;

// Returns bytes that differ from \a value.
Bytes other_than(const Bytes& value) {
  Bytes other = value;
  for (std::uint8_t& byte : other) {
    byte = static_cast<std::uint8_t>(byte ^ 0x80U);
  }
  return other;
}

Bytes piece(const Bytes& all, std::size_t from, std::size_t count) {
  const std::size_t to = std::min(all.size(), from + count);
  return {all.begin() + static_cast<std::ptrdiff_t>(from), all.begin() + static_cast<std::ptrdiff_t>(to)};
}

// Returns \a at bytes of \a first, followed by those of \a rest.
Bytes mixed(const Bytes& first, const Bytes& rest, std::size_t at) {
  Bytes all = rest;
  std::copy_n(first.begin(), at, all.begin());
  return all;
}

Bytes now(const Variable& one) {
  OD_IO_t io = one.io;
  OD_rwRestart(&io.stream);
  return read(io, static_cast<OD_size_t>(one.value.size())).data;
}

// Returns false for OCTET_STRING and domain: bytes behind the last piece are no longer part of the value.
bool keeps_the_rest(const Variable& one) { return one.name != "OCTET_STRING"; }

Bytes text_of(const CO_OBJ_STR_RW& text) { return {text.Start, text.Start + text.Size}; }

}  // namespace

TEST_CASE("OD_writeOriginal: a null argument is ODR_DEV_INCOMPAT") {
  Bytes memory(4);
  OD_IO_t io = variable(memory);
  const std::uint8_t buffer[4] = {1, 2, 3, 4};
  OD_size_t taken = 77;
  CHECK(OD_writeOriginal(nullptr, buffer, 4, &taken) == ODR_DEV_INCOMPAT);
  CHECK(OD_writeOriginal(&io.stream, nullptr, 4, &taken) == ODR_DEV_INCOMPAT);
  CHECK(OD_writeOriginal(&io.stream, buffer, 4, nullptr) == ODR_DEV_INCOMPAT);
  CHECK(taken == 77);
  CHECK(memory == Bytes(4));
}

TEST_CASE("OD_writeOriginal: a variable without memory is ODR_SUB_NOT_EXIST") {
  Bytes memory(4);
  OD_IO_t io = variable(memory);
  io.stream.dataOrig = nullptr;
  CHECK(write(io, {1, 2, 3, 4}) == ODR_SUB_NOT_EXIST);
  Variables variables;
  OD_IO_t number = variable(variables.node, 0x400A, 0);
  OD_IO_t stream = variable(variables.node, 0x400A, 1);
  CHECK(write(number, {1, 2, 3, 4}) == ODR_SUB_NOT_EXIST);
  CHECK(write(stream, {1, 2, 3, 4}) == ODR_SUB_NOT_EXIST);
  OD_IO_t text = variable(variables.node, 0x2110);
  variables.node.objects.text.Start = nullptr;
  CHECK(write(text, {1}) == ODR_SUB_NOT_EXIST);
}

TEST_CASE("OD_writeOriginal: an offset at or behind the end is ODR_DEV_INCOMPAT and nothing is written") {
  Variables variables;
  for (Variable& one : variables.writable()) {
    CAPTURE(one.name);
    for (const OD_size_t behind : {0U, 1U, 1000U}) {
      one.io.stream.dataOffset = static_cast<OD_size_t>(one.value.size()) + behind;
      CHECK(write(one.io, {0x99}) == ODR_DEV_INCOMPAT);
      CHECK(now(one) == one.value);
    }
  }
}

TEST_CASE("OD_writeOriginal: all bytes in one call return ODR_OK, and the next call restarts") {
  Variables variables;
  for (Variable& one : variables.writable()) {
    CAPTURE(one.name);
    CHECK(write(one.io, other_than(one.value)) == ODR_OK);
    CHECK(one.io.stream.dataOffset == 0);
    CHECK(now(one) == other_than(one.value));
    CHECK(write(one.io, one.value) == ODR_OK);
    CHECK(now(one) == one.value);
  }
}

TEST_CASE("OD_writeOriginal: fewer bytes return ODR_PARTIAL, the last ones ODR_OK; each is written at once") {
  Variables variables;
  for (Variable& one : variables.writable()) {
    CAPTURE(one.name);
    const std::size_t length = one.value.size();
    for (std::size_t count = 1; count < length; ++count) {
      CAPTURE(count);
      const Bytes before = now(one);
      const Bytes next = other_than(before);
      std::size_t at = 0;
      for (; length - at > count; at += count) {
        CHECK(write(one.io, piece(next, at, count)) == ODR_PARTIAL);
        CHECK(one.io.stream.dataOffset == at + count);
        if (keeps_the_rest(one)) {
          CHECK(now(one) == mixed(next, before, at + count));
        }
      }
      CHECK(write(one.io, piece(next, at, count)) == ODR_OK);
      CHECK(one.io.stream.dataOffset == 0);
      CHECK(now(one) == next);
    }
  }
}

TEST_CASE("OD_writeOriginal: more bytes than remain are ODR_DATA_LONG and not written; earlier ones stay") {
  Variables variables;
  for (Variable& one : variables.writable()) {
    CAPTURE(one.name);
    const Bytes next = other_than(one.value);
    Bytes too_long = next;
    too_long.push_back(0x99);
    CHECK(write(one.io, too_long) == ODR_DATA_LONG);
    CHECK(one.io.stream.dataOffset == 0);
    CHECK(now(one) == one.value);
    if (one.value.size() < 2) {
      continue;
    }
    CHECK(write(one.io, piece(next, 0, 1)) == ODR_PARTIAL);
    CHECK(write(one.io, next) == ODR_DATA_LONG);
    CHECK(one.io.stream.dataOffset == 1);
    if (keeps_the_rest(one)) {
      CHECK(now(one) == mixed(next, one.value, 1));
    }
    CHECK(write(one.io, piece(next, 1, 100)) == ODR_OK);
    CHECK(now(one) == next);
  }
}

TEST_CASE("OD_writeOriginal: no bytes return ODR_PARTIAL and change nothing") {
  Variables variables;
  for (Variable& one : variables.writable()) {
    CAPTURE(one.name);
    if (keeps_the_rest(one)) {
      CHECK(write(one.io, {}) == ODR_PARTIAL);
      CHECK(now(one) == one.value);
    }
  }
}

TEST_CASE("OD_rwRestart: an unfinished write restarts; written bytes stay") {
  Variables variables;
  for (Variable& one : variables.writable()) {
    if (one.value.size() < 2 || !keeps_the_rest(one)) {
      continue;
    }
    CAPTURE(one.name);
    const Bytes next = other_than(one.value);
    CHECK(write(one.io, piece(next, 0, 1)) == ODR_PARTIAL);
    OD_rwRestart(&one.io.stream);
    CHECK(now(one) == mixed(next, one.value, 1));
    CHECK(write(one.io, one.value) == ODR_OK);
    CHECK(now(one) == one.value);
  }
}

TEST_CASE("OD_writeOriginal: accesses to one variable have independent positions") {
  Variables variables;
  for (Variable& one : variables.writable()) {
    if (one.value.size() < 3 || !keeps_the_rest(one)) {
      continue;
    }
    CAPTURE(one.name);
    const Bytes next = other_than(one.value);
    OD_IO_t other = one.io;
    CHECK(write(one.io, piece(next, 0, 2)) == ODR_PARTIAL);
    CHECK(write(other, piece(one.value, 0, 1)) == ODR_PARTIAL);
    CHECK(write(one.io, piece(next, 2, 100)) == ODR_OK);
    CHECK(write(other, piece(one.value, 1, 100)) == ODR_OK);
    CHECK(now(one) == one.value);
  }
}

// Numbers -------------------------------------------------------------------------------------------------------------

TEST_CASE("OD_writeOriginal: a signed number of 3 bytes keeps its sign in the variable") {
  std::int32_t memory = 0;
  Fixture node(Setup().only_small().with({CO_KEY(0x4000, 0, CO_OBJ_____RW), CO_TSIGNED24, (CO_DATA)(&memory)}));
  OD_IO_t io = variable(node, 0x4000);
  CHECK(write(io, bytes_of(std::uint32_t{0xFFFFFE}, 3)) == ODR_OK);
  CHECK(memory == -2);
  CHECK(write(io, bytes_of(std::uint32_t{0x000123}, 3)) == ODR_OK);
  CHECK(memory == 0x123);
}

TEST_CASE("OD_writeOriginal: a value relative to the node-ID is stored without it") {
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x4006);
  CHECK(write(io, bytes_of(std::uint32_t{0x601})) == ODR_OK);
  CHECK(variables.relative == 0x600);
  CHECK(read(io, 4) == ReadResult{ODR_OK, bytes_of(std::uint32_t{0x601})});
}

TEST_CASE("OD_writeOriginal: each piece of a number writes the whole number and calls its type") {
  Variables variables;
  static unsigned writes;
  writes = 0;
  static const CO_OBJ_TYPE counted = {[](CO_OBJ*, CO_NODE*, std::uint32_t) { return std::uint32_t{2}; }, nullptr,
                                      [](CO_OBJ*, CO_NODE*, void* buffer, std::uint32_t size) {
                                        __builtin_memset(buffer, 0x10, size);
                                        return CO_ERR_NONE;
                                      },
                                      [](CO_OBJ*, CO_NODE*, void* buffer, std::uint32_t size) {
                                        ++writes;
                                        const auto* const bytes = static_cast<const std::uint8_t*>(buffer);
                                        return size == 2 && bytes[0] <= 0x20 ? CO_ERR_NONE : CO_ERR_OBJ_RANGE;
                                      },
                                      nullptr};
  Fixture node(Setup().only_small().with({CO_KEY(0x4000, 0, CO_OBJ_____RW), &counted, CO_DATA(&variables)}));
  OD_IO_t io = variable(node, 0x4000);
  CHECK(write(io, {0x20}) == ODR_PARTIAL);
  CHECK(write(io, {0xFF}) == ODR_OK);
  CHECK(writes == 2);
  CHECK(write(io, {0x21}) == ODR_INVALID_VALUE);
  CHECK(io.stream.dataOffset == 0);
  CHECK(write(io, {0x21, 0x00}) == ODR_INVALID_VALUE);
  CHECK(writes == 4);
}

TEST_CASE("OD_writeOriginal: a change of a number with flag A sends its TPDO, the same value does not") {
  std::uint8_t memory = 1;
  std::uint32_t cob_id = 0x40000181;
  std::uint8_t type = 254;
  std::uint8_t mapped = 1;
  std::uint32_t mapping = CO_LINK(0x4000, 0, 8);
  Fixture node(Setup()
                   .only_small()
                   .may_change(0x4000, 0)
                   .with({CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)})
                   .with({CO_KEY(0x1800, 1, CO_OBJ_____RW), CO_TPDO_ID, (CO_DATA)(&cob_id)})
                   .with({CO_KEY(0x1800, 2, CO_OBJ_____RW), CO_TPDO_TYPE, (CO_DATA)(&type)})
                   .with({CO_KEY(0x1A00, 0, CO_OBJ_____RW), CO_TPDO_NUM, (CO_DATA)(&mapped)})
                   .with({CO_KEY(0x1A00, 1, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA)(&mapping)})
                   .with({CO_KEY(0x4000, 0, CO_OBJ___APRW), CO_TUNSIGNED8, (CO_DATA)(&memory)}));
  node.rx("000#0101");
  node.trace();
  const OD_entry_t* const entry = OD_find(&node.od, 0x4000);
  node.call([entry] { CHECK(OD_set_u8(entry, 0, 1, false) == ODR_OK); });
  node.silent();
  node.call([entry] { CHECK(OD_set_u8(entry, 0, 2, false) == ODR_OK); });
  node.tx("181#02");
}

// Texts, octets and streams -------------------------------------------------------------------------------------------

TEST_CASE("OD_writeOriginal: a shorter text is ODR_PARTIAL, or ODR_OK if the caller has set its length") {
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x2110);
  const CO_OBJ_STR_RW& text = variables.node.objects.text;
  CHECK(write(io, {'a', 'b', 'c'}) == ODR_PARTIAL);
  OD_rwRestart(&io.stream);
  io.stream.dataLength = 2;
  CHECK(write(io, {'d', 'e'}) == ODR_OK);
  CHECK(text_of(text) == Bytes{'d', 'e'});
  io.stream.dataLength = 3;
  CHECK(write(io, {'f', 'g', 'h', 'i'}) == ODR_DATA_LONG);
  CHECK(text_of(text) == Bytes{'d', 'e'});
  io.stream.dataLength = 100;  // more than the capacity
  CHECK(write(io, Bytes(17, 'x')) == ODR_DATA_LONG);
  CHECK(write(io, Bytes(16, 'x')) == ODR_OK);
  CHECK(text_of(text) == Bytes(16, 'x'));
}

TEST_CASE("OD_writeOriginal: a zero at the end of a text is not part of it") {
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x2110);
  const CO_OBJ_STR_RW& text = variables.node.objects.text;
  io.stream.dataLength = 4;
  CHECK(write(io, {'a', 'b'}) == ODR_PARTIAL);
  CHECK(write(io, {'c', 0}) == ODR_OK);
  CHECK(text_of(text) == Bytes{'a', 'b', 'c'});
  CHECK(variables.node.upload(0x2110, 0) == Bytes{'a', 'b', 'c'});
  CHECK(write(io, {0, 0, 0, 0}) == ODR_OK);
  CHECK(text_of(text).empty());
  io.stream.dataLength = 16;
  CHECK(write(io, {'a', 0, 'b', 'c', 'd', 'e', 'f', 'g', 'h', 'i', 'j', 0, 0, 0, 0, 0}) == ODR_OK);
  CHECK(text.Size == 11);
}

TEST_CASE("OD_writeOriginal: two zeros end a UNICODE_STRING; a zero byte of a character is kept") {
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x2112);
  const CO_OBJ_STR_RW& text = variables.node.objects.unicode;
  io.stream.dataLength = 4;
  CHECK(write(io, {'A', 0, 'B', 0}) == ODR_OK);
  CHECK(text.Size == 4);
  CHECK(variables.node.upload(0x2112, 0) == Bytes{'A', 0, 'B', 0});
  io.stream.dataLength = 6;
  CHECK(write(io, {'A', 0, 0, 1, 0, 0}) == ODR_OK);
  CHECK(text.Size == 4);
  CHECK(variables.node.upload(0x2112, 0) == Bytes{'A', 0, 0, 1});
}

TEST_CASE("OD_writeOriginal: zeros are part of an OCTET_STRING, which may be shorter") {
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x2111);
  io.stream.dataLength = 3;
  CHECK(write(io, {9, 0, 0}) == ODR_OK);
  CHECK(text_of(variables.node.objects.octets) == Bytes{9, 0, 0});
}

TEST_CASE("OD_writeOriginal: a domain is written up to the length that the caller sets") {
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x2100, 15);
  io.stream.dataLength = 2;
  CHECK(write(io, {0x91}) == ODR_PARTIAL);
  CHECK(write(io, {0x92}) == ODR_OK);
  CHECK(piece(variables.node.objects.memory[15], 0, 3) == Bytes{0x91, 0x92, 3});
}

TEST_CASE("OD_writeOriginal: a read-only object is ODR_READONLY, protected memory ODR_UNSUPP_ACCESS") {
  Variables variables;
  OD_IO_t text = variable(variables.node, 0x1008);
  CHECK(write(text, {'x'}) == ODR_READONLY);
  Fixture protected_node(Setup().only_small().writable([](const void*, std::uint32_t) { return false; }));
  OD_IO_t number = variable(protected_node, 0x2004);
  OD_IO_t octets = variable(protected_node, 0x2111);
  CHECK(write(number, {1, 2, 3, 4}) == ODR_UNSUPP_ACCESS);
  CHECK(write(octets, {1}) == ODR_UNSUPP_ACCESS);
  CHECK(protected_node.objects.u32 == 0x44332211);
}

TEST_CASE("OD_writeOriginal: an application-defined stream of unknown length ends where the caller sets it") {
  Variables variables;
  variables.plain.knows_size = false;
  OD_IO_t io = variable(variables.node, 0x4000);
  REQUIRE(io.stream.dataLength == 0);
  CHECK(write(io, {1, 2, 3}) == ODR_PARTIAL);
  CHECK(write(io, Bytes(40, 4)) == ODR_PARTIAL);
  io.stream.dataLength = 45;
  CHECK(write(io, {5, 6, 7}) == ODR_DATA_LONG);
  CHECK(write(io, {5, 6}) == ODR_OK);
  CHECK(io.stream.dataOffset == 0);
  Bytes expected = {1, 2, 3};
  expected.resize(43, 4);
  expected.insert(expected.end(), {5, 6});
  CHECK(variables.plain.data == expected);
}

TEST_CASE("OD_writeOriginal: an application-defined stream is written in pieces of any length") {
  for (std::size_t count = 1; count <= 20; ++count) {
    CAPTURE(count);
    Variables variables;
    const Bytes next = other_than(variables.plain.data);
    OD_IO_t io = variable(variables.node, 0x4000);
    REQUIRE(io.stream.dataLength == 20);
    for (std::size_t at = 0; at < 20; at += count) {
      CHECK(write(io, piece(next, at, count)) == (at + count < 20 ? ODR_PARTIAL : ODR_OK));
    }
    CHECK(variables.plain.data == next);
  }
}

TEST_CASE("OD_writeOriginal: an empty write of length 0 empties an application-defined stream") {
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x4000);
  CHECK(write(io, {}) == ODR_PARTIAL);
  CHECK(variables.plain.data.size() == 20);
  io.stream.dataLength = 0;
  variables.plain.take_log();
  CHECK(write(io, {}) == ODR_OK);
  CHECK(variables.plain.take_log() == Log{"reset 0", "write 0", "write 0"});
  CHECK(variables.plain.data.empty());
}

TEST_CASE("OD_writeOriginal: a type is not called for a piece of no bytes") {
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x4000);
  CHECK(write(io, {1}) == ODR_PARTIAL);
  variables.plain.take_log();
  CHECK(write(io, {}) == ODR_PARTIAL);
  CHECK(variables.plain.take_log().empty());
}

TEST_CASE("OD_writeOriginal: strings, domains and streams of lengths around the size of a copy are written") {
  for (const std::size_t capacity : std::initializer_list<std::size_t>{5, 31, 32, 33, 64, 100}) {
    for (const std::size_t length :
         {std::size_t{1}, std::size_t{32}, std::size_t{33}, std::size_t{65}, capacity - 1, capacity, capacity + 1}) {
      CAPTURE(capacity);
      CAPTURE(length);
      Bytes memory(3 * capacity, 0x55);
      const auto room = static_cast<std::uint32_t>(capacity);
      CO_OBJ_STR_RW text{0, room, room, memory.data()};
      CO_OBJ_STR_RW octets{0, room, room, memory.data() + capacity};
      CO_OBJ_DOM domain{0, room, memory.data() + 2 * capacity};
      Fixture node(Setup()
                       .only_small()
                       .with({CO_KEY(0x4000, 0, CO_OBJ_____RW), CO_TVISIBLE_STRING, (CO_DATA)(&text)})
                       .with({CO_KEY(0x4001, 0, CO_OBJ_____RW), OD_TOCTET_STRING, (CO_DATA)(&octets)})
                       .with({CO_KEY(0x4002, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&domain)}));
      Bytes data(length);
      for (std::size_t n = 0; n < length; ++n) {
        data[n] = static_cast<std::uint8_t>(n + 1);
      }
      const bool fits = length <= capacity;
      for (const std::uint16_t index : std::initializer_list<std::uint16_t>{0x4000, 0x4001, 0x4002}) {
        OD_IO_t io = variable(node, index);
        io.stream.dataLength = static_cast<OD_size_t>(length);
        CHECK(write(io, data) == (fits ? ODR_OK : ODR_DATA_LONG));
      }
      CHECK(text.Size == (fits ? length : capacity));
      CHECK(octets.Size == (fits ? length : capacity));
      Bytes expected(3 * capacity, 0x55);
      for (std::size_t n = 0; fits && n < 3 * capacity; n += capacity) {
        std::copy(data.begin(), data.end(), expected.begin() + static_cast<std::ptrdiff_t>(n));
      }
      if (length < capacity) {
        expected[length] = 0;  // behind the text
      }
      CHECK(memory == expected);
    }
  }
}

TEST_CASE("OD_writeOriginal: a refusal of the second copy leaves the first one written") {
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x4000);
  io.stream.dataLength = 40;
  variables.plain.on_piece = [&](CO_OBJ*, CO_NODE*) {
    return variables.plain.position > 32 ? CO_ERR_OBJ_RANGE : CO_ERR_NONE;
  };
  CHECK(write(io, Bytes(40, 7)) == ODR_INVALID_VALUE);
  CHECK(io.stream.dataOffset == 0);
}

TEST_CASE("OD_writeOriginal: Begin and End of a type are called only by SDO transfers") {
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x4001);
  variables.extended.take_log();
  CHECK(write(io, Bytes(20, 1)) == ODR_PARTIAL);
  CHECK(write(io, {2}) == ODR_OK);
  CHECK(variables.extended.take_log() == Log{"reset 0", "write 0", "write 20", "reset 20", "write 1"});
}

TEST_CASE("OD_writeOriginal: a value of more than 8 bytes is written in one call") {
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x4009);
  CHECK(write(io, Bytes(11, 0x99)) == ODR_UNSUPP_ACCESS);
  CHECK(write(io, Bytes(13, 0x99)) == ODR_DATA_LONG);
  CHECK(variables.long_value[0] == 1);
  CHECK(write(io, Bytes(12, 0x99)) == ODR_OK);
  CHECK(variables.long_value[11] == 0x99);
}

#endif
