/* SPDX-License-Identifier: Apache-2.0 */
/* A node with what its configuration has and nothing else: what the linker keeps of it is what firmware pays. */
#include "co_core.h"

static CO_NODE Node;
static uint8_t ErrorRegister;
static uint16_t Heartbeat;
static uint32_t EmcyId = 0x80;
static uint8_t Values[8];
#if !NODE_IS_SMALLEST
static uint32_t History[2];
static uint8_t HistoryNum;
static uint32_t Consumer = 0x000203E8;
static const CO_PARA Group = {0, sizeof(Values), Values, 0, CO_RESET_NODE, 0, CO_PARA___E, 0, 0};
static uint8_t SdoBuffer[CO_SSDO_N * CO_SDO_BUF_BYTE];
static uint8_t Answer[4];
#endif

static const CO_OBJ Dictionary[] = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0},
                                    {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)&ErrorRegister},
#if !NODE_IS_SMALLEST
                                    {CO_KEY(0x1003, 0, CO_OBJ_____RW), CO_TEMCY_HIST, (CO_DATA)&HistoryNum},
                                    {CO_KEY(0x1003, 1, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)&History[0]},
                                    {CO_KEY(0x1003, 2, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)&History[1]},
                                    {CO_KEY(0x1005, 0, CO_OBJ_D___R_), CO_TSYNC_ID, (CO_DATA)0x80},
                                    {CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)&Group},
                                    {CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, (CO_DATA)&Group},
#endif
                                    {CO_KEY(0x1014, 0, CO_OBJ__N__R_), CO_TEMCY_ID, (CO_DATA)&EmcyId},
#if !NODE_IS_SMALLEST
                                    {CO_KEY(0x1016, 1, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)&Consumer},
#endif
                                    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)&Heartbeat},
                                    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)1},
                                    {CO_KEY(0x1018, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)2},
                                    {CO_KEY(0x1018, 3, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)3},
                                    {CO_KEY(0x1018, 4, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)4},
#if !NODE_IS_SMALLEST
                                    {CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0x602},
                                    {CO_KEY(0x1280, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0x582},
                                    {CO_KEY(0x1280, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)2},
#endif
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
                                    CO_OBJ_DICT_ENDMARK};

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
      1, 250000, (CO_OBJ*)Dictionary, sizeof(Dictionary) / sizeof(Dictionary[0]), Errors, 0, 0, 1000, &Drivers, 0};
#if !NODE_IS_SMALLEST
  spec.SdoBuf = SdoBuffer;
#endif
  CONodeInit(&Node, &spec);
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
