// SPDX-License-Identifier: Apache-2.0
// Block transfers with firmware that was written for a stack without them: its object types at the server, its buffers
// at the client.
#include <stdio.h>
#include <string.h>

#include "co_core.h"
#include "fakes.h"
#include "unity.h"

#define JOURNAL_BYTES 2000u

/* A stream of CANopen-Stack: a user type with Reset. */

static struct JOURNAL {
  uint8_t Text[JOURNAL_BYTES];
  uint32_t Length;
  uint32_t Position;
  uint32_t Pieces[4]; /* lengths of the first reads or writes */
  unsigned PieceNum;
  unsigned Resets;
} Journal;

static void NotePiece(uint32_t size) {
  if (size != 0 && Journal.PieceNum < 4) {
    Journal.Pieces[Journal.PieceNum++] = size;
  }
}

static uint32_t JournalSize(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  (void)obj;
  (void)node;
  if (width == 0) {
    return Journal.Length;
  }
  return width < JOURNAL_BYTES ? width : JOURNAL_BYTES;
}

static CO_ERR JournalRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  (void)obj;
  (void)node;
  ASSERT_LOWER_ERR(Journal.Position + size, Journal.Length + 1, CO_ERR_TYPE_RD);
  memcpy(buffer, &Journal.Text[Journal.Position], size);
  Journal.Position += size;
  NotePiece(size);
  return CO_ERR_NONE;
}

static CO_ERR JournalWrite(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  (void)obj;
  (void)node;
  ASSERT_LOWER_ERR(Journal.Position + size, JOURNAL_BYTES + 1, CO_ERR_TYPE_WR);
  memcpy(&Journal.Text[Journal.Position], buffer, size);
  Journal.Position += size;
  Journal.Length = Journal.Position;
  NotePiece(size);
  return CO_ERR_NONE;
}

static CO_ERR JournalReset(CO_OBJ* obj, CO_NODE* node, uint32_t para) {
  (void)obj;
  (void)node;
  Journal.Resets++;
  Journal.Position = para;
  return CO_ERR_NONE;
}

static CO_OBJ_TYPE JournalType = {JournalSize, 0, JournalRead, JournalWrite, JournalReset};

/* A value of CANopen-Stack: a user type without Reset. */

static uint64_t Limit;
static uint32_t LimitWritten;

static uint32_t LimitSize(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  (void)obj;
  (void)node;
  (void)width;
  return sizeof(Limit);
}

static CO_ERR LimitWrite(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  (void)obj;
  (void)node;
  LimitWritten = size;
  memcpy(&Limit, buffer, sizeof(Limit));
  return Limit > 1000 ? CO_ERR_OBJ_RANGE : CO_ERR_NONE;
}

static const CO_OBJ_TYPE LimitType = {LimitSize, 0, 0, LimitWrite, 0};

/* A type with Begin and End. */

static CO_OBJ_TRANSFER Transfer;
static uint32_t Begun;
static uint32_t Ended;

static CO_ERR JournalBegin(CO_OBJ* obj, CO_NODE* node, CO_OBJ_TRANSFER transfer, uint32_t size) {
  (void)obj;
  (void)node;
  Transfer = transfer;
  Begun = size;
  return CO_ERR_NONE;
}

static CO_ERR JournalEnd(CO_OBJ* obj, CO_NODE* node, CO_OBJ_TRANSFER transfer, uint32_t abort) {
  (void)obj;
  (void)node;
  Ended = abort;
  return transfer == Transfer ? CO_ERR_NONE : CO_ERR_TYPE_WR;
}

static const CO_OBJ_TYPE_EX WholeJournalType = {
    {JournalSize, 0, JournalRead, JournalWrite, COObjTypeExReset}, JournalReset, JournalBegin, JournalEnd};

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_SDO_REQUEST())},
    {CO_KEY(0x1280, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_SDO_RESPONSE())},
    {CO_KEY(0x1280, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(5)},
    {CO_KEY(0x6789, 0, CO_OBJ_____RW), &JournalType, (CO_DATA)(&Journal)},
    {CO_KEY(0x678A, 0, CO_OBJ______W), &LimitType, (CO_DATA)(&Limit)},
    {CO_KEY(0x678B, 0, CO_OBJ_____RW), &WholeJournalType.Type, (CO_DATA)(&Journal)},
    CO_OBJ_DICT_ENDMARK,
};

static CO_NODE Node;

