// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>
#include <vector>

#include "support/fixture.hpp"

namespace {

using namespace test;

CO_OBJ byte_at(std::uint32_t dev, std::uintptr_t value) { return CO_OBJ{dev | CO_OBJ_D___RW, CO_TUNSIGNED8, value}; }

// Returns the key of entry \a n: 4 entries for each index, with every second sub-index.
std::uint32_t nth_dev(std::uint32_t n) { return CO_DEV(0x2000 + n / 4, 2 * (n % 4) + 1); }

std::vector<CO_OBJ> table_of(std::uint32_t number) {
  std::vector<CO_OBJ> table;
  for (std::uint32_t n = 0; n < number; ++n) {
    table.push_back(byte_at(nth_dev(n), n & 0xFF));
  }
  return table;
}

CO_NODE* some_node() {
  static CO_NODE node;
  return &node;
}

unsigned wrong_results(CO_DICT& dict, std::vector<CO_OBJ>& table, std::uint32_t step) {
  unsigned wrong = 0;
  for (std::uint32_t n = 0; n < table.size(); n += step) {
    const std::uint32_t dev = CO_GET_DEV(table[n].Key);
    wrong += CODictFind(&dict, dev) == &table[n] ? 0U : 1U;
    wrong += CODictFind(&dict, dev - 0x100) == nullptr ? 0U : 1U;
    wrong += CODictFind(&dict, dev + 0x100) == nullptr ? 0U : 1U;
    wrong += CODictFind(&dict, dev | 0xFF) == &table[n] ? 0U : 1U;
  }
  return wrong;
}

TEST_CASE("dictionary: each entry is found and each gap is not, in tables of every size") {
  for (const std::uint32_t size : {1U, 2U, 3U, 4U, 5U, 7U, 8U, 31U, 32U, 33U, 511U, 512U, 513U, 65534U}) {
    for (const bool end_mark : {true, false}) {
      CAPTURE(size);
      CAPTURE(end_mark);
      std::vector<CO_OBJ> table = table_of(size);
      if (end_mark) table.push_back(CO_OBJ CO_OBJ_DICT_ENDMARK);
      CO_DICT dict;
      std::memset(static_cast<void*>(&dict), 0xA5, sizeof dict);
      REQUIRE(CODictInit(&dict, some_node(), table.data(), static_cast<std::uint16_t>(table.size())) ==
              static_cast<std::int16_t>(size < 32767U ? size : 32767U));
      CHECK(dict.Num == size);
      if (end_mark) table.pop_back();
      CHECK(wrong_results(dict, table, size > 1000 ? stride(101) : 1) == 0);
      CHECK(wrong_results(dict, table, size / 3 + 1) == 0);
      CHECK(CODictFind(&dict, 0) == nullptr);
      CHECK(CODictFind(&dict, 0xFF) == nullptr);
      CHECK(CODictFind(&dict, CO_DEV(0x0001, 0)) == nullptr);
      CHECK(CODictFind(&dict, CO_DEV(0xFFFF, 0xFF)) == nullptr);
    }
  }
}

TEST_CASE("dictionary: 65535 entries without end mark are found, including the first and last key") {
  std::vector<CO_OBJ> table = table_of(65534);
  table.push_back(byte_at(CO_DEV(0xFFFF, 0xFE), 1));
  CO_DICT dict;
  REQUIRE(CODictInit(&dict, some_node(), table.data(), 65535) == 32767);  // INT16_MAX
  CHECK(dict.Num == 65535);
  unsigned wrong = 0;
  for (CO_OBJ& obj : table) wrong += CODictFind(&dict, CO_GET_DEV(obj.Key)) == &obj ? 0U : 1U;
  for (std::size_t n = table.size(); n > 0; --n) {
    wrong += CODictFind(&dict, CO_GET_DEV(table[n - 1].Key)) == &table[n - 1] ? 0U : 1U;
  }
  CHECK(wrong == 0);
  CHECK(CODictFind(&dict, CO_DEV(0xFFFF, 0xFF)) == nullptr);
}

TEST_CASE("dictionary: a lookup does not depend on the previous one, for all pairs") {
  std::vector<CO_OBJ> table = table_of(9);
  CO_DICT dict;
  REQUIRE(CODictInit(&dict, some_node(), table.data(), 9) == 9);
  for (CO_OBJ& first : table) {
    for (CO_OBJ& second : table) {
      CHECK(CODictFind(&dict, first.Key) == &first);
      CHECK(CODictFind(&dict, second.Key) == &second);
      CHECK(CODictFind(&dict, CO_GET_DEV(second.Key) + 0x100) == nullptr);
    }
  }
}

TEST_CASE("dictionary: an empty table is legal and finds nothing") {
  CO_OBJ table[2] = {CO_OBJ_DICT_ENDMARK, byte_at(CO_DEV(0x2000, 0), 1)};
  CO_DICT dict;
  CHECK(CODictInit(&dict, some_node(), table, 2) == 0);
  CHECK(dict.Num == 0);
  CHECK(CODictFind(&dict, CO_DEV(0x2000, 0)) == nullptr);
  CHECK(CODictFind(&dict, 0) == nullptr);
  CHECK(CODictObjInit(&dict, some_node()) == CO_ERR_NONE);
}

TEST_CASE("dictionary: entries behind the end mark are ignored") {
  CO_OBJ table[3] = {byte_at(CO_DEV(0x2000, 0), 1), CO_OBJ_DICT_ENDMARK, byte_at(CO_DEV(0x2001, 0), 1)};
  CO_DICT dict;
  REQUIRE(CODictInit(&dict, some_node(), table, 3) == 1);
  CHECK(CODictFind(&dict, CO_DEV(0x2000, 0)) == &table[0]);
  CHECK(CODictFind(&dict, CO_DEV(0x2001, 0)) == nullptr);
}

TEST_CASE("dictionary: arguments without a table are refused") {
  CO_OBJ table[1] = {CO_OBJ_DICT_ENDMARK};
  CO_DICT dict;
  CHECK(CODictInit(nullptr, some_node(), table, 1) == -1);
  CHECK(CODictInit(&dict, nullptr, table, 1) == -1);
  CHECK(CODictInit(&dict, some_node(), nullptr, 1) == -1);
  CHECK(CODictInit(&dict, some_node(), table, 0) == -1);
  CHECK(CODictFind(nullptr, CO_DEV(0x2000, 0)) == nullptr);
  CHECK(CODictObjInit(nullptr, some_node()) == CO_ERR_BAD_ARG);
  CHECK(CODictObjInit(&dict, nullptr) == CO_ERR_BAD_ARG);
  CHECK(CODictGetFault(nullptr, nullptr) == CO_DICT_OK);
}

TEST_CASE("dictionary: entries added to and removed from a table in RAM are used after CODictInit [OD]") {
  Fixture node;
  CO_OBJ table[4] = {byte_at(CO_DEV(0x2000, 0), 1), byte_at(CO_DEV(0x2002, 0), 3), CO_OBJ_DICT_ENDMARK,
                     CO_OBJ_DICT_ENDMARK};
  REQUIRE(CODictInit(&node->Dict, &node.node, table, 4) == 2);
  node.ask("601#4001200000000000", "581#8001200000000206");
  table[2] = table[1];
  table[1] = byte_at(CO_DEV(0x2001, 0), 2);
  REQUIRE(CODictInit(&node->Dict, &node.node, table, 4) == 3);
  node.ask("601#4001200000000000", "581#4F01200002000000");
  node.ask("601#4002200000000000", "581#4F02200003000000");
  table[1] = table[2];
  table[2] = CO_OBJ CO_OBJ_DICT_ENDMARK;
  REQUIRE(CODictInit(&node->Dict, &node.node, table, 4) == 2);
  node.ask("601#4001200000000000", "581#8001200000000206");
}

TEST_CASE("dictionary: a transfer whose entry was moved is aborted at its next frame") {
  std::uint64_t value = 0x0807060504030201;
  CO_OBJ before[2] = {{CO_KEY(0x2008, 0, CO_OBJ_____RW), CO_TUNSIGNED64, &value}, CO_OBJ_DICT_ENDMARK};
  CO_OBJ after[3] = {
      byte_at(CO_DEV(0x2000, 0), 1), {CO_KEY(0x2008, 0, CO_OBJ_____RW), CO_TUNSIGNED64, &value}, CO_OBJ_DICT_ENDMARK};
  Fixture node;
  REQUIRE(CODictInit(&node->Dict, &node.node, before, 2) == 1);
  node.ask("601#2108200008000000", "581#6008200000000000");
  REQUIRE(CODictInit(&node->Dict, &node.node, after, 3) == 2);
  node.rx("601#0011121314151617");
  const std::vector<std::string> sent = node.frames();
  REQUIRE(sent.size() == 1);
  CHECK(sent[0].substr(0, 12) == "581#80082000");
  CHECK(value == 0x0807060504030201);
}

std::uint32_t variable;

#if USE_DICT_CHECK

struct Faulty {
  CO_OBJ entry;
  CO_DICT_FAULT fault;
};

CO_DICT_FAULT fault_of_node_with(CO_OBJ entry, std::uint32_t& key, CO_ERR& error) {
  Fixture node(Setup().with(entry).stay_in_init());
  error = node.error();
  return CODictGetFault(&node->Dict, &key);
}

TEST_CASE("dictionary: a fault of an entry is reported with its key") {
  const Faulty rows[] = {
      {{CO_KEY(0x0000, 1, CO_OBJ_D___R_), CO_TUNSIGNED8, 1}, CO_DICT_RESERVED_INDEX},
      {{CO_KEY(0x0005, 0, CO_OBJ_____R_), CO_TUNSIGNED8, &variable}, CO_DICT_RESERVED_INDEX},
      {{CO_KEY(0x4000, 0, CO_OBJ_____R_), nullptr, &variable}, CO_DICT_NO_TYPE},
      {{CO_KEY(0x12FF, 1, CO_OBJ_____R_), CO_TSDO_ID, &variable}, CO_DICT_NOT_CONFIGURED},
      {{CO_KEY(0x4000, 0, CO_OBJ_____R_), CO_TUNSIGNED32, nullptr}, CO_DICT_NO_DATA},
      {{CO_KEY(0x4000, 0, CO_OBJ_____R_), CO_TUNSIGNED24, nullptr}, CO_DICT_NO_DATA},
      {{CO_KEY(0x4000, 0, CO_OBJ_____R_), CO_TBOOLEAN, nullptr}, CO_DICT_NO_DATA},
      {{CO_KEY(0x4000, 0, CO_OBJ_____R_), CO_TREAL64, nullptr}, CO_DICT_NO_DATA},
      {{CO_KEY(0x4000, 0, CO_OBJ_____R_), CO_TDOMAIN, nullptr}, CO_DICT_NO_DATA},
      {{CO_KEY(0x4000, 0, CO_OBJ_____R_), CO_TSTRING, nullptr}, CO_DICT_NO_DATA},
      {{CO_KEY(0x4000, 0, CO_OBJ_____R_), CO_TVISIBLE_STRING, nullptr}, CO_DICT_NO_DATA},
      {{CO_KEY(0x4000, 0, CO_OBJ_____R_), CO_TTIME_OF_DAY, nullptr}, CO_DICT_NO_DATA},
      {{CO_KEY(0x4000, 0, CO_OBJ_D___R_), CO_TREAL32, 1}, CO_DICT_DIRECT_TYPE},
      {{CO_KEY(0x4000, 0, CO_OBJ_D___R_), CO_TDOMAIN, 1}, CO_DICT_DIRECT_TYPE},
      {{CO_KEY(0x4000, 0, CO_OBJ_D___R_), CO_TSTRING, 1}, CO_DICT_DIRECT_TYPE},
      {{CO_KEY(0x4000, 0, CO_OBJ_D___R_), CO_TTIME_OF_DAY, 1}, CO_DICT_DIRECT_TYPE},
      {{CO_KEY(0x4000, 0, CO_OBJ__N__R_), CO_TREAL32, &variable}, CO_DICT_NODEID_TYPE},
      {{CO_KEY(0x4000, 0, CO_OBJ__N__R_), CO_TBOOLEAN, &variable}, CO_DICT_NODEID_TYPE},
      {{CO_KEY(0x1018, 5, CO_OBJ_____R_), CO_THB_PROD, &variable}, CO_DICT_WRONG_PLACE},
      {{CO_KEY(0x1017, 1, CO_OBJ_____R_), CO_THB_PROD, &variable}, CO_DICT_WRONG_PLACE},
      {{CO_KEY(0x1200, 3, CO_OBJ_____R_), CO_TSDO_ID, &variable}, CO_DICT_WRONG_PLACE},
      {{CO_KEY(0x4000, 1, CO_OBJ_____R_), CO_TSDO_ID, &variable}, CO_DICT_WRONG_PLACE},
  };
  for (const Faulty& row : rows) {
    CAPTURE(row.fault);
    CAPTURE(row.entry.Key);
    std::uint32_t key = 0;
    CO_ERR error = CO_ERR_NONE;
    const bool of_data = row.fault == CO_DICT_RESERVED_INDEX && CO_GET_IDX(row.entry.Key) != 0;
    const bool runs = row.fault == CO_DICT_NO_DATA || row.fault == CO_DICT_NODEID_TYPE || of_data;
    CHECK(fault_of_node_with(row.entry, key, error) == row.fault);
    CHECK(key == row.entry.Key);
    CHECK(error == (runs ? CO_ERR_OBJ_INIT : CO_ERR_DICT_INIT));
  }
}

TEST_CASE("dictionary: unordered and duplicate entries are reported") {
  CO_DICT dict;
  std::uint32_t key = 0;
  CO_OBJ swapped[3] = {byte_at(CO_DEV(0x2001, 0), 1), byte_at(CO_DEV(0x2003, 0), 1), byte_at(CO_DEV(0x2002, 0), 1)};
  CHECK(CODictInit(&dict, some_node(), swapped, 3) == -1);
  CHECK(CODictGetFault(&dict, &key) == CO_DICT_NOT_ASCENDING);
  CHECK(key == CO_KEY(0x2002, 0, CO_OBJ_D___RW));
  CHECK(CODictFind(&dict, CO_DEV(0x2001, 0)) == nullptr);
  CO_OBJ doubled[2] = {byte_at(CO_DEV(0x2001, 1), 1), byte_at(CO_DEV(0x2001, 1), 1)};
  doubled[1].Key |= CO_OBJ____P__;
  CHECK(CODictInit(&dict, some_node(), doubled, 2) == -1);
  CHECK(CODictGetFault(&dict, &key) == CO_DICT_NOT_ASCENDING);
  CHECK(key == doubled[1].Key);
  CHECK(CODictGetFault(&dict, nullptr) == CO_DICT_NOT_ASCENDING);
  CHECK(CODictInit(&dict, some_node(), doubled, 1) == 1);
  CHECK(CODictGetFault(&dict, &key) == CO_DICT_OK);
}

TEST_CASE("dictionary: a node with a faulty one does not start") {
  Fixture node(Setup().with({CO_KEY(0x4000, 0, CO_OBJ_____R_), nullptr, 1}).stay_in_init());
  CHECK(node.mode() == CO_INVALID);
  node.call([&] { CONodeStart(&node.node); });
  node.silent();
  CHECK(node.mode() == CO_INVALID);
}

#else

TEST_CASE("dictionary: without USE_DICT_CHECK one in the wrong order is used, and the fault is found when asked for") {
  CO_DICT dict;
  std::uint32_t key = 1;
  CO_OBJ table[4] = {byte_at(CO_DEV(0x2001, 0), 1), byte_at(CO_DEV(0x2002, 0), 1), byte_at(CO_DEV(0x2002, 0), 1),
                     CO_OBJ_DICT_ENDMARK};
  CHECK(CODictInit(&dict, some_node(), table, 3) == 3);
  CHECK(CODictGetFault(&dict, &key) == CO_DICT_NOT_ASCENDING);
  CHECK(CO_GET_DEV(key) == CO_DEV(0x2002, 0));
  CHECK(CODictFind(&dict, CO_DEV(0x2000, 0)) == nullptr);
  CHECK(CODictFind(&dict, CO_DEV(0xFFFF, 0xFF)) == nullptr);
  CHECK(CODictInit(&dict, some_node(), table + 3, 1) == 0);
  CHECK(CODictGetFault(&dict, &key) == CO_DICT_OK);
  CHECK(key == 0);
  CHECK(CODictInit(&dict, some_node(), table, 2) == 2);
  CHECK(CODictGetFault(&dict, &key) == CO_DICT_OK);
}

#endif

TEST_CASE("dictionary: a table in read-only memory works") {
  static const CO_OBJ table[] = {
      {CO_KEY(0x2000, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 7},
      {CO_KEY(0x2001, 0, CO_OBJ_____RW), CO_TUNSIGNED32, &variable},
  };
  Fixture node;
  REQUIRE(CODictInit(&node->Dict, &node.node, const_cast<CO_OBJ*>(table), 2) == 2);
  node.ask("601#4000200000000000", "581#4F00200007000000");
  node.ask("601#2301200001020304", "581#6001200000000000");
  CHECK(variable == 0x04030201);
}

TEST_CASE("dictionary: Init of every entry runs once, from the first to the last; the last error is returned") {
  static std::vector<std::uint32_t> inits;
  static CO_ERR answer;
  const auto init = [](CO_OBJ* obj, CO_NODE*) -> CO_ERR {
    inits.push_back(obj->Key);
    return CO_GET_SUB(obj->Key) == 1 ? answer : CO_ERR_NONE;
  };
  const CO_OBJ_TYPE type = {nullptr, init, nullptr, nullptr, nullptr};
  CO_OBJ table[3] = {
      {CO_KEY(0x2000, 0, 0), &type, 0}, {CO_KEY(0x2000, 1, 0), &type, 0}, {CO_KEY(0x2001, 0, 0), &type, 0}};
  CO_DICT dict;
  inits.clear();
  answer = CO_ERR_NONE;
  REQUIRE(CODictInit(&dict, some_node(), table, 3) == 3);
  CHECK(CODictObjInit(&dict, some_node()) == CO_ERR_NONE);
  CHECK(inits == std::vector<std::uint32_t>{table[0].Key, table[1].Key, table[2].Key});
  answer = CO_ERR_TYPE_INIT;
  CHECK(CODictObjInit(&dict, some_node()) == CO_ERR_TYPE_INIT);
  CHECK(inits.size() == 6);
}

TEST_CASE("dictionary: values of one, two and four bytes are accessed, with every error") {
  Fixture node;
  CO_DICT* const dict = &node->Dict;
  std::uint8_t byte = 0;
  std::uint16_t word = 0;
  std::uint32_t value = 0;
  CHECK(CODictRdByte(dict, CO_DEV(0x2001, 0), &byte) == CO_ERR_NONE);
  CHECK(byte == 0x11);
  CHECK(CODictRdWord(dict, CO_DEV(0x2002, 0), &word) == CO_ERR_NONE);
  CHECK(word == 0x2211);
  CHECK(CODictRdLong(dict, CO_DEV(0x2004, 0), &value) == CO_ERR_NONE);
  CHECK(value == 0x44332211);
  CHECK(CODictWrByte(dict, CO_DEV(0x2001, 0), 0xA1) == CO_ERR_NONE);
  CHECK(node.objects.u8 == 0xA1);
  CHECK(CODictWrWord(dict, CO_DEV(0x2002, 0), 0xA2A1) == CO_ERR_NONE);
  CHECK(node.objects.u16 == 0xA2A1);
  CHECK(CODictWrLong(dict, CO_DEV(0x2004, 0), 0xA4A3A2A1) == CO_ERR_NONE);
  CHECK(node.objects.u32 == 0xA4A3A2A1);

  CHECK(CODictRdByte(dict, CO_DEV(0x2004, 0), &byte) == CO_ERR_OBJ_SIZE);
  CHECK(CODictRdWord(dict, CO_DEV(0x2004, 0), &word) == CO_ERR_OBJ_SIZE);
  CHECK(CODictRdLong(dict, CO_DEV(0x2001, 0), &value) == CO_ERR_OBJ_SIZE);
  CHECK(CODictWrByte(dict, CO_DEV(0x2004, 0), 1) == CO_ERR_OBJ_SIZE);
  CHECK(CODictWrWord(dict, CO_DEV(0x2001, 0), 1) == CO_ERR_OBJ_SIZE);
  CHECK(CODictWrLong(dict, CO_DEV(0x2002, 0), 1) == CO_ERR_OBJ_SIZE);
  CHECK(CODictRdByte(dict, CO_DEV(0x2FFF, 0), &byte) == CO_ERR_OBJ_NOT_FOUND);
  CHECK(CODictRdWord(dict, CO_DEV(0x2FFF, 0), &word) == CO_ERR_OBJ_NOT_FOUND);
  CHECK(CODictRdLong(dict, CO_DEV(0x2FFF, 0), &value) == CO_ERR_OBJ_NOT_FOUND);
  CHECK(CODictWrByte(dict, CO_DEV(0x2FFF, 0), 1) == CO_ERR_OBJ_NOT_FOUND);
  CHECK(CODictWrWord(dict, CO_DEV(0x2FFF, 0), 1) == CO_ERR_OBJ_NOT_FOUND);
  CHECK(CODictWrLong(dict, CO_DEV(0x2FFF, 0), 1) == CO_ERR_OBJ_NOT_FOUND);
  CHECK(CODictRdByte(dict, CO_DEV(0x2001, 0), nullptr) == CO_ERR_BAD_ARG);
  CHECK(CODictRdWord(dict, CO_DEV(0x2002, 0), nullptr) == CO_ERR_BAD_ARG);
  CHECK(CODictRdLong(dict, CO_DEV(0x2004, 0), nullptr) == CO_ERR_BAD_ARG);
  CHECK(CODictRdByte(nullptr, CO_DEV(0x2001, 0), &byte) == CO_ERR_BAD_ARG);
  CHECK(CODictRdWord(nullptr, CO_DEV(0x2002, 0), &word) == CO_ERR_BAD_ARG);
  CHECK(CODictRdLong(nullptr, CO_DEV(0x2004, 0), &value) == CO_ERR_BAD_ARG);
  CHECK(CODictWrByte(nullptr, CO_DEV(0x2001, 0), 1) == CO_ERR_BAD_ARG);
  CHECK(CODictWrWord(nullptr, CO_DEV(0x2002, 0), 1) == CO_ERR_BAD_ARG);
  CHECK(CODictWrLong(nullptr, CO_DEV(0x2004, 0), 1) == CO_ERR_BAD_ARG);
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("dictionary: the access rights of the network do not limit the application") {
  Fixture node;
  std::uint32_t value = 0;
  CHECK(CODictRdLong(&node->Dict, CO_DEV(0x2030, 0), &value) == CO_ERR_NONE);
  CHECK(CODictWrLong(&node->Dict, CO_DEV(0x2031, 0), 5) == CO_ERR_NONE);
  CHECK(node.objects.read_only == 5);
  CHECK(CODictWrLong(&node->Dict, CO_DEV(0x2032, 0), 6) == CO_ERR_NONE);
  CHECK(node.objects.no_access == 6);
}

TEST_CASE("dictionary: a type without Read or Write function refuses the access") {
  const auto four = [](CO_OBJ*, CO_NODE*, std::uint32_t) -> std::uint32_t { return 4; };
  const CO_OBJ_TYPE type = {four, nullptr, nullptr, nullptr, nullptr};
  const CO_OBJ_TYPE empty = {nullptr, nullptr, nullptr, nullptr, nullptr};
  Fixture node(
      Setup().with({CO_KEY(0x4000, 0, CO_OBJ_____RW), &type, 0}).with({CO_KEY(0x4001, 0, CO_OBJ_____RW), &empty, 0}));
  std::uint32_t value = 0;
  std::uint8_t buffer[4];
  CHECK(CODictRdLong(&node->Dict, CO_DEV(0x4000, 0), &value) == CO_ERR_OBJ_ACC);
  CHECK(CODictWrLong(&node->Dict, CO_DEV(0x4000, 0), 1) == CO_ERR_OBJ_ACC);
  CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x4000, 0), buffer, 4) == CO_ERR_OBJ_ACC);
  CHECK(CODictWrBuffer(&node->Dict, CO_DEV(0x4000, 0), buffer, 4) == CO_ERR_OBJ_ACC);
  CHECK(CODictRdLong(&node->Dict, CO_DEV(0x4001, 0), &value) == CO_ERR_OBJ_SIZE);
}

