// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: strings and a domain.
#include <string.h>

#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static CO_OBJ_STR Vendor = {0, (const uint8_t*)"Example Ltd"};  // read only
static uint8_t PlaceText[32] = "hall 1";
static CO_OBJ_STR_RW Place = {0, 6, sizeof(PlaceText), PlaceText};  // length now: 6; at most 32
static uint8_t KeyBytes[16];
static CO_OBJ_STR_RW Key = {0, 0, sizeof(KeyBytes), KeyBytes};
static uint8_t TableBytes[200];
static CO_OBJ_DOM Table = {0, sizeof(TableBytes), TableBytes};

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2300, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&Vendor)},
    {CO_KEY(0x2301, 0, CO_OBJ_____RW), CO_TVISIBLE_STRING, (CO_DATA)(&Place)},
    {CO_KEY(0x2302, 0, CO_OBJ______W), CO_TOCTET_STRING, (CO_DATA)(&Key)},
    {CO_KEY(0x2303, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&Table)},
};

void a_string_is_written_and_read(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_STRING("585: 41 00 23 00 0B 00 00 00", BenchSend("605: 40 00 23 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 00 45 78 61 6D 70 6C 65", BenchSend("605: 60 00 00 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 17 20 4C 74 64 00 00 00", BenchSend("605: 70 00 00 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 60 01 23 00 00 00 00 00", BenchSend("605: 27 01 23 00 6C 61 62 00"));
  TEST_ASSERT_EQUAL_UINT32(3, Place.Size);
  TEST_ASSERT_EQUAL_STRING("lab", (const char*)PlaceText);
  TEST_ASSERT_EQUAL_STRING("585: 47 01 23 00 6C 61 62 00", BenchSend("605: 40 01 23 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 60 02 23 00 00 00 00 00", BenchSend("605: 23 02 23 00 01 02 03 04"));
  TEST_ASSERT_EQUAL_UINT32(4, Key.Size);
}

void a_domain_is_written_in_segments(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_STRING("585: 60 03 23 00 00 00 00 00", BenchSend("605: 21 03 23 00 0A 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 20 00 00 00 00 00 00 00", BenchSend("605: 00 01 02 03 04 05 06 07"));
  TEST_ASSERT_EQUAL_STRING("585: 30 00 00 00 00 00 00 00", BenchSend("605: 19 08 09 0A 00 00 00 00"));
  TEST_ASSERT_EQUAL_UINT8(1, TableBytes[0]);
  TEST_ASSERT_EQUAL_UINT8(10, TableBytes[9]);
  TEST_ASSERT_EQUAL_STRING("585: 41 03 23 00 C8 00 00 00", BenchSend("605: 40 03 23 00 00 00 00 00"));
}
