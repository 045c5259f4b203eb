// SPDX-License-Identifier: Apache-2.0
// Firmware that reads and writes objects of another node: 1280h with 600h and 580h without node-ID, static buffers, and
// a callback that requests the next object.
#include <string.h>

#include "co_core.h"
#include "fakes.h"
#include "unity.h"

#define SERVER_NODE_ID 5
#define TIMEOUT_MS 100u

static uint8_t ServerNodeId;

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1280, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
    {CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_SDO_REQUEST())},
    {CO_KEY(0x1280, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_SDO_RESPONSE())},
    {CO_KEY(0x1280, 3, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&ServerNodeId)},
    CO_OBJ_DICT_ENDMARK,
};

static CO_NODE Node;

static uint8_t Value[4];
static uint8_t Text[16];

/* Number of calls of the callback, and its last arguments. */
static struct ENDED {
  unsigned Calls;
  CO_CSDO* Csdo;
  uint16_t Index;
  uint8_t Sub;
  uint32_t Code;
  CO_CSDO_STATE State;
  uint32_t Num;
} Ended;

static void AppCSdoEnded(CO_CSDO* csdo, uint16_t index, uint8_t sub, uint32_t code) {
  Ended.Calls++;
  Ended.Csdo = csdo;
  Ended.Index = index;
  Ended.Sub = sub;
  Ended.Code = code;
  Ended.State = csdo->State;
  Ended.Num = COCSdoGetNum(csdo);
}

void setUp(void) {
  memset(&Ended, 0, sizeof(Ended));
  memset(Value, 0xA5, sizeof(Value));
  memset(Text, 0, sizeof(Text));
  ServerNodeId = SERVER_NODE_ID;
  NodeUp(&Node, Dictionary, sizeof(Dictionary) / sizeof(Dictionary[0]));
}

static CO_CSDO* Client(void) {
  CO_CSDO* csdo = COCSdoFind(&Node, 0);
  TEST_ASSERT_NOT_NULL(csdo);
  return csdo;
}

static void Upload(uint8_t* buffer, uint32_t size) {
  TEST_ASSERT_EQUAL(CO_ERR_NONE,
                    COCSdoRequestUpload(Client(), CO_DEV(0x2000, 5), buffer, size, AppCSdoEnded, TIMEOUT_MS));
}

static void Download(uint8_t* buffer, uint32_t size) {
  TEST_ASSERT_EQUAL(CO_ERR_NONE,
                    COCSdoRequestDownload(Client(), CO_DEV(0x2000, 5), buffer, size, AppCSdoEnded, TIMEOUT_MS));
}

static void AssertEnded(uint32_t code) {
  TEST_ASSERT_EQUAL(1, Ended.Calls);
  TEST_ASSERT_EQUAL_PTR(Client(), Ended.Csdo);
  TEST_ASSERT_EQUAL_HEX16(0x2000, Ended.Index);
  TEST_ASSERT_EQUAL_UINT8(5, Ended.Sub);
  TEST_ASSERT_EQUAL_HEX32(code, Ended.Code);
  TEST_ASSERT_EQUAL(CO_CSDO_STATE_IDLE, Ended.State);
  TEST_ASSERT_SENT("");
}

static void test_the_functions_have_the_types_that_firmware_declares(void) {
  CO_CSDO* (*find)(struct CO_NODE_T*, uint8_t) = COCSdoFind;
  CO_ERR (*upload)(CO_CSDO*, uint32_t, uint8_t*, uint32_t, CO_CSDO_CALLBACK_T, uint32_t) = COCSdoRequestUpload;
  CO_ERR (*download)(CO_CSDO*, uint32_t, uint8_t*, uint32_t, CO_CSDO_CALLBACK_T, uint32_t) = COCSdoRequestDownload;
  CO_CSDO_CALLBACK_T callback = AppCSdoEnded;
  CO_ERR (*cancel)(CO_CSDO*) = COCSdoCancel;
  uint32_t (*num)(const CO_CSDO*) = COCSdoGetNum;
  uint32_t (*total)(const CO_CSDO*) = COCSdoGetTotal;
  CO_CSDO* csdo = find(&Node, 0);
  TEST_ASSERT_EQUAL(CO_ERR_NONE, upload(csdo, CO_DEV(0x2000, 5), Value, 4, callback, TIMEOUT_MS));
  TEST_ASSERT_EQUAL(CO_ERR_SDO_BUSY, download(csdo, CO_DEV(0x2000, 5), Value, 4, callback, TIMEOUT_MS));
  TEST_ASSERT_EQUAL_UINT32(0, num(csdo));
  TEST_ASSERT_EQUAL_UINT32(0, total(csdo));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, cancel(csdo));
}

