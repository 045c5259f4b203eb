// SPDX-License-Identifier: Apache-2.0
// Object types with Begin and End (CO_OBJ_TYPE_EX), as constant tables with positional initialisers: a firmware image
// that is valid only when it was received completely, and records whose number is unknown before they are read.
#include <stdio.h>
#include <string.h>

#include "co_core.h"
#include "fakes.h"
#include "unity.h"

/* Calls of the type functions, in their order. */
static char Calls[256];

static void Called(const char* what, uint32_t number) {
  size_t at = strlen(Calls);
  (void)snprintf(&Calls[at], sizeof(Calls) - at, "%s %lX, ", what, (unsigned long)number);
}

#define TEST_ASSERT_CALLS(calls) TEST_ASSERT_EQUAL_STRING(calls, Calls)

typedef struct IMAGE {
  uint8_t Flash[32];
  uint32_t Position;
  uint32_t Length; /* length of a valid image, else 0 */
} IMAGE;

static IMAGE Image;
static int IsLocked;

static uint32_t ImageSize(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  const IMAGE* image = (const IMAGE*)obj->Data;
  (void)node;
  if (width == 0) {
    return image->Length;
  }
  return width < sizeof(image->Flash) ? width : (uint32_t)sizeof(image->Flash);
}

static CO_ERR ImageRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  IMAGE* image = (IMAGE*)obj->Data;
  (void)node;
  Called("read", size);
  memcpy(buffer, &image->Flash[image->Position], size);
  image->Position += size;
  return CO_ERR_NONE;
}

static CO_ERR ImageWrite(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  IMAGE* image = (IMAGE*)obj->Data;
  (void)node;
  Called("write", size);
  memcpy(&image->Flash[image->Position], buffer, size);
  image->Position += size;
  return CO_ERR_NONE;
}

static CO_ERR ImageReset(CO_OBJ* obj, CO_NODE* node, uint32_t para) {
  IMAGE* image = (IMAGE*)obj->Data;
  (void)node;
  Called("reset", para);
  image->Position = para;
  return CO_ERR_NONE;
}

static CO_ERR ImageBegin(CO_OBJ* obj, CO_NODE* node, CO_OBJ_TRANSFER transfer, uint32_t size) {
  IMAGE* image = (IMAGE*)obj->Data;
  Called(transfer == CO_OBJ_DOWNLOAD ? "begin download" : "begin upload", size);
  if (IsLocked) {
    COObjTypeUserSDOAbort(obj, node, CO_SDO_ERR_TOS_LOCAL);
    return CO_ERR_TYPE_WR;
  }
  if (transfer == CO_OBJ_DOWNLOAD) {
    image->Length = 0;
  }
  return CO_ERR_NONE;
}

/* Ends a transfer. A received image is valid if its first byte is 7Fh. */
static CO_ERR ImageEnd(CO_OBJ* obj, CO_NODE* node, CO_OBJ_TRANSFER transfer, uint32_t abort) {
  IMAGE* image = (IMAGE*)obj->Data;
  Called(transfer == CO_OBJ_DOWNLOAD ? "end download" : "end upload", abort);
  if (transfer == CO_OBJ_UPLOAD || abort != 0) {
    return CO_ERR_NONE;
  }
  if (image->Flash[0] == 0) {
    COObjTypeUserSDOAbort(obj, node, 0x12345678);
    return CO_ERR_TYPE_WR;
  }
  if (image->Flash[0] != 0x7F) {
    return CO_ERR_OBJ_RANGE;
  }
  image->Length = image->Position;
  return CO_ERR_NONE;
}

static const CO_OBJ_TYPE_EX ImageType = {
    {ImageSize, 0, ImageRead, ImageWrite, COObjTypeExReset}, /* functions of every type */
    ImageReset,                                              /* sets the position */
    ImageBegin,                                              /* called when a transfer begins */
    ImageEnd                                                 /* called when a transfer has ended */
};

