// SPDX-License-Identifier: Apache-2.0
// Uses a dictionary that is defined like the example of the page "Object Dictionary" (od_definition/ODxyz.c): finds,
// reads and writes its entries without a node.
#include <string.h>

// clang-format off: the page's header needs the other before it
#include "301/CO_ODinterface.h"
#include "od_definition/ODxyz.h"
// clang-format on
#include "unity.h"

/* The page defines 1003h as a variable, but means an array. */
static OD_obj_array_t Errors = {
    &ODxyz_RAM.x1003_preDefinedErrorField_sub0,
    &ODxyz_RAM.x1003_preDefinedErrorField[0],
    ODA_SDO_RW,
    ODA_SDO_R | ODA_MB,
    4,
    sizeof(uint32_t),
};
static const OD_entry_t ErrorsEntry = {0x1003, 0x09, ODT_ARR, &Errors, NULL};

void setUp(void) {
  memset(&ODxyz_RAM, 0, sizeof(ODxyz_RAM));
  memset(&ODxyz_PERSIST_COMM, 0, sizeof(ODxyz_PERSIST_COMM));
  ODxyz_PERSIST_COMM.x1018_identity.maxSubIndex = 4;
}

static void test_its_objects_are_found(void) {
  TEST_ASSERT_EQUAL_UINT16(4, ODxyz->size);
  TEST_ASSERT_EQUAL_PTR(ODxyz_ENTRY_H1000, OD_find(ODxyz, 0x1000));
  TEST_ASSERT_EQUAL_PTR(ODxyz_ENTRY_H1001_errorRegister, OD_find(ODxyz, 0x1001));
  TEST_ASSERT_EQUAL_PTR(ODxyz_ENTRY_H1003, OD_find(ODxyz, 0x1003));
  TEST_ASSERT_EQUAL_PTR(ODxyz_ENTRY_H1018_identity, OD_find(ODxyz, 0x1018));
  TEST_ASSERT_NULL(OD_find(ODxyz, 0x1002));
  TEST_ASSERT_NULL(OD_find(ODxyz, 0x0000));
}

static void test_a_variable_is_read_and_written(void) {
  uint32_t type = 0;
  TEST_ASSERT_EQUAL(ODR_OK, OD_set_u32(OD_find(ODxyz, OD_H1000_DEV_TYPE), 0, 0x000F0191, false));
  TEST_ASSERT_EQUAL_HEX32(0x000F0191, ODxyz_PERSIST_COMM.x1000_deviceType);
  TEST_ASSERT_EQUAL(ODR_OK, OD_get_u32(OD_find(ODxyz, 0x1000), 0, &type, false));
  TEST_ASSERT_EQUAL_HEX32(0x000F0191, type);
  TEST_ASSERT_EQUAL(ODR_SUB_NOT_EXIST, OD_get_u32(OD_find(ODxyz, 0x1000), 1, &type, false));
}

static void test_a_record_is_read_by_its_sub_indexes(void) {
  OD_IO_t io;
  uint8_t last = 0;
  ODxyz_PERSIST_COMM.x1018_identity.serialNumber = 0x12345678;
  TEST_ASSERT_EQUAL(ODR_OK, OD_get_u8(OD_find(ODxyz, 0x1018), 0, &last, false));
  TEST_ASSERT_EQUAL_UINT8(4, last);
  TEST_ASSERT_EQUAL(ODR_OK, OD_getSub(OD_find(ODxyz, 0x1018), 4, &io, false));
  TEST_ASSERT_EQUAL_PTR(&ODxyz_PERSIST_COMM.x1018_identity.serialNumber, io.stream.dataOrig);
  TEST_ASSERT_EQUAL_HEX8(ODA_SDO_R | ODA_MB, io.stream.attribute);
  TEST_ASSERT_EQUAL(ODR_SUB_NOT_EXIST, OD_getSub(OD_find(ODxyz, 0x1018), 5, &io, false));
}

static void test_an_array_is_read_by_its_sub_indexes(void) {
  uint32_t code = 0;
  uint8_t number = 0;
  ODxyz_RAM.x1003_preDefinedErrorField_sub0 = 2;
  ODxyz_RAM.x1003_preDefinedErrorField[7] = 0x8130;
  TEST_ASSERT_EQUAL(ODR_OK, OD_get_u8(&ErrorsEntry, 0, &number, false));
  TEST_ASSERT_EQUAL_UINT8(2, number);
  TEST_ASSERT_EQUAL(ODR_OK, OD_get_u32(&ErrorsEntry, 8, &code, false));
  TEST_ASSERT_EQUAL_HEX32(0x8130, code);
  TEST_ASSERT_EQUAL(ODR_SUB_NOT_EXIST, OD_get_u32(&ErrorsEntry, 9, &code, false));
}

static ODR_t ReadAndCount(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* countRead) {
  ++*(unsigned*)stream->object;
  return OD_readOriginal(stream, buf, count, countRead);
}

static void test_an_object_is_extended(void) {
  unsigned reads = 0;
  uint8_t error = 0;
  OD_extension_t extension;
  memset(&extension, 0, sizeof(extension));
  extension.object = &reads;
  extension.read = ReadAndCount;
  ODxyz_RAM.x1001_errorRegister = 0x11;
  TEST_ASSERT_EQUAL(ODR_OK, OD_extension_init(OD_find(ODxyz, 0x1001), &extension));
  TEST_ASSERT_EQUAL(ODR_OK, OD_get_u8(OD_find(ODxyz, 0x1001), 0, &error, false));
  TEST_ASSERT_EQUAL_HEX8(0x11, error);
  TEST_ASSERT_EQUAL_UINT(1, reads);
  TEST_ASSERT_EQUAL(ODR_UNSUPP_ACCESS, OD_set_u8(OD_find(ODxyz, 0x1001), 0, 1, false));
  TEST_ASSERT_EQUAL(ODR_OK, OD_extension_init(OD_find(ODxyz, 0x1001), NULL));
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_its_objects_are_found);
  RUN_TEST(test_a_variable_is_read_and_written);
  RUN_TEST(test_a_record_is_read_by_its_sub_indexes);
  RUN_TEST(test_an_array_is_read_by_its_sub_indexes);
  RUN_TEST(test_an_object_is_extended);
  return UNITY_END();
}