static void test_clients_are_found_by_their_number_from_0(void) {
  CO_CSDO* csdo = COCSdoFind(&(Node), 0);
  TEST_ASSERT_EQUAL_PTR(&Node.CSdo[0], csdo);
  TEST_ASSERT_EQUAL(CO_CSDO_STATE_IDLE, csdo->State);
  TEST_ASSERT_EQUAL_UINT8(SERVER_NODE_ID, csdo->NodeId);
  TEST_ASSERT_NULL(COCSdoFind(&Node, 1));
  TEST_ASSERT_NULL(COCSdoFind(&Node, CO_CSDO_N));
  TEST_ASSERT_NULL(COCSdoFind(NULL, 0));
}

static void test_without_1280h_there_is_no_client(void) {
  NodeUp(&Node, Dictionary, 4);
  TEST_ASSERT_NULL(COCSdoFind(&Node, 0));
  TEST_ASSERT_EQUAL(CO_CSDO_STATE_INVALID, Node.CSdo[0].State);
}

static void test_a_number_is_uploaded(void) {
  const uint8_t bytes[] = {0x78, 0x56, 0x34, 0x12};
  Upload(&Value[0], sizeof(Value));
  TEST_ASSERT_SENT("605#4000200500000000");
  TEST_ASSERT_EQUAL(0, Ended.Calls);
  BusReceive(&Node, "585#4300200578563412");
  AssertEnded(0);
  TEST_ASSERT_EQUAL_HEX8_ARRAY(bytes, Value, 4);
}

static void test_a_number_may_be_shorter_than_the_buffer(void) {
  const uint8_t bytes[] = {0x34, 0x12, 0xA5, 0xA5};
  Upload(Value, sizeof(Value));
  TEST_ASSERT_SENT("605#4000200500000000");
  BusReceive(&Node, "585#4B00200534120000");
  AssertEnded(0);
  TEST_ASSERT_EQUAL_UINT32(2, Ended.Num);
  TEST_ASSERT_EQUAL_HEX8_ARRAY(bytes, Value, 4);
}

static void test_a_text_is_uploaded_in_segments(void) {
  Upload(Text, sizeof(Text));
  TEST_ASSERT_SENT("605#4000200500000000");
  BusReceive(&Node, "585#410020050C000000");
  TEST_ASSERT_SENT("605#6000000000000000");
  BusReceive(&Node, "585#004C65786963616E");
  TEST_ASSERT_SENT("605#7000000000000000");
  TEST_ASSERT_EQUAL(0, Ended.Calls);
  BusReceive(&Node, "585#152064656D6F0000");
  AssertEnded(0);
  TEST_ASSERT_EQUAL_UINT32(12, Ended.Num);
  TEST_ASSERT_EQUAL_STRING("Lexican demo", Text);
}

static void test_an_object_larger_than_the_buffer_is_aborted(void) {
  Upload(Text, sizeof(Text));
  TEST_ASSERT_SENT("605#4000200500000000");
  BusReceive(&Node, "585#4100200511000000");
  TEST_ASSERT_SENT("605#8000200505000405");
  AssertEnded(CO_SDO_ERR_MEM);
}