#define CO_TIMAGE ((const CO_OBJ_TYPE*)&ImageType)

/* A type that reads records from a queue; their number is known when the queue is empty. */

static uint32_t RecordsNum;   /* bytes in the queue */
static uint32_t RecordsTaken; /* bytes read by this transfer */
static int RecordsAreOut;

static uint32_t RecordsSize(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  (void)obj;
  (void)node;
  (void)width;
  return RecordsAreOut ? RecordsTaken : CO_OBJ_SIZE_UNKNOWN;
}

static CO_ERR RecordsRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  uint32_t left = RecordsNum - RecordsTaken;
  (void)obj;
  (void)node;
  RecordsAreOut = left < size;
  size = left < size ? left : size;
  memset(buffer, 0x33, size);
  RecordsTaken += size;
  return CO_ERR_NONE;
}

static CO_ERR RecordsReset(CO_OBJ* obj, CO_NODE* node, uint32_t para) {
  (void)obj;
  (void)node;
  RecordsTaken = para;
  RecordsAreOut = 0;
  return CO_ERR_NONE;
}

/* Ends a transfer. The next one requests the size before it begins. */
static CO_ERR RecordsEnd(CO_OBJ* obj, CO_NODE* node, CO_OBJ_TRANSFER transfer, uint32_t abort) {
  (void)obj;
  (void)node;
  (void)transfer;
  (void)abort;
  RecordsAreOut = 0;
  return CO_ERR_NONE;
}

static const CO_OBJ_TYPE_EX RecordsType = {
    {RecordsSize, 0, RecordsRead, 0, COObjTypeExReset}, RecordsReset, 0, RecordsEnd};

/* A type without Reset, Begin and End. */

static uint8_t Register[9];

static uint32_t RegisterSize(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  (void)obj;
  (void)node;
  (void)width;
  return sizeof(Register);
}

static CO_ERR RegisterRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  (void)node;
  memcpy(buffer, (const uint8_t*)obj->Data, size);
  return CO_ERR_NONE;
}

static const CO_OBJ_TYPE_EX RegisterType = {{RegisterSize, 0, RegisterRead, 0, COObjTypeExReset}, 0, 0, 0};

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1F50, 1, CO_OBJ_____RW), CO_TIMAGE, (CO_DATA)(&Image)},
    {CO_KEY(0x2200, 0, CO_OBJ_____R_), &RecordsType.Type, (CO_DATA)(0)},
    {CO_KEY(0x2201, 0, CO_OBJ_____R_), &RegisterType.Type, (CO_DATA)(&Register)},
    CO_OBJ_DICT_ENDMARK,
};

static CO_NODE Node;

void setUp(void) {
  memset(&Image, 0, sizeof(Image));
  memset(Register, 0x44, sizeof(Register));
  Calls[0] = 0;
  IsLocked = 0;
  RecordsNum = 0;
  RecordsAreOut = 0;
  NodeUp(&Node, Dictionary, sizeof(Dictionary) / sizeof(Dictionary[0]));
}

/* Downloads an image, up to the response to the last segment. */
static void DownloadImage(const char* first_segment) {
  BusReceive(&Node, "601#21501F010A000000");
  TEST_ASSERT_SENT("581#60501F0100000000");
  BusReceive(&Node, first_segment);
  TEST_ASSERT_SENT("581#2000000000000000");
  BusReceive(&Node, "601#1908090A00000000");
}

#define DOWNLOAD_CALLS "begin download A, reset 0, write 0, write 7, write 3, "

