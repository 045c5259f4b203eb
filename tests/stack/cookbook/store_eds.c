// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: the device's own EDS.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static const uint8_t EdsBytes[] = "[FileInfo]\nFileName=pump.eds\n";  // generated from the file, in flash
static CO_OBJ_DOM_RO Eds = {0, sizeof(EdsBytes) - 1, EdsBytes};

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1021, 0, CO_OBJ_____R_), CO_TDOMAIN_RO, (CO_DATA)(&Eds)},
    {CO_KEY(0x1022, 0, CO_OBJ_D___R_), CO_TUNSIGNED16, (CO_DATA)(CO_EDS_FORMAT_PLAIN)},
};

void the_eds_is_read_from_the_device(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_STRING("585: 4B 22 10 00 00 00 00 00", BenchSend("605: 40 22 10 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 41 21 10 00 1D 00 00 00", BenchSend("605: 40 21 10 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 00 5B 46 69 6C 65 49 6E", BenchSend("605: 60 00 00 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 10 66 6F 5D 0A 46 69 6C", BenchSend("605: 70 00 00 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 80 21 10 00 02 00 01 06", BenchSend("605: 21 21 10 00 05 00 00 00"));
}
