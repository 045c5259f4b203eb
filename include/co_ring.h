// SPDX-License-Identifier: Apache-2.0
/// \file co_ring.h
/// A queue of frames between one producer (a receive interrupt) and one consumer (the loop), without locks.
#ifndef CO_RING_H_
#define CO_RING_H_

#include "co_if_can.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CO_RING_T {
  CO_IF_FRM* Mem;
  uint16_t Size;
  uint16_t Head;  ///< written by the producer only; counts 0…2*Size-1
  uint16_t Tail;  ///< written by the consumer only
  uint16_t Lost;  ///< written by the producer only
} CO_RING;

/// Prepares a ring over \a size frames at \a mem (1…32767), which stay the caller's. Neither end may be in use.
/// Returns false if an argument is null or out of range; the ring then holds nothing.
bool CORingInit(CO_RING* ring, CO_IF_FRM* mem, uint16_t size);

/// Producer end. Returns false if the ring is full: the frame is lost and counted (CORingLost()).
bool CORingPut(CO_RING* ring, const CO_IF_FRM* frm);

/// Consumer end. Returns false if the ring is empty.
bool CORingGet(CO_RING* ring, CO_IF_FRM* frm);

/// Consumer end. Takes out all frames that the ring holds now; those that come meanwhile stay. Null: nothing happens.
void CORingClear(CO_RING* ring);

/// Frames in the ring. From either end: a snapshot.
uint16_t CORingCount(const CO_RING* ring);

/// Frames lost since CORingInit(), saturating. From either end.
uint16_t CORingLost(const CO_RING* ring);

#ifdef __cplusplus
}
#endif

#endif