static void test_a_download_begins_and_ends(void) {
  const uint8_t bytes[] = {0x7F, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  DownloadImage("601#007F020304050607");
  TEST_ASSERT_SENT("581#3000000000000000");
  TEST_ASSERT_CALLS(DOWNLOAD_CALLS "end download 0, ");
  TEST_ASSERT_EQUAL_UINT32(10, Image.Length);
  TEST_ASSERT_EQUAL_HEX8_ARRAY(bytes, Image.Flash, sizeof(bytes));
}

static void test_the_end_of_a_download_refuses_what_has_come(void) {
  DownloadImage("601#0001020304050607");
  TEST_ASSERT_SENT("581#80501F0130000906");
  TEST_ASSERT_CALLS(DOWNLOAD_CALLS "end download 0, ");
  TEST_ASSERT_EQUAL_UINT32(0, Image.Length);
}

static void test_the_end_of_a_download_names_the_abort_code(void) {
  DownloadImage("601#0000020304050607");
  TEST_ASSERT_SENT("581#80501F0178563412");
}

static void test_an_expedited_download_begins_and_ends(void) {
  BusReceive(&Node, "601#27501F017F020300");
  TEST_ASSERT_SENT("581#60501F0100000000");
  TEST_ASSERT_EQUAL_STRING_LEN("begin download 3, reset 0, ", Calls, 27);
  TEST_ASSERT_NOT_NULL(strstr(Calls, "write 3, end download 0, "));
  TEST_ASSERT_EQUAL_UINT32(3, Image.Length);
}

static void test_an_upload_begins_and_ends(void) {
  memcpy(Image.Flash, "ABCDEFGHIJ", 10);
  Image.Length = 10;
  BusReceive(&Node, "601#40501F0100000000");
  TEST_ASSERT_SENT("581#41501F010A000000");
  BusReceive(&Node, "601#6000000000000000");
  TEST_ASSERT_SENT("581#0041424344454647");
  BusReceive(&Node, "601#7000000000000000");
  TEST_ASSERT_SENT("581#1948494A00000000");
  TEST_ASSERT_CALLS("begin upload A, reset 0, read 0, read 7, read 3, end upload 0, ");
}

static void test_what_does_not_begin_does_not_end(void) {
  IsLocked = 1;
  BusReceive(&Node, "601#21501F010A000000");
  TEST_ASSERT_SENT("581#80501F0121000008");
  TEST_ASSERT_CALLS("begin download A, ");
  BusReceive(&Node, "601#80501F0100000000");
  TEST_ASSERT_CALLS("begin download A, ");
}

static void test_what_is_too_long_does_not_begin(void) {
  BusReceive(&Node, "601#21501F0121000000");
  TEST_ASSERT_SENT("581#80501F0112000706");
  TEST_ASSERT_CALLS("");
}

static void HalfADownload(void) {
  BusReceive(&Node, "601#21501F010A000000");
  TEST_ASSERT_SENT("581#60501F0100000000");
  BusReceive(&Node, "601#007F020304050607");
  TEST_ASSERT_SENT("581#2000000000000000");
  TEST_ASSERT_CALLS("begin download A, reset 0, write 0, write 7, ");
  Calls[0] = 0;
}

static void test_the_abort_of_the_client_is_the_end(void) {
  HalfADownload();
  BusReceive(&Node, "601#80501F0144332211");
  TEST_ASSERT_SENT("");
  TEST_ASSERT_CALLS("end download 11223344, ");
  TEST_ASSERT_EQUAL_UINT32(0, Image.Length);
}

static void test_the_abort_of_the_server_is_the_end(void) {
  HalfADownload();
  BusReceive(&Node, "601#0908090A00000000"); /* toggle bit of the previous segment */
  TEST_ASSERT_SENT("581#80501F0100000305");
  TEST_ASSERT_CALLS("end download 5030000, ");
}

static void test_a_client_that_falls_silent_is_the_end(void) {
  HalfADownload();
  TimePasses(&Node, CO_SDO_TIMEOUT);
  TEST_ASSERT_SENT("581#80501F0100000405");
  TEST_ASSERT_CALLS("end download 5040000, ");
}

static void test_a_new_request_is_the_end_of_the_one_before(void) {
  HalfADownload();
  BusReceive(&Node, "601#21501F0109000000");
  TEST_ASSERT_SENT("581#60501F0100000000");
  TEST_ASSERT_CALLS("end download 8000022, begin download 9, reset 0, write 0, ");
}

static void test_a_node_that_stops_is_the_end(void) {
  HalfADownload();
  BusReceive(&Node, "000#0201");
  TEST_ASSERT_CALLS("end download 8000022, ");
  BusReceive(&Node, "000#8001");
  TEST_ASSERT_CALLS("end download 8000022, ");
}

static void test_accesses_of_the_application_are_no_transfers(void) {
  uint8_t bytes[] = {0x7F, 1, 2, 3, 4, 5};
  uint8_t back[6];
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictWrBuffer(&Node.Dict, CO_DEV(0x1F50, 1), bytes, sizeof(bytes)));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdBuffer(&Node.Dict, CO_DEV(0x1F50, 1), back, sizeof(back)));
  TEST_ASSERT_CALLS("reset 0, write 6, reset 0, read 6, ");
  TEST_ASSERT_EQUAL_MEMORY(bytes, back, sizeof(bytes));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, COObjReset(CODictFind(&Node.Dict, CO_DEV(0x1F50, 1)), &Node, 4));
  TEST_ASSERT_EQUAL_UINT32(4, Image.Position);
}

