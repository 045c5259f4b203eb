// SPDX-License-Identifier: Apache-2.0
// Names, numbers and macros that firmware uses without calling the stack.
#include <string.h>

#include "co_core.h"
#include "co_ver.h"
#include "unity.h"

static unsigned FatalErrors;
void CONodeFatalError(void) { FatalErrors++; }

static void test_keys_are_index_sub_index_and_flags(void) {
  TEST_ASSERT_EQUAL_HEX32(0x12345678, CO_KEY(0x1234, 0x56, 0x78));
  TEST_ASSERT_EQUAL_HEX32(0x12345678, CO_KEY(0xF1234, 0x156, 0x178));
  TEST_ASSERT_EQUAL_HEX32(0x12345600, CO_DEV(0x1234, 0x56));
  TEST_ASSERT_EQUAL_HEX32(0x60400010, CO_LINK(0x6040, 0, 16));
  TEST_ASSERT_EQUAL_HEX32(0x12345600, CO_GET_DEV(0x12345678));
  TEST_ASSERT_EQUAL_HEX16(0x1234, CO_GET_IDX(0x12345678));
  TEST_ASSERT_EQUAL_HEX8(0x56, CO_GET_SUB(0x12345678));
}

static void test_flags_have_their_bits(void) {
  TEST_ASSERT_EQUAL_HEX8(0x01, CO_OBJ______W);
  TEST_ASSERT_EQUAL_HEX8(0x02, CO_OBJ_____R_);
  TEST_ASSERT_EQUAL_HEX8(0x04, CO_OBJ____P__);
  TEST_ASSERT_EQUAL_HEX8(0x08, CO_OBJ___A___);
  TEST_ASSERT_EQUAL_HEX8(0x08, CO_OBJ_T0);
  TEST_ASSERT_EQUAL_HEX8(0x10, CO_OBJ_T1);
  TEST_ASSERT_EQUAL_HEX8(0x20, CO_OBJ_T2);
  TEST_ASSERT_EQUAL_HEX8(0x40, CO_OBJ_T3);
  TEST_ASSERT_EQUAL_HEX8(0x40, CO_OBJ__N____);
  TEST_ASSERT_EQUAL_HEX8(0x80, CO_OBJ_D_____);
}

static void test_combined_flags_have_their_bits(void) {
  const struct {
    uint32_t Flags;
    uint32_t Bits;
  } expected[] = {
      {CO_OBJ_____RW, 0x03}, {CO_OBJ____PR_, 0x06}, {CO_OBJ____P_W, 0x05}, {CO_OBJ____PRW, 0x07}, {CO_OBJ___APR_, 0x0E},
      {CO_OBJ___AP_W, 0x0D}, {CO_OBJ___APRW, 0x0F}, {CO_OBJ__N__R_, 0x42}, {CO_OBJ__N___W, 0x41}, {CO_OBJ__N__RW, 0x43},
      {CO_OBJ__N_PR_, 0x46}, {CO_OBJ__N_P_W, 0x45}, {CO_OBJ__N_PRW, 0x47}, {CO_OBJ_D___R_, 0x82}, {CO_OBJ_D____W, 0x81},
      {CO_OBJ_D___RW, 0x83}, {CO_OBJ_DN__R_, 0xC2}, {CO_OBJ_DN___W, 0xC1}, {CO_OBJ_DN__RW, 0xC3},
  };
  for (size_t i = 0; i < sizeof(expected) / sizeof(expected[0]); i++) {
    TEST_ASSERT_EQUAL_HEX32(expected[i].Bits, expected[i].Flags);
  }
}

