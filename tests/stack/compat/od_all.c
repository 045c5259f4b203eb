// SPDX-License-Identifier: Apache-2.0
// Defines OD_ALL after co_core.h, which has declared all basic types, and after a first co_od.h: all basic types can be
// extended from there on, also if the header of a type is included again.
#include <string.h>

#include "co_core.h"
#include "co_od.h"
#include "fakes.h"
#include "unity.h"

static const CO_OBJ_TYPE* const Before = CO_TUNSIGNED32;

#define OD_ALL
#include "co_core.h"
#include "co_domain.h"
#include "co_number.h"
#include "co_od.h"
#include "co_string.h"

static uint32_t Words[16];
static uint64_t Wide[16];
static CO_TIME_OF_DAY Time;
static uint8_t Memory[8];
static CO_OBJ_STR_RW Text = {0, 0, 8, Memory};
static CO_OBJ_STR Constant = {0, (const uint8_t*)"Mixer"};
static CO_OBJ_DOM Domain = {0, 8, Memory};

static const CO_OBJ Table[] = {
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(7)},
    {CO_KEY(0x2101, 0, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&Words[0])},
    {CO_KEY(0x2102, 0, CO_OBJ_____RW), CO_TUNSIGNED16, (CO_DATA)(&Words[1])},
    {CO_KEY(0x2103, 0, CO_OBJ_____RW), CO_TUNSIGNED24, (CO_DATA)(&Words[2])},
    {CO_KEY(0x2104, 0, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&Words[3])},
    {CO_KEY(0x2105, 0, CO_OBJ_____RW), CO_TUNSIGNED40, (CO_DATA)(&Wide[0])},
    {CO_KEY(0x2106, 0, CO_OBJ_____RW), CO_TUNSIGNED48, (CO_DATA)(&Wide[1])},
    {CO_KEY(0x2107, 0, CO_OBJ_____RW), CO_TUNSIGNED56, (CO_DATA)(&Wide[2])},
    {CO_KEY(0x2108, 0, CO_OBJ_____RW), CO_TUNSIGNED64, (CO_DATA)(&Wide[3])},
    {CO_KEY(0x2111, 0, CO_OBJ_____RW), CO_TSIGNED8, (CO_DATA)(&Words[4])},
    {CO_KEY(0x2112, 0, CO_OBJ_____RW), CO_TSIGNED16, (CO_DATA)(&Words[5])},
    {CO_KEY(0x2113, 0, CO_OBJ_____RW), CO_TSIGNED24, (CO_DATA)(&Words[6])},
    {CO_KEY(0x2114, 0, CO_OBJ_____RW), CO_TSIGNED32, (CO_DATA)(&Words[7])},
    {CO_KEY(0x2115, 0, CO_OBJ_____RW), CO_TSIGNED40, (CO_DATA)(&Wide[4])},
    {CO_KEY(0x2116, 0, CO_OBJ_____RW), CO_TSIGNED48, (CO_DATA)(&Wide[5])},
    {CO_KEY(0x2117, 0, CO_OBJ_____RW), CO_TSIGNED56, (CO_DATA)(&Wide[6])},
    {CO_KEY(0x2118, 0, CO_OBJ_____RW), CO_TSIGNED64, (CO_DATA)(&Wide[7])},
    {CO_KEY(0x2121, 0, CO_OBJ_____RW), CO_TBOOLEAN, (CO_DATA)(&Words[8])},
    {CO_KEY(0x2122, 0, CO_OBJ_____RW), CO_TREAL32, (CO_DATA)(&Words[9])},
    {CO_KEY(0x2123, 0, CO_OBJ_____RW), CO_TREAL64, (CO_DATA)(&Wide[8])},
    {CO_KEY(0x2124, 0, CO_OBJ_____RW), CO_TTIME_OF_DAY, (CO_DATA)(&Time)},
    {CO_KEY(0x2125, 0, CO_OBJ_____RW), CO_TTIME_DIFFERENCE, (CO_DATA)(&Time)},
    {CO_KEY(0x2131, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&Constant)},
    {CO_KEY(0x2132, 0, CO_OBJ_____RW), CO_TVISIBLE_STRING, (CO_DATA)(&Text)},
    {CO_KEY(0x2133, 0, CO_OBJ_____RW), CO_TOCTET_STRING, (CO_DATA)(&Text)},
    {CO_KEY(0x2134, 0, CO_OBJ_____RW), CO_TUNICODE_STRING, (CO_DATA)(&Text)},
    {CO_KEY(0x2135, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&Domain)},
    CO_OBJ_DICT_ENDMARK,
};
#define TABLE_N ((uint16_t)(sizeof(Table) / sizeof(Table[0])))

