// SPDX-License-Identifier: Apache-2.0
// SDO cases of CiA's conformance test tool, in its order and with its preparation. Other cases of the tool are in other
// files of this directory: the names of their tests contain the numbers of the tool.
#include "support/fixture.hpp"

namespace {

using namespace test;

// Prepares a group of tests: reset node, "load" to 1011h, reset again; no node consumes the tool's markers on 7FFh.
void prepare(Fixture& node) {
  node.rx("000#8101");
  node.tx("701#00");
  node.ask("601#231110016C6F6164", "581#8011100100000206");
  node.rx("000#8101");
  node.tx("701#00");
  node.rx("7FF#010203040506");
  node.silent();
}

TEST_CASE("CiA tool: expedited SDO transfers [SDO 01] [SDO 02] [SDO 12] [SDO 13]") {
  Fixture node;
  prepare(node);
  node.ask("601#4000100000000000", "581#4300100091010F00");
  node.ask("601#4017100000000000", "581#4B17100000000000");
  node.ask("601#2B17100000000000", "581#6017100000000000");
  node.ask("601#4000120100000000", "581#4300120101060000");
  node.ask("601#4000120200000000", "581#4300120281050000");
}

TEST_CASE("CiA tool: refused SDO accesses [SDO 03]-[SDO 11]") {
  Fixture node;
  prepare(node);
  node.ask("601#2300100000000000", "581#8000100002000106");
  node.ask("601#4030200000000000", "581#8030200001000106");
  node.ask("601#4000100100000000", "581#8000100111000906");
  node.ask("601#4004100000000000", "581#8004100000000206");
  node.ask("601#E000100000000000", "581#8000100001000405");
  node.ask("601#2301200000000000", "581#8001200012000706");
  node.ask("601#2302200000000000", "581#8002200012000706");
  node.ask("601#2F02200000000000", "581#8002200013000706");
  node.ask("601#2F04200000000000", "581#8004200013000706");
  node.ask("601#2F202000FF000000", "581#8020200030000906");
}

TEST_CASE("CiA tool: segmented SDO transfers [SDO 14]-[SDO 18]") {
  Fixture node;
  prepare(node);
  node.ask("601#2117100002000000", "581#6017100000000000");
  node.ask("601#0B00000000000000", "581#2000000000000000");
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.ask("601#6000000000000000", "581#004C65786963616E");
  node.ask("601#7000000000000000", "581#102074657374206E");
  node.ask("601#6000000000000000", "581#096F646500000000");
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.ask("601#7000000000000000", "581#8008100000000305");
}

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

TEST_CASE("CiA tool: SDO block upload of four bytes without CRC [SDO 19]") {
  Fixture node;
  prepare(node);
  node.ask("601#A000100014000000", "581#C600100004000000");
  node.ask("601#A300000000000000", "581#8191010F00000000");
  node.ask("601#A201140000000000", "581#CD00000000000000");
  node.rx("601#A100000000000000");
  node.silent();
}

TEST_CASE(
    "CiA tool: SDO, block download without and with CRC, which is 0 for the value 0 [SDO 20] [SDO 21] [SDO 24] [SDO "
    "25]") {
  for (const char* const initiate : {"601#C217100002000000", "601#C617100002000000"}) {
    Fixture node;
    prepare(node);
    node.ask(initiate, "581#A41710007F000000");
    node.ask("601#8100000000000000", "581#A2017E0000000000");
    node.ask("601#D500000000000000", "581#A100000000000000");
    node.ask("601#4017100000000000", "581#4B17100000000000");
  }
}

// The string is "Lexican test node".
TEST_CASE("CiA tool: SDO block upload of a string without and with CRC [SDO 22] [SDO 23]") {
  const std::string ends[] = {"581#D100000000000000", "581#D1C9780000000000"};
  for (const bool crc : {false, true}) {
    Fixture node;
    prepare(node);
    node.ask(crc ? "601#A408100014000000" : "601#A008100014000000", "581#C608100011000000");
    node.rx("601#A300000000000000");
    node.tx({"581#014C65786963616E", "581#022074657374206E", "581#836F646500000000"});
    node.ask("601#A203140000000000", ends[crc ? 1 : 0]);
    node.rx("601#A100000000000000");
    node.silent();
  }
}

TEST_CASE("CiA tool: SDO blocks of 128 segments and an ackseq of 128 are aborted [SDO 26] [SDO 27]") {
  Fixture node;
  prepare(node);
  node.ask("601#A008100080000000", "581#8008100002000405");
  node.ask("601#A008100014000000", "581#C608100011000000");
  node.rx("601#A300000000000000");
  node.tx({"581#014C65786963616E", "581#022074657374206E", "581#836F646500000000"});
  node.ask("601#A280140000000000", "581#8008100003000405");
}

#endif

TEST_CASE("CiA tool: a device without SDO block transfer aborts block requests [SDO 19]-[SDO 27]") {
  Fixture node(USE_SDO_BLOCK != 0 ? Setup().without_sdo_buffer() : Setup());
  prepare(node);
  node.ask("601#A000100014000000", "581#8000100001000405");
  node.ask("601#C217100002000000", "581#8017100001000405");
  node.ask("601#A008100014000000", "581#8008100001000405");
  node.ask("601#A408100014000000", "581#8008100001000405");
  node.ask("601#C617100002000000", "581#8017100001000405");
  node.ask("601#A008100080000000", "581#8008100001000405");
  node.ask("601#A208100080000000", "581#8008100001000405");
}

TEST_CASE("CiA tool: SDO servers and clients that do not exist [SDO 28]-[SDO 30]") {
  Fixture node;
  prepare(node);
  node.ask("601#407F120100000000", "581#807F120100000206");
  node.ask("601#4080120100000000", "581#8080120100000206");
  node.ask("601#40FF120100000000", "581#80FF120100000206");
}

TEST_CASE("CiA tool: random data written to every writable entry does not stop the node [State 01]") {
  Fixture node(Setup().only_small());
  for (unsigned index = 0x1000; index < 0x2000; index += index < 0x1030 ? 1 : stride(41)) {
    if (index == 0x1017) continue;
    CO_IF_FRM write = frame("601#23000000DEADBEEF");
    CO_SET_WORD(&write, index, 1);
    for (const unsigned sub : {0U, 1U, 2U, 3U, 255U}) {
      CO_SET_BYTE(&write, sub, 3);
      node.rx(write);
      CHECK(node.frames().size() == 1);
    }
  }
  prepare(node);
  node.ask("601#4000100000000000", "581#4300100091010F00");
}

}  // namespace