static void test_flags_of_a_key_are_asked(void) {
  TEST_ASSERT_TRUE(CO_IS_WRITE(CO_KEY(0x2000, 0, CO_OBJ______W)));
  TEST_ASSERT_FALSE(CO_IS_WRITE(CO_KEY(0x2000, 0, CO_OBJ_____R_)));
  TEST_ASSERT_TRUE(CO_IS_READ(CO_KEY(0x2000, 0, CO_OBJ_____R_)));
  TEST_ASSERT_FALSE(CO_IS_READ(CO_KEY(0x2000, 0, CO_OBJ______W)));
  TEST_ASSERT_TRUE(CO_IS_PDOMAP(CO_KEY(0x2000, 0, CO_OBJ____PR_)));
  TEST_ASSERT_FALSE(CO_IS_PDOMAP(CO_KEY(0x2000, 0, CO_OBJ_____RW)));
  TEST_ASSERT_TRUE(CO_IS_ASYNC(CO_KEY(0x2000, 0, CO_OBJ___APR_)));
  TEST_ASSERT_FALSE(CO_IS_ASYNC(CO_KEY(0x2000, 0, CO_OBJ____PR_)));
  TEST_ASSERT_TRUE(CO_IS_NODEID(CO_KEY(0x2000, 0, CO_OBJ__N__R_)));
  TEST_ASSERT_FALSE(CO_IS_NODEID(CO_KEY(0x2000, 0, CO_OBJ_D___R_)));
  TEST_ASSERT_TRUE(CO_IS_DIRECT(CO_KEY(0x2000, 0, CO_OBJ_D___R_)));
  TEST_ASSERT_FALSE(CO_IS_DIRECT(CO_KEY(0x2000, 0, CO_OBJ__N__R_)));
}

static void test_frames_are_little_endian_and_positions_wrap(void) {
  const uint8_t bytes[] = {0x11, 0x34, 0x12, 0xFF, 0x78, 0x56, 0x34, 0x12};
  CO_IF_FRM frame;
  CO_IF_FRM* frm = &frame;
  memset(frm, 0xFF, sizeof(frame));
  CO_SET_ID(frm, 0x581);
  CO_SET_DLC(frm, 8);
  CO_SET_BYTE(frm, 0x11, 0);
  CO_SET_WORD(frm, 0x1234, 1);
  CO_SET_LONG(frm, 0x12345678, 4);
  TEST_ASSERT_EQUAL_HEX8_ARRAY(bytes, frame.Data, 8);
  TEST_ASSERT_EQUAL_HEX32(0x581, CO_GET_ID(frm));
  TEST_ASSERT_EQUAL(8, CO_GET_DLC(frm));
  TEST_ASSERT_EQUAL_HEX8(0x11, CO_GET_BYTE(frm, 0));
  TEST_ASSERT_EQUAL_HEX8(0x11, CO_GET_BYTE(frm, 8));
  TEST_ASSERT_EQUAL_HEX16(0x1234, CO_GET_WORD(frm, 1));
  TEST_ASSERT_EQUAL_HEX32(0x12345678, CO_GET_LONG(frm, 4));
  TEST_ASSERT_EQUAL_HEX32(0x34111234, CO_GET_LONG(frm, 6));
}

static void test_values_are_put_into_a_frame_once(void) {
  const uint8_t bytes[] = {5, 0, 6, 0, 0, 0, 7, 8};
  CO_IF_FRM frames[2] = {{0, {0, 0, 0, 0, 0, 0, 7, 8}, 8}, {0, {0}, 0}};
  CO_IF_FRM* frm = frames;
  uint8_t next = 5;
  uint8_t pos = 0;
  CO_SET_WORD(frm, next++, pos++);
  TEST_ASSERT_EQUAL(6, next);
  TEST_ASSERT_EQUAL(1, pos);
  CO_SET_LONG(frm++, next++, 2);
  TEST_ASSERT_EQUAL(7, next);
  TEST_ASSERT_EQUAL_PTR(&frames[1], frm);
  TEST_ASSERT_EQUAL_HEX8_ARRAY(bytes, frames[0].Data, 8);
}