static void test_numbers_are_downloaded_in_one_frame(void) {
  static const char* const requests[] = {"605#2F00200511000000", "605#2B00200511220000", "605#2700200511223300",
                                         "605#2300200511223344"};
  for (uint32_t size = 1; size <= 4; size++) {
    memset(&Ended, 0, sizeof(Ended));
    memcpy(Value, "\x11\x22\x33\x44", 4);
    Download(Value, size);
    TEST_ASSERT_SENT(requests[size - 1]);
    BusReceive(&Node, "585#6000200500000000");
    AssertEnded(0);
    TEST_ASSERT_EQUAL_UINT32(size, Ended.Num);
  }
}

static void test_a_text_is_downloaded_in_segments(void) {
  memcpy(Text, "new name", 8);
  Download(Text, 8);
  TEST_ASSERT_SENT("605#2100200508000000");
  BusReceive(&Node, "585#6000200500000000");
  TEST_ASSERT_SENT("605#006E6577206E616D");
  BusReceive(&Node, "585#2000000000000000");
  TEST_ASSERT_SENT("605#1D65000000000000");
  TEST_ASSERT_EQUAL(0, Ended.Calls);
  BusReceive(&Node, "585#3000000000000000");
  AssertEnded(0);
}

static void test_the_abort_code_of_the_server_reaches_the_callback(void) {
  Upload(Value, sizeof(Value));
  TEST_ASSERT_SENT("605#4000200500000000");
  BusReceive(&Node, "585#8000200501000106");
  AssertEnded(0x06010001);
  memset(&Ended, 0, sizeof(Ended));
  Download(Value, 1);
  TEST_ASSERT_SENT("605#2F002005A5000000");
  BusReceive(&Node, "585#8000200530000906");
  AssertEnded(CO_SDO_ERR_RANGE);
}

static void test_a_server_that_is_not_there_times_out(void) {
  Upload(Value, sizeof(Value));
  TEST_ASSERT_SENT("605#4000200500000000");
  TimePasses(&Node, TIMEOUT_MS - 1);
  TEST_ASSERT_SENT("");
  TEST_ASSERT_EQUAL(CO_CSDO_STATE_BUSY, Client()->State);
  TimePasses(&Node, 1);
  TEST_ASSERT_SENT("605#8000200500000405");
  AssertEnded(0x05040000);
  BusReceive(&Node, "585#4300200578563412"); /* response after the time-out */
  TimePasses(&Node, 10 * TIMEOUT_MS);
  AssertEnded(0x05040000);
  TEST_ASSERT_EQUAL_HEX8(0xA5, Value[0]);
}

static void test_a_time_out_of_0_waits_for_ever(void) {
  CO_ERR err = COCSdoRequestUpload(Client(), CO_DEV(0x2000, 5), Value, sizeof(Value), AppCSdoEnded, 0);
  TEST_ASSERT_EQUAL(CO_ERR_NONE, err);
  TEST_ASSERT_SENT("605#4000200500000000");
  TimePasses(&Node, 100000);
  TEST_ASSERT_EQUAL(0, Ended.Calls);
  BusReceive(&Node, "585#4F00200577000000");
  AssertEnded(0);
}

static void test_the_state_tells_whether_the_client_is_free(void) {
  CO_CSDO* csdo = Client();
  Upload(Value, sizeof(Value));
  TEST_ASSERT_SENT("605#4000200500000000");
  TEST_ASSERT_EQUAL(CO_CSDO_STATE_BUSY, csdo->State);
  TEST_ASSERT_EQUAL_PTR(csdo, COCSdoFind(&Node, 0));
  TEST_ASSERT_EQUAL(CO_ERR_SDO_BUSY, COCSdoRequestUpload(csdo, CO_DEV(0x2001, 0), Text, 4, AppCSdoEnded, 0));
  TEST_ASSERT_EQUAL(CO_ERR_SDO_BUSY, COCSdoRequestDownload(csdo, CO_DEV(0x2001, 0), Text, 4, AppCSdoEnded, 0));
  TEST_ASSERT_SENT("");
  BusReceive(&Node, "585#4300200578563412");
  AssertEnded(0);
  TEST_ASSERT_EQUAL_HEX8(0x78, Value[0]);
  TEST_ASSERT_EQUAL_HEX8(0, Text[0]);
}

