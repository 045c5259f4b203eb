// SPDX-License-Identifier: Apache-2.0
// Object types of the application: with all five functions, with omitted functions, with application-specific abort
// codes, and based on basic types.
#include <string.h>

#include "co_core.h"
#include "fakes.h"
#include "unity.h"

/* A type with all five functions: a stream of bytes that counts its calls. */

typedef struct JOURNAL {
  uint8_t Text[32];
  uint32_t Length;
  uint32_t Position;
  unsigned Inits;
  unsigned Resets;
  uint32_t WidthInside; /* result of COObjGetSize() within Read */
  uint32_t LargestPiece;
} JOURNAL;

static JOURNAL Journal;

static uint32_t JournalSize(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  const JOURNAL* journal = (const JOURNAL*)obj->Data;
  (void)node;
  return (width == 0 || width > sizeof(journal->Text)) ? journal->Length : width;
}

static CO_ERR JournalInit(CO_OBJ* obj, CO_NODE* node) {
  JOURNAL* journal = (JOURNAL*)obj->Data;
  CO_UNUSED(node);
  journal->Inits++;
  return CO_ERR_NONE;
}

static CO_ERR JournalRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  JOURNAL* journal = (JOURNAL*)obj->Data;
  journal->WidthInside = COObjGetSize(obj, node, 0);
  if (journal->Position + size > journal->WidthInside) {
    return CO_ERR_TYPE_RD;
  }
  memcpy(buffer, &journal->Text[journal->Position], size);
  journal->Position += size;
  return CO_ERR_NONE;
}

static CO_ERR JournalWrite(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  JOURNAL* journal = (JOURNAL*)obj->Data;
  (void)node;
  if (journal->Position + size > sizeof(journal->Text)) {
    return CO_ERR_TYPE_WR;
  }
  memcpy(&journal->Text[journal->Position], buffer, size);
  journal->Position += size;
  journal->Length = journal->Position;
  journal->LargestPiece = size > journal->LargestPiece ? size : journal->LargestPiece;
  return CO_ERR_NONE;
}

static CO_ERR JournalReset(CO_OBJ* obj, CO_NODE* node, uint32_t para) {
  JOURNAL* journal = (JOURNAL*)obj->Data;
  (void)node;
  journal->Resets++;
  journal->Position = para;
  return CO_ERR_NONE;
}

static CO_OBJ_TYPE JournalType = {
    JournalSize,  /* type function to get object size */
    JournalInit,  /* type function to initialize type object */
    JournalRead,  /* type function to read object content */
    JournalWrite, /* type function to write object content */
    JournalReset  /* type function to reset the object */
};

#define CO_TJOURNAL ((CO_OBJ_TYPE*)&JournalType)

/* A type that changes only the Write of a basic type; no Init, no Reset. */

static uint32_t LimitSize(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  const CO_OBJ_TYPE* uint32 = CO_TUNSIGNED32;
  return uint32->Size(obj, node, width);
}

static CO_ERR LimitRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  const CO_OBJ_TYPE* uint32 = CO_TUNSIGNED32;
  return uint32->Read(obj, node, buffer, size);
}

static CO_ERR LimitWrite(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  const CO_OBJ_TYPE* uint32 = CO_TUNSIGNED32;
  uint32_t value;
  ASSERT_EQU_ERR(size, sizeof(value), CO_ERR_BAD_ARG);
  memcpy(&value, buffer, sizeof(value));
  if (value > 1000) {
    return CO_ERR_OBJ_RANGE;
  }
  if (value == 999) {
    COObjTypeUserSDOAbort(obj, node, 0x12345678);
    return CO_ERR_TYPE_WR;
  }
  if (value == 998) {
    return CO_ERR_TYPE_WR;
  }
  return uint32->Write(obj, node, buffer, size);
}

static const CO_OBJ_TYPE LimitType = {LimitSize, 0, LimitRead, LimitWrite, 0};
static uint32_t Limit;

/* A type without Read and Write. */

static uint32_t OneByte(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  (void)obj;
  (void)node;
  (void)width;
  return 1;
}

static const CO_OBJ_TYPE LockedType = {OneByte, 0, 0, 0, 0};
static uint8_t Locked;

/* A type whose Read refuses with an application-specific abort code, also in a segmented transfer. */

static uint32_t TenBytes(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  (void)obj;
  (void)node;
  (void)width;
  return 10;
}

static CO_ERR RefuseRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  (void)buffer;
  (void)size;
  COObjTypeUserSDOAbort(obj, node, 0x08000021);
  return CO_ERR_TYPE_RD;
}