static void test_cob_ids_say_whether_they_are_valid(void) {
  TEST_ASSERT_EQUAL_HEX32(0x00000601, CO_COBID_SDO_STD(1, 0, 0x601));
  TEST_ASSERT_EQUAL_HEX32(0x80000601, CO_COBID_SDO_STD(0, 0, 0x601));
  TEST_ASSERT_EQUAL_HEX32(0x40000601, CO_COBID_SDO_STD(1, 1, 0x601));
  TEST_ASSERT_EQUAL_HEX32(0x00000601, CO_COBID_SDO_STD(1, 0, 0xFE01));
  TEST_ASSERT_EQUAL_HEX32(0x32345678, CO_COBID_SDO_EXT(1, 0, 0x12345678));
  TEST_ASSERT_EQUAL_HEX32(0x80000100, CO_COBID_TIME_STD(1, 0, 0x100));
  TEST_ASSERT_EQUAL_HEX32(0x40000100, CO_COBID_TIME_STD(0, 1, 0xF100));
  TEST_ASSERT_EQUAL_HEX32(0xF2345678, CO_COBID_TIME_EXT(1, 1, 0x12345678));
  TEST_ASSERT_EQUAL_HEX32(0x600, CO_COBID_SDO_REQUEST());
  TEST_ASSERT_EQUAL_HEX32(0x580, CO_COBID_SDO_RESPONSE());
  TEST_ASSERT_EQUAL_HEX32(0x80000000, CO_SDO_ID_OFF);
}

static unsigned Passed;
static void AssertPtr(const void* p) {
  ASSERT_PTR(p);
  Passed++;
}
static CO_ERR AssertPtrErr(const void* p) {
  ASSERT_PTR_ERR(p, CO_ERR_BAD_ARG);
  return CO_ERR_NONE;
}
static void AssertPtrFatal(const void* p) {
  ASSERT_PTR_FATAL(p);
  Passed++;
}
static CO_ERR AssertPtrFatalErr(const void* p) {
  ASSERT_PTR_FATAL_ERR(p, CO_ERR_BAD_ARG);
  return CO_ERR_NONE;
}
static CO_ERR AssertEquErr(int v) {
  ASSERT_EQU_ERR(v, 5, CO_ERR_OBJ_RANGE);
  return CO_ERR_NONE;
}
static void AssertNot(int v) {
  ASSERT_NOT(v, 5);
  Passed++;
}
static CO_ERR AssertNotErr(int v) {
  ASSERT_NOT_ERR(v, 5, CO_ERR_OBJ_RANGE);
  return CO_ERR_NONE;
}
static void AssertLower(int v) {
  ASSERT_LOWER(v, 5);
  Passed++;
}
static CO_ERR AssertLowerErr(int v) {
  ASSERT_LOWER_ERR(v, 5, CO_ERR_OBJ_RANGE);
  return CO_ERR_NONE;
}

static void test_argument_checks_leave_the_function(void) {
  Passed = 0;
  FatalErrors = 0;
  AssertPtr(NULL);
  AssertPtrFatal(NULL);
  AssertNot(5);
  AssertLower(5);
  TEST_ASSERT_EQUAL(0, Passed);
  TEST_ASSERT_EQUAL(1, FatalErrors);
  TEST_ASSERT_EQUAL(CO_ERR_BAD_ARG, AssertPtrErr(NULL));
  TEST_ASSERT_EQUAL(CO_ERR_BAD_ARG, AssertPtrFatalErr(NULL));
  TEST_ASSERT_EQUAL(2, FatalErrors);
  TEST_ASSERT_EQUAL(CO_ERR_OBJ_RANGE, AssertEquErr(4));
  TEST_ASSERT_EQUAL(CO_ERR_OBJ_RANGE, AssertNotErr(5));
  TEST_ASSERT_EQUAL(CO_ERR_OBJ_RANGE, AssertLowerErr(5));
}

