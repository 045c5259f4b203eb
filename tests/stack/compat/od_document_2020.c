// SPDX-License-Identifier: Apache-2.0
// Accesses the object dictionary like the first draft of the page "Object Dictionary": myFunc() is unchanged except for
// white space.
#include <string.h>

#include "co_core.h"
#include "co_od_2020.h"
#include "fakes.h"
#include "unity.h"

extern const OD_t ODxyz;
void myFunc(const OD_t* od);

/* omitted by the page */
static char Name[50];
static OD_size_t NameBytes;
static int Errors;

void myFunc(const OD_t* od) {
  ODR_t ret;
  const OD_entry_t* entry;
  OD_subEntry_t subEntry;
  OD_IO_t io1008;
  char buf[50];
  OD_size_t bytesRd;
  int error = 0;

  /* Init IO for "Manufacturer device name" at index 0x1008, sub-index 0x00 */
  entry = OD_find(od, 0x1008);
  ret = OD_getSub(entry, 0x00, &subEntry, &io1008.stream, false);
  io1008.read = subEntry.read;
  /* Read with io1008, subindex = 0x00 */
  if (ret == ODR_OK) bytesRd = io1008.read(&io1008.stream, 0x00, &buf[0], sizeof(buf), &ret);
  if (ret != ODR_OK) error++;

  /* not part of the page: results for the test */
  if (ret == ODR_OK) {
    memcpy(Name, buf, bytesRd);
    NameBytes = bytesRd;
  }

  /* Use helper and set "Producer heartbeat time" at index 0x1017, sub 0x00 */
  ret = OD_set_u16(OD_find(od, 0x1017), 0x00, 500, false);
  if (ret != ODR_OK) error++;

  Errors = error; /* not part of the page */
}

static CO_NODE Node;
static uint16_t HeartbeatTime;
static uint32_t SerialNumber = 0x12345678;
static uint8_t NameMemory[20] = "Mixer 4";
static CO_OBJ_STR_RW NameObj = {0, 7, 20, NameMemory};
static float Ratio = 1.5f;

static const CO_OBJ Table[] = {
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1008, 0, CO_OBJ_____R_), CO_TVISIBLE_STRING, (CO_DATA)(&NameObj)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&HeartbeatTime)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(4)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1018, 4, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&SerialNumber)},
    {CO_KEY(0x2000, 0, CO_OBJ____PRW), CO_TREAL32, (CO_DATA)(&Ratio)},
    CO_OBJ_DICT_ENDMARK,
};
#define TABLE_N ((uint16_t)(sizeof(Table) / sizeof(Table[0])))

static OD_entry_t List[OD_LIST_N(5)];
static OD_t Od;

void setUp(void) {
  Errors = -1;
  NameBytes = 0;
  HeartbeatTime = 0;
  memset(Name, 0, sizeof(Name));
  TEST_ASSERT_EQUAL(ODR_OK, OD_init(&Od, List, OD_LIST_N(5), &Node, (CO_OBJ*)Table, TABLE_N));
  NodeUp(&Node, Table, TABLE_N);
}

static void test_the_function_of_the_page_reads_the_name(void) {
  myFunc(&Od);
  TEST_ASSERT_EQUAL_INT(0, Errors);
  TEST_ASSERT_EQUAL_STRING("Mixer 4", Name);
  TEST_ASSERT_EQUAL_UINT32(20, NameBytes);
}

static void test_the_function_of_the_page_starts_the_heartbeat(void) {
  myFunc(&Od);
  TEST_ASSERT_EQUAL_UINT16(500, HeartbeatTime);
  TimePasses(&Node, 500);
  TEST_ASSERT_SENT("701#7F");
}

static void test_a_variable_tells_its_properties(void) {
  OD_subEntry_t entry;
  OD_stream_t stream;
  memset(&entry, 0xA5, sizeof(entry));
  TEST_ASSERT_EQUAL(ODR_OK, OD_getSub(OD_find(&Od, 0x1018), 4, &entry, &stream, false));
  TEST_ASSERT_EQUAL_HEX16(0x1018, entry.index);
  TEST_ASSERT_EQUAL_UINT8(4, entry.subIndex);
  TEST_ASSERT_EQUAL_UINT8(2, entry.maxSubIndex); /* number of sub-indexes, 3, minus 1 */
  TEST_ASSERT_EQUAL_UINT8(0, entry.storageGroup);
  TEST_ASSERT_EQUAL_HEX8(ODA_SDO_R | ODA_MB, entry.attribute);
}