TEST_CASE("dictionary: buffers of any length are accessed from the beginning of the object") {
  Fixture node(Setup().with_70000());
  for (const std::uint32_t length : {1U, 255U, 256U, 257U, 512U, 889U, 65536U, 70000U}) {
    CAPTURE(length);
    Bytes in(length);
    for (std::uint32_t i = 0; i < length; ++i) in[i] = static_cast<std::uint8_t>(i * 7 + length);
    Bytes out(length);
    CHECK(CODictWrBuffer(&node->Dict, CO_DEV(0x2102, 0), in.data(), length) == CO_ERR_NONE);
    CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x2102, 0), out.data(), length) == CO_ERR_NONE);
    CHECK(in == out);
    CHECK(std::equal(in.begin(), in.end(), node.objects.memory[70000].begin()));
  }
}

TEST_CASE("dictionary: a buffer longer than the stream is unchanged behind the data") {
  Fixture node;
  Bytes out(20, 0xEE);
  CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x100A, 0), out.data(), 20) == CO_ERR_NONE);
  CHECK(out[0] == '1');
  CHECK(out[2] == '0');
  CHECK(out[3] == 0xEE);
}

TEST_CASE("dictionary: buffers and values are accessed, with every error") {
  Fixture node;
  std::uint8_t buffer[8] = {1, 2, 3, 4};
  CHECK(CODictWrBuffer(&node->Dict, CO_DEV(0x2004, 0), buffer, 4) == CO_ERR_NONE);
  CHECK(std::memcmp(&node.objects.u32, buffer, 4) == 0);  // values have the byte order of the CPU
  CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x2004, 0), buffer + 1, 4) == CO_ERR_NONE);
  CHECK(buffer[4] == 4);
  CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x2004, 0), buffer, 3) == CO_ERR_BAD_ARG);
  CHECK(CODictWrBuffer(&node->Dict, CO_DEV(0x2004, 0), buffer, 5) == CO_ERR_BAD_ARG);
  CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x2FFF, 0), buffer, 4) == CO_ERR_OBJ_NOT_FOUND);
  CHECK(CODictWrBuffer(&node->Dict, CO_DEV(0x2FFF, 0), buffer, 4) == CO_ERR_OBJ_NOT_FOUND);
  CHECK(CODictRdBuffer(nullptr, CO_DEV(0x2004, 0), buffer, 4) == CO_ERR_BAD_ARG);
  CHECK(CODictWrBuffer(nullptr, CO_DEV(0x2004, 0), buffer, 4) == CO_ERR_BAD_ARG);
  CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x2004, 0), nullptr, 4) == CO_ERR_BAD_ARG);
  CHECK(CODictWrBuffer(&node->Dict, CO_DEV(0x2004, 0), nullptr, 4) == CO_ERR_BAD_ARG);
}

}  // namespace
