// SPDX-License-Identifier: Apache-2.0
// Two simulated controllers that are connected to each other; a thread simulates the interrupts of each.
#ifndef WIRE_H_
#define WIRE_H_

#include <pthread.h>

#include "node_task.h"

#define WIRE_MAILBOXES 3u

typedef struct CONTROLLER_T {
  NODE_TASK* Node;
  struct CONTROLLER_T* Peer;
  pthread_t Interrupt;
  pthread_mutex_t Mutex;  // masks the interrupts of this controller
  pthread_cond_t Changed;
  CO_IF_FRM Box[WIRE_MAILBOXES];
  unsigned Num;
  bool On;
} CONTROLLER;

extern const NODE_TASK_CAN WireDriver;  // its context argument is a CONTROLLER

void WireConnect(CONTROLLER* one, CONTROLLER* other);

#endif
