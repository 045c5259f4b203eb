// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "support/entry.hpp"

namespace {

using namespace test;

TEST_CASE("types: DOMAIN reads and writes from its position up to its end") {
  std::uint8_t memory[5] = {1, 2, 3, 4, 5};
  CO_OBJ_DOM domain{3, 5, memory};
  Entry entry(CO_TDOMAIN, CO_OBJ_____RW, &domain);
  CO_NODE* const node = &entry.node.node;
  CHECK(COObjInit(&entry.obj, node) == CO_ERR_NONE);
  CHECK(domain.Offset == 0);
  CHECK(entry.size() == 5);
  CHECK(entry.size(3) == 3);
  CHECK(entry.size(5) == 5);
  CHECK(entry.size(6) == 5);
  std::uint8_t buffer[8] = {0xEE, 0xEE, 0xEE, 0xEE, 0xEE, 0xEE, 0xEE, 0xEE};
  CHECK(COObjRdBufStart(&entry.obj, node, buffer, 2) == CO_ERR_NONE);
  CHECK(COObjRdBufCont(&entry.obj, node, buffer + 2, 6) == CO_ERR_NONE);
  CHECK(Bytes(buffer, buffer + 8) == Bytes{1, 2, 3, 4, 5, 0xEE, 0xEE, 0xEE});
  CHECK(domain.Offset == 5);
  CHECK(COObjReset(&entry.obj, node, 2) == CO_ERR_NONE);
  CHECK(domain.Offset == 2);
  std::uint8_t in[8] = {9, 8, 7, 6, 5, 4, 3, 2};
  CHECK(COObjWrBufCont(&entry.obj, node, in, 1) == CO_ERR_NONE);
  CHECK(COObjWrBufCont(&entry.obj, node, in, 8) == CO_ERR_NONE);
  CHECK(Bytes(memory, memory + 5) == Bytes{1, 2, 9, 9, 8});
  CHECK(COObjWrBufStart(&entry.obj, node, in, 0) == CO_ERR_NONE);
  CHECK(domain.Offset == 0);
  CHECK(COObjReset(&entry.obj, node, 100) == CO_ERR_NONE);
  CHECK(COObjRdBufCont(&entry.obj, node, buffer, 8) == CO_ERR_NONE);
  CHECK(COObjWrBufCont(&entry.obj, node, in, 8) == CO_ERR_NONE);
  CHECK(Bytes(memory, memory + 5) == Bytes{1, 2, 9, 9, 8});
}

TEST_CASE("types: DOMAIN without memory refuses accesses") {
  CO_OBJ_DOM domain{0, 5, nullptr};
  for (const CO_DATA data : {CO_DATA(static_cast<void*>(nullptr)), CO_DATA(&domain)}) {
    Entry entry(CO_TDOMAIN, CO_OBJ_____RW, data);
    std::uint8_t buffer[1] = {};
    CHECK(entry.size() == 0);
    CHECK(entry.read(buffer, 1) == CO_ERR_BAD_ARG);
    CHECK(entry.write(buffer, 1) == CO_ERR_BAD_ARG);
  }
}

TEST_CASE("types: a read-only text is read up to its NUL") {
  static const std::uint8_t text[] = "Hello World!";
  CO_OBJ_STR string{7, text};
  Entry entry(CO_TSTRING, CO_OBJ_____R_, &string);
  CO_NODE* const node = &entry.node.node;
  CHECK(COObjInit(&entry.obj, node) == CO_ERR_NONE);
  CHECK(string.Offset == 0);
  CHECK(entry.size() == 12);
  CHECK(entry.size(4) == 12);
  std::uint8_t buffer[20];
  std::memset(buffer, 0xEE, sizeof buffer);
  CHECK(COObjRdBufStart(&entry.obj, node, buffer, 5) == CO_ERR_NONE);
  CHECK(COObjRdBufCont(&entry.obj, node, buffer + 5, 15) == CO_ERR_NONE);
  CHECK(std::memcmp(buffer, "Hello World!", 12) == 0);
  CHECK(buffer[12] == 0xEE);
  CHECK(COObjRdBufCont(&entry.obj, node, buffer, 5) == CO_ERR_NONE);
  CHECK(buffer[0] == 'H');
  CHECK(entry.write(buffer, 1) == CO_ERR_OBJ_ACC);
  Entry none(CO_TSTRING, CO_OBJ_____R_, nullptr);
  CHECK(none.size() == 0);
  CHECK(none.read(buffer, 1) == CO_ERR_BAD_ARG);
}

TEST_CASE("types: VISIBLE_STRING ends at its length or a NUL, and gets a NUL if it fits") {
  std::uint8_t memory[8] = "abc";
  CO_OBJ_STR_RW string{0, 8, 8, memory};
  Entry entry(CO_TVISIBLE_STRING, CO_OBJ_____RW, &string);
  CO_NODE* const node = &entry.node.node;
  CHECK(entry.size() == 3);
  CHECK(entry.size(5) == 5);
  CHECK(entry.size(9) == 8);
  std::uint8_t in[9] = "12345678";
  CHECK(COObjWrBufStart(&entry.obj, node, in, 5) == CO_ERR_NONE);
  CHECK(string.Size == 5);
  CHECK(memory[5] == 0);
  CHECK(COObjWrBufStart(&entry.obj, node, in, 8) == CO_ERR_NONE);
  CHECK(string.Size == 8);
  CHECK(memory[7] == '8');
  CHECK(entry.size() == 8);
  CHECK(COObjWrBufStart(&entry.obj, node, in, 4) == CO_ERR_NONE);
  CHECK(COObjWrBufCont(&entry.obj, node, in, 2) == CO_ERR_NONE);
  CHECK(string.Size == 6);
  CHECK(std::memcmp(memory, "123412", 7) == 0);
  string.Size = 4;
  CHECK(entry.size() == 4);
  string.Size = 100;
  memory[6] = memory[7] = 'x';
  CHECK(entry.size() == 8);
}

TEST_CASE("types: OCTET_STRING may contain any bytes") {
  std::uint8_t memory[4] = {0, 1, 0, 2};
  CO_OBJ_STR_RW string{0, 3, 4, memory};
  Entry entry(CO_TOCTET_STRING, CO_OBJ_____RW, &string);
  CO_NODE* const node = &entry.node.node;
  CHECK(entry.size() == 3);
  CHECK(entry.size(4) == 4);
  CHECK(entry.size(5) == 4);
  std::uint8_t buffer[8];
  std::memset(buffer, 0xEE, sizeof buffer);
  CHECK(COObjRdBufStart(&entry.obj, node, buffer, 8) == CO_ERR_NONE);
  CHECK(Bytes(buffer, buffer + 4) == Bytes{0, 1, 0, 0xEE});
  std::uint8_t in[4] = {0, 0, 7, 0};
  CHECK(COObjWrBufStart(&entry.obj, node, in, 4) == CO_ERR_NONE);
  CHECK(string.Size == 4);
  CHECK(Bytes(memory, memory + 4) == Bytes{0, 0, 7, 0});
  CHECK(COObjWrBufStart(&entry.obj, node, in, 0) == CO_ERR_NONE);
  CHECK(string.Size == 0);
}

TEST_CASE("types: UNICODE_STRING is sent low byte first on any CPU") {
  std::uint16_t memory[3] = {0x20AC, 0x0041, 0};
  CO_OBJ_STR_RW string{0, 4, 6, reinterpret_cast<std::uint8_t*>(memory)};
  Entry entry(CO_TUNICODE_STRING, CO_OBJ_____RW, &string);
  CO_NODE* const node = &entry.node.node;
  CHECK(entry.size() == 4);
  CHECK(entry.size(2) == 2);
  CHECK(entry.size(3) == 2);
  CHECK(entry.size(8) == 6);
  std::uint8_t buffer[4];
  CHECK(COObjRdBufStart(&entry.obj, node, buffer, 4) == CO_ERR_NONE);
  CHECK(Bytes(buffer, buffer + 4) == Bytes{0xAC, 0x20, 0x41, 0x00});
  std::uint8_t in[6] = {0x42, 0x00, 0xE4, 0x00, 0x34, 0x12};
  CHECK(COObjWrBufStart(&entry.obj, node, in, 3) == CO_ERR_NONE);
  CHECK(COObjWrBufCont(&entry.obj, node, in + 3, 3) == CO_ERR_NONE);
  CHECK(memory[0] == 0x0042);
  CHECK(memory[1] == 0x00E4);
  CHECK(memory[2] == 0x1234);
  CHECK(string.Size == 6);
}

TEST_CASE("types: strings without memory refuse accesses") {
  CO_OBJ_STR_RW string{0, 2, 4, nullptr};
  for (const CO_OBJ_TYPE* type : {CO_TVISIBLE_STRING, CO_TOCTET_STRING, CO_TUNICODE_STRING}) {
    for (const CO_DATA data : {CO_DATA(static_cast<void*>(nullptr)), CO_DATA(&string)}) {
      Entry entry(type, CO_OBJ_____RW, data);
      std::uint8_t buffer[2] = {};
      CHECK(entry.size() == 0);
      CHECK(entry.size(2) == 0);
      CHECK(entry.read(buffer, 2) == CO_ERR_BAD_ARG);
      CHECK(entry.write(buffer, 2) == CO_ERR_BAD_ARG);
    }
  }
}

}  // namespace
