// SPDX-License-Identifier: Apache-2.0
// Emergencies of firmware: an error table, a history, COEmcySet() and related functions, and the callback of the
// consumer.
#include <string.h>

#include "co_core.h"
#include "fakes.h"
#include "unity.h"

/* errors of the application */
enum EMCY_CODES {
  APP_ERR_ID_SOMETHING = 0, /* identifier of an error in the table */
  APP_ERR_ID_HOT,
  APP_ERR_ID_HOW_TO_CONTINUE,

  APP_ERR_ID_NUM /* number of errors */
};

static CO_EMCY_TBL AppEmcyTbl[CO_EMCY_N] = {
    {CO_EMCY_REG_GENERAL, CO_EMCY_CODE_GEN_ERR},          /* APP_ERR_ID_SOMETHING */
    {CO_EMCY_REG_TEMP, CO_EMCY_CODE_TEMP_AMBIENT_ERR},    /* APP_ERR_ID_HOT */
    {CO_EMCY_REG_MANUFACTURER, CO_EMCY_CODE_SW_USER_ERR}, /* APP_ERR_ID_HOW_TO_CONTINUE */
};

static uint8_t Obj1001_00_08 = 0;
static uint8_t Obj1003_00_08 = 0;
static uint32_t Obj1003_01_20[4] = {0, 0, 0, 0};
static uint32_t Obj1014_00_20 = CO_COBID_EMCY_STD(1, 0x80);
static uint16_t Obj1015_00_10 = 0;

static CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&Obj1001_00_08)},
    {CO_KEY(0x1003, 0, CO_OBJ_____RW), CO_TEMCY_HIST, (CO_DATA)(&Obj1003_00_08)},
    {CO_KEY(0x1003, 1, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&Obj1003_01_20[0])},
    {CO_KEY(0x1003, 2, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&Obj1003_01_20[1])},
    {CO_KEY(0x1003, 3, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&Obj1003_01_20[2])},
    {CO_KEY(0x1003, 4, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&Obj1003_01_20[3])},
    {CO_KEY(0x1014, 0, CO_OBJ__N__RW), CO_TEMCY_ID, (CO_DATA)(&Obj1014_00_20)},
    {CO_KEY(0x1015, 0, CO_OBJ_____RW), CO_TUNSIGNED16, (CO_DATA)(&Obj1015_00_10)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
#if CO_EMCY_CONS_N > 1
    {CO_KEY(0x1028, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1028, 2, CO_OBJ_D___R_), CO_TEMCY_CONS, (CO_DATA)(CO_COBID_EMCY_STD(1, 0x82))},
#endif
    {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_SDO_REQUEST())},
    {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_SDO_RESPONSE())},
    CO_OBJ_DICT_ENDMARK,
};

static CO_IF_DRV Drivers = {&FakeCanDriver, &FakeCyclicTimerDriver, NULL};
static CO_NODE Node;

static uint8_t HeardFrom;
static uint16_t HeardCode;
static uint8_t HeardRegister;
static uint8_t HeardBytes[5];

void COEmcyReceived(CO_NODE* node, uint8_t nodeId, uint16_t code, uint8_t reg, const uint8_t msef[5]) {
  TEST_ASSERT_TRUE(node == &Node);
  HeardFrom = nodeId;
  HeardCode = code;
  HeardRegister = reg;
  memcpy(HeardBytes, msef, sizeof(HeardBytes));
}

static void Start(CO_EMCY_TBL* errors) {
  CO_NODE_SPEC spec = {0x05, 250000, NULL, 0, NULL, NULL, 0, 1000, NULL, NULL};
  spec.Dict = &Dictionary[0];
  spec.DictLen = (uint16_t)(sizeof(Dictionary) / sizeof(Dictionary[0]));
  spec.EmcyCode = errors;
  spec.Drv = &Drivers;
  CONodeInit(&Node, &spec);
  TEST_ASSERT_EQUAL_HEX32(CO_ERR_NONE, CONodeGetErr(&Node));
  CONodeStart(&Node);
  TEST_ASSERT_SENT("705#00");
  CONmtSetMode(&Node.Nmt, CO_OPERATIONAL);
}

void setUp(void) {
  FakesReset();
  memset(&Node, 0xA5, sizeof(Node));
  HeardFrom = 0;
  Obj1001_00_08 = 0;
  Obj1014_00_20 = CO_COBID_EMCY_STD(1, 0x80);
  Obj1015_00_10 = 0;
  Start(AppEmcyTbl);
}

