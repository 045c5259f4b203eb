// SPDX-License-Identifier: Apache-2.0
// The examples of docs/od-access.md: an index of the table, variables read and written in pieces, an object that the
// application extends, and the abort codes that an SDO client receives for its errors.
#include <string.h>

#include "co_core.h"
#include "co_od.h"
#include "fakes.h"
#include "unity.h"

typedef struct MOTOR {
  uint32_t Limit;
} MOTOR;

static MOTOR Motor;
static uint32_t Speed;
static uint8_t NameMemory[20];
static CO_OBJ_STR_RW Name = {0, 0, 20, NameMemory};
static uint8_t FileMemory[40];
static CO_OBJ_DOM File = {0, sizeof(FileMemory), FileMemory};
static uint16_t HeartbeatTime;

static const CO_OBJ Table[] = {
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1008, 0, CO_OBJ_____RW), CO_TVISIBLE_STRING, (CO_DATA)(&Name)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&HeartbeatTime)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2100, 0, CO_OBJ____PRW), OD_TUNSIGNED32, (CO_DATA)(&Speed)}, /* can be extended */
    {CO_KEY(0x2101, 0, CO_OBJ_____R_), OD_TNUMBER, (CO_DATA)(2)},          /* readable by an extension only */
    {CO_KEY(0x2102, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&File)},
    CO_OBJ_DICT_ENDMARK,
};
#define TABLE_N ((uint16_t)(sizeof(Table) / sizeof(Table[0])))

static OD_entry_t List[OD_LIST_N(7)]; /* at least as many objects as the table has */
static OD_t Od;
static CO_NODE Node;

static ODR_t WriteSpeed(OD_stream_t* stream, const void* buf, OD_size_t count, OD_size_t* written) {
  uint32_t wanted;
  if (stream == NULL || buf == NULL || written == NULL || count != sizeof(wanted)) {
    return ODR_DEV_INCOMPAT;
  }
  memcpy(&wanted, buf, sizeof(wanted));
  if (wanted > ((const MOTOR*)stream->object)->Limit) {
    return ODR_VALUE_HIGH;
  }
  return OD_writeOriginal(stream, buf, count, written);
}

static ODR_t ReadTemperature(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* read) {
  const int16_t temperature = -40;
  if (stream == NULL || buf == NULL || read == NULL || count != sizeof(temperature)) {
    return ODR_DEV_INCOMPAT;
  }
  memcpy(buf, &temperature, sizeof(temperature));
  *read = sizeof(temperature);
  return ODR_OK;
}

static OD_extension_t SpeedExtension;
static OD_extension_t TemperatureExtension;

void setUp(void) {
  static CO_NODE_EXT ext; /* must exist as long as the node */
  memset(&ext, 0, sizeof(ext));
  ext.Size = sizeof(ext);
  ext.Od = &Od;
  Motor.Limit = 1000;
  Speed = 100;
  memcpy(NameMemory, "Mixer", 6);
  Name.Size = 5;
  memset(&SpeedExtension, 0, sizeof(SpeedExtension));
  SpeedExtension.object = &Motor;
  SpeedExtension.read = OD_readOriginal;
  SpeedExtension.write = WriteSpeed;
  memset(&TemperatureExtension, 0, sizeof(TemperatureExtension));
  TemperatureExtension.read = ReadTemperature;
  memset(&Od, 0, sizeof(Od));
  TEST_ASSERT_EQUAL(ODR_OK, OD_init(&Od, List, OD_LIST_N(7), &Node, (CO_OBJ*)Table, TABLE_N));
  NodeUpEx(&Node, Table, TABLE_N, &ext);
}

static void test_a_text_is_read_with_zeros_behind_it(void) {
  OD_IO_t name;
  char text[21];
  OD_size_t n = 0;
  TEST_ASSERT_EQUAL(ODR_OK, OD_getSub(OD_find(&Od, 0x1008), 0, &name, false));
  TEST_ASSERT_EQUAL(ODR_OK, name.read(&name.stream, text, sizeof(text), &n));
  TEST_ASSERT_EQUAL_UINT32(20, n);
  TEST_ASSERT_EQUAL_STRING("Mixer", text);
}

