/* SPDX-License-Identifier: Apache-2.0 */
/* A node with what its configuration has, and with no other functions: what the linker keeps is what firmware pays.
   minimal: entries of plain types, which the network reads. Otherwise: all entries of 4 PDOs in each direction, with 8
   objects each, which the network configures. */
#include "co_core.h"

static CO_NODE Node;
static uint8_t ErrorRegister;
static uint16_t Heartbeat;
static uint32_t EmcyId = 0x80;
static uint8_t Values[32];
#if !NODE_IS_SMALLEST
static uint32_t History[8];
static uint8_t HistoryNum;
static uint32_t SyncId = 0x80;
static uint32_t SyncCycle;
static uint16_t EmcyInhibit;
static CO_HBCONS Consumers[3];
static const CO_PARA Group = {0, sizeof(Values), Values, 0, CO_RESET_NODE, 0, CO_PARA___E, 0, 0};
static uint8_t SdoBuffer[CO_SSDO_N * CO_SDO_BUF_BYTE];
static uint8_t Answer[4];

typedef struct PDO {
  uint32_t Id;
  uint8_t Type;
  uint16_t Inhibit;
  uint16_t Event;
  uint8_t Num;
  uint32_t Map[8];
} PDO;
static PDO Rpdo[4];
static PDO Tpdo[4];

/* The entries of one PDO. */
#define MAPPING(index, pdo)                                                       \
  {CO_KEY(index, 0, CO_OBJ_____RW), CO_TPDO_NUM, (CO_DATA) & (pdo).Num},          \
      {CO_KEY(index, 1, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA) & (pdo).Map[0]},   \
      {CO_KEY(index, 2, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA) & (pdo).Map[1]},   \
      {CO_KEY(index, 3, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA) & (pdo).Map[2]},   \
      {CO_KEY(index, 4, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA) & (pdo).Map[3]},   \
      {CO_KEY(index, 5, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA) & (pdo).Map[4]},   \
      {CO_KEY(index, 6, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA) & (pdo).Map[5]},   \
      {CO_KEY(index, 7, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA) & (pdo).Map[6]}, { \
    CO_KEY(index, 8, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA) & (pdo).Map[7]        \
  }
#define RPDO(n)                                                                         \
  {CO_KEY(0x1400 + (n), 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)5},                  \
      {CO_KEY(0x1400 + (n), 1, CO_OBJ__N__RW), CO_TPDO_ID, (CO_DATA)&Rpdo[n].Id},       \
      {CO_KEY(0x1400 + (n), 2, CO_OBJ_____RW), CO_TPDO_TYPE, (CO_DATA)&Rpdo[n].Type}, { \
    CO_KEY(0x1400 + (n), 5, CO_OBJ_____RW), CO_TPDO_EVENT, (CO_DATA)&Rpdo[n].Event      \
  }
#define TPDO(n)                                                                               \
  {CO_KEY(0x1800 + (n), 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)5},                        \
      {CO_KEY(0x1800 + (n), 1, CO_OBJ__N__RW), CO_TPDO_ID, (CO_DATA)&Tpdo[n].Id},             \
      {CO_KEY(0x1800 + (n), 2, CO_OBJ_____RW), CO_TPDO_TYPE, (CO_DATA)&Tpdo[n].Type},         \
      {CO_KEY(0x1800 + (n), 3, CO_OBJ_____RW), CO_TPDO_INHIBIT, (CO_DATA)&Tpdo[n].Inhibit}, { \
    CO_KEY(0x1800 + (n), 5, CO_OBJ_____RW), CO_TPDO_EVENT, (CO_DATA)&Tpdo[n].Event            \
  }
