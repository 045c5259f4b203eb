// SPDX-License-Identifier: Apache-2.0
// A device (node-ID 5) on FLEXCAN1 and its master (node-ID 1) on FLEXCAN2, on one bus at 500 kbit/s. The master reads
// and writes the device by SDO, starts it, and exchanges PDOs with it. Prints a line for each step.
#include "board.h"
#include "co_core.h"

// The device ----------------------------------------------------------------------------------------------------------

static uint8_t DeviceError;
static uint32_t Received;
static uint32_t Sent;
static uint8_t Bytes[600];
static CO_OBJ_DOM Domain = {0, sizeof(Bytes), Bytes};
static const uint8_t NameText[] = "SABRE Lite";
static CO_OBJ_STR Name = {0, NameText};

static const CO_OBJ DeviceDictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x00020192)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&DeviceError)},
    {CO_KEY(0x1008, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&Name)},
    {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, (CO_DATA)(0x80)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // vendor-ID: get one from CiA
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_RPDO_DEFAULT(0))},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2100, 0, 32))},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_TPDO_DEFAULT(0))},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2200, 0, 32))},
    {CO_KEY(0x2010, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&Domain)},
    {CO_KEY(0x2100, 0, CO_OBJ____PRW), CO_TUNSIGNED32, (CO_DATA)(&Received)},
    {CO_KEY(0x2200, 0, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)(&Sent)},
    CO_OBJ_DICT_ENDMARK,
};

static CO_EMCY_TBL Errors[CO_EMCY_N] = {{CO_EMCY_REG_VOLTAGE, CO_EMCY_CODE_VOL_INPUT_ERR}};

// The master ----------------------------------------------------------------------------------------------------------

static uint8_t MasterError;
static uint32_t MasterReceived;
static uint32_t MasterSent;

static const CO_OBJ MasterDictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&MasterError)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1028, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(5)},
    {CO_KEY(0x1028, 5, CO_OBJ_D___R_), CO_TEMCY_CONS, (CO_DATA)(0x85)},
    {CO_KEY(0x1280, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
    {CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(0x605)},
    {CO_KEY(0x1280, 2, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(0x585)},
    {CO_KEY(0x1280, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(5)},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_D___R_), CO_TPDO_ID, (CO_DATA)(0x185)},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2100, 0, 32))},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1800, 1, CO_OBJ_D___R_), CO_TPDO_ID, (CO_DATA)(0x40000205)},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2200, 0, 32))},
    {CO_KEY(0x2100, 0, CO_OBJ____PRW), CO_TUNSIGNED32, (CO_DATA)(&MasterReceived)},
    {CO_KEY(0x2200, 0, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)(&MasterSent)},
    CO_OBJ_DICT_ENDMARK,
};

// Both ----------------------------------------------------------------------------------------------------------------

static CO_NODE Device;
static CO_NODE Master;
static uint8_t SdoBuffer[2][CO_SSDO_N * CO_SDO_BUF_BYTE];
static CO_TMR_MEM Timers[2][4];
static CO_NODE_EXT Drivers[2];

static void StartNode(CO_NODE* node, uint8_t which, uint8_t id, const CO_OBJ* dictionary, uint16_t entries) {
  CO_NODE_SPEC spec = {.NodeId = id, .Baudrate = 500000, .TmrNum = 4, .TmrFreq = BOARD_TICKS};
  spec.Dict = (CO_OBJ*)dictionary;
  spec.DictLen = entries;
  spec.TmrMem = Timers[which];
  spec.SdoBuf = SdoBuffer[which];
  spec.EmcyCode = node == &Device ? Errors : NULL;
  Drivers[which].Size = sizeof(Drivers[which]);
  Drivers[which].Can = &FlexcanCanDriver;
  Drivers[which].CanCtx = &BoardCan[which];
  Drivers[which].Timer = &BoardTimer;
  CONodeInitEx(node, &spec, &Drivers[which]);
  CONodeStart(node);
}

static void Process(CO_NODE* node) {
  CONodeProcess(node);
  (void)COTmrService(&node->Tmr);
  COTmrProcess(&node->Tmr);
}

// Runs both nodes until *done is true, at most for some milliseconds. Returns its value.
static bool RunUntil(const volatile bool* done, uint32_t milliseconds) {
  const uint32_t start = BoardMicroseconds();
  while (!*done && BoardMicroseconds() - start < 1000u * milliseconds) {
    Process(&Device);
    Process(&Master);
  }
  return *done;
}

static void RunFor(uint32_t milliseconds) {
  static const volatile bool never = false;
  (void)RunUntil(&never, milliseconds);
}

static bool HasEnded;
static uint32_t AbortCode;
static uint16_t Emergency;

static void TransferEnded(CO_CSDO* client, uint16_t index, uint8_t sub, uint32_t code) {
  CO_UNUSED(client);
  CO_UNUSED(index);
  CO_UNUSED(sub);
  HasEnded = true;
  AbortCode = code;
}

