// SPDX-License-Identifier: Apache-2.0
// Two simulated CAN controllers that are connected to each other. A thread for each simulates its interrupts.
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
  CO_IF_FRM Box[WIRE_MAILBOXES];  // transmit mailboxes
  unsigned Num;                   // frames in Box, the first is transmitted next
  bool On;                        // on the bus
} CONTROLLER;

extern const NODE_TASK_CAN WireDriver;  // its context argument is a CONTROLLER

// Connects two controllers and starts their threads.
void WireConnect(CONTROLLER* one, CONTROLLER* other);

#endif
