// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L

#include "wire.h"

#include <time.h>

static CONTROLLER* Of(void* ctx) { return (CONTROLLER*)ctx; }

static void Start(void* ctx, uint32_t baud) {
  CONTROLLER* const c = Of(ctx);
  CO_UNUSED(baud);
  (void)pthread_mutex_lock(&c->Mutex);
  c->On = true;
  (void)pthread_mutex_unlock(&c->Mutex);
}

static bool Write(void* ctx, const CO_IF_FRM* frame) {
  CONTROLLER* const c = Of(ctx);
  (void)pthread_mutex_lock(&c->Mutex);
  const bool free = c->On && c->Num < WIRE_MAILBOXES;
  if (free) {
    c->Box[c->Num++] = *frame;
    (void)pthread_cond_signal(&c->Changed);
  }
  (void)pthread_mutex_unlock(&c->Mutex);
  return free;
}

static void Restart(void* ctx) {
  CONTROLLER* const c = Of(ctx);
  (void)pthread_mutex_lock(&c->Mutex);
  c->Num = 0;
  (void)pthread_mutex_unlock(&c->Mutex);
}

static void Stop(void* ctx) {
  CONTROLLER* const c = Of(ctx);
  (void)pthread_mutex_lock(&c->Mutex);
  c->On = false;
  c->Num = 0;
  (void)pthread_mutex_unlock(&c->Mutex);
}

const NODE_TASK_CAN WireDriver = {Start, Write, Restart, Stop};

static CO_IF_FRM TakeFirst(CONTROLLER* c) {
  (void)pthread_mutex_lock(&c->Mutex);
  while (c->Num == 0) {
    (void)pthread_cond_wait(&c->Changed, &c->Mutex);
  }
  const CO_IF_FRM frame = c->Box[0];
  for (unsigned n = 1; n < c->Num; ++n) {
    c->Box[n - 1] = c->Box[n];
  }
  --c->Num;
  (void)pthread_mutex_unlock(&c->Mutex);
  return frame;
}

// Delivers a frame in the peer's receive interrupt. Returns false if the peer's ring is full: unlike real hardware the
// wire then repeats the frame, so that the result does not depend on the speed of the machine.
static bool Deliver(CONTROLLER* peer, const CO_IF_FRM* frame) {
  (void)pthread_mutex_lock(&peer->Mutex);
  const bool full = peer->On && CORingCount(&peer->Node->Received) == NODE_TASK_FRAMES;
  if (peer->On && !full) {
    NodeTaskReceivedFromISR(peer->Node, frame);
  }
  (void)pthread_mutex_unlock(&peer->Mutex);
  return !full;
}

// Transmits the first queued frame: calls the receive interrupt of the peer, and the transmit interrupt of this
// controller.
static bool Forward(CONTROLLER* c) {
  const struct timespec frame_time = {0, 50000};
  const CO_IF_FRM frame = TakeFirst(c);
  do {
    (void)nanosleep(&frame_time, NULL);
  } while (!Deliver(c->Peer, &frame));
  NodeTaskSentFromISR(c->Node);
  return true;
}

static void* Transmit(void* ctx) {
  while (Forward(Of(ctx))) {
  }
  return NULL;
}

static void Connect(CONTROLLER* one, CONTROLLER* other) {
  one->Peer = other;
  (void)pthread_mutex_init(&one->Mutex, NULL);
  (void)pthread_cond_init(&one->Changed, NULL);
}

void WireConnect(CONTROLLER* one, CONTROLLER* other) {
  Connect(one, other);
  Connect(other, one);
  (void)pthread_create(&one->Interrupt, NULL, Transmit, one);
  (void)pthread_create(&other->Interrupt, NULL, Transmit, other);
}
