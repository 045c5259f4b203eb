// SPDX-License-Identifier: Apache-2.0
// Ring of frames. Head and Tail count modulo twice the size, so that a full ring differs from an empty one without an
// unused element.
#include "co_ring.h"

#include "co_assert.h"

namespace co::ring {
namespace {

uint16_t load(const uint16_t& position) { return __atomic_load_n(&position, __ATOMIC_ACQUIRE); }

void store(uint16_t& position, uint16_t value) { __atomic_store_n(&position, value, __ATOMIC_RELEASE); }

uint16_t used(const CO_RING& ring, uint16_t head, uint16_t tail) {
  return static_cast<uint16_t>(head >= tail ? head - tail : head + 2 * ring.Size - tail);
}

uint16_t next(const CO_RING& ring, uint16_t position) {
  return static_cast<uint16_t>(position + 1 == 2 * ring.Size ? 0 : position + 1);
}

CO_IF_FRM& frame_at(const CO_RING& ring, uint16_t position) {
  CO_ASSERT(position < 2 * ring.Size);
  return ring.Mem[position < ring.Size ? position : position - ring.Size];
}

}  // namespace
}  // namespace co::ring

extern "C" {

bool CORingInit(CO_RING* ring, CO_IF_FRM* mem, uint16_t size) {
  if (ring == nullptr) {
    return false;
  }
  const bool usable = mem != nullptr && size != 0 && size <= INT16_MAX;
  *ring = {mem, static_cast<uint16_t>(usable ? size : 0), 0, 0, 0};
  return usable;
}

bool CORingPut(CO_RING* ring, const CO_IF_FRM* frm) {
  if (ring == nullptr || frm == nullptr) {
    return false;
  }
  if (co::ring::used(*ring, ring->Head, co::ring::load(ring->Tail)) == ring->Size) {
    if (ring->Lost != UINT16_MAX) {
      co::ring::store(ring->Lost, static_cast<uint16_t>(ring->Lost + 1));
    }
    return false;
  }
  co::ring::frame_at(*ring, ring->Head) = *frm;
  co::ring::store(ring->Head, co::ring::next(*ring, ring->Head));
  return true;
}

bool CORingGet(CO_RING* ring, CO_IF_FRM* frm) {
  if (ring == nullptr || frm == nullptr || co::ring::load(ring->Head) == ring->Tail) {
    return false;
  }
  *frm = co::ring::frame_at(*ring, ring->Tail);
  co::ring::store(ring->Tail, co::ring::next(*ring, ring->Tail));
  return true;
}

void CORingClear(CO_RING* ring) {
  if (ring != nullptr) {
    co::ring::store(ring->Tail, co::ring::load(ring->Head));
  }
}

uint16_t CORingCount(const CO_RING* ring) {
  return ring == nullptr ? static_cast<uint16_t>(0)
                         : co::ring::used(*ring, co::ring::load(ring->Head), co::ring::load(ring->Tail));
}

uint16_t CORingLost(const CO_RING* ring) {
  return ring == nullptr ? static_cast<uint16_t>(0) : co::ring::load(ring->Lost);
}

}  // extern "C"