static void test_what_is_not_there_is_told(void) {
  OD_subEntry_t entry;
  OD_stream_t stream;
  TEST_ASSERT_EQUAL(ODR_IDX_NOT_EXIST, OD_getSub(OD_find(&Od, 0x2001), 0, &entry, &stream, false));
  TEST_ASSERT_EQUAL(ODR_SUB_NOT_EXIST, OD_getSub(OD_find(&Od, 0x1018), 5, &entry, &stream, false));
  TEST_ASSERT_EQUAL(ODR_DEV_INCOMPAT, OD_getSub(OD_find(&Od, 0x1018), 4, NULL, &stream, false));
  TEST_ASSERT_EQUAL(ODR_DEV_INCOMPAT, OD_getSub(OD_find(&Od, 0x1018), 4, &entry, NULL, false));
  TEST_ASSERT_EQUAL(ODR_IDX_NOT_EXIST, OD_getSub(NULL, 4, NULL, NULL, false));
  TEST_ASSERT_NULL(OD_find(NULL, 0x1018));
}

static void test_pieces_count_their_bytes(void) {
  OD_subEntry_t entry;
  OD_stream_t stream;
  ODR_t ret = ODR_HW;
  uint8_t bytes[4] = {0xEE, 0xEE, 0xEE, 0xEE};
  memset(&entry, 0, sizeof(entry));
  TEST_ASSERT_EQUAL(ODR_OK, OD_getSub(OD_find(&Od, 0x2000), 0, &entry, &stream, false));
  TEST_ASSERT_EQUAL_UINT32(3, entry.read(&stream, 0, bytes, 3, &ret));
  TEST_ASSERT_EQUAL(ODR_PARTIAL, ret);
  TEST_ASSERT_EQUAL_UINT32(1, entry.read(&stream, 0, bytes + 3, 4, &ret));
  TEST_ASSERT_EQUAL(ODR_OK, ret);
  TEST_ASSERT_EQUAL_MEMORY(&Ratio, bytes, 4);
  TEST_ASSERT_EQUAL_UINT32(0, entry.read(&stream, 1, bytes, 4, &ret));
  TEST_ASSERT_EQUAL(ODR_SUB_NOT_EXIST, ret);
  TEST_ASSERT_EQUAL_UINT32(0, entry.write(&stream, 0, bytes, 5, &ret));
  TEST_ASSERT_EQUAL(ODR_DATA_LONG, ret);
  TEST_ASSERT_EQUAL_UINT32(4, entry.write(&stream, 0, bytes, 4, &ret));
  TEST_ASSERT_EQUAL(ODR_OK, ret);
}

static void test_reals_and_addresses_have_the_names_of_the_draft(void) {
  float32_t ratio = 0;
  float32_t* place = NULL;
  uint8_t* byte = NULL;
  TEST_ASSERT_EQUAL(ODR_OK, OD_set_r32(OD_find(&Od, 0x2000), 0, 2.5f, false));
  TEST_ASSERT_EQUAL(ODR_OK, OD_get_r32(OD_find(&Od, 0x2000), 0, &ratio, false));
  TEST_ASSERT_TRUE(ratio >= 2.5f && ratio <= 2.5f);
  TEST_ASSERT_EQUAL(ODR_OK, OD_getPtr_r32(OD_find(&Od, 0x2000), 0, &place));
  TEST_ASSERT_EQUAL_PTR(&Ratio, place);
  TEST_ASSERT_EQUAL(ODR_TYPE_MISMATCH, OD_getPtr_u8(OD_find(&Od, 0x2000), 0, &byte));
  TEST_ASSERT_NULL(byte);
  TEST_ASSERT_EQUAL(ODR_DEV_INCOMPAT, OD_getPtr_u8(OD_find(&Od, 0x2000), 0, NULL));
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_the_function_of_the_page_reads_the_name);
  RUN_TEST(test_the_function_of_the_page_starts_the_heartbeat);
  RUN_TEST(test_a_variable_tells_its_properties);
  RUN_TEST(test_what_is_not_there_is_told);
  RUN_TEST(test_pieces_count_their_bytes);
  RUN_TEST(test_reals_and_addresses_have_the_names_of_the_draft);
  return UNITY_END();
}
