// SPDX-License-Identifier: Apache-2.0
#include "support/entry.hpp"

namespace {

using namespace test;

TEST_CASE("types: COObj functions refuse null arguments") {
  std::uint32_t variable = 0;
  Entry entry(CO_TUNSIGNED32, CO_OBJ_____RW, &variable);
  CO_OBJ untyped{CO_KEY(0x2000, 0, 0), nullptr, &variable};
  CO_NODE* const node = &entry.node.node;
  std::uint8_t buffer[4] = {};
  CHECK(COObjGetSize(nullptr, node, 0) == 0);
  CHECK(COObjGetSize(&entry.obj, nullptr, 0) == 0);
  CHECK(COObjGetSize(&untyped, node, 0) == 0);
  using Buffer = CO_ERR (*)(CO_OBJ*, CO_NODE*, std::uint8_t*, std::uint32_t);
  for (const Buffer function :
       {Buffer{COObjRdBufStart}, Buffer{COObjRdBufCont}, Buffer{COObjWrBufStart}, Buffer{COObjWrBufCont}}) {
    CHECK(function(nullptr, node, buffer, 4) == CO_ERR_BAD_ARG);
    CHECK(function(&entry.obj, nullptr, buffer, 4) == CO_ERR_BAD_ARG);
    CHECK(function(&entry.obj, node, nullptr, 4) == CO_ERR_BAD_ARG);
    CHECK(function(&untyped, node, buffer, 4) == CO_ERR_BAD_ARG);
  }
  using Value = CO_ERR (*)(CO_OBJ*, CO_NODE*, void*, std::uint8_t);
  for (const Value function : {Value{COObjRdValue}, Value{COObjWrValue}}) {
    CHECK(function(nullptr, node, buffer, 4) == CO_ERR_BAD_ARG);
    CHECK(function(&entry.obj, nullptr, buffer, 4) == CO_ERR_BAD_ARG);
    CHECK(function(&entry.obj, node, nullptr, 4) == CO_ERR_BAD_ARG);
    CHECK(function(&untyped, node, buffer, 4) == CO_ERR_BAD_ARG);
  }
  CHECK(COObjInit(nullptr, node) == CO_ERR_BAD_ARG);
  CHECK(COObjInit(&entry.obj, nullptr) == CO_ERR_BAD_ARG);
  CHECK(COObjInit(&untyped, node) == CO_ERR_BAD_ARG);
  CHECK(COObjReset(nullptr, node, 0) == CO_ERR_BAD_ARG);
  CHECK(COObjReset(&entry.obj, nullptr, 0) == CO_ERR_BAD_ARG);
  CHECK(COObjReset(&untyped, node, 0) == CO_ERR_BAD_ARG);
  COObjTypeUserSDOAbort(nullptr, node, 1);
  COObjTypeUserSDOAbort(&entry.obj, nullptr, 1);
  COObjTypeUserSDOAbort(&entry.obj, node, 1);
}

TEST_CASE("types: a type without functions succeeds in Init and Reset and refuses reads and writes") {
  const CO_OBJ_TYPE type = {nullptr, nullptr, nullptr, nullptr, nullptr};
  Entry entry(&type, CO_OBJ_____RW, 0);
  CHECK(COObjInit(&entry.obj, &entry.node.node) == CO_ERR_NONE);
  CHECK(COObjReset(&entry.obj, &entry.node.node, 0) == CO_ERR_NONE);
  std::uint8_t buffer[1] = {};
  CHECK(entry.read(buffer, 1) == CO_ERR_OBJ_ACC);
  CHECK(entry.write(buffer, 1) == CO_ERR_OBJ_ACC);
}

TEST_CASE("types: memory that must not be written is unchanged (Writable hook)") {
  Fixture* asked = nullptr;
  bool allow = false;
  std::uint32_t calls = 0;
  Fixture node(Setup().writable([&](const void* address, std::uint32_t size) {
    ++calls;
    const auto* byte = static_cast<const std::uint8_t*>(address);
    const auto* first = reinterpret_cast<const std::uint8_t*>(&asked->objects);
    const bool inside = byte >= first && byte + size <= first + sizeof(Objects);
    CHECK((inside || asked->objects.memory[15].data() == byte));
    return allow;
  }));
  asked = &node;
  const Bytes data{1, 0, 0, 0};
  std::uint8_t one[1] = {1};
  CHECK(CODictWrByte(&node->Dict, CO_DEV(0x2001, 0), 1) == CO_ERR_OBJ_ACC);
  CHECK(CODictWrByte(&node->Dict, CO_DEV(0x2020, 0), 1) == CO_ERR_OBJ_ACC);
  CHECK(CODictWrLong(&node->Dict, CO_DEV(0x2004, 0), 1) == CO_ERR_OBJ_ACC);
  CHECK(CODictWrWord(&node->Dict, CO_DEV(0x1017, 0), 1) == CO_ERR_OBJ_ACC);
  CHECK(CODictWrBuffer(&node->Dict, CO_DEV(0x2110, 0), one, 1) == CO_ERR_OBJ_ACC);
  CHECK(CODictWrBuffer(&node->Dict, CO_DEV(0x2111, 0), one, 1) == CO_ERR_OBJ_ACC);
  CHECK(CODictWrBuffer(&node->Dict, CO_DEV(0x2100, 15), one, 1) == CO_ERR_OBJ_ACC);
  CHECK(calls >= 7);
  CHECK(node.objects.u8 == 0x11);
  node.ask("601#2F01200001000000", "581#8001200000000106");
  node.after(100ms);
  node.silent();
  allow = true;
  node.ask("601#2F01200001000000", "581#6001200000000000");
  CHECK(node.objects.u8 == 1);
}

}  // namespace
