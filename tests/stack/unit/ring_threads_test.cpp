// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <atomic>
#include <thread>

#include "co_ring.h"
#include "support/numbered_frame.hpp"

namespace {

using test::is_numbered;
using test::numbered;

TEST_CASE("ring: with a writing and a reading thread no frame is partially written, lost or out of order") {
  constexpr std::uint32_t number = 50000;
  CO_IF_FRM mem[16];
  CO_RING ring;
  REQUIRE(CORingInit(&ring, mem, 16));
  std::thread producer([&] {
    for (std::uint32_t n = 0; n < number; ++n) {
      const CO_IF_FRM frm = numbered(n);
      while (!CORingPut(&ring, &frm)) {
        std::this_thread::yield();
      }
    }
  });
  std::uint32_t wrong = 0;
  for (std::uint32_t n = 0; n < number; ++n) {
    CO_IF_FRM frm;
    while (!CORingGet(&ring, &frm)) {
      std::this_thread::yield();
    }
    wrong += is_numbered(frm, n) ? 0U : 1U;
    wrong += CORingCount(&ring) <= 16 ? 0U : 1U;
    CORingLost(&ring);
  }
  producer.join();
  CHECK(wrong == 0);
}

TEST_CASE("ring: with a writing thread and one that reads and clears later frames are complete and in order") {
  constexpr std::uint32_t number = 50000;
  CO_IF_FRM mem[16];
  CO_RING ring;
  REQUIRE(CORingInit(&ring, mem, 16));
  std::atomic<bool> ends = false;
  std::thread producer([&] {
    for (std::uint32_t n = 0; n < number; ++n) {
      const CO_IF_FRM frm = numbered(n);
      while (!CORingPut(&ring, &frm)) {
        std::this_thread::yield();
      }
    }
    ends = true;
  });
  std::uint32_t wrong = 0;
  std::uint32_t next = 0;
  for (std::uint32_t call = 0; !ends || CORingCount(&ring) != 0; ++call) {
    CO_IF_FRM frm;
    if (call % 8 == 0) {
      CORingClear(&ring);
    } else if (CORingGet(&ring, &frm)) {
      while (next < number && !is_numbered(frm, next)) ++next;
      wrong += next < number ? 0U : 1U;
      ++next;
    } else {
      std::this_thread::yield();
    }
  }
  producer.join();
  CHECK(wrong == 0);
  CHECK(CORingCount(&ring) == 0);
}

}  // namespace
