// SPDX-License-Identifier: Apache-2.0
/// \file sdo_request.h
/// SDO requests of a task that waits for their end, beside the task of its node (node_task.h). One request at a time
/// for each object of this type.
#ifndef SDO_REQUEST_H_
#define SDO_REQUEST_H_

#include "node_task.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \a Client: number of the SDO client (1280h + Client) that this task alone uses.
typedef struct SDO_REQUEST_T {
  NODE_TASK* Node;
  uint8_t Client;
} SDO_REQUEST;

/// Each returns 0, or an abort code (CO_SDO_ERR_…): CO_SDO_ERR_TOS_STATE also if the request could not be started.
/// \a key: CO_DEV(); \a num: the bytes that were read.
uint32_t SdoRead(SDO_REQUEST* self, uint32_t key, uint8_t* buffer, uint32_t size, uint32_t* num);
uint32_t SdoWrite(SDO_REQUEST* self, uint32_t key, const uint8_t* buffer, uint32_t size);

#ifdef __cplusplus
}
#endif

#endif
