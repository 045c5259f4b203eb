// SPDX-License-Identifier: Apache-2.0
// Uses CONodeInit() and CONodeInitEx() in a program with the library's configuration: by calls, by a second
// declaration, by their addresses, and by the symbols to which objects without lexican/detail/configuration.h refer.
#include <string.h>

#include "co_core.h"
#include "fakes.h"
#include "unity.h"

#ifdef __cplusplus
extern "C" {
#endif
void CONodeInit(CO_NODE* node, const CO_NODE_SPEC* spec);
extern void CONodeInitEx(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext);
#ifdef __ELF__
void PlainInit(CO_NODE* node, const CO_NODE_SPEC* spec) __asm__("CONodeInit");
void PlainInitEx(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext) __asm__("CONodeInitEx");
#else
#define PlainInit CONodeInit
#define PlainInitEx CONodeInitEx
#endif
#ifdef __cplusplus
}
#endif

typedef void (*INIT)(CO_NODE* node, const CO_NODE_SPEC* spec);
typedef void (*INIT_EX)(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext);

static uint8_t ErrorRegister;
static CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    CO_OBJ_DICT_ENDMARK,
};

static CO_IF_DRV Drivers = {&FakeCanDriver, &FakeCyclicTimerDriver, &FakeNvmDriver};
static const CO_NODE_SPEC Spec = {7, 500000, Dictionary, 5, NULL, NULL, 0, 100, &Drivers, NULL};
static struct {
  CO_NODE Node[2];
  uint8_t Behind[16];
} Memory;

static const INIT Constant = CONodeInit;
static const INIT_EX ConstantEx = &CONodeInitEx;

void setUp(void) {
  FakesReset();
  memset(&Memory, 0xA5, sizeof(Memory));
}

static void ExpectAStart(CO_NODE* node) {
  uint8_t behind[sizeof(Memory.Behind)];
  memset(behind, 0xA5, sizeof(behind));
  TEST_ASSERT_EQUAL_HEX32(CO_ERR_NONE, CONodeGetErr(node));
  CONodeStart(node);
  TEST_ASSERT_SENT("707#00");
  TEST_ASSERT_EQUAL_HEX8_ARRAY(behind, Memory.Behind, sizeof(behind));
}

static void test_a_declaration_is_repeated(void) {
  CONodeInit(&Memory.Node[1], &Spec);
  ExpectAStart(&Memory.Node[1]);
  CONodeInitEx(&Memory.Node[0], &Spec, NULL);
  ExpectAStart(&Memory.Node[0]);
}

static void test_addresses_are_taken(void) {
  const INIT init = &CONodeInit;
  TEST_ASSERT_TRUE(init == Constant);
  Constant(&Memory.Node[1], &Spec);
  ExpectAStart(&Memory.Node[1]);
  ConstantEx(&Memory.Node[1], &Spec, NULL);
  ExpectAStart(&Memory.Node[1]);
}

static void test_plain_symbols_are_linked(void) {
  PlainInit(&Memory.Node[1], &Spec);
  ExpectAStart(&Memory.Node[1]);
  PlainInitEx(&Memory.Node[1], &Spec, NULL);
  ExpectAStart(&Memory.Node[1]);
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_declaration_is_repeated);
  RUN_TEST(test_addresses_are_taken);
  RUN_TEST(test_plain_symbols_are_linked);
  return UNITY_END();
}
