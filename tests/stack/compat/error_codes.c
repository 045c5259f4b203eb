// SPDX-License-Identifier: Apache-2.0
// Checks the numbers and names of the error codes, which firmware logs and tools interpret.
#include <string.h>

#include "co_err.h"
#include "unity.h"

#define ROW(code, number) \
  { code, number, #code }

static const struct {
  CO_ERR Code;
  unsigned Number;
  const char* Name;
} Expected[] = {
    ROW(CO_ERR_NONE, 0x000),
    ROW(CO_ERR_BAD_ARG, 0x100),
    ROW(CO_ERR_OBJ_NOT_FOUND, 0x101),
    ROW(CO_ERR_OBJ_READ, 0x102),
    ROW(CO_ERR_OBJ_WRITE, 0x103),
    ROW(CO_ERR_OBJ_SIZE, 0x104),
    ROW(CO_ERR_OBJ_INIT, 0x105),
    ROW(CO_ERR_OBJ_MAP_LEN, 0x106),
    ROW(CO_ERR_OBJ_MAP_TYPE, 0x107),
    ROW(CO_ERR_OBJ_ACC, 0x108),
    ROW(CO_ERR_OBJ_RANGE, 0x109),
    ROW(CO_ERR_OBJ_INCOMPATIBLE, 0x10A),
    ROW(CO_ERR_DICT_INIT, 0x10B),
    ROW(CO_ERR_PARA_IDX, 0x10C),
    ROW(CO_ERR_PARA_STORE, 0x10D),
    ROW(CO_ERR_PARA_RESTORE, 0x10E),
    ROW(CO_ERR_PARA_LOAD, 0x10F),
    ROW(CO_ERR_LSS_STORE, 0x110),
    ROW(CO_ERR_LSS_LOAD, 0x111),
    ROW(CO_ERR_CFG_1001_0, 0x112),
    ROW(CO_ERR_CFG_1003_0, 0x113),
    ROW(CO_ERR_CFG_1003_1, 0x114),
    ROW(CO_ERR_CFG_1005_0, 0x115),
    ROW(CO_ERR_CFG_1006_0, 0x116),
    ROW(CO_ERR_CFG_1010_0, 0x117),
    ROW(CO_ERR_CFG_1011_0, 0x118),
    ROW(CO_ERR_CFG_1014_0, 0x119),
    ROW(CO_ERR_CFG_1017_0, 0x11A),
    ROW(CO_ERR_CFG_1016, 0x11B),
    ROW(CO_ERR_CFG_1018, 0x11C),
    ROW(CO_ERR_TMR_NO_ACT, 0x11D),
    ROW(CO_ERR_TMR_INSERT, 0x11E),
    ROW(CO_ERR_TMR_CREATE, 0x11F),
    ROW(CO_ERR_TMR_DELETE, 0x120),
    ROW(CO_ERR_NMT_INIT, 0x121),
    ROW(CO_ERR_NMT_APP_RESET, 0x122),
    ROW(CO_ERR_NMT_COM_RESET, 0x123),
    ROW(CO_ERR_NMT_MODE, 0x124),
    ROW(CO_ERR_EMCY_BAD_ROOT, 0x125),
    ROW(CO_ERR_TPDO_COM_OBJ, 0x126),
    ROW(CO_ERR_TPDO_MAP_OBJ, 0x127),
    ROW(CO_ERR_TPDO_OBJ_TRIGGER, 0x128),
    ROW(CO_ERR_TPDO_NUM_TRIGGER, 0x129),
    ROW(CO_ERR_TPDO_INHIBIT, 0x12A),
    ROW(CO_ERR_TPDO_EVENT, 0x12B),
    ROW(CO_ERR_RPDO_COM_OBJ, 0x12C),
    ROW(CO_ERR_RPDO_MAP_OBJ, 0x12D),
    ROW(CO_ERR_SDO_SILENT, 0x12E),
    ROW(CO_ERR_SDO_OFF, 0x12F),
    ROW(CO_ERR_SDO_BUSY, 0x130),
    ROW(CO_ERR_SDO_ABORT, 0x131),
    ROW(CO_ERR_SDO_READ, 0x132),
    ROW(CO_ERR_SDO_WRITE, 0x133),
    ROW(CO_ERR_SYNC_MSG, 0x134),
    ROW(CO_ERR_SYNC_RES, 0x135),
    ROW(CO_ERR_IF_CAN_INIT, 0x136),
    ROW(CO_ERR_IF_CAN_ENABLE, 0x137),
    ROW(CO_ERR_IF_CAN_FLUSH_RX, 0x138),
    ROW(CO_ERR_IF_CAN_FLUSH_TX, 0x139),
    ROW(CO_ERR_IF_CAN_RESET, 0x13A),
    ROW(CO_ERR_IF_CAN_CLOSE, 0x13B),
    ROW(CO_ERR_IF_CAN_READ, 0x13C),
    ROW(CO_ERR_IF_CAN_SEND, 0x13D),
    ROW(CO_ERR_IF_TIMER_INIT, 0x13E),
    ROW(CO_ERR_IF_TIMER_UPDATE, 0x13F),
    ROW(CO_ERR_IF_TIMER_RELOAD, 0x140),
    ROW(CO_ERR_IF_TIMER_DELAY, 0x141),
    ROW(CO_ERR_IF_TIMER_STOP, 0x142),
    ROW(CO_ERR_IF_TIMER_START, 0x143),
    ROW(CO_ERR_IF_NVM_INIT, 0x144),
    ROW(CO_ERR_IF_NVM_READ, 0x145),
    ROW(CO_ERR_IF_NVM_WRITE, 0x146),
    ROW(CO_ERR_SIG_INIT, 0x147),
    ROW(CO_ERR_SIG_CREATE, 0x148),
    ROW(CO_ERR_MSG_INIT, 0x149),
    ROW(CO_ERR_MSG_CREATE, 0x14A),
    ROW(CO_ERR_MSG_READ, 0x14B),
    ROW(CO_ERR_TYPE_INIT, 0x14C),
    ROW(CO_ERR_TYPE_RD, 0x14D),
    ROW(CO_ERR_TYPE_WR, 0x14E),
    ROW(CO_ERR_TYPE_RESET, 0x14F),
    // codes that CANopen-Stack does not have
    ROW(CO_ERR_OBJ_STATE, 0x150),
    ROW(CO_ERR_OBJ_NO_DATA, 0x151),
    ROW(CO_ERR_LSS_BUSY, 0x152),
    ROW(CO_ERR_LSS_NO_STORE, 0x153),
    ROW(CO_ERR_TYPE_AGAIN, 0x154),
    ROW(CO_ERR_NODE_EXT, 0x155),
    ROW(CO_ERR_NODE_CAN, 0x156),
    ROW(CO_ERR_NODE_TIMER, 0x157),
    ROW(CO_ERR_NODE_TMR_FREQ, 0x158),
    ROW(CO_ERR_NODE_ID, 0x159),
    ROW(CO_ERR_NODE_DICT, 0x15A),
    ROW(CO_ERR_PARA_OVERLAP, 0x15B),
    ROW(CO_ERR_OBJ_RANGE_LOW, 0x15C),
    ROW(CO_ERR_NODE_SDO_BUF, 0x15D),
    ROW(CO_ERR_NODE_ID_TWICE, 0x15E),
    ROW(CO_ERR_DICT_BUSY, 0x15F),
};

#define EXPECTED_NUM (sizeof(Expected) / sizeof(Expected[0]))

static void test_each_error_code_has_its_number(void) {
  for (unsigned i = 0; i < EXPECTED_NUM; i++) {
    TEST_ASSERT_EQUAL_HEX32(Expected[i].Number, Expected[i].Code);
  }
}

static void test_each_error_code_has_its_name(void) {
  for (unsigned i = 0; i < EXPECTED_NUM; i++) {
    TEST_ASSERT_EQUAL_STRING(Expected[i].Name, COErrName(Expected[i].Code));
  }
}

static void test_each_error_code_has_a_meaning(void) {
  for (unsigned i = 0; i < EXPECTED_NUM; i++) {
    TEST_ASSERT_NOT_EQUAL(0, strcmp("unknown error", COErrText(Expected[i].Code)));
  }
}

// Fails if a code was added to co_err.h and not to the table above.
static void test_no_other_number_is_an_error_code(void) {
  const unsigned beyond = Expected[EXPECTED_NUM - 1].Number + 1;
  TEST_ASSERT_EQUAL_STRING("unknown error", COErrName((CO_ERR)beyond));
  TEST_ASSERT_EQUAL_STRING("unknown error", COErrText((CO_ERR)beyond));
}

static void test_the_numbers_begin_at_the_base(void) {
  TEST_ASSERT_EQUAL_HEX32(0x100, CO_ERR_BASE);
  TEST_ASSERT_EQUAL_HEX32(CO_ERR_BASE, CO_ERR_BAD_ARG);
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_each_error_code_has_its_number);
  RUN_TEST(test_each_error_code_has_its_name);
  RUN_TEST(test_each_error_code_has_a_meaning);
  RUN_TEST(test_no_other_number_is_an_error_code);
  RUN_TEST(test_the_numbers_begin_at_the_base);
  return UNITY_END();
}