static OD_entry_t List[OD_LIST_N(TABLE_N)];
static OD_t Od;
static CO_NODE Node;
static unsigned Reads;

static ODR_t Refuse(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* read) {
  (void)stream;
  (void)buf;
  (void)count;
  (void)read;
  ++Reads;
  return ODR_HW;
}

static OD_extension_t Extension;

void setUp(void) {
  static CO_NODE_EXT ext; /* must exist as long as the node */
  uint16_t n;
  memset(&ext, 0, sizeof(ext));
  ext.Size = sizeof(ext);
  ext.Od = &Od;
  memset(&Od, 0, sizeof(Od));
  memset(&Extension, 0, sizeof(Extension));
  memset(Memory, 0x31, sizeof(Memory));
  Text.Size = 8;
  Extension.read = Refuse;
  Reads = 0;
  TEST_ASSERT_EQUAL(ODR_OK, OD_init(&Od, List, OD_LIST_N(TABLE_N), &Node, (CO_OBJ*)Table, TABLE_N));
  for (n = 0; n < Od.size; ++n) {
    TEST_ASSERT_EQUAL(ODR_OK, OD_extension_init(&List[n], NULL));
  }
  NodeUpEx(&Node, Table, TABLE_N, &ext);
}

static void Upload(uint16_t index) {
  static const char digit[] = "0123456789ABCDEF";
  char frame[] = "601#4000210000000000";
  frame[6] = digit[(index >> 4) & 0xF];
  frame[7] = digit[index & 0xF];
  BusReceive(&Node, frame);
}

static void test_a_type_named_before_is_the_plain_one(void) {
  TEST_ASSERT_TRUE(Before == (const CO_OBJ_TYPE*)&COTInt32);
  TEST_ASSERT_TRUE(CO_TUNSIGNED32 == OD_TUNSIGNED32);
  TEST_ASSERT_TRUE(CO_TUNSIGNED32 != Before);
}

static void test_every_object_can_be_extended(void) {
  uint16_t n;
  for (n = 0; n < Od.size; ++n) {
    TEST_ASSERT_EQUAL(ODR_OK, OD_extension_init(&List[n], &Extension));
  }
}

static void test_the_network_reaches_the_extension_of_every_type(void) {
  uint16_t n;
  for (n = 2; n < Od.size; ++n) {
    const unsigned before = Reads;
    TEST_ASSERT_EQUAL(ODR_OK, OD_extension_init(&List[n], &Extension));
    Upload(List[n].index);
    (void)BusSent();
    BusReceive(&Node, "601#6000000000000000"); /* longer values are read with the first segment */
    (void)BusSent();
    TEST_ASSERT_EQUAL_UINT32(before + 1, Reads);
    BusReceive(&Node, "601#8000210000000008");
  }
}

static void test_without_an_extension_they_are_what_they_were(void) {
  Words[3] = 0x04030201;
  BusReceive(&Node, "601#4004210000000000");
  TEST_ASSERT_SENT("581#4304210001020304");
  BusReceive(&Node, "601#2B02210034120000");
  TEST_ASSERT_SENT("581#6002210000000000");
  BusReceive(&Node, "601#4002210000000000");
  TEST_ASSERT_SENT("581#4B02210034120000");
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_type_named_before_is_the_plain_one);
  RUN_TEST(test_every_object_can_be_extended);
  RUN_TEST(test_the_network_reaches_the_extension_of_every_type);
  RUN_TEST(test_without_an_extension_they_are_what_they_were);
  return UNITY_END();
}
