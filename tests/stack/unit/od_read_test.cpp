// SPDX-License-Identifier: Apache-2.0
// OD_readOriginal(): variables of every kind in pieces of every length.
#include "support/od_variables.hpp"

#if USE_OD

namespace {

using namespace test;

Bytes piece(const Bytes& all, std::size_t from, std::size_t count) {
  const std::size_t to = std::min(all.size(), from + count);
  return {all.begin() + static_cast<std::ptrdiff_t>(from), all.begin() + static_cast<std::ptrdiff_t>(to)};
}

OD_size_t length_of(const Variable& one) { return static_cast<OD_size_t>(one.value.size()); }

}  // namespace

TEST_CASE("OD_readOriginal: a null argument is ODR_DEV_INCOMPAT") {
  Bytes memory(4);
  OD_IO_t io = variable(memory);
  std::uint8_t buffer[4] = {};
  OD_size_t given = 77;
  CHECK(OD_readOriginal(nullptr, buffer, 4, &given) == ODR_DEV_INCOMPAT);
  CHECK(OD_readOriginal(&io.stream, nullptr, 4, &given) == ODR_DEV_INCOMPAT);
  CHECK(OD_readOriginal(&io.stream, buffer, 4, nullptr) == ODR_DEV_INCOMPAT);
  CHECK(given == 77);
}

TEST_CASE("OD_readOriginal: a variable without memory is ODR_SUB_NOT_EXIST") {
  Bytes memory(4);
  OD_IO_t io = variable(memory);
  io.stream.dataOrig = nullptr;
  CHECK(read(io, 4) == ReadResult{ODR_SUB_NOT_EXIST, {}});
  Variables variables;
  OD_IO_t number = variable(variables.node, 0x400A, 0);
  OD_IO_t stream = variable(variables.node, 0x400A, 1);
  CHECK(read(number, 4) == ReadResult{ODR_SUB_NOT_EXIST, {}});
  CHECK(read(stream, 4) == ReadResult{ODR_SUB_NOT_EXIST, {}});
  OD_IO_t text = variable(variables.node, 0x2110);
  OD_IO_t domain = variable(variables.node, 0x4007);
  variables.node.objects.text.Start = nullptr;
  variables.domain.Start = nullptr;
  CHECK(read(text, 4) == ReadResult{ODR_SUB_NOT_EXIST, {}});
  CHECK(read(domain, 4) == ReadResult{ODR_SUB_NOT_EXIST, {}});
}

TEST_CASE("OD_readOriginal: a buffer of the length or more gets all bytes with ODR_OK") {
  Variables variables;
  for (Variable& one : variables.all()) {
    CAPTURE(one.name);
    for (const OD_size_t more : {0U, 1U, 7U, 100U}) {
      CHECK(read(one.io, length_of(one) + more) == ReadResult{ODR_OK, one.value});
      CHECK(one.io.stream.dataOffset == 0);
    }
  }
}

TEST_CASE("OD_readOriginal: pieces return ODR_PARTIAL, the last one ODR_OK, and the next read restarts") {
  Variables variables;
  for (Variable& one : variables.all()) {
    CAPTURE(one.name);
    for (OD_size_t count = 1; count < length_of(one); ++count) {
      CAPTURE(count);
      for (unsigned times = 0; times < 2; ++times) {
        OD_size_t at = 0;
        for (; length_of(one) - at > count; at += count) {
          CHECK(read(one.io, count) == ReadResult{ODR_PARTIAL, piece(one.value, at, count)});
          CHECK(one.io.stream.dataOffset == at + count);
        }
        CHECK(read(one.io, count) == ReadResult{ODR_OK, piece(one.value, at, count)});
        CHECK(one.io.stream.dataOffset == 0);
      }
    }
  }
}

TEST_CASE("OD_readOriginal: a buffer of no bytes returns ODR_PARTIAL") {
  Variables variables;
  for (Variable& one : variables.all()) {
    CAPTURE(one.name);
    CHECK(read(one.io, 0) == ReadResult{ODR_PARTIAL, {}});
    CHECK(one.io.stream.dataOffset == 0);
    CHECK(read(one.io, 100) == ReadResult{ODR_OK, one.value});
  }
}