static void test_an_error_is_set_and_cleared(void) {
  COEmcySet(&Node.Emcy, APP_ERR_ID_HOT, NULL);
  TEST_ASSERT_SENT("085#0041090000000000");
  TEST_ASSERT_EQUAL_HEX8(0x09, Obj1001_00_08);
  TEST_ASSERT_EQUAL(1, COEmcyGet(&Node.Emcy, APP_ERR_ID_HOT));
  TEST_ASSERT_EQUAL(0, COEmcyGet(&Node.Emcy, APP_ERR_ID_SOMETHING));
  TEST_ASSERT_EQUAL(1, COEmcyCnt(&Node.Emcy));
  COEmcySet(&Node.Emcy, APP_ERR_ID_HOT, NULL);
  TEST_ASSERT_SENT("");
  COEmcyClr(&Node.Emcy, APP_ERR_ID_HOT);
  TEST_ASSERT_SENT("085#0000000000000000");
  TEST_ASSERT_EQUAL(0, COEmcyGet(&Node.Emcy, APP_ERR_ID_HOT));
  TEST_ASSERT_EQUAL_HEX8(0x00, Obj1001_00_08);
}

static void test_the_user_adds_bytes_and_a_history_word(void) {
  CO_EMCY_USR usr;
  usr.Hist = 0x1234;
  for (uint8_t n = 0; n < 5; n++) {
    usr.Emcy[n] = (uint8_t)(n + 1);
  }
  COEmcySet(&Node.Emcy, APP_ERR_ID_HOW_TO_CONTINUE, &usr);
  TEST_ASSERT_SENT("085#0062810102030405");
  uint32_t entry = 0;
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdLong(&Node.Dict, CO_DEV(0x1003, 1), &entry));
  TEST_ASSERT_EQUAL_HEX32(0x12346200, entry);
  TEST_ASSERT_EQUAL(CO_ERR_TYPE_RD, CODictRdLong(&Node.Dict, CO_DEV(0x1003, 2), &entry));
  BusReceive(&Node, "605#4003100100000000");
  TEST_ASSERT_SENT("585#4303100100623412");
  BusReceive(&Node, "605#4003100200000000");
  TEST_ASSERT_SENT("585#8003100224000008");
}

static void test_the_history_is_cleared_by_the_application_and_by_the_network(void) {
  uint8_t number = 0;
  COEmcySet(&Node.Emcy, APP_ERR_ID_HOT, NULL);
  COEmcySet(&Node.Emcy, APP_ERR_ID_SOMETHING, NULL);
  TEST_ASSERT_SENT("085#0041090000000000");
  TEST_ASSERT_SENT("085#0010090000000000");
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdByte(&Node.Dict, CO_DEV(0x1003, 0), &number));
  TEST_ASSERT_EQUAL(2, number);
  COEmcyHistReset(&Node.Emcy);
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdByte(&Node.Dict, CO_DEV(0x1003, 0), &number));
  TEST_ASSERT_EQUAL(0, number);
  COEmcyClr(&Node.Emcy, APP_ERR_ID_HOT);
  COEmcySet(&Node.Emcy, APP_ERR_ID_HOT, NULL);
  TEST_ASSERT_SENT("085#0000010000000000");
  TEST_ASSERT_SENT("085#0041090000000000");
  BusReceive(&Node, "605#2F03100000000000");
  TEST_ASSERT_SENT("585#6003100000000000");
  BusReceive(&Node, "605#4003100100000000");
  TEST_ASSERT_SENT("585#8003100124000008");
}

static void test_all_errors_are_reset_with_and_without_messages(void) {
  COEmcySet(&Node.Emcy, APP_ERR_ID_HOT, NULL);
  COEmcySet(&Node.Emcy, APP_ERR_ID_SOMETHING, NULL);
  TEST_ASSERT_SENT("085#0041090000000000");
  TEST_ASSERT_SENT("085#0010090000000000");
  TEST_ASSERT_EQUAL(2, COEmcyCnt(&Node.Emcy));
  COEmcyReset(&Node.Emcy, 0);
  TEST_ASSERT_SENT("085#0000090000000000");
  TEST_ASSERT_SENT("085#0000000000000000");
  TEST_ASSERT_EQUAL(0, COEmcyCnt(&Node.Emcy));
  COEmcySet(&Node.Emcy, APP_ERR_ID_HOT, NULL);
  TEST_ASSERT_SENT("085#0041090000000000");
  COEmcyReset(&Node.Emcy, 1);
  TEST_ASSERT_SENT("");
  TEST_ASSERT_EQUAL_HEX8(0x00, Obj1001_00_08);
}

