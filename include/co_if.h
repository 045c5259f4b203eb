// SPDX-License-Identifier: Apache-2.0
/// \file co_if.h
/// The drivers of a node, and the functions through which the stack (and the application) calls them.
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

struct CO_STORE_T;

/// The drivers of a node: &node.If. The application must not access the members. Inside the stack all drivers have a
/// context argument; those of classic drivers are adapters.
typedef struct CO_IF_T {
  struct CO_NODE_T* Node;                   ///< owner
  struct CO_IF_DRV_T* Drv;                  ///< classic drivers, CO_NODE_SPEC.Drv; null: they are not used
  const CO_IF_CAN_DRV_EX* Can;              ///< CAN driver
  void* CanCtx;                             ///< argument of the functions of Can
  const CO_IF_TIMER_DRV_EX* Timer;          ///< timer driver
  void* TimerCtx;                           ///< argument of the functions of Timer
  const CO_IF_NVM_DRV_EX* Nvm;              ///< memory driver, or null
  void* NvmCtx;                             ///< argument of the functions of Nvm
  const struct CO_STORE_T* Raw;             ///< stores groups in a memory without Shape; null: no group is stored there
  bool (*HasElapsed)(struct CO_IF_T* cif);  ///< asked by COTmrService(): classic timer drivers only, otherwise null
  uint32_t Expiry;      ///< classic timer driver: clock at the expiry for which it counts, or at the moment of its stop
  uint32_t Programmed;  ///< classic timer driver: ticks for which it counts; 0: stopped
  bool IsElapsed;       ///< classic timer driver: its expiry is being processed by COTmrService()
} CO_IF;

/// Counters of a node since CONodeInit(). All counters saturate.
typedef struct CO_NODE_COUNTERS_T {
  uint32_t Received;  ///< frames read from the driver
  /// Received frames without a consumer in this node, or of a service that the NMT state does not allow.
  uint32_t Unclaimed;
  /// Received frames that a service of this node consumes, but with a wrong length or format, or with a DLC above 15;
  /// they are ignored. Frames with a DLC above 15 that the application sends are counted here, too.
  uint32_t Malformed;
  uint32_t Sent;  ///< frames that the driver accepted
  /// Frames that were discarded because a queue was full, or by a reset or a change of the NMT state.
  uint32_t Dropped;
  uint32_t SdoAborts;                    ///< SDO transfers that the server aborted
  uint32_t TimerExhausted;               ///< calls of COTmrCreate() without a free timer
  uint32_t CanEvents[CO_CAN_EVENT_NUM];  ///< events reported by CONodeCanEvent() or detected by CONodeProcess()
} CO_NODE_COUNTERS;

/// Returns a copy of the counters; all are 0 if \a node is null.
CO_NODE_COUNTERS CONodeGetCounters(const struct CO_NODE_T* node);

/// Connects the interface with a node and initialises all drivers. CONodeInit() has done both: not for a node that
/// runs, because the timers of the stack would stop. \a freq: timer ticks per second.
void COIfInit(CO_IF* cif, struct CO_NODE_T* node, uint32_t freq);

/// Initialises the CAN driver; the controller stays off the bus.
void COIfCanInit(CO_IF* cif, struct CO_NODE_T* node);
/// Goes on the bus with \a baud bit/s; 0: the node's present bit rate.
void COIfCanEnable(CO_IF* cif, uint32_t baud);
/// Reads a frame. Frames with a DLC above 15 are counted (CO_NODE_COUNTERS.Malformed) and skipped.
/// \retval sizeof(CO_IF_FRM)  a frame was read
/// \retval 0                  no frame is available
/// \retval <0                 the driver reported an error; the node's error is CO_ERR_IF_CAN_READ
int16_t COIfCanRead(CO_IF* cif, CO_IF_FRM* frm);
/// Sends a frame of the application, in any NMT state; in CO_INIT the frame is queued until the boot-up message is
/// sent. The transmit queue is ordered by priority. Up to half of it (at most one frame for each SDO server and client,
/// and two more, for an EMCY message and a heartbeat) is reserved for the node's own frames. After a driver error the
/// frame stays in the queue and the node's error is CO_ERR_IF_CAN_SEND.
/// \retval sizeof(CO_IF_FRM)  the frame is sent or queued
/// \retval 0                  the queue is full; the frame is counted as dropped
/// \retval -1                 an argument is null, the node is in CO_INVALID, or the DLC is above 15 (counted as
///                            malformed)
int16_t COIfCanSend(CO_IF* cif, CO_IF_FRM* frm);
/// Clears errors and queues of the controller.
void COIfCanReset(CO_IF* cif);
/// Goes off the bus.
void COIfCanClose(CO_IF* cif);

/// Reads \a size bytes at address \a start. Returns the number of bytes read; 0 without a driver.
uint32_t COIfNvmRead(CO_IF* cif, uint32_t start, uint8_t* buffer, uint32_t size);
/// Writes \a size bytes at address \a start. Returns the number of bytes written; 0 without a driver.
uint32_t COIfNvmWrite(CO_IF* cif, uint32_t start, uint8_t* buffer, uint32_t size);

/// \name As in CANopen-Stack
/// The callbacks are functions that the application may define (see co_nmt.h); the defaults do nothing.
/// \{

/// The classic drivers (without context) of a node. Nvm may be null: then nothing can be stored.
typedef struct CO_IF_DRV_T {
  const CO_IF_CAN_DRV* Can;      ///< may be null if CO_NODE_EXT.Can is not
  const CO_IF_TIMER_DRV* Timer;  ///< may be null if CO_NODE_EXT.Timer is not
  const CO_IF_NVM_DRV* Nvm;      ///< not used if CO_NODE_EXT.Nvm is not null
} CO_IF_DRV;

/// Like CO_CALLBACKS.CanReceive: called for a received frame that no service of the node consumes; not called in
/// CO_INIT and CO_INVALID. With a real-time thread: see CO_NODE_EXT.Foreign.
void COIfCanReceive(CO_IF_FRM* frm);

/// Like CO_CALLBACKS.CanChange: called when the CAN controller has changed its state.
void CONodeCanChange(struct CO_NODE_T* node, CO_CAN_EVENT event);
/// \}

#ifdef __cplusplus
}
#endif

#endif
