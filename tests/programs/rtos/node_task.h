// SPDX-License-Identifier: Apache-2.0
/// \file node_task.h
/// Runs a node in a task of FreeRTOS: an example to copy (docs/porting.md). There may be several nodes, each with a
/// task.
///
///     static NODE_TASK Motor;
///     Motor.Can = &MyController;  Motor.CanCtx = CAN1;
///     if (NodeTaskStart(&Motor, &spec) != CO_ERR_NONE) { ... }        // in any task
///     void CAN1_RX_IRQHandler(void) { ... NodeTaskReceivedFromISR(&Motor, &frm); }
///     void CAN1_TX_IRQHandler(void) { ... NodeTaskSentFromISR(&Motor); }
///
///     NodeTaskLock(&Motor);                                           // any other task
///     COTPdoTrigPdo(Motor.Node.TPdo, 0);
///     NodeTaskUnlock(&Motor);
///
/// Rule: a task must hold the lock to call any function of the stack. Callbacks and type functions are called with the
/// lock held; they call the stack directly, and must not wait.
#ifndef NODE_TASK_H_
#define NODE_TASK_H_

#include "co_core.h"

#include "FreeRTOS.h"

#include "semphr.h"
#include "task.h"

#ifdef __cplusplus
extern "C" {
#endif

#define NODE_TASK_FRAMES 32u   ///< frames in the ring between the receive interrupt and the task
#define NODE_TASK_STACK 1024u  ///< words; docs/sizes.md has the stack's use, add that of your callbacks
#define NODE_TASK_PRIORITY 3u

/// Functions of the controller. After Stop has returned, no interrupt may occur.
typedef struct NODE_TASK_CAN_T {
  void (*Start)(void* ctx, uint32_t baud);           ///< goes on the bus
  bool (*Write)(void* ctx, const CO_IF_FRM* frame);  ///< returns false if no mailbox is free
  void (*Restart)(void* ctx);                        ///< clears errors, ends bus-off
  void (*Stop)(void* ctx);                           ///< goes off the bus
} NODE_TASK_CAN;

/// A node and its task. Set Can and CanCtx, and all other members to zero.
typedef struct NODE_TASK_T {
  const NODE_TASK_CAN* Can;
  void* CanCtx;
  CO_NODE Node;  ///< to be used with the lock held
  CO_NODE_EXT Ext;
  CO_RING Received;
  CO_IF_FRM ReceivedMem[NODE_TASK_FRAMES];
  uint16_t Lost;      ///< number of lost frames (ring full) already reported to the node
  TaskHandle_t Task;  ///< set before the first interrupt
  StaticTask_t TaskMem;
  StackType_t Stack[NODE_TASK_STACK];
  SemaphoreHandle_t Mutex;
  StaticSemaphore_t MutexMem;
} NODE_TASK;

/// Initialises the node, starts it, and creates its task. To be called in a task, with the scheduler running. \a spec
/// needs no drivers except one for memory; TmrFreq is set by this function. Returns the node's error; after
/// CO_ERR_DICT_INIT and CO_ERR_NODE_… the node sends nothing.
CO_ERR NodeTaskStart(NODE_TASK* self, const CO_NODE_SPEC* spec);

/// \name Lock of the node, for calls of the stack in other tasks; not in callbacks or interrupts
/// \{
void NodeTaskLock(NODE_TASK* self);
void NodeTaskUnlock(NODE_TASK* self);
/// \}

/// \name Functions to be called in the controller's interrupts
/// \{
void NodeTaskReceivedFromISR(NODE_TASK* self, const CO_IF_FRM* frame);
void NodeTaskSentFromISR(NODE_TASK* self);  ///< a mailbox has become free
/// \}

#ifdef __cplusplus
}
#endif

#endif
