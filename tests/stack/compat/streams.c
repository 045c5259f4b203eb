// SPDX-License-Identifier: Apache-2.0
// Domains and strings: their memory, their descriptions, and their access by the network and the application.
#include <string.h>

#include "co_core.h"
#include "fakes.h"
#include "unity.h"

#define IMAGE_SIZE 20u

static uint8_t Image[IMAGE_SIZE]; /* domain memory area */
static CO_OBJ_DOM ImageDomain = {
    0,          /* position of the next access */
    IMAGE_SIZE, /* size of domain memory */
    &Image[0]   /* start address of domain memory */
};

static const uint8_t DeviceName[] = "Lexican demo";
static CO_OBJ_STR DeviceNameString = {
    0,             /* position of the next access */
    &DeviceName[0] /* start address of string memory */
};

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1008, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&DeviceNameString)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2345, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&ImageDomain)},
};

static CO_NODE Node;

void setUp(void) {
  memset(Image, 0, sizeof(Image));
  NodeUp(&Node, Dictionary, sizeof(Dictionary) / sizeof(Dictionary[0]));
}

static void test_a_string_is_uploaded_in_segments(void) {
  BusReceive(&Node, "601#4008100000000000");
  TEST_ASSERT_SENT("581#410810000C000000");
  BusReceive(&Node, "601#6000000000000000");
  TEST_ASSERT_SENT("581#004C65786963616E");
  BusReceive(&Node, "601#7000000000000000");
  TEST_ASSERT_SENT("581#152064656D6F0000");
}

static void test_a_string_is_read_by_the_application_from_its_beginning(void) {
  uint8_t text[13];
  CO_OBJ* obj = CODictFind(&Node.Dict, CO_DEV(0x1008, 0));
  memset(text, 0, sizeof(text));
  TEST_ASSERT_EQUAL_UINT32(12, COObjGetSize(obj, &Node, 0));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdBuffer(&Node.Dict, CO_DEV(0x1008, 0), text, 12));
  TEST_ASSERT_EQUAL_STRING("Lexican demo", text);
  memset(text, 0, sizeof(text));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdBuffer(&Node.Dict, CO_DEV(0x1008, 0), text, 7));
  TEST_ASSERT_EQUAL_STRING("Lexican", text);
}

static void test_a_string_is_read_in_pieces(void) {
  uint8_t text[13];
  CO_OBJ* obj = CODictFind(&Node.Dict, CO_DEV(0x1008, 0));
  memset(text, 0, sizeof(text));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, COObjRdBufStart(obj, &Node, &text[0], 5));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, COObjRdBufCont(obj, &Node, &text[5], 7));
  TEST_ASSERT_EQUAL_STRING("Lexican demo", text);
}

static void test_a_string_is_never_written(void) {
  uint8_t text[] = {'x', 'y', 'z', 'z', 'y'};
  TEST_ASSERT_EQUAL(CO_ERR_OBJ_ACC, CODictWrBuffer(&Node.Dict, CO_DEV(0x1008, 0), text, sizeof(text)));
  BusReceive(&Node, "601#2F08100078000000");
  TEST_ASSERT_SENT("581#8008100002000106");
}

static void test_a_domain_is_downloaded_in_segments(void) {
  BusReceive(&Node, "601#2145230014000000");
  TEST_ASSERT_SENT("581#6045230000000000");
  BusReceive(&Node, "601#0001020304050607");
  TEST_ASSERT_SENT("581#2000000000000000");
  BusReceive(&Node, "601#1008090A0B0C0D0E");
  TEST_ASSERT_SENT("581#3000000000000000");
  BusReceive(&Node, "601#030F101112131400");
  TEST_ASSERT_SENT("581#2000000000000000");
  for (uint8_t i = 0; i < IMAGE_SIZE; i++) {
    TEST_ASSERT_EQUAL(i + 1, Image[i]);
  }
}

static void test_a_domain_is_uploaded_in_segments(void) {
  for (uint8_t i = 0; i < IMAGE_SIZE; i++) {
    Image[i] = (uint8_t)(0xF0 + i);
  }
  BusReceive(&Node, "601#4045230000000000");
  TEST_ASSERT_SENT("581#4145230014000000");
  BusReceive(&Node, "601#6000000000000000");
  TEST_ASSERT_SENT("581#00F0F1F2F3F4F5F6");
  BusReceive(&Node, "601#7000000000000000");
  TEST_ASSERT_SENT("581#10F7F8F9FAFBFCFD");
  BusReceive(&Node, "601#6000000000000000");
  TEST_ASSERT_SENT("581#03FEFF0001020300");
}

static void test_a_domain_is_written_and_read_by_the_application(void) {
  uint8_t out[IMAGE_SIZE];
  uint8_t in[IMAGE_SIZE];
  for (uint8_t i = 0; i < IMAGE_SIZE; i++) {
    out[i] = (uint8_t)(3 * i);
  }
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictWrBuffer(&Node.Dict, CO_DEV(0x2345, 0), out, sizeof(out)));
  TEST_ASSERT_EQUAL_MEMORY(out, Image, sizeof(out));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdBuffer(&Node.Dict, CO_DEV(0x2345, 0), in, sizeof(in)));
  TEST_ASSERT_EQUAL_MEMORY(out, in, sizeof(in));
}

static void test_a_domain_knows_its_size_and_the_possible_part_of_a_wanted_one(void) {
  CO_OBJ* obj = CODictFind(&Node.Dict, CO_DEV(0x2345, 0));
  TEST_ASSERT_EQUAL_UINT32(IMAGE_SIZE, COObjGetSize(obj, &Node, 0));
  TEST_ASSERT_EQUAL_UINT32(5, COObjGetSize(obj, &Node, 5));
  TEST_ASSERT_EQUAL_UINT32(IMAGE_SIZE, COObjGetSize(obj, &Node, IMAGE_SIZE + 1));
}

static void test_a_domain_is_written_in_pieces(void) {
  uint8_t piece[] = {1, 2, 3, 4, 5, 6};
  CO_OBJ* obj = CODictFind(&Node.Dict, CO_DEV(0x2345, 0));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, COObjWrBufStart(obj, &Node, piece, 4));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, COObjWrBufCont(obj, &Node, &piece[4], 2));
  TEST_ASSERT_EQUAL_MEMORY(piece, Image, sizeof(piece));
  TEST_ASSERT_EQUAL_UINT8(0, Image[6]);
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_string_is_uploaded_in_segments);
  RUN_TEST(test_a_string_is_read_by_the_application_from_its_beginning);
  RUN_TEST(test_a_string_is_read_in_pieces);
  RUN_TEST(test_a_string_is_never_written);
  RUN_TEST(test_a_domain_is_downloaded_in_segments);
  RUN_TEST(test_a_domain_is_uploaded_in_segments);
  RUN_TEST(test_a_domain_is_written_and_read_by_the_application);
  RUN_TEST(test_a_domain_knows_its_size_and_the_possible_part_of_a_wanted_one);
  RUN_TEST(test_a_domain_is_written_in_pieces);
  return UNITY_END();
}