static void test_an_upload_of_unknown_length_ends_where_the_type_says_so(void) {
  RecordsNum = 9;
  BusReceive(&Node, "601#4000220000000000");
  TEST_ASSERT_SENT("581#4000220000000000");
  BusReceive(&Node, "601#6000000000000000");
  TEST_ASSERT_SENT("581#0033333333333333");
  BusReceive(&Node, "601#7000000000000000");
  TEST_ASSERT_SENT("581#1B33330000000000");
}

static void test_an_upload_of_unknown_length_may_end_with_an_empty_segment(void) {
  RecordsNum = 7;
  BusReceive(&Node, "601#4000220000000000");
  TEST_ASSERT_SENT("581#4000220000000000");
  BusReceive(&Node, "601#6000000000000000");
  TEST_ASSERT_SENT("581#0033333333333333");
  BusReceive(&Node, "601#7000000000000000");
  TEST_ASSERT_SENT("581#1F00000000000000");
}

static void test_reset_begin_and_end_may_be_missing(void) {
  BusReceive(&Node, "601#4001220000000000");
  TEST_ASSERT_SENT("581#4101220009000000");
  BusReceive(&Node, "601#6000000000000000");
  TEST_ASSERT_SENT("581#0044444444444444");
  BusReceive(&Node, "601#7000000000000000");
  TEST_ASSERT_SENT("581#1B44440000000000");
  TEST_ASSERT_EQUAL(CO_ERR_NONE, COObjReset(CODictFind(&Node.Dict, CO_DEV(0x2201, 0)), &Node, 0));
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_download_begins_and_ends);
  RUN_TEST(test_the_end_of_a_download_refuses_what_has_come);
  RUN_TEST(test_the_end_of_a_download_names_the_abort_code);
  RUN_TEST(test_an_expedited_download_begins_and_ends);
  RUN_TEST(test_an_upload_begins_and_ends);
  RUN_TEST(test_what_does_not_begin_does_not_end);
  RUN_TEST(test_what_is_too_long_does_not_begin);
  RUN_TEST(test_the_abort_of_the_client_is_the_end);
  RUN_TEST(test_the_abort_of_the_server_is_the_end);
  RUN_TEST(test_a_client_that_falls_silent_is_the_end);
  RUN_TEST(test_a_new_request_is_the_end_of_the_one_before);
  RUN_TEST(test_a_node_that_stops_is_the_end);
  RUN_TEST(test_accesses_of_the_application_are_no_transfers);
  RUN_TEST(test_an_upload_of_unknown_length_ends_where_the_type_says_so);
  RUN_TEST(test_an_upload_of_unknown_length_may_end_with_an_empty_segment);
  RUN_TEST(test_reset_begin_and_end_may_be_missing);
  return UNITY_END();
}