static void test_argument_checks_let_good_arguments_pass(void) {
  Passed = 0;
  FatalErrors = 0;
  AssertPtr(&Passed);
  AssertPtrFatal(&Passed);
  AssertNot(4);
  AssertLower(4);
  TEST_ASSERT_EQUAL(4, Passed);
  TEST_ASSERT_EQUAL(0, FatalErrors);
  TEST_ASSERT_EQUAL(CO_ERR_NONE, AssertPtrErr(&Passed));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, AssertPtrFatalErr(&Passed));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, AssertEquErr(5));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, AssertNotErr(4));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, AssertLowerErr(4));
}

/* Structure tags, by which firmware declares types without including their headers. */
static void test_structures_have_their_tags(void) {
  struct CO_OBJ_T obj = CO_OBJ_DICT_ENDMARK;
  TEST_ASSERT_EQUAL(sizeof(CO_OBJ), sizeof(obj));
  TEST_ASSERT_EQUAL(sizeof(CO_OBJ_TYPE), sizeof(struct CO_OBJ_TYPE_T));
  TEST_ASSERT_EQUAL(sizeof(CO_OBJ_DOM), sizeof(struct CO_OBJ_DOM_T));
  TEST_ASSERT_EQUAL(sizeof(CO_OBJ_STR), sizeof(struct CO_OBJ_STR_T));
  TEST_ASSERT_EQUAL(sizeof(CO_PARA), sizeof(struct CO_PARA_T));
  TEST_ASSERT_EQUAL(sizeof(CO_DICT), sizeof(struct CO_DICT_T));
  TEST_ASSERT_EQUAL(sizeof(CO_NODE), sizeof(struct CO_NODE_T));
  TEST_ASSERT_EQUAL(sizeof(CO_NODE_SPEC), sizeof(struct CO_NODE_SPEC_T));
  TEST_ASSERT_EQUAL(sizeof(CO_NMT), sizeof(struct CO_NMT_T));
  TEST_ASSERT_EQUAL(sizeof(CO_SDO), sizeof(struct CO_SDO_T));
  TEST_ASSERT_EQUAL(sizeof(CO_TMR), sizeof(struct CO_TMR_T));
  TEST_ASSERT_EQUAL(sizeof(CO_TMR_MEM), sizeof(struct CO_TMR_MEM_T));
  TEST_ASSERT_EQUAL(sizeof(CO_IF), sizeof(struct CO_IF_T));
  TEST_ASSERT_EQUAL(sizeof(CO_IF_DRV), sizeof(struct CO_IF_DRV_T));
  TEST_ASSERT_EQUAL(sizeof(CO_IF_FRM), sizeof(struct CO_IF_FRM_T));
  TEST_ASSERT_EQUAL(sizeof(CO_IF_CAN_DRV), sizeof(struct CO_IF_CAN_DRV_T));
  TEST_ASSERT_EQUAL(sizeof(CO_IF_TIMER_DRV), sizeof(struct CO_IF_TIMER_DRV_T));
  TEST_ASSERT_EQUAL(sizeof(CO_IF_NVM_DRV), sizeof(struct CO_IF_NVM_DRV_T));
  TEST_ASSERT_EQUAL(sizeof(CO_MODE), sizeof(enum CO_MODE_T));
  TEST_ASSERT_EQUAL(sizeof(CO_NMT_RESET), sizeof(enum CO_NMT_RESET_T));
  TEST_ASSERT_EQUAL(sizeof(CO_ERR), sizeof(enum CO_ERR_T));
  TEST_ASSERT_EQUAL(sizeof(CO_CSDO), sizeof(struct CO_CSDO_T));
  TEST_ASSERT_EQUAL(sizeof(CO_CSDO_STATE), sizeof(enum CO_CSDO_STATE_T));
  TEST_ASSERT_EQUAL(sizeof(CO_OBJ_TYPE_EX), sizeof(struct CO_OBJ_TYPE_EX_T));
  TEST_ASSERT_EQUAL(sizeof(CO_OBJ_TRANSFER), sizeof(enum CO_OBJ_TRANSFER_T));
}

