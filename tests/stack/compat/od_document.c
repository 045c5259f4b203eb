// SPDX-License-Identifier: Apache-2.0
// Accesses the object dictionary like the page "Object Dictionary": myFunc() is unchanged except for white space, the
// second example uses names of this stack.
#include <string.h>

#include "301/CO_ODinterface.h"
#include "co_core.h"
#include "fakes.h"
#include "unity.h"

extern OD_t* ODxyz;
void myFunc(OD_t* od);

/* omitted by the page */
static CO_NODE Node;
static CO_NODE* const CANmodule = &Node;
static char Name[50];
static OD_size_t NameBytes;
static int Errors;

void myFunc(OD_t* od) {
  ODR_t odRet;
  OD_entry_t* entry;
  OD_IO_t io1008;
  char buf[50];
  OD_size_t bytesRd;
  int error = 0;

  /* Init IO for "Manufacturer device name" at index 0x1008, sub-index 0x00 */
  entry = OD_find(od, 0x1008);
  odRet = OD_getSub(entry, 0x00, &io1008, false);
  /* Read with io1008, subindex = 0x00 */
  if (odRet == ODR_OK) {
    /* Locking is necessary from mainline thread, but must not be used from
     * timer interval (real-time) thread. Locking is not necessary in the
     * CANoopen initialization section. Locking is also not necessary, if
     * OD variable is not mappable to PDO and not accessed from RT thread.*/
    CO_LOCK_OD(CANmodule);
    odRet = io1008.read(&io1008.stream, &buf[0], sizeof(buf), &bytesRd);
    CO_UNLOCK_OD(CANmodule);
  }
  if (odRet != ODR_OK) error++;

  /* not part of the page: results for the test */
  if (odRet == ODR_OK) {
    memcpy(Name, buf, bytesRd);
    NameBytes = bytesRd;
  }

  /* Use helper and set "Producer heartbeat time" at index 0x1017, sub 0x00 */
  CO_LOCK_OD(CANmodule); /* may not be necessary, see comment above */
  odRet = OD_set_u16(OD_find(od, 0x1017), 0x00, 500, false);
  CO_UNLOCK_OD(CANmodule);
  if (odRet != ODR_OK) error++;

  Errors = error; /* not part of the page */
}

static uint8_t ErrorRegister;
static uint16_t HeartbeatTime;
static uint8_t NameMemory[20] = "Mixer 4";
static CO_OBJ_STR_RW NameObj = {0, 7, 20, NameMemory};
static struct {
  uint32_t x1000_deviceType;
  struct {
    uint32_t serialNumber;
  } x1018_identity;
} ODxyz_0 = {0x000F0191, {0}};

static const CO_OBJ Table[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&ODxyz_0.x1000_deviceType)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1008, 0, CO_OBJ_____R_), CO_TVISIBLE_STRING, (CO_DATA)(&NameObj)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&HeartbeatTime)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(4)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1018, 4, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&ODxyz_0.x1018_identity.serialNumber)},
    CO_OBJ_DICT_ENDMARK,
};
#define TABLE_N ((uint16_t)(sizeof(Table) / sizeof(Table[0])))

static OD_entry_t List[OD_LIST_N(5)];
static OD_t Od;
OD_t* ODxyz = &Od;

/* Shortcut like those of the page's header; the list is this file's, in the order of the indexes. */
#define ODxyz_1001_errorRegister &ODxyz->list[1]

void setUp(void) {
  Errors = -1;
  NameBytes = 0;
  HeartbeatTime = 0;
  memset(Name, 0, sizeof(Name));
  TEST_ASSERT_EQUAL(ODR_OK, OD_init(&Od, List, OD_LIST_N(5), &Node, (CO_OBJ*)Table, TABLE_N));
  NodeUp(&Node, Table, TABLE_N);
}

static void test_the_function_of_the_page_reads_the_name(void) {
  myFunc(ODxyz);
  TEST_ASSERT_EQUAL_INT(0, Errors);
  TEST_ASSERT_EQUAL_STRING("Mixer 4", Name);
  TEST_ASSERT_EQUAL_UINT32(20, NameBytes);
}

static void test_the_function_of_the_page_starts_the_heartbeat(void) {
  myFunc(ODxyz);
  TEST_ASSERT_EQUAL_UINT16(500, HeartbeatTime);
  TimePasses(&Node, 500);
  TEST_ASSERT_SENT("701#7F");
  TEST_ASSERT_SENT("");
  TimePasses(&Node, 500);
  TEST_ASSERT_SENT("701#7F");
}

static void test_the_function_of_the_page_counts_what_is_not_there(void) {
  static OD_t empty;
  myFunc(&empty);
  TEST_ASSERT_EQUAL_INT(2, Errors);
  myFunc(NULL);
  TEST_ASSERT_EQUAL_INT(2, Errors);
}

/* The second example of the page. */
static void test_simple_access_by_globals(void) {
  /* Direct address instead of OD_find() */
  OD_entry_t* entry_errReg = ODxyz_1001_errorRegister;

  /* Direct access to OD variable */
  uint32_t devType = ODxyz_0.x1000_deviceType;
  ODxyz_0.x1018_identity.serialNumber = 0x12345678;

  TEST_ASSERT_EQUAL_PTR(OD_find(ODxyz, 0x1001), entry_errReg);
  TEST_ASSERT_EQUAL_HEX16(0x1001, OD_getIndex(entry_errReg));
  TEST_ASSERT_EQUAL_HEX32(0x000F0191, devType);
  BusReceive(&Node, "601#4018100400000000");
  TEST_ASSERT_SENT("581#4318100478563412");
}

/* Checks numbers outside ODR_t, which a program that stores results in an int may pass. */
static void test_numbers_that_are_no_result_have_an_abort_code(void) {
  TEST_ASSERT_EQUAL_HEX32(0x06040047, OD_getSDOabCode((ODR_t)-1));
  TEST_ASSERT_EQUAL_HEX32(0x06040047, OD_getSDOabCode((ODR_t)26));
  TEST_ASSERT_EQUAL_HEX32(0x08000024, OD_getSDOabCode(ODR_NO_DATA));
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_the_function_of_the_page_reads_the_name);
  RUN_TEST(test_the_function_of_the_page_starts_the_heartbeat);
  RUN_TEST(test_the_function_of_the_page_counts_what_is_not_there);
  RUN_TEST(test_simple_access_by_globals);
  RUN_TEST(test_numbers_that_are_no_result_have_an_abort_code);
  return UNITY_END();
}