TEST_CASE("OD_readOriginal: pieces of different lengths are consecutive") {
  Variables variables;
  for (Variable& one : variables.all()) {
    if (one.value.size() < 4) {
      continue;
    }
    CAPTURE(one.name);
    CHECK(read(one.io, 1) == ReadResult{ODR_PARTIAL, piece(one.value, 0, 1)});
    CHECK(read(one.io, 2) == ReadResult{ODR_PARTIAL, piece(one.value, 1, 2)});
    CHECK(read(one.io, 100) == ReadResult{ODR_OK, piece(one.value, 3, 100)});
  }
}

TEST_CASE("OD_readOriginal: an offset at or behind the end is ODR_DEV_INCOMPAT") {
  Variables variables;
  for (Variable& one : variables.all()) {
    CAPTURE(one.name);
    for (const OD_size_t behind : {0U, 1U, 1000U}) {
      if (one.name.find("stream of the application") != std::string::npos && behind == 0) {
        continue;  // a stream may be read at its end
      }
      CAPTURE(behind);
      one.io.stream.dataOffset = length_of(one) + behind;
      CHECK(read(one.io, 1) == ReadResult{ODR_DEV_INCOMPAT, {}});
    }
    OD_rwRestart(&one.io.stream);
    CHECK(read(one.io, 100) == ReadResult{ODR_OK, one.value});
  }
}

TEST_CASE("OD_rwRestart: an unfinished read restarts") {
  Variables variables;
  for (Variable& one : variables.all()) {
    if (one.value.size() < 2) {
      continue;
    }
    CAPTURE(one.name);
    CHECK(read(one.io, 1).result == ODR_PARTIAL);
    OD_rwRestart(&one.io.stream);
    CHECK(read(one.io, 100) == ReadResult{ODR_OK, one.value});
  }
}

TEST_CASE("OD_readOriginal: accesses to one variable, also by CODict, have independent positions") {
  Variables variables;
  for (Variable& one : variables.all()) {
    if (one.value.size() < 3) {
      continue;
    }
    CAPTURE(one.name);
    OD_IO_t other = one.io;
    CHECK(read(one.io, 1) == ReadResult{ODR_PARTIAL, piece(one.value, 0, 1)});
    CHECK(read(other, 2) == ReadResult{ODR_PARTIAL, piece(one.value, 0, 2)});
    CHECK(read(one.io, 1) == ReadResult{ODR_PARTIAL, piece(one.value, 1, 1)});
    if (one.io.stream.Entry != nullptr) {
      std::uint8_t buffer[8] = {};
      (void)CODictRdBuffer(&variables.node->Dict, CO_DEV(one.io.stream.index, one.io.stream.subIndex), buffer, 1);
    }
    CHECK(read(other, 100) == ReadResult{ODR_OK, piece(one.value, 2, 100)});
    CHECK(read(one.io, 100) == ReadResult{ODR_OK, piece(one.value, 2, 100)});
  }
}

TEST_CASE("OD_readOriginal: a refusal of the type is the result with its abort code") {
  const struct {
    CO_ERR err;
    ODR_t result;
  } cases[] = {{CO_ERR_OBJ_ACC, ODR_UNSUPP_ACCESS},       {CO_ERR_OBJ_RANGE, ODR_INVALID_VALUE},
               {CO_ERR_OBJ_SIZE, ODR_TYPE_MISMATCH},      {CO_ERR_OBJ_NO_DATA, ODR_NO_DATA},
               {CO_ERR_TYPE_RD, ODR_DATA_TRANSF},         {CO_ERR_OBJ_INCOMPATIBLE, ODR_PAR_INCOMPAT},
               {CO_ERR_OBJ_STATE, ODR_DATA_DEV_STATE},    {CO_ERR_IF_NVM_READ, ODR_HW},
               {CO_ERR_OBJ_MAP_TYPE, ODR_NO_MAP},         {CO_ERR_OBJ_MAP_LEN, ODR_MAP_LEN},
               {CO_ERR_OBJ_NOT_FOUND, ODR_IDX_NOT_EXIST}, {CO_ERR_TMR_CREATE, ODR_GENERAL}};
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x4000);
  for (const auto& one : cases) {
    CAPTURE(one.result);
    variables.plain.on_piece = [&one](CO_OBJ*, CO_NODE*) { return one.err; };
    CHECK(read(io, 5) == ReadResult{one.result, {}});
    CHECK(io.stream.dataOffset == 0);
  }
  variables.plain.on_piece = nullptr;
  CHECK(read(io, 5) == ReadResult{ODR_PARTIAL, {1, 2, 3, 4, 5}});
  variables.plain.on_piece = [](CO_OBJ*, CO_NODE*) { return CO_ERR_TYPE_RD; };
  CHECK(read(io, 5) == ReadResult{ODR_DATA_TRANSF, {}});
  CHECK(io.stream.dataOffset == 5);
  variables.plain.on_piece = nullptr;
  CHECK(read(io, 5) == ReadResult{ODR_PARTIAL, {6, 7, 8, 9, 10}});
}

