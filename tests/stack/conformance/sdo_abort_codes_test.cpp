// SPDX-License-Identifier: Apache-2.0
// SDO server: object types can return each of the 31 abort codes in each kind of upload and download, and each error
// code of a type function is converted to an abort code. [301:7.2.4.3.17]
#include <cstring>
#include <iterator>

#include "support/fixture.hpp"

namespace {

using namespace test;

// Abort codes in bus order: low byte first.
const char* const codes[] = {
    "00000305", "00000405", "01000405", "02000405", "03000405", "04000405", "05000405", "00000106",
    "01000106", "02000106", "00000206", "41000406", "42000406", "43000406", "47000406", "00000606",
    "10000706", "12000706", "13000706", "11000906", "30000906", "31000906", "32000906", "36000906",
    "23000A06", "00000008", "20000008", "21000008", "22000008", "23000008", "24000008",
};

struct Script {
  std::uint32_t size;
  std::uint32_t abort;  // argument of COObjTypeUserSDOAbort(); 0: it is not called
  CO_ERR error;
  unsigned good_calls;  // calls of Read and Write with a length that succeed before one fails
} script;

uint32_t scripted_size(CO_OBJ*, CO_NODE*, uint32_t) { return script.size; }
CO_ERR scripted(CO_OBJ* obj, CO_NODE* node, uint32_t size) {
  if (size == 0) {
    return CO_ERR_NONE;
  }
  if (script.good_calls > 0) {
    --script.good_calls;
    return CO_ERR_NONE;
  }
  if (script.abort != 0) {
    COObjTypeUserSDOAbort(obj, node, script.abort);
  }
  return script.error;
}
CO_ERR scripted_read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  std::memset(buffer, 0x55, size);
  return scripted(obj, node, size);
}
CO_ERR scripted_write(CO_OBJ* obj, CO_NODE* node, void*, uint32_t size) { return scripted(obj, node, size); }
CO_ERR scripted_reset(CO_OBJ*, CO_NODE*, uint32_t) { return CO_ERR_NONE; }

const CO_OBJ_TYPE value_type = {scripted_size, nullptr, scripted_read, scripted_write, nullptr};
const CO_OBJ_TYPE stream_type = {scripted_size, nullptr, scripted_read, scripted_write, scripted_reset};
const CO_OBJ_TYPE stream_without_size = {nullptr, nullptr, scripted_read, scripted_write, scripted_reset};

Setup scripted_setup() {
  return Setup()
      .only_small()
      .with({CO_KEY(0x3000, 0, CO_OBJ_____RW), &value_type, 0})
      .with({CO_KEY(0x3001, 0, CO_OBJ_____RW), &stream_type, 0})
      .with({CO_KEY(0x3002, 0, CO_OBJ_____RW), &stream_without_size, 0});
}

// Runs each kind of transfer until the type function fails, and checks the abort code.
void check_refusals(Fixture& node, const Script& how, const std::string& code) {
  const auto with_size = [&](std::uint32_t size, unsigned good_calls = 0) {
    script = how;
    script.size = size;
    script.good_calls = good_calls;
  };
  const std::string value = "581#80003000" + code;
  const std::string stream = "581#80013000" + code;
  with_size(4);
  node.ask("601#4000300000000000", value);
  node.ask("601#2300300001020304", value);
  node.ask("601#4001300000000000", stream);
  node.ask("601#2301300001020304", stream);
  with_size(8);
  node.ask("601#4000300000000000", value);
  node.ask("601#2100300008000000", "581#6000300000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#1D08000000000000", value);
  with_size(20);
  node.ask("601#4001300000000000", "581#4101300014000000");
  node.ask("601#6000000000000000", stream);
  with_size(20, 1);
  node.ask("601#4001300000000000", "581#4101300014000000");
  node.ask("601#6000000000000000", "581#0055555555555555");
  node.ask("601#7000000000000000", stream);
  with_size(20);
  node.ask("601#2101300014000000", "581#6001300000000000");
  node.ask("601#0001020304050607", stream);
  with_size(20, 2);
  node.ask("601#2101300014000000", "581#6001300000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#1001020304050607", "581#3000000000000000");
  node.ask("601#0301020304050600", stream);
  node.ask("601#E0AABBCC00000000", "581#80AABBCC01000405");
}

TEST_CASE("SDO abort codes: COObjTypeUserSDOAbort sends each of 31, expedited and segmented, in both directions") {
  CHECK(std::size(codes) == 31);
  for (const std::string code : codes) {
    CAPTURE(code);
    Fixture node(scripted_setup());
    const CO_IF_FRM bytes = frame("000#" + code);
    const std::uint32_t number = CO_GET_LONG(&bytes, 0);
    check_refusals(node, {0, number, CO_ERR_TYPE_WR, 0}, code);
    check_refusals(node, {0, number, CO_ERR_OBJ_RANGE, 0}, code);
  }
}

TEST_CASE("SDO abort codes: each error code is sent as its abort code, expedited and segmented, in both directions") {
  struct Row {
    CO_ERR error;
    const char* code;
  };
  const Row rows[] = {
      {CO_ERR_OBJ_ACC, "00000106"},          {CO_ERR_OBJ_NOT_FOUND, "00000206"}, {CO_ERR_OBJ_MAP_TYPE, "41000406"},
      {CO_ERR_OBJ_MAP_LEN, "42000406"},      {CO_ERR_BAD_ARG, "47000406"},       {CO_ERR_OBJ_SIZE, "10000706"},
      {CO_ERR_OBJ_INCOMPATIBLE, "43000406"}, {CO_ERR_IF_NVM_INIT, "00000606"},   {CO_ERR_IF_NVM_READ, "00000606"},
      {CO_ERR_IF_NVM_WRITE, "00000606"},     {CO_ERR_PARA_IDX, "00000606"},      {CO_ERR_PARA_STORE, "00000606"},
      {CO_ERR_PARA_RESTORE, "00000606"},     {CO_ERR_PARA_LOAD, "00000606"},     {CO_ERR_OBJ_RANGE, "30000906"},
      {CO_ERR_TYPE_RD, "20000008"},          {CO_ERR_TYPE_WR, "20000008"},       {CO_ERR_OBJ_STATE, "22000008"},
      {CO_ERR_OBJ_NO_DATA, "24000008"},      {CO_ERR_OBJ_RANGE_LOW, "32000906"}, {CO_ERR_PARA_OVERLAP, "00000606"},
  };
  for (int number = CO_ERR_BASE; number <= CO_ERR_NODE_SDO_BUF; ++number) {
    const auto error = static_cast<CO_ERR>(number);
    std::string code = "00000008";
    for (const Row& row : rows) {
      if (row.error == error) code = row.code;
    }
    CAPTURE(number);
    Fixture node(scripted_setup());
    check_refusals(node, {0, 0, error, 0}, code);
  }
}

TEST_CASE("SDO abort 0800 0020h: a stream without Size function refuses every transfer") {
  Fixture node(scripted_setup());
  script = {};
  for (const char* request : {"601#4002300000000000", "601#2302300001020304", "601#2202300001020304",
                              "601#2F02300001000000", "601#2102300014000000", "601#2002300000000000"}) {
    CAPTURE(std::string(request));
    node.ask(request, "581#8002300020000008");
    node.ask("601#0011223300000000", "581#8011223301000405");
    node.ask("601#6011223300000000", "581#8011223301000405");
  }
}

}  // namespace
