// SPDX-License-Identifier: Apache-2.0
// The examples of the page "Using Object Dictionary", unchanged except for white space. The tables of several sections
// are joined, lines with ellipses are removed, and prototypes and variables that the page omits are added.
#include <string.h>

#include "co_core.h"
#include "fakes.h"
#include "unity.h"

/* omitted by the page */
#define DEMO_DOMAIN_SIZE 10u
static CO_NODE demo;
static uint32_t value;
static uint8_t DemoErrReg = 1;
static uint32_t DemoEmcyId = 0x80;
static uint32_t DemoVarLong = 0x12345678;
static uint32_t DemoPolled = 7;
static uint32_t DemoValue;
static uint32_t MyValue = 0x55;
static uint32_t DemoWidth;

uint32_t DemoSize(CO_OBJ* obj, CO_NODE* node, uint32_t width);
CO_ERR DemoInit(CO_OBJ* obj, CO_NODE* node);
CO_ERR DemoRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size);
CO_ERR DemoWrite(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size);
CO_ERR DemoReset(CO_OBJ* obj, CO_NODE* node, uint32_t para);

uint32_t MyTypeSize(CO_OBJ* obj, CO_NODE* node, uint32_t width);
CO_ERR MyTypeRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size);
CO_ERR MyTypeWrite(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size);

/* Domain Objects */
uint8_t DemoDomainMem[DEMO_DOMAIN_SIZE]; /* domain memory area */

CO_OBJ_DOM DemoDomainObj = {
    0,                /* variable for read position     */
    DEMO_DOMAIN_SIZE, /* size of domain memory          */
    &DemoDomainMem[0] /* start address of domain memory */
};

/* String Objects */
const uint8_t DemoString[] = "Hello World!"; /* string memory */

CO_OBJ_STR DemoStringObj = {
    0,             /* variable for read position     */
    &DemoString[0] /* start address of string memory */
};

/* User Objects */
CO_OBJ_TYPE DemoType = {
    DemoSize,  /* type function to get object size         */
    DemoInit,  /* type function to initialize type object  */
    DemoRead,  /* type function to read object content     */
    DemoWrite, /* type function to write object content    */
    DemoReset  /* type function to reset the object        */
};

#define CO_TDEMO ((CO_OBJ_TYPE*)&DemoType)

/* define your new type interface */
const CO_OBJ_TYPE MyType = {MyTypeSize, 0, MyTypeRead, MyTypeWrite};

const CO_OBJ DemoOD[] = {
    /* mandatory, omitted by the page */
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},

    /* PDO mappable read-only value: */
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&DemoErrReg)},

    /* Read-only value, which depends on Node-ID: */
    {CO_KEY(0x1014, 0, CO_OBJ__N__R_), CO_TUNSIGNED32, (CO_DATA)(&DemoEmcyId)},

    /* mandatory, omitted by the page */
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},

    /* entries of the examples for access and for domains */
    {CO_KEY(0x1234, 0x56, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&DemoPolled)},
    {CO_KEY(0x2345, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&DemoDomainObj)},
    {CO_KEY(0x2345, 0x56, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&DemoVarLong)},

    /* In CO_DATA pointer memory stored constant value: */
    {CO_KEY(0x2400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},

    /* A normal 32bit process data entry: */
    {CO_KEY(0x2400, 1, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&DemoVarLong)},

    {CO_KEY(0x3456, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&DemoStringObj)},

    {CO_KEY(0x6789, 0, CO_OBJ_____RW), CO_TDEMO, (CO_DATA)(&DemoValue)},
    {CO_KEY(0x678A, 0, CO_OBJ_____RW), &MyType, (CO_DATA)(&MyValue)},

    /* mark the end of object dictionary: */
    CO_OBJ_DICT_ENDMARK};

/* omitted by the page */
uint32_t DemoSize(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  (void)obj;
  (void)node;
  (void)width;
  return 4;
}

CO_ERR DemoInit(CO_OBJ* obj, CO_NODE* node) {
  (void)obj;
  (void)node;
  DemoValue = 0x600DCAFE;
  return CO_ERR_NONE;
}

CO_ERR DemoReset(CO_OBJ* obj, CO_NODE* node, uint32_t para) {
  (void)obj;
  (void)node;
  (void)para;
  return CO_ERR_NONE;
}

/* How can I access the object size when implementing a type function? */
CO_ERR DemoRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  uint32_t width = COObjGetSize(obj, node, 0);

  /* now you can handle your data with:
   *  - size (number of bytes in buffer)
   *  - width (number of bytes in object entry)
   *  Note: you can trust, that the indicated SDO transfer size (if given)
   *        is equal to the width (checked by the SDO server)
   */
  DemoWidth = width;
  memcpy(buffer, &DemoValue, size);
  return CO_ERR_NONE;
}