TEST_CASE("OD_readOriginal: a type that cannot be read is ODR_WRITEONLY") {
  static const CO_OBJ_TYPE without_read = {[](CO_OBJ*, CO_NODE*, std::uint32_t) { return std::uint32_t{4}; }, nullptr,
                                           nullptr, nullptr, nullptr};
  Fixture node(Setup().only_small().with({CO_KEY(0x4000, 0, CO_OBJ_____RW), &without_read, CO_DATA(&node)}));
  OD_IO_t io = variable(node, 0x4000);
  CHECK(read(io, 4) == ReadResult{ODR_WRITEONLY, {}});
}

// Streams -------------------------------------------------------------------------------------------------------------

TEST_CASE("OD_readOriginal: an OCTET_STRING ends with its value") {
  Variables variables;
  variables.node.objects.octets.Size = 4;
  OD_IO_t io = variable(variables.node, 0x2111);
  CHECK(io.stream.dataLength == 10);
  CHECK(read(io, 10) == ReadResult{ODR_OK, {1, 2, 3, 4}});
  CHECK(read(io, 3) == ReadResult{ODR_PARTIAL, {1, 2, 3}});
  CHECK(read(io, 3) == ReadResult{ODR_OK, {4}});
  variables.node.objects.octets.Size = 0;
  CHECK(read(io, 10) == ReadResult{ODR_OK, {}});
}

TEST_CASE("OD_readOriginal: an empty stream is ODR_OK at its beginning") {
  Variables variables;
  variables.plain.data.clear();
  OD_IO_t io = variable(variables.node, 0x4000);
  CHECK(read(io, 5) == ReadResult{ODR_OK, {}});
  OD_IO_t domain = variable(variables.node, 0x2100, 0);
  CHECK(read(domain, 5) == ReadResult{ODR_OK, {}});
}

TEST_CASE("OD_readOriginal: a stream of unknown length returns its length at its end") {
  Variables variables;
  variables.plain.knows_size = false;
  OD_IO_t io = variable(variables.node, 0x4000);
  CHECK(io.stream.dataLength == 0);
  CHECK(read(io, 12) == ReadResult{ODR_PARTIAL, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}});
  OD_size_t given = 0;
  std::uint8_t buffer[12] = {};
  CHECK(io.read(&io.stream, buffer, 12, &given) == ODR_OK);
  CHECK(Bytes(buffer, buffer + given) == Bytes{13, 14, 15, 16, 17, 18, 19, 20});
  CHECK(io.stream.dataOffset == 0);
}

TEST_CASE("OD_readOriginal: a stream that becomes shorter than the read part is ODR_DEV_INCOMPAT") {
  Variables variables;
  variables.plain.knows_size = false;
  OD_IO_t io = variable(variables.node, 0x4000);
  CHECK(read(io, 12).result == ODR_PARTIAL);
  variables.plain.data.resize(5);
  OD_size_t given = 0;
  std::uint8_t buffer[12] = {};
  CHECK(io.read(&io.stream, buffer, 12, &given) == ODR_DEV_INCOMPAT);
}

