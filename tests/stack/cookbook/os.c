// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: OS command, debugger interface and prompt.
#include <string.h>

#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static uint8_t CommandBytes[128];
static uint8_t ReplyBytes[128];

// Executes a command. A command that takes longer returns at once, and calls COOsEnd() later.
static void Execute(CO_NODE* node, void* user, CO_OS_COMMAND* os, const uint8_t* command, uint16_t length) {
  const uint8_t version[] = {'1', '.', '0', '2'};
  bool known = length == 3 && memcmp(command, "ver", 3) == 0;
  (void)user;
  if (known) {
    (void)COOsReply(os, version, sizeof(version));
  }
  (void)COOsEnd(node, os, !known);
}

static CO_OS_COMMAND Os = CO_OS_COMMAND_OF(CommandBytes, ReplyBytes, Execute, NULL);

static uint8_t DebugCommand[32];
static uint8_t DebugReply[32];
static CO_OS_COMMAND Debugger = CO_OS_COMMAND_OF(DebugCommand, DebugReply, Execute, NULL);

static void Input(CO_NODE* node, void* user, uint8_t character);

static uint8_t Out[64];
static uint8_t Err[32];
static CO_OS_PROMPT Prompt = CO_OS_PROMPT_OF(Input, Out, Err);

// Echoes each character of the terminal.
static void Input(CO_NODE* node, void* user, uint8_t character) {
  (void)user;
  (void)COOsPrint(node, 2, &character, 1);
}

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1023, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
    {CO_KEY(0x1023, 1, CO_OBJ_____RW), CO_TOS_COMMAND, (CO_DATA)(&Os)},
    {CO_KEY(0x1023, 2, CO_OBJ_____R_), CO_TOS_STATUS, (CO_DATA)(&Os)},
    {CO_KEY(0x1023, 3, CO_OBJ_____R_), CO_TOS_REPLY, (CO_DATA)(&Os)},
    {CO_KEY(0x1024, 0, CO_OBJ______W), CO_TOS_MODE, (CO_DATA)(&Os)},
    {CO_KEY(0x1025, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
    {CO_KEY(0x1025, 1, CO_OBJ_____RW), CO_TOS_COMMAND, (CO_DATA)(&Debugger)},
    {CO_KEY(0x1025, 2, CO_OBJ_____R_), CO_TOS_STATUS, (CO_DATA)(&Debugger)},
    {CO_KEY(0x1025, 3, CO_OBJ_____R_), CO_TOS_REPLY, (CO_DATA)(&Debugger)},
    {CO_KEY(0x1026, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
    {CO_KEY(0x1026, 1, CO_OBJ____P_W), CO_TOS_STDIN, (CO_DATA)(&Prompt)},
    {CO_KEY(0x1026, 2, CO_OBJ____PR_), CO_TOS_STDOUT, (CO_DATA)(&Prompt)},
    {CO_KEY(0x1026, 3, CO_OBJ____PR_), CO_TOS_STDOUT, (CO_DATA)(&Prompt)},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_RPDO_DEFAULT(0))},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(255)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x1026, 1, 8))},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_TPDO_DEFAULT(0))},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(255)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x1026, 2, 8))},
};

void a_command_is_executed_and_answered(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_STRING("585: 60 23 10 01 00 00 00 00", BenchSend("605: 27 23 10 01 76 65 72 00"));  // "ver"
  TEST_ASSERT_EQUAL_STRING("585: 4F 23 10 02 01 00 00 00", BenchSend("605: 40 23 10 02 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 43 23 10 03 31 2E 30 32", BenchSend("605: 40 23 10 03 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 60 25 10 01 00 00 00 00", BenchSend("605: 2F 25 10 01 3F 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 4F 25 10 02 02 00 00 00", BenchSend("605: 40 25 10 02 00 00 00 00"));
}

void stored_commands_are_executed_later(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_STRING("585: 60 24 10 00 00 00 00 00", BenchSend("605: 2F 24 10 00 01 00 00 00"));
  (void)BenchSend("605: 27 23 10 01 76 65 72 00");
  (void)BenchSend("605: 27 23 10 01 76 65 72 00");
  TEST_ASSERT_EQUAL_STRING("585: 4F 23 10 02 00 00 00 00", BenchSend("605: 40 23 10 02 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 60 24 10 00 00 00 00 00", BenchSend("605: 2F 24 10 00 02 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 41 23 10 03 08 00 00 00", BenchSend("605: 40 23 10 03 00 00 00 00"));
}

void the_prompt_echoes_characters(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  (void)BenchSend("000: 01 05");
  TEST_ASSERT_EQUAL_STRING("185: 68", BenchSend("205: 68"));
  TEST_ASSERT_EQUAL_STRING("185: 69", BenchSend("205: 69"));
  TEST_ASSERT_EQUAL_STRING("585: 80 26 10 02 24 00 00 08", BenchSend("605: 40 26 10 02 00 00 00 00"));
}