/* How can I set a non-standard ABORT codes when implementing a type function? */
CO_ERR DemoWrite(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  uint32_t wanted = 0;
  memcpy(&wanted, buffer, size);
  if (wanted > 100 /* your error condition */) {
    /* the given abort code is considered in SDO transfers only! */
    COObjTypeUserSDOAbort(obj, node, 0x12345678);
    return CO_ERR_TYPE_WR;
  }
  DemoValue = wanted;
  return CO_ERR_NONE;
}

/* How can I use the basic type functions when implementing a type function? */
uint32_t MyTypeSize(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  /* get base type and re-use it for the size function */
  const CO_OBJ_TYPE* uint32 = CO_TUNSIGNED32;
  return uint32->Size(obj, node, width);
}

CO_ERR MyTypeRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  /* get base type and re-use it for the read function */
  const CO_OBJ_TYPE* uint32 = CO_TUNSIGNED32;
  return uint32->Read(obj, node, buffer, size);
}

CO_ERR MyTypeWrite(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  /* place here your implementation for the write function */
  (void)obj;
  (void)node;
  (void)buffer;
  (void)size;
  return CO_ERR_NONE;
}

void setUp(void) { NodeUp(&demo, DemoOD, sizeof(DemoOD) / sizeof(DemoOD[0])); }

static void test_basic_objects_are_read(void) {
  value = 0;
  CODictRdLong(&demo.Dict, CO_DEV(0x2345, 0x56), &value);
  TEST_ASSERT_EQUAL_HEX32(0x12345678, value);
}

static void test_a_found_object_is_read_until_it_changes(void) {
  value = 0;
  CO_OBJ* obj = CODictFind(&demo.Dict, CO_DEV(0x1234, 0x56));

  do {
    COObjRdValue(obj, &demo, &value, sizeof(value));
  } while (value == 0);
  TEST_ASSERT_EQUAL_UINT32(7, value);
}

static void test_the_table_serves_the_network(void) {
  BusReceive(&demo, "601#4000240000000000");
  TEST_ASSERT_SENT("581#4F00240001000000");
  BusReceive(&demo, "601#4014100000000000");
  TEST_ASSERT_SENT("581#4314100081000000");
}

static void test_the_string_is_read_as_hello_world(void) {
  BusReceive(&demo, "601#4056340000000000");
  TEST_ASSERT_SENT("581#415634000C000000");
  BusReceive(&demo, "601#6000000000000000");
  TEST_ASSERT_SENT("581#0048656C6C6F2057");
  BusReceive(&demo, "601#7000000000000000");
  TEST_ASSERT_SENT("581#156F726C64210000");
}

static void test_the_domain_is_written(void) {
  BusReceive(&demo, "601#214523000A000000");
  TEST_ASSERT_SENT("581#6045230000000000");
  BusReceive(&demo, "601#0001020304050607");
  TEST_ASSERT_SENT("581#2000000000000000");
  BusReceive(&demo, "601#1908090A00000000");
  TEST_ASSERT_SENT("581#3000000000000000");
  TEST_ASSERT_EQUAL_UINT8(10, DemoDomainMem[9]);
}

static void test_the_user_type_is_initialised_read_and_written(void) {
  BusReceive(&demo, "601#4089670000000000");
  TEST_ASSERT_SENT("581#43896700FECA0D60");
  TEST_ASSERT_EQUAL_UINT32(4, DemoWidth);
  BusReceive(&demo, "601#2389670064000000");
  TEST_ASSERT_SENT("581#6089670000000000");
  TEST_ASSERT_EQUAL_UINT32(100, DemoValue);
}

static void test_the_user_type_aborts_with_its_own_code(void) {
  BusReceive(&demo, "601#2389670065000000");
  TEST_ASSERT_SENT("581#8089670078563412");
}

static void test_the_reused_type_reads_and_keeps_its_value(void) {
  BusReceive(&demo, "601#238A670001000000");
  TEST_ASSERT_SENT("581#608A670000000000");
  BusReceive(&demo, "601#408A670000000000");
  TEST_ASSERT_SENT("581#438A670055000000");
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_basic_objects_are_read);
  RUN_TEST(test_a_found_object_is_read_until_it_changes);
  RUN_TEST(test_the_table_serves_the_network);
  RUN_TEST(test_the_string_is_read_as_hello_world);
  RUN_TEST(test_the_domain_is_written);
  RUN_TEST(test_the_user_type_is_initialised_read_and_written);
  RUN_TEST(test_the_user_type_aborts_with_its_own_code);
  RUN_TEST(test_the_reused_type_reads_and_keeps_its_value);
  return UNITY_END();
}