static uint8_t Buffer[64]; /* buffer of the client */
static unsigned Calls;
static uint32_t Code;

static void AppCSdoEnded(CO_CSDO* csdo, uint16_t index, uint8_t sub, uint32_t code) {
  (void)csdo;
  (void)index;
  (void)sub;
  Calls++;
  Code = code;
}

void setUp(void) {
  memset(&Journal, 0, sizeof(Journal));
  memset(Buffer, 0, sizeof(Buffer));
  Limit = 5;
  LimitWritten = 0;
  Begun = 0xA5A5A5A5;
  Ended = 0xA5A5A5A5;
  Calls = 0;
  NodeUp(&Node, Dictionary, sizeof(Dictionary) / sizeof(Dictionary[0]));
}

static uint8_t Letter(uint32_t position) { return (uint8_t)('A' + position % 23); }

/* Returns a segment of a block: sequence number, with bit 7 in the last segment, and the letters from position on. */
static const char* Segment(const char* id, uint32_t number, uint32_t position, uint32_t size) {
  static char frame[24];
  unsigned last = position + 7 >= size ? 0x80u : 0;
  int at = snprintf(frame, sizeof(frame), "%s#%02X", id, (unsigned)number | last);
  for (uint32_t i = position; i < position + 7; i++) {
    at += snprintf(&frame[at], sizeof(frame) - (size_t)at, "%02X", i < size ? (unsigned)Letter(i) : 0u);
  }
  return frame;
}

static uint32_t SegmentsInBlock(uint32_t position, uint32_t size, uint32_t block) {
  uint32_t left = (size - position + 6) / 7;
  return left < block ? left : block;
}

/* Downloads the letters in segments, block by block, and checks the acknowledges. */
static void DownloadBlocks(uint32_t size) {
  for (uint32_t position = 0; position < size;) {
    char acknowledge[24];
    uint32_t num = SegmentsInBlock(position, size, CO_SDO_BUF_SEG);
    for (uint32_t n = 1; n <= num; n++) {
      TEST_ASSERT_SENT("");
      BusReceive(&Node, Segment("601", n, position, size));
      position += 7;
    }
    const char* sent = BusSent();
    (void)snprintf(acknowledge, sizeof(acknowledge), "581#A2%02X", (unsigned)num);
    TEST_ASSERT_EQUAL_STRING_LEN(acknowledge, sent, 8);
  }
}

static void ReceiveSegments(uint32_t num, uint32_t position, uint32_t size) {
  for (uint32_t n = 1; n <= num; n++) {
    CONodeProcess(&Node); /* sends the next segment */
    TEST_ASSERT_SENT(Segment("581", n, position + (n - 1) * 7, size));
  }
  CONodeProcess(&Node);
  TEST_ASSERT_SENT("");
}

static void test_a_stream_is_downloaded_in_pieces_of_the_buffer(void) {
  BusReceive(&Node, "601#C2896700DC050000"); /* 1500 bytes, no CRC */
  TEST_ASSERT_EQUAL_STRING_LEN("581#A4896700", BusSent(), 12);
  DownloadBlocks(1500);
  BusReceive(&Node, "601#D500000000000000");
  TEST_ASSERT_SENT("581#A100000000000000");
  TEST_ASSERT_EQUAL(1, Journal.Resets);
  TEST_ASSERT_EQUAL_UINT32(CO_SDO_BUF_BYTE, Journal.Pieces[0]);
  TEST_ASSERT_EQUAL_UINT32(1500 - CO_SDO_BUF_BYTE, Journal.Pieces[1]);
  TEST_ASSERT_EQUAL_UINT32(1500, Journal.Length);
  for (uint32_t i = 0; i < Journal.Length; i++) {
    TEST_ASSERT_EQUAL_UINT8(Letter(i), Journal.Text[i]);
  }
}

static void test_a_stream_is_uploaded_in_pieces_of_the_buffer(void) {
  Journal.Length = 1500;
  for (uint32_t i = 0; i < Journal.Length; i++) {
    Journal.Text[i] = Letter(i);
  }
  BusReceive(&Node, "601#A08967007F000000");
  TEST_ASSERT_SENT("581#C6896700DC050000");
  BusReceive(&Node, "601#A300000000000000");
  ReceiveSegments(127, 0, 1500);
  BusReceive(&Node, "601#A27F7F0000000000");
  ReceiveSegments(88, 889, 1500);
  BusReceive(&Node, "601#A2587F0000000000");
  TEST_ASSERT_SENT("581#D500000000000000");
  BusReceive(&Node, "601#A100000000000000");
  TEST_ASSERT_SENT("");
  TEST_ASSERT_EQUAL_UINT32(CO_SDO_BUF_BYTE, Journal.Pieces[0]);
  TEST_ASSERT_EQUAL_UINT32(1500 - CO_SDO_BUF_BYTE, Journal.Pieces[1]);
}