static void test_a_shorter_text_is_written_by_saying_so(void) {
  OD_IO_t name;
  OD_size_t n = 0;
  TEST_ASSERT_EQUAL(ODR_OK, OD_getSub(OD_find(&Od, 0x1008), 0, &name, false));
  TEST_ASSERT_EQUAL(ODR_PARTIAL, name.write(&name.stream, "abc", 3, &n));
  OD_rwRestart(&name.stream);
  name.stream.dataLength = 3;
  TEST_ASSERT_EQUAL(ODR_OK, name.write(&name.stream, "abc", 3, &n));
  BusReceive(&Node, "601#4008100000000000");
  TEST_ASSERT_SENT("581#4708100061626300");
}

static void test_a_file_is_read_in_pieces(void) {
  OD_IO_t file;
  uint8_t part[16];
  uint8_t all[sizeof(FileMemory)];
  OD_size_t at = 0;
  OD_size_t n = 0;
  ODR_t r;
  memset(FileMemory, 0x5A, sizeof(FileMemory));
  TEST_ASSERT_EQUAL(ODR_OK, OD_getSub(OD_find(&Od, 0x2102), 0, &file, false));
  do {
    r = file.read(&file.stream, part, sizeof(part), &n);
    TEST_ASSERT_TRUE(r == ODR_OK || r == ODR_PARTIAL);
    memcpy(&all[at], part, n);
    at += n;
  } while (r == ODR_PARTIAL);
  TEST_ASSERT_EQUAL_UINT32(sizeof(FileMemory), at);
  TEST_ASSERT_EQUAL_MEMORY(FileMemory, all, sizeof(all));
}

static void test_an_extension_validates_before_anything_changes(void) {
  TEST_ASSERT_EQUAL(ODR_OK, OD_extension_init(OD_find(&Od, 0x2100), &SpeedExtension));
  BusReceive(&Node, "601#23002100E9030000"); /* 1001 */
  TEST_ASSERT_SENT("581#8000210031000906");
  TEST_ASSERT_EQUAL_UINT32(100, Speed);
  BusReceive(&Node, "601#23002100E8030000"); /* 1000 */
  TEST_ASSERT_SENT("581#6000210000000000");
  TEST_ASSERT_EQUAL_UINT32(1000, Speed);
  TEST_ASSERT_EQUAL(ODR_VALUE_HIGH, OD_set_u32(OD_find(&Od, 0x2100), 0, 2000, false));
  TEST_ASSERT_EQUAL(ODR_OK, OD_set_u32(OD_find(&Od, 0x2100), 0, 2000, true));
  TEST_ASSERT_EQUAL_UINT32(2000, Speed);
}

static void test_a_number_that_only_an_extension_has(void) {
  int16_t temperature = 0;
  BusReceive(&Node, "601#4001210000000000");
  TEST_ASSERT_SENT("581#8001210001000106"); /* no access without an extension */
  TEST_ASSERT_EQUAL(ODR_SUB_NOT_EXIST, OD_get_i16(OD_find(&Od, 0x2101), 0, &temperature, false));
  TEST_ASSERT_EQUAL(ODR_OK, OD_extension_init(OD_find(&Od, 0x2101), &TemperatureExtension));
  BusReceive(&Node, "601#4001210000000000");
  TEST_ASSERT_SENT("581#4B012100D8FF0000");
  TEST_ASSERT_EQUAL(ODR_OK, OD_get_i16(OD_find(&Od, 0x2101), 0, &temperature, false));
  TEST_ASSERT_EQUAL_INT(-40, temperature);
  TEST_ASSERT_EQUAL(ODR_UNSUPP_ACCESS, OD_set_i16(OD_find(&Od, 0x2101), 0, 1, false));
}

static void test_an_object_whose_entries_do_not_say_so_cannot_be_extended(void) {
  TEST_ASSERT_EQUAL(ODR_UNSUPP_ACCESS, OD_extension_init(OD_find(&Od, 0x1017), &SpeedExtension));
  TEST_ASSERT_EQUAL(ODR_OK, OD_set_u16(OD_find(&Od, 0x1017), 0, 500, false));
  TEST_ASSERT_EQUAL_UINT16(500, HeartbeatTime);
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_text_is_read_with_zeros_behind_it);
  RUN_TEST(test_a_shorter_text_is_written_by_saying_so);
  RUN_TEST(test_a_file_is_read_in_pieces);
  RUN_TEST(test_an_extension_validates_before_anything_changes);
  RUN_TEST(test_a_number_that_only_an_extension_has);
  RUN_TEST(test_an_object_whose_entries_do_not_say_so_cannot_be_extended);
  return UNITY_END();
}