static void test_bad_arguments_are_refused(void) {
  CO_CSDO* csdo = Client();
  const uint32_t key = CO_DEV(0x2000, 5);
  TEST_ASSERT_EQUAL(CO_ERR_BAD_ARG, COCSdoRequestUpload(NULL, key, Value, 4, AppCSdoEnded, 0));
  TEST_ASSERT_EQUAL(CO_ERR_BAD_ARG, COCSdoRequestUpload(csdo, key, NULL, 4, AppCSdoEnded, 0));
  TEST_ASSERT_EQUAL(CO_ERR_BAD_ARG, COCSdoRequestUpload(csdo, key, Value, 0, AppCSdoEnded, 0));
  TEST_ASSERT_EQUAL(CO_ERR_BAD_ARG, COCSdoRequestUpload(csdo, key, Value, 4, NULL, 0));
  TEST_ASSERT_EQUAL(CO_ERR_BAD_ARG, COCSdoRequestDownload(NULL, key, Value, 4, AppCSdoEnded, 0));
  TEST_ASSERT_EQUAL(CO_ERR_BAD_ARG, COCSdoRequestDownload(csdo, key, NULL, 4, AppCSdoEnded, 0));
  TEST_ASSERT_EQUAL(CO_ERR_BAD_ARG, COCSdoRequestDownload(csdo, key, Value, 4, NULL, 0));
  TEST_ASSERT_EQUAL(CO_CSDO_STATE_IDLE, csdo->State);
  TEST_ASSERT_SENT("");
}

static void test_a_stopped_node_has_no_client(void) {
  Upload(Value, sizeof(Value));
  TEST_ASSERT_SENT("605#4000200500000000");
  BusReceive(&Node, "000#0201");
  AssertEnded(CO_SDO_ERR_TOS_STATE);
  TEST_ASSERT_EQUAL(CO_ERR_SDO_OFF,
                    COCSdoRequestUpload(Client(), CO_DEV(0x2000, 5), Value, sizeof(Value), AppCSdoEnded, 0));
  TEST_ASSERT_SENT("");
}

static void test_a_transfer_is_cancelled(void) {
  TEST_ASSERT_EQUAL(CO_ERR_SDO_OFF, COCSdoCancel(Client()));
  Upload(Value, sizeof(Value));
  TEST_ASSERT_SENT("605#4000200500000000");
  TEST_ASSERT_EQUAL(CO_ERR_NONE, COCSdoCancel(Client()));
  TEST_ASSERT_SENT("605#8000200521000008");
  AssertEnded(CO_SDO_ERR_TOS_LOCAL);
}

/* A start-up sequence: reads the vendor-ID, writes the heartbeat time and reads it back; restarts after an error. */

static unsigned Step;
static uint8_t Identity[4];
static uint8_t Heartbeat[2] = {0xE8, 0x03};

static void GoOn(CO_CSDO* csdo, uint16_t index, uint8_t sub, uint32_t code) {
  AppCSdoEnded(csdo, index, sub, code);
  Step = code == 0 ? Step + 1 : 0;
  switch (Step) {
    case 0: (void)COCSdoRequestUpload(csdo, CO_DEV(0x1018, 1), Identity, 4, GoOn, TIMEOUT_MS); break;
    case 1: (void)COCSdoRequestDownload(csdo, CO_DEV(0x1017, 0), Heartbeat, 2, GoOn, TIMEOUT_MS); break;
    case 2: (void)COCSdoRequestUpload(csdo, CO_DEV(0x1017, 0), Value, 2, GoOn, TIMEOUT_MS); break;
    default: break;
  }
}