static const CO_OBJ_TYPE RefusingType = {TenBytes, 0, RefuseRead, 0, 0};
static uint8_t Refusing;

/* A type that uses the flags reserved for types. */

static uint32_t FlagsSeen;

static CO_ERR FlagRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  (void)node;
  FlagsSeen = obj->Key & (CO_OBJ_T1 | CO_OBJ_T2);
  memset(buffer, 0x5A, size);
  return CO_ERR_NONE;
}

static const CO_OBJ_TYPE FlagType = {OneByte, 0, FlagRead, 0, 0};

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x6789, 0, CO_OBJ_____RW), CO_TJOURNAL, (CO_DATA)(&Journal)},
    {CO_KEY(0x678A, 0, CO_OBJ_____RW), &LimitType, (CO_DATA)(&Limit)},
    {CO_KEY(0x678B, 0, CO_OBJ_____RW), &LockedType, (CO_DATA)(&Locked)},
    {CO_KEY(0x678C, 0, CO_OBJ_____RW), &RefusingType, (CO_DATA)(&Refusing)},
    {CO_KEY(0x678D, 0, CO_OBJ_____R_ | CO_OBJ_T2), &FlagType, (CO_DATA)(&Locked)},
    CO_OBJ_DICT_ENDMARK,
};

static CO_NODE Node;

void setUp(void) {
  memset(&Journal, 0, sizeof(Journal));
  Limit = 5;
  NodeUp(&Node, Dictionary, sizeof(Dictionary) / sizeof(Dictionary[0]));
}

static void test_init_runs_once_for_each_entry_when_the_node_starts(void) { TEST_ASSERT_EQUAL(1, Journal.Inits); }

static void test_init_runs_again_in_a_reset(void) {
  BusReceive(&Node, "000#8201");
  TEST_ASSERT_EQUAL(2, Journal.Inits);
}

static void test_a_stream_is_downloaded_piece_by_piece(void) {
  BusReceive(&Node, "601#2189670009000000");
  TEST_ASSERT_SENT("581#6089670000000000");
  BusReceive(&Node, "601#0041424344454647");
  TEST_ASSERT_SENT("581#2000000000000000");
  BusReceive(&Node, "601#1B48490000000000");
  TEST_ASSERT_SENT("581#3000000000000000");
  TEST_ASSERT_EQUAL_UINT32(9, Journal.Length);
  TEST_ASSERT_EQUAL_STRING("ABCDEFGHI", Journal.Text);
  TEST_ASSERT_EQUAL(1, Journal.Resets);
  TEST_ASSERT_LESS_OR_EQUAL(7, Journal.LargestPiece);
}

static void test_a_stream_is_uploaded_and_knows_its_width_while_it_is_read(void) {
  memcpy(Journal.Text, "abcdefghij", 10);
  Journal.Length = 10;
  BusReceive(&Node, "601#4089670000000000");
  TEST_ASSERT_SENT("581#418967000A000000");
  BusReceive(&Node, "601#6000000000000000");
  TEST_ASSERT_SENT("581#0061626364656667");
  BusReceive(&Node, "601#7000000000000000");
  TEST_ASSERT_SENT("581#1968696A00000000");
  TEST_ASSERT_EQUAL_UINT32(10, Journal.WidthInside);
}

static void test_type_functions_serve_the_application_as_well(void) {
  uint8_t text[] = {'o', 'n', 'e'};
  uint8_t back[3];
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictWrBuffer(&Node.Dict, CO_DEV(0x6789, 0), text, sizeof(text)));
  TEST_ASSERT_EQUAL_UINT32(3, COObjGetSize(CODictFind(&Node.Dict, CO_DEV(0x6789, 0)), &Node, 0));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdBuffer(&Node.Dict, CO_DEV(0x6789, 0), back, sizeof(back)));
  TEST_ASSERT_EQUAL_MEMORY(text, back, sizeof(back));
  TEST_ASSERT_EQUAL(2, Journal.Resets);
}

static void test_missing_init_and_reset_are_successes(void) {
  CO_OBJ* obj = CODictFind(&Node.Dict, CO_DEV(0x678A, 0));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, COObjInit(obj, &Node));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, COObjReset(obj, &Node, 0));
}

