// SPDX-License-Identifier: Apache-2.0
// PDOs in a dictionary as applications define it, and the PDO callbacks. Objects of more than 4 bytes are passed to the
// application's functions, if there are any.
#include <string.h>

#include "co_core.h"
#include "fakes.h"
#include "unity.h"

static uint16_t Speed;
static uint8_t State;
static uint64_t Position;
static uint32_t RpdoMap[] = {CO_LINK(0x2000, 0, 16), CO_LINK(0x2001, 0, 8)};
static uint32_t LongMap[] = {CO_LINK(0x2002, 0, 64)};

static CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_RPDO_DEFAULT(0))},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(254)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1600, 1, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&RpdoMap[0])},
    {CO_KEY(0x1600, 2, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&RpdoMap[1])},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_TPDO_DEFAULT(0))},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(254)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1A00, 1, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&LongMap[0])},
    {CO_KEY(0x2000, 0, CO_OBJ____PRW), CO_TUNSIGNED16, (CO_DATA)(&Speed)},
    {CO_KEY(0x2001, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&State)},
    {CO_KEY(0x2002, 0, CO_OBJ____PRW), CO_TUNSIGNED64, (CO_DATA)(&Position)},
};

static CO_NODE Node;

static unsigned Transmits;
static unsigned Receives;
static unsigned Updates;
static unsigned SyncUpdates;
static unsigned LongReads;
static unsigned LongWrites;
static int16_t Taken;

void COPdoTransmit(CO_IF_FRM* frm) {
  (void)frm;
  Transmits++;
}

int16_t COPdoReceive(CO_IF_FRM* frm) {
  (void)frm;
  Receives++;
  return Taken;
}

void COPdoUpdate(CO_RPDO* pdo) {
  TEST_ASSERT_TRUE(pdo == &Node.RPdo[0]);
  Updates++;
}

void COPdoSyncUpdate(CO_RPDO* pdo) {
  (void)pdo;
  SyncUpdates++;
}

void COTpdoReadData(CO_IF_FRM* frm, uint8_t pos, uint8_t size, CO_OBJ* obj) {
  TEST_ASSERT_EQUAL_UINT8(0, pos);
  TEST_ASSERT_EQUAL_UINT8(8, size);
  TEST_ASSERT_TRUE(obj == CODictFind(&Node.Dict, CO_DEV(0x2002, 0)));
  memcpy(&frm->Data[pos], "readings", size);
  LongReads++;
}

void CORpdoWriteData(CO_IF_FRM* frm, uint8_t pos, uint8_t size, CO_OBJ* obj) {
  TEST_ASSERT_EQUAL_UINT8(0, pos);
  TEST_ASSERT_EQUAL_UINT8(8, size);
  TEST_ASSERT_TRUE(obj == CODictFind(&Node.Dict, CO_DEV(0x2002, 0)));
  TEST_ASSERT_EQUAL_HEX8(0x11, frm->Data[0]);
  TEST_ASSERT_EQUAL_HEX8(0x88, frm->Data[7]);
  LongWrites++;
}

void setUp(void) {
  Speed = 0;
  State = 0;
  Position = 0;
  Transmits = Receives = Updates = SyncUpdates = LongReads = LongWrites = 0;
  Taken = 0;
  RpdoMap[0] = CO_LINK(0x2000, 0, 16);
  NodeUp(&Node, Dictionary, sizeof(Dictionary) / sizeof(Dictionary[0]));
  BusReceive(&Node, "000#0100");
}

static void test_plain_numbers_configure_pdos(void) {
  BusReceive(&Node, "201#341256");
  TEST_ASSERT_EQUAL_HEX16(0x1234, Speed);
  TEST_ASSERT_EQUAL_HEX8(0x56, State);
  TEST_ASSERT_EQUAL_UINT32(1, Receives);
  TEST_ASSERT_EQUAL_UINT32(1, Updates);
  TEST_ASSERT_EQUAL_UINT32(0, SyncUpdates);
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CONodeGetErr(&Node));
}

static void test_the_application_takes_a_frame(void) {
  Taken = 1;
  BusReceive(&Node, "201#341256");
  TEST_ASSERT_EQUAL_HEX16(0, Speed);
  TEST_ASSERT_EQUAL_UINT32(1, Receives);
  TEST_ASSERT_EQUAL_UINT32(0, Updates);
}

static void test_objects_of_more_than_4_bytes_are_sent_by_the_application(void) {
  COTPdoTrigPdo(Node.TPdo, 0);
  TEST_ASSERT_SENT("181#72656164696E6773");
  TEST_ASSERT_EQUAL_UINT32(1, LongReads);
  TEST_ASSERT_EQUAL_UINT32(1, Transmits);
}

static void test_objects_of_more_than_4_bytes_are_received_by_the_application(void) {
  RpdoMap[0] = CO_LINK(0x2002, 0, 64);
  Dictionary[7].Data = (CO_DATA)(1);
  BusReceive(&Node, "000#8200");
  TEST_ASSERT_SENT("701#00");
  BusReceive(&Node, "000#0100");
  BusReceive(&Node, "201#1122334455667788");
  Dictionary[7].Data = (CO_DATA)(2);
  TEST_ASSERT_EQUAL_UINT32(1, LongWrites);
  TEST_ASSERT_TRUE(Position == 0);
}

static void test_identifiers_of_the_macros(void) {
  TEST_ASSERT_EQUAL_HEX32(0x00000201, CO_COBID_RPDO_STD(1, 0x201));
  TEST_ASSERT_EQUAL_HEX32(0x80000201, CO_COBID_RPDO_STD(0, 0x201));
  TEST_ASSERT_EQUAL_HEX32(0x32345678, CO_COBID_RPDO_EXT(1, 0x12345678));
  TEST_ASSERT_EQUAL_HEX32(0x40000181, CO_COBID_TPDO_STD(1, 0x181));
  TEST_ASSERT_EQUAL_HEX32(0xC0000181, CO_COBID_TPDO_STD(0, 0x181));
  TEST_ASSERT_EQUAL_HEX32(0x72345678, CO_COBID_TPDO_EXT(1, 0x12345678));
  TEST_ASSERT_EQUAL_HEX32(0x200, CO_COBID_RPDO_DEFAULT(0));
  TEST_ASSERT_EQUAL_HEX32(0x500, CO_COBID_RPDO_DEFAULT(3));
  TEST_ASSERT_EQUAL_HEX32(0x40000180, CO_COBID_TPDO_DEFAULT(0));
  TEST_ASSERT_EQUAL_HEX32(0x40000480, CO_COBID_TPDO_DEFAULT(3));
  TEST_ASSERT_EQUAL_HEX32(0x40000080, CO_COBID_SYNC_STD(1, 0x80));
  TEST_ASSERT_EQUAL_HEX32(0x20000080, CO_COBID_SYNC_EXT(0, 0x80));
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_plain_numbers_configure_pdos);
  RUN_TEST(test_the_application_takes_a_frame);
  RUN_TEST(test_objects_of_more_than_4_bytes_are_sent_by_the_application);
  RUN_TEST(test_objects_of_more_than_4_bytes_are_received_by_the_application);
  RUN_TEST(test_identifiers_of_the_macros);
  return UNITY_END();
}