static void test_the_callback_starts_the_next_request(void) {
  Step = 0;
  (void)COCSdoRequestUpload(Client(), CO_DEV(0x1018, 1), Identity, 4, GoOn, TIMEOUT_MS);
  TEST_ASSERT_SENT("605#4018100100000000");
  BusReceive(&Node, "585#43181001EFBEADDE");
  TEST_ASSERT_SENT("605#2B171000E8030000");
  TEST_ASSERT_EQUAL(CO_CSDO_STATE_BUSY, Client()->State);
  BusReceive(&Node, "585#6017100000000000");
  TEST_ASSERT_SENT("605#4017100000000000");
  BusReceive(&Node, "585#4B171000E8030000");
  TEST_ASSERT_SENT("");
  TEST_ASSERT_EQUAL(3, Ended.Calls);
  TEST_ASSERT_EQUAL(CO_CSDO_STATE_IDLE, Client()->State);
  TEST_ASSERT_EQUAL_HEX8(0xE8, Value[0]);
}

static void test_the_callback_of_a_time_out_tries_again(void) {
  Step = 0;
  (void)COCSdoRequestUpload(Client(), CO_DEV(0x1018, 1), Identity, 4, GoOn, TIMEOUT_MS);
  TEST_ASSERT_SENT("605#4018100100000000");
  for (unsigned i = 1; i <= 3; i++) {
    TimePasses(&Node, TIMEOUT_MS);
    TEST_ASSERT_SENT("605#8018100100000405");
    TEST_ASSERT_SENT("605#4018100100000000");
    TEST_ASSERT_EQUAL(i, Ended.Calls);
  }
  BusReceive(&Node, "585#43181001EFBEADDE");
  TEST_ASSERT_SENT("605#2B171000E8030000");
}

static void test_another_server_is_addressed_by_its_node_id(void) {
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictWrByte(&Node.Dict, CO_DEV(0x1280, 3), 9));
  Upload(Value, sizeof(Value));
  TEST_ASSERT_SENT("609#4000200500000000");
  BusReceive(&Node, "585#4F00200511000000");
  TEST_ASSERT_EQUAL(0, Ended.Calls);
  BusReceive(&Node, "589#4F00200522000000");
  AssertEnded(0);
  TEST_ASSERT_EQUAL_HEX8(0x22, Value[0]);
}

static void test_complete_identifiers_stay_as_they_are(void) {
  static const CO_OBJ complete[] = {
      {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
      {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
      {CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(CO_COBID_SDO_STD(1, 0, 0x605))},
      {CO_KEY(0x1280, 2, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(CO_COBID_SDO_STD(1, 0, 0x585))},
      {CO_KEY(0x1280, 3, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&ServerNodeId)},
      CO_OBJ_DICT_ENDMARK,
  };
  NodeUp(&Node, complete, sizeof(complete) / sizeof(complete[0]));
  Upload(Value, sizeof(Value));
  TEST_ASSERT_SENT("605#4000200500000000");
  BusReceive(&Node, "585#4F00200511000000");
  AssertEnded(0);
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_the_functions_have_the_types_that_firmware_declares);
  RUN_TEST(test_clients_are_found_by_their_number_from_0);
  RUN_TEST(test_without_1280h_there_is_no_client);
  RUN_TEST(test_a_number_is_uploaded);
  RUN_TEST(test_a_number_may_be_shorter_than_the_buffer);
  RUN_TEST(test_a_text_is_uploaded_in_segments);
  RUN_TEST(test_an_object_larger_than_the_buffer_is_aborted);
  RUN_TEST(test_numbers_are_downloaded_in_one_frame);
  RUN_TEST(test_a_text_is_downloaded_in_segments);
  RUN_TEST(test_the_abort_code_of_the_server_reaches_the_callback);
  RUN_TEST(test_a_server_that_is_not_there_times_out);
  RUN_TEST(test_a_time_out_of_0_waits_for_ever);
  RUN_TEST(test_the_state_tells_whether_the_client_is_free);
  RUN_TEST(test_bad_arguments_are_refused);
  RUN_TEST(test_a_stopped_node_has_no_client);
  RUN_TEST(test_a_transfer_is_cancelled);
  RUN_TEST(test_the_callback_starts_the_next_request);
  RUN_TEST(test_the_callback_of_a_time_out_tries_again);
  RUN_TEST(test_another_server_is_addressed_by_its_node_id);
  RUN_TEST(test_complete_identifiers_stay_as_they_are);
  return UNITY_END();
}
