// SPDX-License-Identifier: Apache-2.0
/// \file node_task.h
/// A node in a task of FreeRTOS: an example to copy (docs/porting.md). Any number of nodes, each with its task.
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
/// The rule: a task that calls any function of the stack holds the lock. Callbacks and type functions are called with
/// the lock held; they call the stack directly, and must not wait.
#ifndef NODE_TASK_H_
#define NODE_TASK_H_

#include "co_core.h"

#include "FreeRTOS.h"

#include "semphr.h"
#include "task.h"

#ifdef __cplusplus
extern "C" {
#endif

#define NODE_TASK_FRAMES 32u   ///< between the receive interrupt and the task
#define NODE_TASK_STACK 1024u  ///< words; docs/sizes.md tells what the stack needs, your callbacks add theirs
#define NODE_TASK_PRIORITY 3u

/// Functions of the controller. Start and Stop: no interrupt occurs after Stop has returned.
typedef struct NODE_TASK_CAN_T {
  void (*Start)(void* ctx, uint32_t baud);           ///< on the bus
  bool (*Write)(void* ctx, const CO_IF_FRM* frame);  ///< false: no mailbox is free
  void (*Restart)(void* ctx);                        ///< clears errors, leaves bus-off
  void (*Stop)(void* ctx);                           ///< off the bus
} NODE_TASK_CAN;

/// Set Can and CanCtx, zero the rest.
typedef struct NODE_TASK_T {
  const NODE_TASK_CAN* Can;
  void* CanCtx;
  CO_NODE Node;  ///< with the lock held
  CO_NODE_EXT Ext;
  CO_RING Received;
  CO_IF_FRM ReceivedMem[NODE_TASK_FRAMES];
  uint16_t Lost;      ///< frames that found the ring full, as reported to the node
  TaskHandle_t Task;  ///< set before the first interrupt
  StaticTask_t TaskMem;
  StackType_t Stack[NODE_TASK_STACK];
  SemaphoreHandle_t Mutex;
  StaticSemaphore_t MutexMem;
} NODE_TASK;

/// Initialises the node, starts it, and gives it its task. To be called in a task: the scheduler runs. \a spec needs no
/// drivers but one for memory, and TmrFreq is set here. Returns the node's error; CO_ERR_DICT_INIT and CO_ERR_NODE_…
/// leave it silent.
CO_ERR NodeTaskStart(NODE_TASK* self, const CO_NODE_SPEC* spec);

/// \name For other tasks: calls of the stack stand between the two. Not in callbacks, not in interrupts.
/// \{
void NodeTaskLock(NODE_TASK* self);
void NodeTaskUnlock(NODE_TASK* self);
/// \}

/// \name For the interrupts of the controller
/// \{
void NodeTaskReceivedFromISR(NODE_TASK* self, const CO_IF_FRM* frame);
void NodeTaskSentFromISR(NODE_TASK* self);  ///< a mailbox is free again
/// \}

#ifdef __cplusplus
}
#endif

#endif