static void test_missing_read_and_write_refuse_the_access(void) {
  uint8_t byte = 0;
  TEST_ASSERT_EQUAL(CO_ERR_OBJ_ACC, CODictRdByte(&Node.Dict, CO_DEV(0x678B, 0), &byte));
  TEST_ASSERT_EQUAL(CO_ERR_OBJ_ACC, CODictWrByte(&Node.Dict, CO_DEV(0x678B, 0), 1));
  BusReceive(&Node, "601#408B670000000000");
  TEST_ASSERT_EQUAL_STRING_LEN("581#808B6700", BusSent(), 12);
  TEST_ASSERT_SENT("");
}

static void test_a_basic_type_is_reused(void) {
  uint32_t value = 0;
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdLong(&Node.Dict, CO_DEV(0x678A, 0), &value));
  TEST_ASSERT_EQUAL_UINT32(5, value);
  BusReceive(&Node, "601#238A6700E8030000");
  TEST_ASSERT_SENT("581#608A670000000000");
  TEST_ASSERT_EQUAL_UINT32(1000, Limit);
  BusReceive(&Node, "601#408A670000000000");
  TEST_ASSERT_SENT("581#438A6700E8030000");
}

static void test_an_abort_code_of_the_application_is_sent(void) {
  BusReceive(&Node, "601#238A6700E7030000");
  TEST_ASSERT_SENT("581#808A670078563412");
  TEST_ASSERT_EQUAL_UINT32(5, Limit);
}

static void test_an_abort_code_of_the_application_holds_for_one_transfer(void) {
  BusReceive(&Node, "601#238A6700E7030000");
  TEST_ASSERT_SENT("581#808A670078563412");
  BusReceive(&Node, "601#238A6700E6030000");
  TEST_ASSERT_SENT("581#808A670020000008");
}

static void test_an_abort_code_of_the_application_is_sent_for_long_objects_too(void) {
  BusReceive(&Node, "601#408C670000000000");
  const char* answer = BusSent();
  if (strncmp(answer, "581#41", 6) == 0) {
    BusReceive(&Node, "601#6000000000000000");
    answer = BusSent();
  }
  TEST_ASSERT_EQUAL_STRING("581#808C670021000008", answer);
}

static void test_errors_of_type_functions_become_abort_codes(void) {
  BusReceive(&Node, "601#238A6700E9030000");
  TEST_ASSERT_SENT("581#808A670030000906");
  BusReceive(&Node, "601#238A6700E6030000");
  TEST_ASSERT_SENT("581#808A670020000008");
}

static void test_without_a_transfer_the_abort_code_has_no_effect(void) {
  TEST_ASSERT_EQUAL(CO_ERR_TYPE_WR, CODictWrLong(&Node.Dict, CO_DEV(0x678A, 0), 999));
  TEST_ASSERT_SENT("");
  BusReceive(&Node, "601#238A6700E6030000");
  TEST_ASSERT_SENT("581#808A670020000008");
}

static void test_an_indicated_size_other_than_the_objects_is_refused_before_the_type_is_asked(void) {
  BusReceive(&Node, "601#2B8A670001000000");
  TEST_ASSERT_SENT("581#808A670013000706");
  TEST_ASSERT_EQUAL_UINT32(5, Limit);
}

static void test_type_flags_are_left_to_the_type(void) {
  BusReceive(&Node, "601#408D670000000000");
  TEST_ASSERT_SENT("581#4F8D67005A000000");
  TEST_ASSERT_EQUAL_HEX32(CO_OBJ_T2, FlagsSeen);
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_init_runs_once_for_each_entry_when_the_node_starts);
  RUN_TEST(test_init_runs_again_in_a_reset);
  RUN_TEST(test_a_stream_is_downloaded_piece_by_piece);
  RUN_TEST(test_a_stream_is_uploaded_and_knows_its_width_while_it_is_read);
  RUN_TEST(test_type_functions_serve_the_application_as_well);
  RUN_TEST(test_missing_init_and_reset_are_successes);
  RUN_TEST(test_missing_read_and_write_refuse_the_access);
  RUN_TEST(test_a_basic_type_is_reused);
  RUN_TEST(test_an_abort_code_of_the_application_is_sent);
  RUN_TEST(test_an_abort_code_of_the_application_holds_for_one_transfer);
  RUN_TEST(test_an_abort_code_of_the_application_is_sent_for_long_objects_too);
  RUN_TEST(test_errors_of_type_functions_become_abort_codes);
  RUN_TEST(test_without_a_transfer_the_abort_code_has_no_effect);
  RUN_TEST(test_an_indicated_size_other_than_the_objects_is_refused_before_the_type_is_asked);
  RUN_TEST(test_type_flags_are_left_to_the_type);
  return UNITY_END();
}
