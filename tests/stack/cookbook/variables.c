// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: variables of the application, an array, and a table with an error.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static uint8_t Mode = 1;
static int16_t Temperature = -25;  // 0.1 degrees Celsius
static float Gain = 1.5f;
static uint16_t Limit[3] = {100, 200, 300};

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2000, 0, CO_OBJ_____RW), CO_VAR(UNSIGNED8, Mode)},
    {CO_KEY(0x2001, 0, CO_OBJ___APR_), CO_VAR(SIGNED16, Temperature)},
    {CO_KEY(0x2002, 0, CO_OBJ____PRW), CO_VAR(REAL32, Gain)},
    {CO_KEY(0x2003, 0, CO_OBJ_D___R_), CO_TUNSIGNED16, (CO_DATA)(8)},  // a constant
    {CO_KEY(0x2004, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},   // an array: highest sub-index
    {CO_KEY(0x2004, 1, CO_OBJ_____RW), CO_VAR(UNSIGNED16, Limit[0])},
    {CO_KEY(0x2004, 2, CO_OBJ_____RW), CO_VAR(UNSIGNED16, Limit[1])},
    {CO_KEY(0x2004, 3, CO_OBJ_____RW), CO_VAR(UNSIGNED16, Limit[2])},
};

void variables_are_read_and_written(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_STRING("585: 60 00 20 00 00 00 00 00", BenchSend("605: 2F 00 20 00 02 00 00 00"));
  TEST_ASSERT_EQUAL_UINT8(2, Mode);
  TEST_ASSERT_EQUAL_STRING("585: 4B 01 20 00 E7 FF 00 00", BenchSend("605: 40 01 20 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 43 02 20 00 00 00 C0 3F", BenchSend("605: 40 02 20 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 4B 03 20 00 08 00 00 00", BenchSend("605: 40 03 20 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 60 04 20 02 00 00 00 00", BenchSend("605: 2B 04 20 02 2C 01 00 00"));
  TEST_ASSERT_EQUAL_UINT16(300, Limit[1]);
  // 0609 0011h: sub-index does not exist
  TEST_ASSERT_EQUAL_STRING("585: 80 04 20 04 11 00 09 06", BenchSend("605: 40 04 20 04 00 00 00 00"));
}

void variables_are_used_by_the_application(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  CO_NODE* node = &Node;
  uint16_t limit = 0;
  CO_ERR error = CODictRdWord(&node->Dict, CO_DEV(0x2004, 3), &limit);
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, error);
  TEST_ASSERT_EQUAL_UINT16(300, limit);
}

void a_wrong_table_names_its_entry(void) {
  static const CO_OBJ wrong[] = {
      {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
      {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
  };
  TEST_ASSERT_EQUAL_INT(CO_ERR_DICT_INIT, BenchStart(wrong, BENCH_NUM(wrong)));
  CO_NODE* node = &Node;
  uint32_t key = 0;
  CO_DICT_FAULT fault = CODictGetFault(&node->Dict, &key);
  TEST_ASSERT_EQUAL_INT(CO_DICT_NOT_ASCENDING, fault);
  TEST_ASSERT_EQUAL_HEX32(0x100000, CO_GET_DEV(key) >> 8);
}
