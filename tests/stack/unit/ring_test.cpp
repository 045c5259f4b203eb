// SPDX-License-Identifier: Apache-2.0
#include "co_ring.h"

#include <doctest/doctest.h>

#include <vector>

#include "support/numbered_frame.hpp"

namespace {

using test::is_numbered;
using test::numbered;

TEST_CASE("ring: frames are read complete and in order") {
  CO_IF_FRM mem[4];
  CO_RING ring;
  REQUIRE(CORingInit(&ring, mem, 4));
  CO_IF_FRM frm;
  CHECK_FALSE(CORingGet(&ring, &frm));
  for (std::uint32_t n = 0; n < 3; ++n) {
    const CO_IF_FRM in = numbered(n);
    CHECK(CORingPut(&ring, &in));
  }
  CHECK(CORingCount(&ring) == 3);
  for (std::uint32_t n = 0; n < 3; ++n) {
    REQUIRE(CORingGet(&ring, &frm));
    CHECK(is_numbered(frm, n));
  }
  CHECK(CORingCount(&ring) == 0);
  CHECK_FALSE(CORingGet(&ring, &frm));
}

TEST_CASE("ring: all slots can be used; a further frame is lost and counted") {
  for (const std::uint16_t size : {std::uint16_t{1}, std::uint16_t{2}, std::uint16_t{7}, std::uint16_t{8}}) {
    CAPTURE(size);
    std::vector<CO_IF_FRM> mem(size);
    CO_RING ring;
    REQUIRE(CORingInit(&ring, mem.data(), size));
    for (std::uint32_t round = 0; round < 3; ++round) {
      for (std::uint32_t n = 0; n < size; ++n) {
        const CO_IF_FRM in = numbered(100 * round + n);
        CHECK(CORingPut(&ring, &in));
      }
      CHECK(CORingCount(&ring) == size);
      const CO_IF_FRM lost = numbered(999);
      CHECK_FALSE(CORingPut(&ring, &lost));
      CHECK_FALSE(CORingPut(&ring, &lost));
      CHECK(CORingLost(&ring) == 2 * (round + 1));
      for (std::uint32_t n = 0; n < size; ++n) {
        CO_IF_FRM out;
        REQUIRE(CORingGet(&ring, &out));
        CHECK(is_numbered(out, 100 * round + n));
      }
    }
  }
}

TEST_CASE("ring: the order is kept over many wraps at any filling") {
  for (std::uint16_t size = 1; size <= 5; ++size) {
    for (std::uint16_t filling = 0; filling < size; ++filling) {
      std::vector<CO_IF_FRM> mem(size);
      CO_RING ring;
      REQUIRE(CORingInit(&ring, mem.data(), size));
      std::uint32_t in = 0;
      std::uint32_t wrong = 0;
      for (std::uint32_t out = 0; out < 1000; ++out) {
        while (CORingCount(&ring) <= filling) {
          const CO_IF_FRM frm = numbered(in++);
          wrong += CORingPut(&ring, &frm) ? 0U : 1U;
        }
        CO_IF_FRM frm;
        wrong += CORingGet(&ring, &frm) && is_numbered(frm, out) ? 0U : 1U;
      }
      CHECK(wrong == 0);
      CHECK(CORingLost(&ring) == 0);
    }
  }
}

TEST_CASE("ring: the largest size works") {
  std::vector<CO_IF_FRM> mem(32767);
  CO_RING ring;
  REQUIRE(CORingInit(&ring, mem.data(), 32767));
  std::uint32_t in = 0;
  std::uint32_t out = 0;
  for (int round = 0; round < 3; ++round) {
    CO_IF_FRM frm = numbered(in);
    while (CORingPut(&ring, &frm)) {
      frm = numbered(++in);
    }
    CHECK(CORingCount(&ring) == 32767);
    unsigned wrong = 0;
    while (CORingGet(&ring, &frm)) {
      wrong += is_numbered(frm, out++) ? 0U : 1U;
    }
    CHECK(wrong == 0);
  }
  CHECK(out == 3 * 32767);
  CHECK(CORingLost(&ring) == 3);
}

TEST_CASE("ring: clearing removes all frames at any position and keeps the count of lost ones") {
  CO_IF_FRM mem[3];
  CO_RING ring;
  REQUIRE(CORingInit(&ring, mem, 3));
  CO_IF_FRM frm;
  for (std::uint32_t n = 0; n < 20; ++n) {
    const unsigned held = n % 4;
    for (unsigned k = 0; k < held; ++k) {
      frm = numbered(n);
      CHECK(CORingPut(&ring, &frm));
    }
    CORingClear(&ring);
    CHECK(CORingCount(&ring) == 0);
    CHECK_FALSE(CORingGet(&ring, &frm));
    frm = numbered(n + 100);
    CHECK(CORingPut(&ring, &frm));
    REQUIRE(CORingGet(&ring, &frm));
    CHECK(is_numbered(frm, n + 100));
  }
  for (int k = 0; k < 4; ++k) CORingPut(&ring, &frm);
  CORingClear(&ring);
  CHECK(CORingLost(&ring) == 1);
}

TEST_CASE("ring: the count of lost frames saturates [Q10]") {
  CO_IF_FRM mem[1];
  CO_RING ring;
  REQUIRE(CORingInit(&ring, mem, 1));
  const CO_IF_FRM frm = numbered(1);
  for (int i = 0; i < 70000; ++i) {
    CORingPut(&ring, &frm);
  }
  CHECK(CORingLost(&ring) == 65535);
}

TEST_CASE("ring: arguments out of range give a ring without slots") {
  CO_IF_FRM mem[2];
  CO_IF_FRM frm = numbered(1);
  CO_RING ring;
  CHECK_FALSE(CORingInit(nullptr, mem, 2));
  for (const std::uint16_t size : {std::uint16_t{0}, std::uint16_t{32768}, std::uint16_t{65535}}) {
    CHECK_FALSE(CORingInit(&ring, mem, size));
    CHECK_FALSE(CORingPut(&ring, &frm));
    CHECK_FALSE(CORingGet(&ring, &frm));
    CHECK(CORingCount(&ring) == 0);
  }
  CHECK_FALSE(CORingInit(&ring, nullptr, 2));
  CHECK_FALSE(CORingPut(&ring, &frm));
  CHECK_FALSE(CORingGet(&ring, &frm));
}

}  // namespace
