// SPDX-License-Identifier: Apache-2.0
// Example of docs/storage.md: an EMCY for a damaged record.
#include <stdbool.h>

#include "bench.h"
#include "co_nvm_ram.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;
static uint32_t EmcyId = 0x80;  // plus node-ID (flag N)
static int16_t Setpoint;
static const int16_t SetpointDefault = 200;
static const CO_PARA Group = {
    0, sizeof(Setpoint), (uint8_t*)&Setpoint, (uint8_t*)&SetpointDefault, CO_RESET_NODE, NULL, CO_PARA___E, 0, 0};

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1010, 0, CO_OBJ_D___R_), CO_TPARA_STORE, (CO_DATA)(1)},
    {CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&Group)},
    {CO_KEY(0x1014, 0, CO_OBJ__N__RW), CO_TEMCY_ID, (CO_DATA)(&EmcyId)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2200, 0, CO_OBJ_____RW), CO_TSIGNED16, (CO_DATA)(&Setpoint)},
};

static bool Damaged;

static void NoteDamage(CO_NODE* node, void* user, const CO_PARA* group) {
  (void)node;
  (void)user;
  (void)group;
  Damaged = true;
}

void COParaLost(CO_NODE* node, const CO_PARA* pg) { NoteDamage(node, NULL, pg); }

static CO_CALLBACKS Callbacks;
static CO_EMCY_TBL Errors[] = {{CO_EMCY_REG_GENERAL, 0x6300}};

static void ConfigureReport(CO_NODE_SPEC* spec, CO_NODE_EXT* ext) {
  Callbacks.ParaRecovered = NoteDamage;
  ext->Callbacks = &Callbacks;
  ext->EmcyNum = 1;
  spec->EmcyCode = Errors;
}

/// Reports a damaged record. Call this in the main loop, after CONodeProcess() and COTmrProcess().
static void ReportDamage(CO_NODE* node) {
  if (Damaged && CONmtGetMode(&node->Nmt) != CO_INIT) {
    Damaged = false;
    COEmcySet(&node->Emcy, 0, NULL);
  }
}

static CO_ERR StartNode(void) {
  ConfigureReport(&Spec, &Ext);
  return BenchStart(Dictionary, BENCH_NUM(Dictionary));
}

static void Save(int16_t value) {
  Setpoint = value;
  TEST_ASSERT_EQUAL_STRING("585: 60 10 10 01 00 00 00 00", BenchSend("605: 23 10 10 01 73 61 76 65"));
}

void a_damaged_record_is_reported(void) {
  const uint32_t slot = CO_PARA_SPACE(sizeof(Setpoint), 1, 1) / 2;  // bytes of a header and the data
  uint8_t* memory = ((CO_NVM_RAM*)Ext.NvmCtx)->Mem;
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, StartNode());
  Save(300);
  Save(301);
  memory[2 * slot - 1] ^= 1;  // the newest record, in the second slot
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, StartNode());
  TEST_ASSERT_EQUAL_INT16(300, Setpoint);
  ReportDamage(&Node);
  TEST_ASSERT_EQUAL_STRING("085: 00 63 01 00 00 00 00 00", BenchRun(1));
  ReportDamage(&Node);
  TEST_ASSERT_EQUAL_STRING("", BenchRun(1));
  memory[slot - 1] ^= 1;  // the older record
  TEST_ASSERT_EQUAL_INT(CO_ERR_PARA_LOAD, StartNode());
  TEST_ASSERT_EQUAL_INT16(200, Setpoint);
  ReportDamage(&Node);
  TEST_ASSERT_EQUAL_STRING("085: 00 63 01 00 00 00 00 00", BenchRun(1));
}
