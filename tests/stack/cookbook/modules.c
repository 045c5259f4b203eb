// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: modules of a modular device.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static uint16_t ModuleType[2] = {0x0101, 0};  // found on the backplane; 0: the place is empty

static CO_ERR ReadModule(CO_NODE* node, void* user, uint8_t sub, uint16_t* value) {
  (void)node;
  (void)user;
  if (sub == 0) {
    *value = (uint16_t)((ModuleType[0] != 0) + (ModuleType[1] != 0));
    return CO_ERR_NONE;
  }
  *value = ModuleType[sub - 1];
  return *value != 0 ? CO_ERR_NONE : CO_ERR_OBJ_NO_DATA;
}

static const CO_MODULE_LIST Modules = {ReadModule};

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1027, 0, CO_OBJ_____R_), CO_TMODULE_LIST, (CO_DATA)(&Modules)},
    {CO_KEY(0x1027, 1, CO_OBJ_____R_), CO_TMODULE_LIST, (CO_DATA)(&Modules)},
    {CO_KEY(0x1027, 2, CO_OBJ_____R_), CO_TMODULE_LIST, (CO_DATA)(&Modules)},
};

void the_modules_of_a_device_are_read(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_STRING("585: 4F 27 10 00 01 00 00 00", BenchSend("605: 40 27 10 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 4B 27 10 01 01 01 00 00", BenchSend("605: 40 27 10 01 00 00 00 00"));
  // 0800 0024h: no data, the place is empty
  TEST_ASSERT_EQUAL_STRING("585: 80 27 10 02 24 00 00 08", BenchSend("605: 40 27 10 02 00 00 00 00"));
}