TEST_CASE("OD_readOriginal: a stream open in an SDO transfer is ODR_DATA_DEV_STATE until its end") {
  Variables variables;
  for (const std::uint16_t index : std::initializer_list<std::uint16_t>{0x4000, 0x4001}) {
    CAPTURE(index);
    OD_IO_t io = variable(variables.node, index);
    const std::string object = index == 0x4000 ? "004000" : "014000";
    variables.node.rx("601#40" + object + "00000000");
    variables.node.trace();
    CHECK(read(io, 5) == ReadResult{ODR_DATA_DEV_STATE, {}});
    CHECK(write(io, {1}) == ODR_DATA_DEV_STATE);
    variables.node.rx("601#80" + object + "00000408");
    CHECK(read(io, 5) == ReadResult{ODR_PARTIAL, {1, 2, 3, 4, 5}});
  }
}

TEST_CASE("OD_readOriginal: SDO transfers of strings and domains and accesses have independent positions") {
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x2100, 15);
  CHECK(read(io, 4) == ReadResult{ODR_PARTIAL, {1, 2, 3, 4}});
  variables.node.ask("601#4000210F00000000", "581#4100210F0F000000");
  CHECK(read(io, 4) == ReadResult{ODR_PARTIAL, {5, 6, 7, 8}});
  variables.node.ask("601#6000000000000000", "581#0001020304050607");
  CHECK(read(io, 4) == ReadResult{ODR_PARTIAL, {9, 10, 11, 12}});
  variables.node.ask("601#7000000000000000", "581#1008090A0B0C0D0E");
  CHECK(read(io, 4) == ReadResult{ODR_OK, {13, 14, 15}});
  variables.node.ask("601#6000000000000000", "581#0D0F000000000000");
}

TEST_CASE("OD_readOriginal: a stream without Reset is read in one call") {
  static const CO_OBJ_TYPE_EX no_way_back = {
      {[](CO_OBJ*, CO_NODE*, std::uint32_t) { return std::uint32_t{9}; }, nullptr,
       [](CO_OBJ*, CO_NODE*, void* buffer, std::uint32_t size) {
         __builtin_memset(buffer, 0x44, size);
         return CO_ERR_NONE;
       },
       nullptr, COObjTypeExReset},
      nullptr,
      nullptr,
      nullptr};
  Fixture node(Setup().only_small().with({CO_KEY(0x4000, 0, CO_OBJ_____R_), &no_way_back.Type, CO_DATA(&node)}));
  OD_IO_t io = variable(node, 0x4000);
  CHECK(read(io, 9) == ReadResult{ODR_OK, Bytes(9, 0x44)});
  CHECK(read(io, 4) == ReadResult{ODR_PARTIAL, Bytes(4, 0x44)});
  CHECK(read(io, 5) == ReadResult{ODR_UNSUPP_ACCESS, {}});
  OD_rwRestart(&io.stream);
  CHECK(read(io, 20) == ReadResult{ODR_OK, Bytes(9, 0x44)});
}

TEST_CASE("OD_readOriginal: a value of more than 8 bytes is read in one call") {
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x4009);
  CHECK(io.stream.dataLength == 12);
  CHECK(read(io, 12) == ReadResult{ODR_OK, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}});
  CHECK(read(io, 30) == ReadResult{ODR_OK, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}});
  CHECK(read(io, 11) == ReadResult{ODR_UNSUPP_ACCESS, {}});
}

TEST_CASE("OD_readOriginal: TIME_OF_DAY is read in its six bytes [301:7.1.6.5]") {
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x2026);
  Bytes expected = {0x04, 0x03, 0x02, 0x01, 0x06, 0x05};
  if (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__) {
    std::reverse(expected.begin(), expected.end());
  }
  CHECK(read(io, 6) == ReadResult{ODR_OK, expected});
  CHECK(read(io, 4) == ReadResult{ODR_PARTIAL, Bytes(expected.begin(), expected.begin() + 4)});
  CHECK(read(io, 4) == ReadResult{ODR_OK, Bytes(expected.begin() + 4, expected.end())});
}

TEST_CASE("OD_readOriginal: Begin and End of a type are called only by SDO transfers") {
  Variables variables;
  OD_IO_t io = variable(variables.node, 0x4001);
  variables.extended.take_log();
  CHECK(read(io, 15).result == ODR_PARTIAL);
  CHECK(read(io, 15).result == ODR_OK);
  CHECK(variables.extended.take_log() == Log{"reset 0", "read 0", "read 15", "reset 15", "read 6"});
}

#endif
