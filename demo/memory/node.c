// SPDX-License-Identifier: Apache-2.0
// A node that stores its parameters in any of the memories of this directory: "save" to 1010h:1, "load" to 1011h:1.
#include "node.h"

typedef struct PARAMETERS {
  uint16_t HeartbeatTime;  // ms
  uint16_t Gain;
  int32_t Setpoint;
} PARAMETERS;

static uint8_t ErrorRegister;
static PARAMETERS Parameters;
static const PARAMETERS Defaults = {1000, 10, 200};

// One group for all parameters uses the fewest pages: two erase units.
static const CO_PARA Group = {.Offset = 0,
                              .Size = sizeof(Parameters),
                              .Start = (uint8_t*)&Parameters,
                              .Default = (uint8_t*)&Defaults,
                              .Type = CO_RESET_NODE,
                              .Value = CO_PARA___E};

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1010, 0, CO_OBJ_D___R_), CO_TPARA_STORE, (CO_DATA)(1)},
    {CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&Group)},
    {CO_KEY(0x1011, 0, CO_OBJ_D___R_), CO_TPARA_RESTORE, (CO_DATA)(1)},
    {CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, (CO_DATA)(&Group)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&Parameters.HeartbeatTime)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // vendor-ID: get one from CiA
    {CO_KEY(0x2200, 0, CO_OBJ_____RW), CO_TSIGNED32, (CO_DATA)(&Parameters.Setpoint)},
    {CO_KEY(0x2201, 0, CO_OBJ_____RW), CO_TUNSIGNED16, (CO_DATA)(&Parameters.Gain)},
};

static CO_NODE Node;
CO_SDO_BUFFER(SdoBuffer);

CO_NODE* StartNode(CO_NODE_EXT* drivers, const CO_IF_NVM_DRV_EX* memory, const void* context) {
  static CO_NODE_SPEC spec = {.NodeId = 5, .Baudrate = 500000, .TmrFreq = 1000};
  spec.Dict = (CO_OBJ*)Dictionary;
  spec.DictLen = sizeof(Dictionary) / sizeof(Dictionary[0]);
  spec.SdoBuf = SdoBuffer;
  drivers->Size = sizeof(*drivers);
  drivers->Nvm = memory;             // for example &FlashPagesNvmDriver
  drivers->NvmCtx = (void*)context;  // for example &FlashStm32g4
  drivers->SdoBufLen = SdoBufferLen;
  CONodeInitEx(&Node, &spec, drivers);
  CONodeStart(&Node);
  return &Node;
}
