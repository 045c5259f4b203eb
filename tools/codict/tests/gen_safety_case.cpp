// SPDX-License-Identifier: Apache-2.0
// Dictionaries generated from fixtures/gen/safety.eds, in C with a compressed EDS and in C++ with a plain one: the
// device's own EDS, SRDO, command line, module list, error status bits, over the bus.
#include <doctest/doctest.h>
#include <zlib.h>

#include <fstream>
#include <iterator>
#include <string>

#include "gen_node.hpp"
#include "safety_c_od.h"
#include "safety_cpp_od.h"

using test::GeneratedNode;
using test::Memory;

namespace {

CO_ERR read_module(CO_NODE* /*node*/, void* /*user*/, std::uint8_t sub_index, std::uint16_t* value) {
  *value = sub_index == 0 ? 1 : 0x1234;
  return CO_ERR_NONE;
}

void echo(CO_NODE* node, void* /*user*/, CO_OS_COMMAND* os, const std::uint8_t* command, std::uint16_t length) {
  COOsReply(os, command, length);
  COOsEnd(node, os, false);
}

std::uint8_t command[16];
std::uint8_t reply[16];
std::uint8_t out[16];
std::uint8_t err[16];

}  // namespace

extern "C" {
CO_OS_COMMAND safety_c_1023 = CO_OS_COMMAND_OF(command, reply, echo, nullptr);
CO_OS_COMMAND safety_c_1025 = CO_OS_COMMAND_OF(command, reply, nullptr, nullptr);
CO_OS_PROMPT safety_c_1026 = CO_OS_PROMPT_OF(nullptr, out, err);
const CO_MODULE_LIST safety_c_1027 = {read_module};
CO_OS_COMMAND safety_cpp_1023 = CO_OS_COMMAND_OF(command, reply, echo, nullptr);
CO_OS_COMMAND safety_cpp_1025 = CO_OS_COMMAND_OF(command, reply, nullptr, nullptr);
CO_OS_PROMPT safety_cpp_1026 = CO_OS_PROMPT_OF(nullptr, out, err);
const CO_MODULE_LIST safety_cpp_1027 = {read_module};
}

namespace {

struct Dictionary {
  const char* name;
  const CO_OBJ* od;
  std::uint16_t length;
  const char* format;  // value of 1022h
};

const Dictionary dictionaries[] = {
    {"safety_c", safety_c_od, SAFETY_C_OD_NUM, "80 00"},
    {"safety_cpp", safety_cpp_od, SAFETY_CPP_OD_NUM, "00 00"},
};

std::string eds_of(const Dictionary& dictionary) {
  std::ifstream file(std::string(LEXICAN_CODICT_GENERATED "/") + dictionary.name + ".eds", std::ios::binary);
  REQUIRE(file);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string inflated(const std::string& compressed) {
  std::string bytes(1U << 16, '\0');
  uLongf size = bytes.size();
  REQUIRE(::uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(compressed.data()),
                       compressed.size()) == Z_OK);
  bytes.resize(size);
  return bytes;
}

std::string hex_of(const std::string& bytes) {
  std::string text;
  for (const char byte : bytes) {
    const auto number = static_cast<unsigned char>(byte);
    text += text.empty() ? "" : " ";
    text += {"0123456789ABCDEF"[number >> 4], "0123456789ABCDEF"[number & 0xFU]};
  }
  return text;
}

}  // namespace

TEST_CASE("gen: the embedded EDS is uploaded segmented and by block and is the EDS of the dictionary") {
  for (const Dictionary& dictionary : dictionaries) {
    CAPTURE(dictionary.name);
    Memory memory;
    GeneratedNode node(dictionary.od, dictionary.length, memory);
    CHECK(node.fault == CO_DICT_OK);
    CHECK(node.error == CO_ERR_NONE);
    CHECK(node.read(0x1022, 0) == dictionary.format);
    const std::string bytes = node.read_block(0x1021, 0);
    const bool is_compressed = dictionary.format[0] == '8';
    CHECK((is_compressed ? inflated(bytes) : bytes) == eds_of(dictionary));
    CHECK(node.read(0x1021, 0) == hex_of(bytes));
    CHECK(node.read(0x1021, 0) == hex_of(bytes));
    CHECK(node.write(0x1021, 0, "00") == "abort 06010002");
  }
}

TEST_CASE("gen: the stack accepts the signature that is filled in and starts the SRDO") {
  for (const Dictionary& dictionary : dictionaries) {
    CAPTURE(dictionary.name);
    Memory memory;
    GeneratedNode node(dictionary.od, dictionary.length, memory);
    std::uint16_t signature = 0;
    CHECK(COSrdoSignature(&node.node, 0, &signature) == CO_ERR_NONE);
    const char bytes[] = {static_cast<char>(signature & 0xFFU), static_cast<char>(signature >> 8)};
    CHECK(node.read(0x13FF, 1) == hex_of({bytes, 2}));
    CHECK(node.read(0x13FE, 0) == "A5");
    CHECK(COSrdoGetState(&node.node, 0) == CO_SRDO_NOT_OPERATIONAL);
    node.say(0, "01 05");
    CHECK(COSrdoGetState(&node.node, 0) == CO_SRDO_INITIALISING);
    CHECK(node.sent_by([&] { COSrdoRequest(&node.node, 0); }) == "109: 00 00");
    CHECK(COSrdoGetState(&node.node, 0) == CO_SRDO_ESTABLISHED);
    CHECK(node.sent_by([&] { COGfcSend(&node.node); }).substr(0, 2) == "1:");
    // A changed parameter has another signature.
    node.say(0, "80 05");
    CHECK(node.write(0x1301, 2, "1A 00") == "ok");
    CHECK(node.read(0x13FE, 0) == "00");
    CHECK(node.write(0x13FE, 0, "A5") == "ok");
    node.say(0, "01 05");
    CHECK(COSrdoGetState(&node.node, 0) == CO_SRDO_ERR_CONFIGURATION);
  }
}

TEST_CASE("gen: status and command and module list and error bits are those of the library") {
  for (const Dictionary& dictionary : dictionaries) {
    CAPTURE(dictionary.name);
    Memory memory;
    GeneratedNode node(dictionary.od, dictionary.length, memory);
    CHECK(CONodeSetStatus(&node.node, 0x12345678) == CO_ERR_NONE);
    CHECK(node.read(0x1002, 0) == "78 56 34 12");
    CHECK(node.write(0x1023, 1, "41 42 43") == "ok");
    CHECK(node.read(0x1023, 2) == "01");
    CHECK(node.read(0x1023, 3) == "41 42 43");
    CHECK(node.write(0x1024, 0, "04") == "abort 06090030");
    CHECK(node.write(0x1025, 1, "41") == "ok");
    CHECK(node.read(0x1025, 2) == "02");
    CHECK(node.read(0x1026, 2) == "abort 08000024");
    CHECK(node.write(0x1026, 1, "41") == "abort 08000020");
    CHECK(node.read(0x1027, 0) == "01");
    CHECK(node.read(0x1027, 1) == "34 12");
    CHECK(node.read(0x2100, 0) == "00 00");
    CHECK(node.write(0x2100, 0, "01 00") == "abort 06010002");
  }
}
