// SPDX-License-Identifier: Apache-2.0
/// \file co_if.h
/// The drivers of a node, and the functions through which the stack (and the application) reaches them.
///
/// Context: the loop.
#ifndef CO_IF_H_
#define CO_IF_H_

#include "co_if_can.h"
#include "co_if_nvm.h"
#include "co_if_timer.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;

/// The drivers without context of a node. Nvm may be null: then nothing can be stored.
typedef struct CO_IF_DRV_T {
  const CO_IF_CAN_DRV* Can;
  const CO_IF_TIMER_DRV* Timer;
  const CO_IF_NVM_DRV* Nvm;
} CO_IF_DRV;

typedef struct CO_IF_T {
  struct CO_NODE_T* Node;
  CO_IF_DRV* Drv;
} CO_IF;

/// Connects the interface with a node and initialises all drivers; CONodeInit() does it. \a freq: timer ticks/s.
void COIfInit(CO_IF* cif, struct CO_NODE_T* node, uint32_t freq);

/// Initialises the CAN driver; the controller stays off the bus.
void COIfCanInit(CO_IF* cif, struct CO_NODE_T* node);
/// Goes on the bus with \a baud bit/s; 0 keeps the node's rate.
void COIfCanEnable(CO_IF* cif, uint32_t baud);
/// Reads a frame. Frames with a DLC above 15 are counted (CO_NODE_COUNTERS.Malformed) and skipped. Returns
/// sizeof(CO_IF_FRM), 0 (none), or < 0 (error; the node's error is then CO_ERR_IF_CAN_READ).
int16_t COIfCanRead(CO_IF* cif, CO_IF_FRM* frm);
/// Sends a frame of the application, in any NMT state; in CO_INIT it waits for the boot-up message. Takes its place by
/// priority among frames that wait. Returns sizeof(CO_IF_FRM) when sent or queued, 0 when the queue is full (counted as
/// dropped), -1: an argument is null, the node is in CO_INVALID, or the DLC is above 15 (counted as malformed). Up to
/// half of the queue (one frame for each SDO server and client and one more, at most) is kept for the node's own
/// frames. A driver error leaves the frame in the queue and sets CO_ERR_IF_CAN_SEND.
int16_t COIfCanSend(CO_IF* cif, CO_IF_FRM* frm);
/// Clears errors and queues of the controller.
void COIfCanReset(CO_IF* cif);
/// Goes off the bus.
void COIfCanClose(CO_IF* cif);

/// Reads \a size bytes at \a start. Returns the bytes read; 0 without a driver.
uint32_t COIfNvmRead(CO_IF* cif, uint32_t start, uint8_t* buffer, uint32_t size);
/// Writes \a size bytes at \a start. Returns the bytes written; 0 without a driver.
uint32_t COIfNvmWrite(CO_IF* cif, uint32_t start, uint8_t* buffer, uint32_t size);

#ifdef __cplusplus
}
#endif

#endif
