// SPDX-License-Identifier: Apache-2.0
/// \file co_err.h
/// Error codes. Functions return them; the node also keeps the last one (CONodeGetErr()).
/// The numbers are part of the interface: new codes are added at the end only. Codes without a comment belong to
/// services that carry their name, or are kept for firmware that names them.
#ifndef CO_ERR_H_
#define CO_ERR_H_

#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

#ifndef CO_ERR_BASE
/// Value of the first error code. Default 0x0100.
#define CO_ERR_BASE 0x0100
#endif

typedef enum CO_ERR_T {
  CO_ERR_NONE = 0,               ///< success
  CO_ERR_BAD_ARG = CO_ERR_BASE,  ///< an argument is null, out of range or of the wrong length
  CO_ERR_OBJ_NOT_FOUND,          ///< no such index and sub-index
  CO_ERR_OBJ_READ,
  CO_ERR_OBJ_WRITE,
  CO_ERR_OBJ_SIZE,          ///< the object has another length
  CO_ERR_OBJ_INIT,          ///< the Init function of an object type failed; the node runs
  CO_ERR_OBJ_MAP_LEN,       ///< mapping too long (0604 0042h)
  CO_ERR_OBJ_MAP_TYPE,      ///< object cannot be mapped (0604 0041h)
  CO_ERR_OBJ_ACC,           ///< the object cannot be read, or cannot be written
  CO_ERR_OBJ_RANGE,         ///< value not allowed (SDO abort 0609 0030h)
  CO_ERR_OBJ_INCOMPATIBLE,  ///< value contradicts another setting (0604 0043h)
  CO_ERR_DICT_INIT,         ///< the dictionary is refused; CODictGetFault() names the entry
  CO_ERR_PARA_IDX,
  CO_ERR_PARA_STORE,
  CO_ERR_PARA_RESTORE,
  CO_ERR_PARA_LOAD,
  CO_ERR_LSS_STORE,
  CO_ERR_LSS_LOAD,
  CO_ERR_CFG_1001_0,  ///< the mandatory object 1001h:0 is missing; the node runs
  CO_ERR_CFG_1003_0,
  CO_ERR_CFG_1003_1,
  CO_ERR_CFG_1005_0,
  CO_ERR_CFG_1006_0,
  CO_ERR_CFG_1010_0,
  CO_ERR_CFG_1011_0,
  CO_ERR_CFG_1014_0,
  CO_ERR_CFG_1017_0,
  CO_ERR_CFG_1016,
  CO_ERR_CFG_1018,    ///< the mandatory object 1018h:1 is missing; the node runs
  CO_ERR_TMR_NO_ACT,  ///< no free timer
  CO_ERR_TMR_INSERT,
  CO_ERR_TMR_CREATE,
  CO_ERR_TMR_DELETE,
  CO_ERR_NMT_INIT,
  CO_ERR_NMT_APP_RESET,
  CO_ERR_NMT_COM_RESET,
  CO_ERR_NMT_MODE,  ///< not possible in this NMT state
  CO_ERR_EMCY_BAD_ROOT,
  CO_ERR_TPDO_COM_OBJ,
  CO_ERR_TPDO_MAP_OBJ,
  CO_ERR_TPDO_OBJ_TRIGGER,
  CO_ERR_TPDO_NUM_TRIGGER,
  CO_ERR_TPDO_INHIBIT,
  CO_ERR_TPDO_EVENT,
  CO_ERR_RPDO_COM_OBJ,
  CO_ERR_RPDO_MAP_OBJ,
  CO_ERR_SDO_SILENT,
  CO_ERR_SDO_OFF,
  CO_ERR_SDO_BUSY,
  CO_ERR_SDO_ABORT,
  CO_ERR_SDO_READ,   ///< an SDO upload failed for a hardware error (SDO abort 0606 0000h)
  CO_ERR_SDO_WRITE,  ///< an SDO download failed for a hardware error (SDO abort 0606 0000h)
  CO_ERR_SYNC_MSG,
  CO_ERR_SYNC_RES,
  CO_ERR_IF_CAN_INIT,
  CO_ERR_IF_CAN_ENABLE,
  CO_ERR_IF_CAN_FLUSH_RX,
  CO_ERR_IF_CAN_FLUSH_TX,
  CO_ERR_IF_CAN_RESET,
  CO_ERR_IF_CAN_CLOSE,
  CO_ERR_IF_CAN_READ,  ///< the CAN driver's Read reported an error
  CO_ERR_IF_CAN_SEND,  ///< the CAN driver's Send reported an error
  CO_ERR_IF_TIMER_INIT,
  CO_ERR_IF_TIMER_UPDATE,
  CO_ERR_IF_TIMER_RELOAD,
  CO_ERR_IF_TIMER_DELAY,
  CO_ERR_IF_TIMER_STOP,
  CO_ERR_IF_TIMER_START,
  CO_ERR_IF_NVM_INIT,
  CO_ERR_IF_NVM_READ,   ///< non-volatile memory could not be read (SDO abort 0606 0000h)
  CO_ERR_IF_NVM_WRITE,  ///< non-volatile memory could not be written (SDO abort 0606 0000h)
  CO_ERR_SIG_INIT,
  CO_ERR_SIG_CREATE,
  CO_ERR_MSG_INIT,
  CO_ERR_MSG_CREATE,
  CO_ERR_MSG_READ,
  CO_ERR_TYPE_INIT,      ///< an object type is used at an index or sub-index where it must not be
  CO_ERR_TYPE_RD,        ///< a type function cannot give the value (SDO abort 0800 0020h)
  CO_ERR_TYPE_WR,        ///< a type function cannot take the value (SDO abort 0800 0020h)
  CO_ERR_TYPE_RESET,     ///< a type function cannot reset the object
  CO_ERR_OBJ_STATE,      ///< not possible in the present device state (SDO abort 0800 0022h)
  CO_ERR_OBJ_NO_DATA,    ///< there is no data to give (SDO abort 0800 0024h)
  CO_ERR_LSS_BUSY,       ///< a service of the LSS master is going on
  CO_ERR_LSS_NO_STORE,   ///< node-ID and bit rate cannot be stored
  CO_ERR_TYPE_AGAIN,     ///< a Reset function that has not come to the position yet (co_obj.h)
  CO_ERR_NODE_EXT,       ///< CONodeInitEx(): CO_NODE_EXT.Size is less than sizeof(CO_NODE_EXT)
  CO_ERR_NODE_CAN,       ///< CONodeInit(): there is no CAN driver
  CO_ERR_NODE_TIMER,     ///< CONodeInit(): there is no timer driver
  CO_ERR_NODE_TMR_FREQ,  ///< CONodeInit(): CO_NODE_SPEC.TmrFreq is 0
  CO_ERR_NODE_ID,        ///< CONodeInit(): CO_NODE_SPEC.NodeId is not 1…127, nor CO_LSS_NO_NODE_ID with USE_LSS
  CO_ERR_NODE_DICT,      ///< CONodeInit(): CO_NODE_SPEC.Dict is null, or DictLen is 0
  CO_ERR_PARA_OVERLAP,   ///< a parameter group overlaps one with a lower sub-index of 1010h; it is not used
  CO_ERR_OBJ_RANGE_LOW,  ///< value too low (SDO abort 0609 0032h)
} CO_ERR;

#ifdef __cplusplus
}
#endif

#endif
