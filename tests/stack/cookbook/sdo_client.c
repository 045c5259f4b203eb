// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: an SDO client reads and writes objects of another node.
#include <string.h>

#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static uint32_t ClientRequest = 0x601;  // complete COB-IDs, here of node 1
static uint32_t ClientResponse = 0x581;
static uint8_t ServerNodeId = 1;

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1280, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
    {CO_KEY(0x1280, 1, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&ClientRequest)},
    {CO_KEY(0x1280, 2, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&ClientResponse)},
    {CO_KEY(0x1280, 3, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&ServerNodeId)},
};

static char Name[32];
static bool NameIsThere;
static uint8_t HeartbeatTime[2] = {0xF4, 0x01};  // 500, least significant byte first
static uint32_t LastAbort;

static void HeartbeatWritten(CO_CSDO* client, uint16_t index, uint8_t sub, uint32_t code) {
  (void)client;
  (void)index;
  (void)sub;
  LastAbort = code;
}

static void NameRead(CO_CSDO* client, uint16_t index, uint8_t sub, uint32_t code) {
  (void)index;
  (void)sub;
  LastAbort = code;
  if (code != 0) {
    return;  // aborted by the server, or no answer for 1000 ms: CO_SDO_ERR_TIMEOUT
  }
  NameIsThere = true;
  Name[COCSdoGetNum(client)] = '\0';
  (void)COCSdoRequestDownload(client, CO_DEV(0x1017, 0), HeartbeatTime, 2, HeartbeatWritten, 1000);
}

static CO_ERR ReadName(CO_NODE* node) {
  CO_CSDO* client = COCSdoFind(node, 0);  // 0: 1280h
  return COCSdoRequestUpload(client, CO_DEV(0x1008, 0), (uint8_t*)Name, sizeof(Name) - 1, NameRead, 1000);
}

void a_client_reads_and_writes_objects_of_another_node(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, ReadName(&Node));
  // The client requests 31 bytes by block transfer; the server, whose object has 4 bytes, may respond with an expedited
  // upload.
  TEST_ASSERT_EQUAL_STRING("601: A4 08 10 00 7F 1C 00 00", BenchRun(1));
  TEST_ASSERT_EQUAL_STRING("601: 2B 17 10 00 F4 01 00 00", BenchSend("581: 43 08 10 00 70 75 6D 70"));
  TEST_ASSERT_TRUE(NameIsThere);
  TEST_ASSERT_EQUAL_STRING("pump", Name);
  (void)BenchSend("581: 80 17 10 00 02 00 01 06");
  TEST_ASSERT_EQUAL_HEX32(CO_SDO_ERR_WR, LastAbort);
}

void a_client_gives_up_a_server_that_is_silent(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, ReadName(&Node));
  LastAbort = 0;
  (void)BenchRun(990);
  TEST_ASSERT_EQUAL_HEX32(0, LastAbort);
  (void)BenchRun(20);
  TEST_ASSERT_EQUAL_HEX32(CO_SDO_ERR_TIMEOUT, LastAbort);
}