static void test_identifiers_beyond_the_table_are_refused(void) {
  COEmcySet(&Node.Emcy, (uint8_t)(CO_EMCY_N - 1), NULL);
  TEST_ASSERT_SENT("085#0000010000000000");
#if CO_EMCY_N < 256
  COEmcySet(&Node.Emcy, (uint8_t)CO_EMCY_N, NULL);
  TEST_ASSERT_EQUAL_HEX32(CO_ERR_BAD_ARG, CONodeGetErr(&Node));
  TEST_ASSERT_EQUAL(-1, COEmcyGet(&Node.Emcy, (uint8_t)CO_EMCY_N));
#endif
  TEST_ASSERT_SENT("");
  TEST_ASSERT_EQUAL(1, COEmcyCnt(&Node.Emcy));
  TEST_ASSERT_EQUAL(-1, COEmcyGet(NULL, 0));
  TEST_ASSERT_EQUAL(-1, COEmcyCnt(NULL));
}

static void test_a_firmware_without_errors_needs_no_table(void) {
  Start(NULL);
  COEmcySet(&Node.Emcy, 0, NULL);
  TEST_ASSERT_EQUAL_HEX32(CO_ERR_EMCY_BAD_ROOT, CONodeGetErr(&Node));
  TEST_ASSERT_SENT("");
}

static void test_the_inhibit_time_holds_messages_back(void) {
  BusReceive(&Node, "605#2B15100064000000");
  TEST_ASSERT_SENT("585#6015100000000000");
  COEmcySet(&Node.Emcy, APP_ERR_ID_HOT, NULL);
  COEmcyClr(&Node.Emcy, APP_ERR_ID_HOT);
#if CO_EMCY_QUEUE_N > 0
  TEST_ASSERT_SENT("085#0041090000000000");
  TimePasses(&Node, 9);
  TEST_ASSERT_SENT("");
  TimePasses(&Node, 1);
  TEST_ASSERT_SENT("085#0000000000000000");
#else
  TEST_ASSERT_SENT("085#0041090000000000");
  TEST_ASSERT_SENT("085#0000000000000000");
#endif
}

static void test_the_network_switches_the_emcy_off(void) {
  BusReceive(&Node, "605#2314100085000080");
  TEST_ASSERT_SENT("585#6014100000000000");
  TEST_ASSERT_EQUAL_HEX32(CO_COBID_EMCY_STD(0, 0x80), Obj1014_00_20);
  COEmcySet(&Node.Emcy, APP_ERR_ID_HOT, NULL);
  TEST_ASSERT_SENT("");
  TEST_ASSERT_EQUAL_HEX8(0x09, Obj1001_00_08);
}

static void test_messages_of_another_node_come_to_the_callback(void) {
  BusReceive(&Node, "082#3081110007000102");
#if CO_EMCY_CONS_N > 1
  const uint8_t bytes[5] = {0, 7, 0, 1, 2};
  TEST_ASSERT_EQUAL(2, HeardFrom);
  TEST_ASSERT_EQUAL_HEX16(CO_EMCY_CODE_MON_COM_HEARTBEAT_ERR, HeardCode);
  TEST_ASSERT_EQUAL_HEX8(0x11, HeardRegister);
  TEST_ASSERT_EQUAL(0, memcmp(bytes, HeardBytes, sizeof(bytes)));
#else
  TEST_ASSERT_EQUAL(0, HeardFrom);
#endif
}

static void test_macros(void) {
  TEST_ASSERT_EQUAL_HEX32(0x00000081, CO_COBID_EMCY_STD(1, 0x81));
  TEST_ASSERT_EQUAL_HEX32(0x80000081, CO_COBID_EMCY_STD(0, 0xF881));
  TEST_ASSERT_EQUAL_HEX32(0x32345678, CO_COBID_EMCY_EXT(1, 0x12345678));
  TEST_ASSERT_EQUAL_HEX32(0xB2345678, CO_COBID_EMCY_EXT(0, 0xF2345678));
  TEST_ASSERT_EQUAL_HEX32(0x80000000, CO_EMCY_COBID_OFF);
  TEST_ASSERT_EQUAL_HEX32(0x20000000, CO_EMCY_COBID_EXT);
  TEST_ASSERT_EQUAL_HEX32(0x1FFFFFFF, CO_EMCY_COBID_MASK);
  TEST_ASSERT_EQUAL(1 + (CO_EMCY_N - 1) / 8, CO_EMCY_STORAGE);
  const uint8_t bits[] = {CO_EMCY_REG_GENERAL, CO_EMCY_REG_CURRENT, CO_EMCY_REG_VOLTAGE,      CO_EMCY_REG_TEMP,
                          CO_EMCY_REG_COM,     CO_EMCY_REG_PROFILE, CO_EMCY_REG_MANUFACTURER, CO_EMCY_REG_NUM};
  const uint8_t numbers[] = {0, 1, 2, 3, 4, 5, 7, 8};
  TEST_ASSERT_EQUAL(0, memcmp(numbers, bits, sizeof(bits)));
}