static void test_modes_and_resets_have_their_numbers(void) {
  TEST_ASSERT_EQUAL(0, CO_INVALID);
  TEST_ASSERT_EQUAL(1, CO_INIT);
  TEST_ASSERT_EQUAL(2, CO_PREOP);
  TEST_ASSERT_EQUAL(3, CO_OPERATIONAL);
  TEST_ASSERT_EQUAL(4, CO_STOP);
  TEST_ASSERT_EQUAL(5, CO_MODE_NUM);
  TEST_ASSERT_EQUAL(0, CO_RESET_INVALID);
  TEST_ASSERT_EQUAL(1, CO_RESET_NODE);
  TEST_ASSERT_EQUAL(2, CO_RESET_COM);
  TEST_ASSERT_EQUAL(3, CO_RESET_NUM);
}

static void test_sdo_clients_and_transfers_have_their_numbers(void) {
  TEST_ASSERT_EQUAL(0, CO_CSDO_STATE_INVALID);
  TEST_ASSERT_EQUAL(1, CO_CSDO_STATE_IDLE);
  TEST_ASSERT_EQUAL(2, CO_CSDO_STATE_BUSY);
  TEST_ASSERT_EQUAL(0, CO_OBJ_UPLOAD);
  TEST_ASSERT_EQUAL(1, CO_OBJ_DOWNLOAD);
  TEST_ASSERT_EQUAL_HEX32(0xFFFFFFFF, CO_OBJ_SIZE_UNKNOWN);
}

static void test_an_extended_type_begins_with_a_type(void) {
  CO_OBJ_TYPE_EX extended;
#if USE_OBJ_EX
  CO_OBJ_RESET_FUNC reset = COObjTypeExReset;
#else
  CO_OBJ_RESET_FUNC reset = NULL;
#endif
  CO_OBJ_BEGIN_FUNC begin = NULL;
  CO_OBJ_END_FUNC end = NULL;
  extended.Type.Reset = reset;
  extended.Reset = NULL;
  extended.Begin = begin;
  extended.End = end;
  TEST_ASSERT_EQUAL_PTR(&extended, &extended.Type);
  TEST_ASSERT_TRUE(extended.Type.Reset == reset);
}

static void test_heartbeat_codes_are_those_of_the_standard(void) {
  TEST_ASSERT_EQUAL(0, CONmtModeEncode(CO_INIT));
  TEST_ASSERT_EQUAL(127, CONmtModeEncode(CO_PREOP));
  TEST_ASSERT_EQUAL(5, CONmtModeEncode(CO_OPERATIONAL));
  TEST_ASSERT_EQUAL(4, CONmtModeEncode(CO_STOP));
  TEST_ASSERT_EQUAL(255, CONmtModeEncode(CO_INVALID));
  TEST_ASSERT_EQUAL(CO_INIT, CONmtModeDecode(0));
  TEST_ASSERT_EQUAL(CO_PREOP, CONmtModeDecode(127));
  TEST_ASSERT_EQUAL(CO_OPERATIONAL, CONmtModeDecode(5));
  TEST_ASSERT_EQUAL(CO_STOP, CONmtModeDecode(4));
  TEST_ASSERT_EQUAL(CO_INVALID, CONmtModeDecode(1));
}

static void test_allowed_services_have_their_bits(void) {
  TEST_ASSERT_EQUAL_HEX8(0x01, CO_NMT_ALLOWED);
  TEST_ASSERT_EQUAL_HEX8(0x02, CO_BOOT_ALLOWED);
  TEST_ASSERT_EQUAL_HEX8(0x04, CO_EMCY_ALLOWED);
  TEST_ASSERT_EQUAL_HEX8(0x08, CO_TIME_ALLOWED);
  TEST_ASSERT_EQUAL_HEX8(0x10, CO_SYNC_ALLOWED);
  TEST_ASSERT_EQUAL_HEX8(0x20, CO_SDO_ALLOWED);
  TEST_ASSERT_EQUAL_HEX8(0x40, CO_PDO_ALLOWED);
}