#define EIGHT_VALUES(index, first)                                                       \
  {CO_KEY(index, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)8},                          \
      {CO_KEY(index, 1, CO_OBJ___APRW), CO_TUNSIGNED8, (CO_DATA)&Values[first]},         \
      {CO_KEY(index, 2, CO_OBJ___APRW), CO_TUNSIGNED8, (CO_DATA)&Values[(first) + 1]},   \
      {CO_KEY(index, 3, CO_OBJ___APRW), CO_TUNSIGNED8, (CO_DATA)&Values[(first) + 2]},   \
      {CO_KEY(index, 4, CO_OBJ___APRW), CO_TUNSIGNED8, (CO_DATA)&Values[(first) + 3]},   \
      {CO_KEY(index, 5, CO_OBJ___APRW), CO_TUNSIGNED8, (CO_DATA)&Values[(first) + 4]},   \
      {CO_KEY(index, 6, CO_OBJ___APRW), CO_TUNSIGNED8, (CO_DATA)&Values[(first) + 5]},   \
      {CO_KEY(index, 7, CO_OBJ___APRW), CO_TUNSIGNED8, (CO_DATA)&Values[(first) + 6]}, { \
    CO_KEY(index, 8, CO_OBJ___APRW), CO_TUNSIGNED8, (CO_DATA)&Values[(first) + 7]        \
  }
#endif

static const CO_OBJ Dictionary[] = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0},
                                    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)&ErrorRegister},
#if !NODE_IS_SMALLEST
                                    {CO_KEY(0x1003, 0, CO_OBJ_____RW), CO_TEMCY_HIST, (CO_DATA)&HistoryNum},
                                    {CO_KEY(0x1003, 1, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)&History[0]},
                                    {CO_KEY(0x1003, 2, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)&History[1]},
                                    {CO_KEY(0x1003, 3, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)&History[2]},
                                    {CO_KEY(0x1003, 4, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)&History[3]},
                                    {CO_KEY(0x1003, 5, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)&History[4]},
                                    {CO_KEY(0x1003, 6, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)&History[5]},
                                    {CO_KEY(0x1003, 7, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)&History[6]},
                                    {CO_KEY(0x1003, 8, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)&History[7]},
                                    {CO_KEY(0x1005, 0, CO_OBJ_____RW), CO_TSYNC_ID, (CO_DATA)&SyncId},
                                    {CO_KEY(0x1006, 0, CO_OBJ_____RW), CO_TSYNC_CYCLE, (CO_DATA)&SyncCycle},
                                    {CO_KEY(0x1010, 0, CO_OBJ_D___R_), CO_TPARA_STORE, (CO_DATA)1},
                                    {CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)&Group},
                                    {CO_KEY(0x1011, 0, CO_OBJ_D___R_), CO_TPARA_RESTORE, (CO_DATA)1},
                                    {CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, (CO_DATA)&Group},
#endif
                                    {CO_KEY(0x1014, 0, CO_OBJ__N__R_), CO_TEMCY_ID, (CO_DATA)&EmcyId},
#if !NODE_IS_SMALLEST
                                    {CO_KEY(0x1015, 0, CO_OBJ_____RW), CO_TUNSIGNED16, (CO_DATA)&EmcyInhibit},
                                    {CO_KEY(0x1016, 0, CO_OBJ_D___R_), CO_THB_CONS, (CO_DATA)3},
                                    {CO_KEY(0x1016, 1, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)&Consumers[0]},
                                    {CO_KEY(0x1016, 2, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)&Consumers[1]},
                                    {CO_KEY(0x1016, 3, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)&Consumers[2]},
#endif
                                    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)&Heartbeat},
                                    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)4},
                                    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)1},
                                    {CO_KEY(0x1018, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)2},
                                    {CO_KEY(0x1018, 3, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)3},
                                    {CO_KEY(0x1018, 4, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)4},
#if NODE_IS_SMALLEST
                                    {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)0x200},
                                    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)255},
                                    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)1},
                                    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)CO_LINK(0x2000, 0, 8)},
                                    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)0x40000180},
                                    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)255},
                                    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)1},
                                    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)CO_LINK(0x2001, 0, 8)},
                                    {CO_KEY(0x2000, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)&Values[0]},
                                    {CO_KEY(0x2001, 0, CO_OBJ___APRW), CO_TUNSIGNED8, (CO_DATA)&Values[1]},