static void test_error_codes(void) {
  const uint16_t codes[] = {
      CO_EMCY_CODE_NO_ERR,
      CO_EMCY_CODE_GEN_ERR,
      CO_EMCY_CODE_CUR_ERR,
      CO_EMCY_CODE_CUR_INPUT_ERR,
      CO_EMCY_CODE_CUR_INTERN_ERR,
      CO_EMCY_CODE_CUR_OUTPUT_ERR,
      CO_EMCY_CODE_VOL_ERR,
      CO_EMCY_CODE_VOL_INPUT_ERR,
      CO_EMCY_CODE_VOL_INTERN_ERR,
      CO_EMCY_CODE_VOL_OUTPUT_ERR,
      CO_EMCY_CODE_TEMP_ERR,
      CO_EMCY_CODE_TEMP_AMBIENT_ERR,
      CO_EMCY_CODE_TEMP_DEVICE_ERR,
      CO_EMCY_CODE_HW_ERR,
      CO_EMCY_CODE_SW_ERR,
      CO_EMCY_CODE_SW_INTERNAL_ERR,
      CO_EMCY_CODE_SW_USER_ERR,
      CO_EMCY_CODE_SW_DATASET_ERR,
      CO_EMCY_CODE_ADD_MODULES_ERR,
      CO_EMCY_CODE_MON_ERR,
      CO_EMCY_CODE_MON_COM_ERR,
      CO_EMCY_CODE_MON_COM_OVERRUN_ERR,
      CO_EMCY_CODE_MON_COM_PASSIVE_ERR,
      CO_EMCY_CODE_MON_COM_HEARTBEAT_ERR,
      CO_EMCY_CODE_MON_COM_RECOVER_ERR,
      CO_EMCY_CODE_MON_COM_COLLISION_ERR,
      CO_EMCY_CODE_MON_PROT_ERR,
      CO_EMCY_CODE_MON_PROT_PDO_IGN_ERR,
      CO_EMCY_CODE_MON_PROT_PDO_LEN_ERR,
      CO_EMCY_CODE_EXT_ERR,
      CO_EMCY_CODE_ADD_FUNC_ERR,
      CO_EMCY_CODE_DEV_ERR,
  };
  const uint16_t numbers[] = {0x0000, 0x1000, 0x2000, 0x2100, 0x2200, 0x2300, 0x3000, 0x3100, 0x3200, 0x3300, 0x4000,
                              0x4100, 0x4200, 0x5000, 0x6000, 0x6100, 0x6200, 0x6300, 0x7000, 0x8000, 0x8100, 0x8110,
                              0x8120, 0x8130, 0x8140, 0x8150, 0x8200, 0x8210, 0x8220, 0x9000, 0xF000, 0xFF00};
  TEST_ASSERT_EQUAL(0, memcmp(numbers, codes, sizeof(codes)));
  TEST_ASSERT_EQUAL(sizeof(numbers), sizeof(codes));
}

static void test_the_structures_are_filled_by_position(void) {
  const CO_EMCY_TBL error = {CO_EMCY_REG_COM, 0x8100};
  const CO_EMCY_USR usr = {0x1234, {1, 2, 3, 4, 5}};
  TEST_ASSERT_EQUAL(4, error.Reg);
  TEST_ASSERT_EQUAL_HEX16(0x8100, error.Code);
  TEST_ASSERT_EQUAL_HEX16(0x1234, usr.Hist);
  TEST_ASSERT_EQUAL(5, usr.Emcy[4]);
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_an_error_is_set_and_cleared);
  RUN_TEST(test_the_user_adds_bytes_and_a_history_word);
  RUN_TEST(test_the_history_is_cleared_by_the_application_and_by_the_network);
  RUN_TEST(test_all_errors_are_reset_with_and_without_messages);
  RUN_TEST(test_identifiers_beyond_the_table_are_refused);
  RUN_TEST(test_a_firmware_without_errors_needs_no_table);
  RUN_TEST(test_the_inhibit_time_holds_messages_back);
  RUN_TEST(test_the_network_switches_the_emcy_off);
  RUN_TEST(test_messages_of_another_node_come_to_the_callback);
  RUN_TEST(test_macros);
  RUN_TEST(test_error_codes);
  RUN_TEST(test_the_structures_are_filled_by_position);
  return UNITY_END();
}
