// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: the mandatory objects, and the identity of a device.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;
static uint32_t ManufacturerStatus;
static uint32_t SerialNumber = 0x2001;  // unique for each device: read it from your hardware

static CO_OBJ_STR DeviceName = {0, (const uint8_t*)"pump"};
static CO_OBJ_STR HardwareVersion = {0, (const uint8_t*)"B"};
static CO_OBJ_STR SoftwareVersion = {0, (const uint8_t*)"1.02"};

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // no device profile
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1002, 0, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)(&ManufacturerStatus)},
    {CO_KEY(0x1008, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&DeviceName)},
    {CO_KEY(0x1009, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&HardwareVersion)},
    {CO_KEY(0x100A, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&SoftwareVersion)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(4)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x123)},       // vendor-ID, from CiA
    {CO_KEY(0x1018, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(7)},           // product code
    {CO_KEY(0x1018, 3, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x00010002)},  // revision 1.2
    {CO_KEY(0x1018, 4, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&SerialNumber)},
};

void identity_is_read(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_STRING("585: 43 00 10 00 00 00 00 00", BenchSend("605: 40 00 10 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 4F 01 10 00 00 00 00 00", BenchSend("605: 40 01 10 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 43 08 10 00 70 75 6D 70", BenchSend("605: 40 08 10 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 4F 09 10 00 42 00 00 00", BenchSend("605: 40 09 10 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 43 0A 10 00 31 2E 30 32", BenchSend("605: 40 0A 10 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 4F 18 10 00 04 00 00 00", BenchSend("605: 40 18 10 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 43 18 10 03 02 00 01 00", BenchSend("605: 40 18 10 03 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 43 18 10 04 01 20 00 00", BenchSend("605: 40 18 10 04 00 00 00 00"));
  // 0601 0002h: attempt to write a read only object
  TEST_ASSERT_EQUAL_STRING("585: 80 18 10 04 02 00 01 06", BenchSend("605: 23 18 10 04 00 00 00 00"));
}
