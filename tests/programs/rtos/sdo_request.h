// SPDX-License-Identifier: Apache-2.0
/// \file sdo_request.h
/// Blocking SDO requests for tasks other than that of the node (node_task.h): the calling task waits until the transfer
/// ends. One request at a time for each SDO_REQUEST.
#ifndef SDO_REQUEST_H_
#define SDO_REQUEST_H_

#include "node_task.h"

#ifdef __cplusplus
extern "C" {
#endif

/// An SDO client of the node. \a Client: its number (1280h + Client); only this object may use it.
typedef struct SDO_REQUEST_T {
  NODE_TASK* Node;
  uint8_t Client;
} SDO_REQUEST;

/// Read and write an object. They return 0, or an abort code (CO_SDO_ERR_…); CO_SDO_ERR_TOS_STATE also if the request
/// could not be started. \a key: CO_DEV(); \a num: number of bytes read.
uint32_t SdoRead(SDO_REQUEST* self, uint32_t key, uint8_t* buffer, uint32_t size, uint32_t* num);
uint32_t SdoWrite(SDO_REQUEST* self, uint32_t key, const uint8_t* buffer, uint32_t size);

#ifdef __cplusplus
}
#endif

#endif
