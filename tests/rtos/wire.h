// SPDX-License-Identifier: Apache-2.0
// Two controllers on one wire, each with an interrupt that runs as a thread.
#ifndef WIRE_H_
#define WIRE_H_

#include <pthread.h>

#include "node_task.h"

#define WIRE_MAILBOXES 3u

typedef struct CONTROLLER_T {
  NODE_TASK* Node;
  struct CONTROLLER_T* Peer;
  pthread_t Interrupt;
  pthread_mutex_t Mutex;  // interrupts of this controller are masked while it is held
  pthread_cond_t Changed;
  CO_IF_FRM Box[WIRE_MAILBOXES];
  unsigned Num;
  bool On;
} CONTROLLER;

extern const NODE_TASK_CAN WireDriver;  // its context is a CONTROLLER

void WireConnect(CONTROLLER* one, CONTROLLER* other);

#endif