#else
                                    {CO_KEY(0x1280, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)3},
                                    {CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)0x602},
                                    {CO_KEY(0x1280, 2, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)0x582},
                                    {CO_KEY(0x1280, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)2},
                                    RPDO(0),
                                    RPDO(1),
                                    RPDO(2),
                                    RPDO(3),
                                    MAPPING(0x1600, Rpdo[0]),
                                    MAPPING(0x1601, Rpdo[1]),
                                    MAPPING(0x1602, Rpdo[2]),
                                    MAPPING(0x1603, Rpdo[3]),
                                    TPDO(0),
                                    TPDO(1),
                                    TPDO(2),
                                    TPDO(3),
                                    MAPPING(0x1A00, Tpdo[0]),
                                    MAPPING(0x1A01, Tpdo[1]),
                                    MAPPING(0x1A02, Tpdo[2]),
                                    MAPPING(0x1A03, Tpdo[3]),
                                    EIGHT_VALUES(0x2000, 0),
                                    EIGHT_VALUES(0x2001, 8),
                                    EIGHT_VALUES(0x2002, 16),
                                    EIGHT_VALUES(0x2003, 24),
#endif
                                    CO_OBJ_DICT_ENDMARK};

/* Drivers with context argument or, with NODE_IS_CLASSIC, classic drivers. */
#if NODE_IS_CLASSIC
static void Nothing(void) {}
static void Take(uint32_t value) { (void)value; }
static int16_t Frame(CO_IF_FRM* frame) {
  (void)frame;
  return 0;
}
static uint32_t Ticks(void) { return 0; }
static uint8_t Elapsed(void) { return 0; }

static const CO_IF_CAN_DRV Can = {Nothing, Take, Frame, Frame, Nothing, Nothing};
static const CO_IF_TIMER_DRV Timer = {Take, Take, Ticks, Nothing, Nothing, Elapsed};
static CO_IF_DRV Drivers = {&Can, &Timer, 0};
#define DRIVERS &Drivers
#else
static void Nothing(void* ctx) { (void)ctx; }
static void Take(void* ctx, uint32_t value) {
  (void)ctx;
  (void)value;
}
static int16_t Read(void* ctx, CO_IF_FRM* frame) {
  (void)ctx;
  (void)frame;
  return 0;
}
static int16_t Send(void* ctx, const CO_IF_FRM* frame) {
  (void)ctx;
  (void)frame;
  return 0;
}
static uint32_t Ticks(void* ctx) {
  (void)ctx;
  return 0;
}

static const CO_IF_CAN_DRV_EX Can = {Nothing, Take, Read, Send, Nothing, Nothing, 0, 0};
static const CO_IF_TIMER_DRV_EX Timer = {Take, Ticks, Take};
static const CO_NODE_EXT Settings = {.Size = sizeof(CO_NODE_EXT), .Can = &Can, .Timer = &Timer};
#define DRIVERS 0
#endif
static CO_EMCY_TBL Errors[2] = {{0, 0x1000}, {1, 0x2000}};

#if !NODE_IS_SMALLEST
static void Done(CO_CSDO* client, uint16_t index, uint8_t sub, uint32_t code) {
  (void)client;
  (void)index;
  (void)sub;
  (void)code;
}
#endif

int main(void) {
  CO_NODE_SPEC spec = {
      1, 250000, (CO_OBJ*)Dictionary, sizeof(Dictionary) / sizeof(Dictionary[0]), Errors, 0, 0, 1000, DRIVERS, 0};
#if !NODE_IS_SMALLEST
  spec.SdoBuf = SdoBuffer;
#endif
#if NODE_IS_CLASSIC
  CONodeInit(&Node, &spec);
#else
  CONodeInitCtx(&Node, &spec, &Settings);
#endif
  CONodeStart(&Node);
  COEmcySet(&Node.Emcy, 0, 0);
  COEmcyClr(&Node.Emcy, 0);
#if !NODE_IS_SMALLEST
  COCSdoRequestUpload(COCSdoFind(&Node, 0), CO_DEV(0x1000, 0), Answer, sizeof(Answer), Done, 1000);
#endif
  for (;;) {
    CONodeProcess(&Node);
    COTmrService(&Node.Tmr);
    COTmrProcess(&Node.Tmr);
  }
}
