// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <thread>

#include "co_ring.h"
#include "support/numbered_frame.hpp"

namespace {

using test::is_numbered;
using test::numbered;

TEST_CASE("ring: one thread puts while another gets, nothing is torn, lost or out of order") {
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

}  // namespace
