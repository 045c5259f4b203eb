// SPDX-License-Identifier: Apache-2.0
// The access hook of docs/access.md: a configuration lock, a role, and a rate limit.
#include "co_core.h"
#include "fakes.h"
#include "unity.h"

#define SAVES_IN_A_ROW 2u

typedef struct DEVICE { /* CO_NODE_EXT.User */
  uint8_t Locked;       /* the key switch in the cabinet is locked */
  uint8_t Moving;       /* the drive is turning */
  uint8_t Saves;        /* number of "save" commands still permitted */
} DEVICE;

static int IsConfiguration(uint16_t index) { return index < 0x2000; }

static uint32_t PermitSdo(CO_NODE* node, void* user, const CO_ACCESS_SDO* access) {
  DEVICE* device = (DEVICE*)user;
  (void)node;
  if (access->Direction == CO_OBJ_UPLOAD) {
    return 0;
  }
  if (device->Locked && IsConfiguration(access->Index)) {
    return CO_SDO_ERR_TOS_LOCAL; /* configuration is locked */
  }
  if (access->Channel != 0 && access->Index != 0x2100) {
    return CO_SDO_ERR_WR; /* role: the operator's panel, on the second SDO server, may write its set point only */
  }
  if (access->Index == 0x1010) {
    if (device->Saves == 0) {
      return CO_SDO_ERR_TOS_STATE; /* rate limit: protects the flash memory */
    }
    device->Saves--;
  }
  return 0;
}

static uint8_t PermitNmt(CO_NODE* node, void* user, const CO_ACCESS_NMT* access) {
  const DEVICE* device = (const DEVICE*)user;
  (void)node;
  return device->Moving && access->Command >= 129; /* no reset while the drive turns */
}

static uint8_t PermitLss(CO_NODE* node, void* user, CO_ACCESS_LSS* access) {
  const DEVICE* device = (const DEVICE*)user;
  (void)node;
  if (access->Service == CO_LSS_SERVICE_ACTIVATE) {
    access->Mode = CO_STOP; /* this device stops before the bit rate is switched */
  }
  access->Specific = 1; /* "locked", in the manual of the device */
  return device->Locked ? 255 : 0;
}

static void RefillSaves(void* parg) {
  DEVICE* device = (DEVICE*)CONodeGetUser((CO_NODE*)parg);
  device->Saves = SAVES_IN_A_ROW;
}

static CO_CALLBACKS Callbacks;
static DEVICE Device;
static uint8_t ErrorRegister;
static uint16_t SetPoint;
static uint16_t HeartbeatTime;
static uint32_t PanelRx = 0x340;
static uint32_t PanelTx = 0x350;
static uint32_t Parameter = 7;
static CO_PARA Group;

static CO_OBJ Dictionary[] = {
    {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1010, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&Group)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&HeartbeatTime)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(4)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(1)},
    {CO_KEY(0x1018, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(2)},
    {CO_KEY(0x1018, 3, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(3)},
    {CO_KEY(0x1018, 4, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(4)},
    {CO_KEY(0x1201, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1201, 1, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&PanelRx)},
    {CO_KEY(0x1201, 2, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&PanelTx)},
    {CO_KEY(0x2100, 0, CO_OBJ_____RW), CO_TUNSIGNED16, (CO_DATA)(&SetPoint)},
    CO_OBJ_DICT_ENDMARK,
};

static CO_NODE Node;
static CO_NODE_EXT Ext;

void setUp(void) {
  Callbacks.AccessSdo = PermitSdo;
  Callbacks.AccessNmt = PermitNmt;
  Callbacks.AccessLss = PermitLss;
  Device.Locked = 0;
  Device.Moving = 0;
  HeartbeatTime = 0;
  Device.Saves = SAVES_IN_A_ROW;
  Group.Size = sizeof(Parameter);
  Group.Start = (uint8_t*)&Parameter;
  Group.Type = CO_RESET_NODE;
  Group.Value = CO_PARA___E;
  Ext.Size = sizeof(Ext);
  Ext.User = &Device;
  Ext.Callbacks = &Callbacks;
  NodeUpEx(&Node, Dictionary, sizeof(Dictionary) / sizeof(Dictionary[0]), &Ext);
}

static void Ask(const char* request, const char* answer) {
  BusReceive(&Node, request);
  TEST_ASSERT_SENT(answer);
}

static void test_a_configuration_lock(void) {
  Device.Locked = 1;
  Ask("601#2B171000E8030000", "581#8017100021000008");
  Ask("601#4017100000000000", "581#4B17100000000000");
  Ask("601#2B00210011220000", "581#6000210000000000");
  Device.Locked = 0;
  Ask("601#2B171000E8030000", "581#6017100000000000");
}

static void test_a_role(void) {
  Ask("340#2B00210011220000", "350#6000210000000000");
  Ask("340#2B171000E8030000", "350#8017100002000106");
  Ask("340#4017100000000000", "350#4B17100000000000");
}

static void test_a_rate_limit(void) {
  Ask("601#2310100173617665", "581#6010100100000000");
  Ask("601#2310100173617665", "581#6010100100000000");
  Ask("601#2310100173617665", "581#8010100122000008");
  RefillSaves(&Node); /* COTmrCreate(&Node.Tmr, …, RefillSaves, &Node) */
  Ask("601#2310100173617665", "581#6010100100000000");
}

static void test_no_reset_while_the_drive_turns(void) {
  Device.Moving = 1;
  Ask("000#8101", "");
  Ask("000#0101", "");
  TEST_ASSERT_EQUAL(CO_OPERATIONAL, CONmtGetMode(&Node.Nmt));
  Device.Moving = 0;
  Ask("000#8201", "701#00");
}

static void test_lss_is_locked_too(void) {
  Ask("7E5#0401000000000000", "");
  Device.Locked = 1;
  Ask("7E5#1105000000000000", "7E4#11FF010000000000");
  Ask("7E5#1500000000000000", "");
  TEST_ASSERT_EQUAL(CO_PREOP, CONmtGetMode(&Node.Nmt));
  Device.Locked = 0;
  Ask("7E5#1500000000000000", "");
  TEST_ASSERT_EQUAL(CO_STOP, CONmtGetMode(&Node.Nmt));
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_configuration_lock);
  RUN_TEST(test_a_role);
  RUN_TEST(test_a_rate_limit);
  RUN_TEST(test_no_reset_while_the_drive_turns);
  RUN_TEST(test_lss_is_locked_too);
  return UNITY_END();
}