static void test_timer_units_and_parameter_flags_have_their_numbers(void) {
  TEST_ASSERT_EQUAL(1000, CO_TMR_UNIT_1MS);
  TEST_ASSERT_EQUAL(10000, CO_TMR_UNIT_100US);
  TEST_ASSERT_EQUAL(0, CO_PARA____);
  TEST_ASSERT_EQUAL(1, CO_PARA___E);
  TEST_ASSERT_EQUAL(2, CO_PARA__A_);
  TEST_ASSERT_EQUAL(3, CO_PARA__AE);
}

static void test_sdo_abort_codes_have_their_numbers(void) {
  TEST_ASSERT_EQUAL_HEX32(0x05030000, CO_SDO_ERR_TBIT);
  TEST_ASSERT_EQUAL_HEX32(0x05040000, CO_SDO_ERR_TIMEOUT);
  TEST_ASSERT_EQUAL_HEX32(0x05040001, CO_SDO_ERR_CMD);
  TEST_ASSERT_EQUAL_HEX32(0x05040002, CO_SDO_ERR_BLK_SIZE);
  TEST_ASSERT_EQUAL_HEX32(0x05040003, CO_SDO_ERR_SEQ_NUM);
  TEST_ASSERT_EQUAL_HEX32(0x05040004, CO_SDO_ERR_CRC);
  TEST_ASSERT_EQUAL_HEX32(0x05040005, CO_SDO_ERR_MEM);
  TEST_ASSERT_EQUAL_HEX32(0x06010000, CO_SDO_ERR_UNSUP);
  TEST_ASSERT_EQUAL_HEX32(0x06010001, CO_SDO_ERR_RD);
  TEST_ASSERT_EQUAL_HEX32(0x06010002, CO_SDO_ERR_WR);
  TEST_ASSERT_EQUAL_HEX32(0x06020000, CO_SDO_ERR_OBJ);
  TEST_ASSERT_EQUAL_HEX32(0x06040041, CO_SDO_ERR_OBJ_MAP);
  TEST_ASSERT_EQUAL_HEX32(0x06040042, CO_SDO_ERR_OBJ_MAP_N);
  TEST_ASSERT_EQUAL_HEX32(0x06040043, CO_SDO_ERR_PARA_INCOMP);
  TEST_ASSERT_EQUAL_HEX32(0x06060000, CO_SDO_ERR_HW_ACCESS);
  TEST_ASSERT_EQUAL_HEX32(0x06070010, CO_SDO_ERR_LEN);
  TEST_ASSERT_EQUAL_HEX32(0x06070012, CO_SDO_ERR_LEN_HIGH);
  TEST_ASSERT_EQUAL_HEX32(0x06070013, CO_SDO_ERR_LEN_SMALL);
  TEST_ASSERT_EQUAL_HEX32(0x06090011, CO_SDO_ERR_SUB);
  TEST_ASSERT_EQUAL_HEX32(0x06090030, CO_SDO_ERR_RANGE);
  TEST_ASSERT_EQUAL_HEX32(0x08000000, CO_SDO_ERR_GENERAL);
  TEST_ASSERT_EQUAL_HEX32(0x08000020, CO_SDO_ERR_TOS);
  TEST_ASSERT_EQUAL_HEX32(0x08000022, CO_SDO_ERR_TOS_STATE);
}

