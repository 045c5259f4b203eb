// SPDX-License-Identifier: Apache-2.0
// Error codes have fixed numbers: firmware logs them, and tools know them.
#include "co_err.h"
#include "unity.h"

static const struct {
  CO_ERR Code;
  unsigned Number;
} Expected[] = {
    {CO_ERR_NONE, 0x000},
    {CO_ERR_BAD_ARG, 0x100},
    {CO_ERR_OBJ_NOT_FOUND, 0x101},
    {CO_ERR_OBJ_READ, 0x102},
    {CO_ERR_OBJ_WRITE, 0x103},
    {CO_ERR_OBJ_SIZE, 0x104},
    {CO_ERR_OBJ_INIT, 0x105},
    {CO_ERR_OBJ_MAP_LEN, 0x106},
    {CO_ERR_OBJ_MAP_TYPE, 0x107},
    {CO_ERR_OBJ_ACC, 0x108},
    {CO_ERR_OBJ_RANGE, 0x109},
    {CO_ERR_OBJ_INCOMPATIBLE, 0x10A},
    {CO_ERR_DICT_INIT, 0x10B},
    {CO_ERR_PARA_IDX, 0x10C},
    {CO_ERR_PARA_STORE, 0x10D},
    {CO_ERR_PARA_RESTORE, 0x10E},
    {CO_ERR_PARA_LOAD, 0x10F},
    {CO_ERR_LSS_STORE, 0x110},
    {CO_ERR_LSS_LOAD, 0x111},
    {CO_ERR_CFG_1001_0, 0x112},
    {CO_ERR_CFG_1003_0, 0x113},
    {CO_ERR_CFG_1003_1, 0x114},
    {CO_ERR_CFG_1005_0, 0x115},
    {CO_ERR_CFG_1006_0, 0x116},
    {CO_ERR_CFG_1010_0, 0x117},
    {CO_ERR_CFG_1011_0, 0x118},
    {CO_ERR_CFG_1014_0, 0x119},
    {CO_ERR_CFG_1017_0, 0x11A},
    {CO_ERR_CFG_1016, 0x11B},
    {CO_ERR_CFG_1018, 0x11C},
    {CO_ERR_TMR_NO_ACT, 0x11D},
    {CO_ERR_TMR_INSERT, 0x11E},
    {CO_ERR_TMR_CREATE, 0x11F},
    {CO_ERR_TMR_DELETE, 0x120},
    {CO_ERR_NMT_INIT, 0x121},
    {CO_ERR_NMT_APP_RESET, 0x122},
    {CO_ERR_NMT_COM_RESET, 0x123},
    {CO_ERR_NMT_MODE, 0x124},
    {CO_ERR_EMCY_BAD_ROOT, 0x125},
    {CO_ERR_TPDO_COM_OBJ, 0x126},
    {CO_ERR_TPDO_MAP_OBJ, 0x127},
    {CO_ERR_TPDO_OBJ_TRIGGER, 0x128},
    {CO_ERR_TPDO_NUM_TRIGGER, 0x129},
    {CO_ERR_TPDO_INHIBIT, 0x12A},
    {CO_ERR_TPDO_EVENT, 0x12B},
    {CO_ERR_RPDO_COM_OBJ, 0x12C},
    {CO_ERR_RPDO_MAP_OBJ, 0x12D},
    {CO_ERR_SDO_SILENT, 0x12E},
    {CO_ERR_SDO_OFF, 0x12F},
    {CO_ERR_SDO_BUSY, 0x130},
    {CO_ERR_SDO_ABORT, 0x131},
    {CO_ERR_SDO_READ, 0x132},
    {CO_ERR_SDO_WRITE, 0x133},
    {CO_ERR_SYNC_MSG, 0x134},
    {CO_ERR_SYNC_RES, 0x135},
    {CO_ERR_IF_CAN_INIT, 0x136},
    {CO_ERR_IF_CAN_ENABLE, 0x137},
    {CO_ERR_IF_CAN_FLUSH_RX, 0x138},
    {CO_ERR_IF_CAN_FLUSH_TX, 0x139},
    {CO_ERR_IF_CAN_RESET, 0x13A},
    {CO_ERR_IF_CAN_CLOSE, 0x13B},
    {CO_ERR_IF_CAN_READ, 0x13C},
    {CO_ERR_IF_CAN_SEND, 0x13D},
    {CO_ERR_IF_TIMER_INIT, 0x13E},
    {CO_ERR_IF_TIMER_UPDATE, 0x13F},
    {CO_ERR_IF_TIMER_RELOAD, 0x140},
    {CO_ERR_IF_TIMER_DELAY, 0x141},
    {CO_ERR_IF_TIMER_STOP, 0x142},
    {CO_ERR_IF_TIMER_START, 0x143},
    {CO_ERR_IF_NVM_INIT, 0x144},
    {CO_ERR_IF_NVM_READ, 0x145},
    {CO_ERR_IF_NVM_WRITE, 0x146},
    {CO_ERR_SIG_INIT, 0x147},
    {CO_ERR_SIG_CREATE, 0x148},
    {CO_ERR_MSG_INIT, 0x149},
    {CO_ERR_MSG_CREATE, 0x14A},
    {CO_ERR_MSG_READ, 0x14B},
    {CO_ERR_TYPE_INIT, 0x14C},
    {CO_ERR_TYPE_RD, 0x14D},
    {CO_ERR_TYPE_WR, 0x14E},
    {CO_ERR_TYPE_RESET, 0x14F},
};

#define EXPECTED_NUM (sizeof(Expected) / sizeof(Expected[0]))

static void test_each_error_code_has_its_number(void) {
  for (unsigned i = 0; i < EXPECTED_NUM; i++) {
    TEST_ASSERT_EQUAL_HEX32(Expected[i].Number, Expected[i].Code);
  }
}

static void test_new_error_codes_follow_the_old_ones(void) {
  TEST_ASSERT_EQUAL_HEX32(0x150, CO_ERR_OBJ_STATE);
  TEST_ASSERT_EQUAL_HEX32(0x151, CO_ERR_OBJ_NO_DATA);
  TEST_ASSERT_EQUAL_HEX32(0x155, CO_ERR_NODE_EXT);
  TEST_ASSERT_EQUAL_HEX32(0x15A, CO_ERR_NODE_DICT);
}

static void test_the_numbers_begin_at_the_base(void) {
  TEST_ASSERT_EQUAL_HEX32(0x100, CO_ERR_BASE);
  TEST_ASSERT_EQUAL_HEX32(CO_ERR_BASE, CO_ERR_BAD_ARG);
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_each_error_code_has_its_number);
  RUN_TEST(test_new_error_codes_follow_the_old_ones);
  RUN_TEST(test_the_numbers_begin_at_the_base);
  return UNITY_END();
}