void COEmcyReceived(CO_NODE* node, uint8_t sender, uint16_t code, uint8_t reg, const uint8_t bytes[5]) {
  CO_UNUSED(node);
  CO_UNUSED(sender);
  CO_UNUSED(reg);
  CO_UNUSED(bytes);
  Emergency = code;
}

static bool Upload(uint32_t key, uint8_t* buffer, uint32_t size) {
  HasEnded = false;
  return COCSdoRequestUpload(COCSdoFind(&Master, 0), key, buffer, size, TransferEnded, 500) == CO_ERR_NONE &&
         RunUntil(&HasEnded, 1000) && AbortCode == 0;
}

static bool Download(uint32_t key, uint8_t* buffer, uint32_t size) {
  HasEnded = false;
  return COCSdoRequestDownload(COCSdoFind(&Master, 0), key, buffer, size, TransferEnded, 500) == CO_ERR_NONE &&
         RunUntil(&HasEnded, 1000) && AbortCode == 0;
}

// Steps ---------------------------------------------------------------------------------------------------------------

static bool ReadType(void) {
  uint8_t type[4] = {0};
  return Upload(CO_DEV(0x1000, 0), type, sizeof(type)) && type[0] == 0x92 && type[1] == 1 && type[2] == 2;
}

static bool ReadName(void) {
  uint8_t name[16] = {0};
  return Upload(CO_DEV(0x1008, 0), name, sizeof(NameText) - 1) && name[0] == 'S' && name[9] == 'e';
}

static bool TransferDomain(void) {
  static uint8_t written[sizeof(Bytes)];
  static uint8_t copy[sizeof(Bytes)];
  for (uint32_t n = 0; n < sizeof(written); ++n) {
    written[n] = (uint8_t)(n * 7u + n / 256u);
  }
  if (!Download(CO_DEV(0x2010, 0), written, sizeof(written)) || !Upload(CO_DEV(0x2010, 0), copy, sizeof(copy))) {
    return false;
  }
  for (uint32_t n = 0; n < sizeof(copy); ++n) {
    if (copy[n] != (uint8_t)(n * 7u + n / 256u) || Bytes[n] != copy[n]) {
      return false;
    }
  }
  return true;
}

static bool Start(void) {
  (void)CONmtCommand(&Master.Nmt, CO_NMT_COMMAND_START, 0);
  RunFor(2);
  return CONmtGetMode(&Device.Nmt) == CO_OPERATIONAL && CONmtGetMode(&Master.Nmt) == CO_OPERATIONAL;
}

static bool ExchangePdos(void) {
  for (uint32_t n = 1; n <= 200; ++n) {
    Sent = n;
    MasterSent = ~n;
    (void)COTPdoRequest(&Device, 0);
    (void)COTPdoRequest(&Master, 0);
    RunFor(1);
    if (MasterReceived != n || Received != ~n) {
      return false;
    }
  }
  return true;
}

static bool ReportError(void) {
  COEmcySet(&Device.Emcy, 0, NULL);
  RunFor(2);
  const bool is_set = Emergency == CO_EMCY_CODE_VOL_INPUT_ERR;
  COEmcyClr(&Device.Emcy, 0);
  RunFor(2);
  return is_set && Emergency == 0;
}

static bool LoseNothing(void) { return COCanFlexcanLost(&BoardCan[0]) == 0 && COCanFlexcanLost(&BoardCan[1]) == 0; }

static const struct {
  const char* name;
  bool (*run)(void);
} Steps[] = {
    {"the master reads 1000h by an expedited upload", ReadType},
    {"the master reads 1008h", ReadName},
    {"600 bytes are written and read back by block transfer", TransferDomain},
    {"NMT starts both nodes", Start},
    {"200 PDOs in both directions", ExchangePdos},
    {"EMCY is received by the master", ReportError},
    {"no frame was lost", LoseNothing},
};
#define STEPS (sizeof(Steps) / sizeof(Steps[0]))

int main(void) {
  BoardStart();
  StartNode(&Master, 1, 1, MasterDictionary, sizeof(MasterDictionary) / sizeof(MasterDictionary[0]));
  StartNode(&Device, 0, 5, DeviceDictionary, sizeof(DeviceDictionary) / sizeof(DeviceDictionary[0]));
  RunFor(5);
  BoardPrint("1..");
  BoardPrintNumber((uint32_t)STEPS);
  BoardPrint("\n");
  int failed = 0;
  for (uint32_t n = 0; n < STEPS; ++n) {
    const bool is_ok = Steps[n].run();
    BoardPrint(is_ok ? "ok " : "not ok ");
    BoardPrint(Steps[n].name);
    BoardPrint("\n");
    failed += is_ok ? 0 : 1;
  }
  return failed == 0 ? 0 : 1;
}