static void test_sdo_abort_codes_of_later_editions_have_their_numbers(void) {
  TEST_ASSERT_EQUAL_HEX32(0x06040047, CO_SDO_ERR_INTERNAL);
  TEST_ASSERT_EQUAL_HEX32(0x06090031, CO_SDO_ERR_RANGE_HIGH);
  TEST_ASSERT_EQUAL_HEX32(0x06090032, CO_SDO_ERR_RANGE_LOW);
  TEST_ASSERT_EQUAL_HEX32(0x06090036, CO_SDO_ERR_RANGE_LIMITS);
  TEST_ASSERT_EQUAL_HEX32(0x060A0023, CO_SDO_ERR_NO_CONNECT);
  TEST_ASSERT_EQUAL_HEX32(0x08000021, CO_SDO_ERR_TOS_LOCAL);
  TEST_ASSERT_EQUAL_HEX32(0x08000023, CO_SDO_ERR_NO_OD);
  TEST_ASSERT_EQUAL_HEX32(0x08000024, CO_SDO_ERR_NO_DATA);
}

static void test_the_version_is_that_of_the_headers(void) {
  CO_VerInit();
  TEST_ASSERT_EQUAL(CO_VER_MAJOR, COVerMajor());
  TEST_ASSERT_EQUAL(CO_VER_MINOR, COVerMinor());
  TEST_ASSERT_EQUAL(CO_VER_BUILD, COVerBuild());
  TEST_ASSERT_EQUAL_UINT32(CO_VER_MAJOR * 10000 + CO_VER_MINOR * 100 + CO_VER_BUILD, COVersion());
}

static void test_sizes_of_the_sdo_buffer_belong_together(void) {
  TEST_ASSERT_EQUAL(CO_SDO_BUF_SEG * 7, CO_SDO_BUF_BYTE);
}

/* The names exist in a configuration that does not use them, too. */
static void test_the_configuration_has_all_its_names(void) {
  const long values[] = {CO_SSDO_N,      USE_CSDO,      CO_CSDO_N,      USE_SDO_BLOCK, CO_CSDO_BLOCK,
                         CO_SDO_TIMEOUT, CO_TX_QUEUE_N, CO_SDO_BUF_SEG, USE_CSDO_OWN};
  const long largest[] = {128, 1, 100, 1, 256, 60000, 1000, 127, 1};
  for (size_t i = 0; i < sizeof(values) / sizeof(values[0]); i++) {
    TEST_ASSERT_GREATER_OR_EQUAL(0, values[i]);
    TEST_ASSERT_LESS_OR_EQUAL(largest[i], values[i]);
  }
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_keys_are_index_sub_index_and_flags);
  RUN_TEST(test_flags_have_their_bits);
  RUN_TEST(test_combined_flags_have_their_bits);
  RUN_TEST(test_flags_of_a_key_are_asked);
  RUN_TEST(test_frames_are_little_endian_and_positions_wrap);
  RUN_TEST(test_values_are_put_into_a_frame_once);
  RUN_TEST(test_cob_ids_say_whether_they_are_valid);
  RUN_TEST(test_argument_checks_leave_the_function);
  RUN_TEST(test_argument_checks_let_good_arguments_pass);
  RUN_TEST(test_structures_have_their_tags);
  RUN_TEST(test_modes_and_resets_have_their_numbers);
  RUN_TEST(test_sdo_clients_and_transfers_have_their_numbers);
  RUN_TEST(test_an_extended_type_begins_with_a_type);
  RUN_TEST(test_heartbeat_codes_are_those_of_the_standard);
  RUN_TEST(test_allowed_services_have_their_bits);
  RUN_TEST(test_timer_units_and_parameter_flags_have_their_numbers);
  RUN_TEST(test_sdo_abort_codes_have_their_numbers);
  RUN_TEST(test_sdo_abort_codes_of_later_editions_have_their_numbers);
  RUN_TEST(test_the_version_is_that_of_the_headers);
  RUN_TEST(test_sizes_of_the_sdo_buffer_belong_together);
  RUN_TEST(test_the_configuration_has_all_its_names);
  return UNITY_END();
}