/* Downloads "123456789", whose CRC is 31C3h. */
static void DownloadDigits(const char* initiate, const char* accept, const char* end) {
  BusReceive(&Node, initiate);
  TEST_ASSERT_EQUAL_STRING_LEN(accept, BusSent(), 12);
  BusReceive(&Node, "601#0131323334353637");
  TEST_ASSERT_SENT("");
  BusReceive(&Node, "601#8238390000000000");
  TEST_ASSERT_EQUAL_STRING_LEN("581#A202", BusSent(), 8);
  TEST_ASSERT_EQUAL_UINT32(0, Journal.Length);
  BusReceive(&Node, end);
}

static void test_a_short_download_arrives_after_its_crc(void) {
  DownloadDigits("601#C689670009000000", "581#A4896700", "601#D5C3310000000000");
  TEST_ASSERT_SENT("581#A100000000000000");
  TEST_ASSERT_EQUAL_STRING("123456789", Journal.Text);
  TEST_ASSERT_EQUAL_UINT32(9, Journal.Pieces[0]);
}

static void test_a_short_download_with_a_wrong_crc_changes_nothing(void) {
  DownloadDigits("601#C689670009000000", "581#A4896700", "601#D5C3300000000000");
  TEST_ASSERT_SENT("581#8089670004000405");
  TEST_ASSERT_EQUAL(0, Journal.Resets);
  TEST_ASSERT_EQUAL_UINT32(0, Journal.Length);
}

static void test_a_value_is_downloaded_as_a_whole(void) {
  const uint64_t expected = 1000;
  BusReceive(&Node, "601#C28A670008000000");
  TEST_ASSERT_EQUAL_STRING_LEN("581#A48A6700", BusSent(), 12);
  BusReceive(&Node, "601#01E8030000000000");
  BusReceive(&Node, "601#8200000000000000");
  TEST_ASSERT_EQUAL_STRING_LEN("581#A202", BusSent(), 8);
  TEST_ASSERT_EQUAL_UINT32(0, LimitWritten);
  BusReceive(&Node, "601#D900000000000000");
  TEST_ASSERT_SENT("581#A100000000000000");
  TEST_ASSERT_EQUAL_UINT32(8, LimitWritten);
  TEST_ASSERT_TRUE(Limit == expected);
}

static void test_a_value_is_refused_by_the_last_answer(void) {
  BusReceive(&Node, "601#C28A670008000000");
  TEST_ASSERT_EQUAL_STRING_LEN("581#A48A6700", BusSent(), 12);
  BusReceive(&Node, "601#01E9030000000000");
  BusReceive(&Node, "601#8200000000000000");
  TEST_ASSERT_EQUAL_STRING_LEN("581#A202", BusSent(), 8);
  BusReceive(&Node, "601#D900000000000000");
  TEST_ASSERT_SENT("581#808A670030000906");
}

static void test_a_type_that_sees_the_end_sees_it_after_the_last_piece(void) {
  DownloadDigits("601#C68B670009000000", "581#A48B6700", "601#D5C3310000000000");
  TEST_ASSERT_SENT("581#A100000000000000");
  TEST_ASSERT_EQUAL(CO_OBJ_DOWNLOAD, Transfer);
  TEST_ASSERT_EQUAL_UINT32(9, Begun);
  TEST_ASSERT_EQUAL_HEX32(0, Ended);
  TEST_ASSERT_EQUAL_UINT32(9, Journal.Length);
}

static void test_a_type_that_sees_the_end_is_told_of_a_wrong_crc_before_anything_was_written(void) {
  DownloadDigits("601#C68B670009000000", "581#A48B6700", "601#D5C3300000000000");
  TEST_ASSERT_SENT("581#808B670004000405");
  TEST_ASSERT_EQUAL_HEX32(CO_SDO_ERR_CRC, Ended);
  TEST_ASSERT_EQUAL_UINT32(0, Journal.PieceNum);
}

