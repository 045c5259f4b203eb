// SPDX-License-Identifier: Apache-2.0
/// \file co_ring.h
/// A lock-free queue of frames between one producer (a receive interrupt) and one consumer (the loop).
#ifndef CO_RING_H_
#define CO_RING_H_

#include "co_if_can.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A ring of frames, owned by the application or a driver, which must not access the members.
typedef struct CO_RING_T {
  CO_IF_FRM* Mem;  ///< memory for Size frames, owned by the caller of CORingInit()
  uint16_t Size;   ///< frames, 1…32767; 0: every frame is rejected
  uint16_t Head;   ///< written by the producer only; counts 0…2*Size-1
  uint16_t Tail;   ///< written by the consumer only
  uint16_t Lost;   ///< written by the producer only
} CO_RING;

/// Initialises a ring with memory for \a size frames at \a mem (1…32767). The caller owns the memory. Must not be
/// called while a producer or consumer uses the ring.
/// \retval false  an argument is null or out of range; the ring is then empty and rejects every frame
bool CORingInit(CO_RING* ring, CO_IF_FRM* mem, uint16_t size);

/// Appends a frame. Called by the producer.
/// \retval false  the ring is full: the frame is lost and counted (CORingLost())
bool CORingPut(CO_RING* ring, const CO_IF_FRM* frm);

/// Removes the oldest frame and copies it to \a frm. Called by the consumer.
/// \retval false  the ring is empty
bool CORingGet(CO_RING* ring, CO_IF_FRM* frm);

/// Removes all frames that are in the ring at the time of the call; frames that arrive during the call remain. Called
/// by the consumer. Has no effect if \a ring is null.
void CORingClear(CO_RING* ring);

/// Returns the number of frames in the ring, a snapshot. Called by the producer or the consumer.
uint16_t CORingCount(const CO_RING* ring);

/// Returns the number of frames lost since CORingInit(), saturating. Called by the producer or the consumer.
uint16_t CORingLost(const CO_RING* ring);

#ifdef __cplusplus
}
#endif

#endif