static void test_without_a_size_the_type_is_told_so(void) {
  DownloadDigits("601#C48B670000000000", "581#A48B6700", "601#D5C3310000000000");
  TEST_ASSERT_SENT("581#A100000000000000");
  TEST_ASSERT_EQUAL_HEX32(CO_OBJ_SIZE_UNKNOWN, Begun);
}

/* The client. Its requests are those of CANopen-Stack; the size of the buffer determines the protocol. */

static void RequestUpload(void) {
  CO_CSDO* csdo = COCSdoFind(&Node, 0);
  TEST_ASSERT_EQUAL(CO_ERR_NONE, COCSdoRequestUpload(csdo, CO_DEV(0x1008, 0), Buffer, 64, AppCSdoEnded, 100));
  TEST_ASSERT_SENT("605#A40810007F1C0000");
}

static void AssertEnded(uint32_t code) {
  TEST_ASSERT_SENT("");
  TEST_ASSERT_EQUAL(1, Calls);
  TEST_ASSERT_EQUAL_HEX32(code, Code);
  TEST_ASSERT_EQUAL(CO_CSDO_STATE_IDLE, COCSdoFind(&Node, 0)->State);
}

static void test_a_large_buffer_is_filled_by_a_block(void) {
  RequestUpload();
  BusReceive(&Node, "585#C608100009000000");
  TEST_ASSERT_SENT("605#A300000000000000");
  BusReceive(&Node, "585#0131323334353637");
  BusReceive(&Node, "585#8238390000000000");
  TEST_ASSERT_SENT("605#A2027F0000000000");
  BusReceive(&Node, "585#D5C3310000000000");
  TEST_ASSERT_SENT("605#A100000000000000");
  AssertEnded(0);
  TEST_ASSERT_EQUAL_STRING("123456789", Buffer);
}

static void test_a_server_without_blocks_is_asked_again(void) {
  RequestUpload();
  BusReceive(&Node, "585#8008100001000405");
  TEST_ASSERT_SENT("605#4008100000000000");
  BusReceive(&Node, "585#4308100061626364");
  AssertEnded(0);
  TEST_ASSERT_EQUAL_STRING("abcd", Buffer);
}

static void test_a_server_may_answer_a_short_object_in_one_frame(void) {
  RequestUpload();
  BusReceive(&Node, "585#4B08100061620000");
  AssertEnded(0);
  TEST_ASSERT_EQUAL_STRING("ab", Buffer);
}

static void test_a_long_download_is_a_block(void) {
  CO_CSDO* csdo = COCSdoFind(&Node, 0);
  for (uint32_t i = 0; i < 29; i++) {
    Buffer[i] = Letter(i);
  }
  TEST_ASSERT_EQUAL(CO_ERR_NONE, COCSdoRequestDownload(csdo, CO_DEV(0x1008, 0), Buffer, 29, AppCSdoEnded, 100));
  TEST_ASSERT_SENT("605#C60810001D000000");
  BusReceive(&Node, "585#A00810007F000000"); /* without CRC */
  for (uint32_t n = 1; n <= 5; n++) {
    TEST_ASSERT_SENT(Segment("605", n, (n - 1) * 7, 29));
  }
  TEST_ASSERT_SENT("");
  BusReceive(&Node, "585#A2057F0000000000");
  TEST_ASSERT_SENT("605#D900000000000000");
  BusReceive(&Node, "585#A100000000000000");
  AssertEnded(0);
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_stream_is_downloaded_in_pieces_of_the_buffer);
  RUN_TEST(test_a_stream_is_uploaded_in_pieces_of_the_buffer);
  RUN_TEST(test_a_short_download_arrives_after_its_crc);
  RUN_TEST(test_a_short_download_with_a_wrong_crc_changes_nothing);
  RUN_TEST(test_a_value_is_downloaded_as_a_whole);
  RUN_TEST(test_a_value_is_refused_by_the_last_answer);
  RUN_TEST(test_a_type_that_sees_the_end_sees_it_after_the_last_piece);
  RUN_TEST(test_a_type_that_sees_the_end_is_told_of_a_wrong_crc_before_anything_was_written);
  RUN_TEST(test_without_a_size_the_type_is_told_so);
  RUN_TEST(test_a_large_buffer_is_filled_by_a_block);
  RUN_TEST(test_a_server_without_blocks_is_asked_again);
  RUN_TEST(test_a_server_may_answer_a_short_object_in_one_frame);
  RUN_TEST(test_a_long_download_is_a_block);
  return UNITY_END();
}
