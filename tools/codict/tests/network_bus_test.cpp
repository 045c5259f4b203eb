// SPDX-License-Identifier: Apache-2.0
// Frame lengths and response times of a network.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "network/frame.hpp"
#include "network/response.hpp"

using namespace lexican::codict::network;

namespace {

constexpr Nanoseconds us = 1000;
constexpr Nanoseconds ms = 1000 * us;

using Times = std::vector<std::optional<Nanoseconds>>;

// Simulates the longest response time of a stream in its busy period: the longest frame of lower priority begins just
// before all others arrive. Returns nothing if the busy period does not end.
std::optional<Nanoseconds> simulated(const std::vector<Stream>& streams, std::size_t at) {
  Nanoseconds time = 0;
  for (std::size_t n = at + 1; n < streams.size(); ++n) {
    time = std::max(time, streams[n].transmission);
  }
  std::vector<Nanoseconds> sent(at + 1, 0);
  Nanoseconds worst = 0;
  while (time < 1000 * ms) {
    const auto is_pending = [&](std::size_t n) { return sent[n] * streams[n].period <= time; };
    std::size_t next = 0;
    while (next <= at && !is_pending(next)) {
      ++next;
    }
    if (next > at) {
      return worst;
    }
    const Nanoseconds arrival = sent[next]++ * streams[next].period;
    time += streams[next].transmission;
    worst = next == at ? std::max(worst, time - arrival) : worst;
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("network: the longest frame has 55 + 10 n bits, with 29 bits of identifier 80 + 10 n") {
  for (std::uint8_t bytes = 0; bytes <= 8; ++bytes) {
    CHECK(longest_bits({0x181, false, false, bytes}) == 55U + 10U * bytes);
    CHECK(longest_bits({0x181, true, false, bytes}) == 80U + 10U * bytes);
  }
  CHECK(longest_bits({0x701, false, true, 1}) == 55);  // a remote frame has no data
}

TEST_CASE("network: the length of a frame with known data counts its stuff bits") {
  // Identifier 0, no data: 19 zeros and the CRC 0: 34 zeros. A stuff bit follows 5 zeros, then each 5 more.
  CHECK(exact_bits({0, false, false, 0}, "") == 34 + 13 + 6);
  // 555h alternates; RTR, IDE, r0 and the DLC are 7 zeros: one stuff bit.
  CHECK(exact_bits({0x555, false, false, 0}, "") == 48);
  // Calculated by a separate program.
  CHECK(exact_bits({0x080, false, false, 0}, "") == 51);
  CHECK(exact_bits({0x702, false, false, 1}, "\x05") == 58);
  CHECK(exact_bits({0x705, false, false, 1}, "\x05") == 59);
  CHECK(exact_bits({0x705, false, true, 1}, "") == 49);
}

TEST_CASE("network: no frame is longer than the maximum, and the mean is between both") {
  std::uint32_t random = 1;
  for (std::uint8_t bytes = 0; bytes <= 8; ++bytes) {
    double sum = 0;
    constexpr unsigned count = 2000;
    const Frame frame{0x181, false, false, bytes};
    for (unsigned n = 0; n < count; ++n) {
      std::string data;
      while (data.size() < bytes) {
        random = random * 1664525U + 1013904223U;
        data += static_cast<char>(random >> 24);
      }
      const unsigned length = exact_bits(frame, data);
      REQUIRE(length <= longest_bits(frame));
      REQUIRE(length >= 47U + 8U * bytes);
      sum += length;
    }
    if (bytes >= 2) {  // the CRC of few bits is not random
      CHECK(sum / count == doctest::Approx(mean_bits(frame)).epsilon(0.015));
    }
  }
}

TEST_CASE("network: the example of Davis et al. 2007: the second instance of C has the longest response") {
  // 125 kbit/s, 7 bytes: 125 bits, 1 ms. A every 2.5 ms, B and C every 3.5 ms.
  const Nanoseconds c = longest_bits({1, false, false, 7}) * 8 * us;
  CHECK(c == ms);
  const std::vector<Stream> streams = {{c, 2500 * us, 0}, {c, 3500 * us, 0}, {c, 3500 * us, 0}};
  CHECK(response_times(streams, 8 * us) == Times{2 * ms, 3 * ms, 3500 * us});
}

TEST_CASE("network: response times are those of a simulation of the worst case") {
  std::uint32_t random = 3;
  const auto number = [&random](std::uint32_t low, std::uint32_t high) {
    random = random * 1664525U + 1013904223U;
    return static_cast<Nanoseconds>(low + (random >> 8) % (high - low + 1));
  };
  unsigned later = 0;  // number of responses above the period, with several instances in one busy period
  for (int round = 0; round < 1000; ++round) {
    std::vector<Stream> streams;
    for (Nanoseconds count = number(2, 6); count != 0; --count) {
      streams.push_back({number(1, 4) * us, number(4, 24) * us / 2, 0});
    }
    const Times times = response_times(streams, 1);
    for (std::size_t n = 0; n < streams.size(); ++n) {
      double load = 0;
      for (std::size_t higher = 0; higher <= n; ++higher) {
        load += static_cast<double>(streams[higher].transmission) / static_cast<double>(streams[higher].period);
      }
      if (load < 0.999) {
        REQUIRE(times[n] == simulated(streams, n));
        later += *times[n] > streams[n].period ? 1U : 0U;
      }
    }
  }
  CHECK(later > 30);
}

TEST_CASE("network: one stream has no waiting time; each of two waits for the other") {
  CHECK(response_times({}, us).empty());
  CHECK(response_times({{100 * us, ms, 0}}, us) == Times{100 * us});
  // The first stream is blocked by a frame that has just begun, the second one waits for the first one.
  CHECK(response_times({{100 * us, ms, 0}, {130 * us, ms, 0}}, us) == Times{230 * us, 230 * us});
}

TEST_CASE("network: jitter delays the stream and increases the waiting time of lower ones") {
  // Within 110 us, the jitter of 950 us lets two frames of the first stream arrive.
  CHECK(response_times({{100 * us, ms, 950 * us}, {100 * us, 10 * ms, 0}}, us) == Times{1150 * us, 300 * us});
}

TEST_CASE("network: a stream without a period blocks and has no response time") {
  CHECK(response_times({{100 * us, ms, 0}, {135 * us, 0, 0}}, us) == Times{235 * us, std::nullopt});
  // At a higher priority it does not count.
  CHECK(response_times({{135 * us, 0, 0}, {100 * us, ms, 0}}, us) == Times{std::nullopt, 100 * us});
}

TEST_CASE("network: a full bus gives no response times for lower streams") {
  CHECK(response_times({{600 * us, ms, 0}, {600 * us, ms, 0}}, us) == Times{1200 * us, std::nullopt});
}

TEST_CASE("network: the analysis of hostile times ends") {
  std::vector<Stream> streams;
  for (int n = 0; n < 200; ++n) {
    streams.push_back({135 * us, 27001 * us, 3 * 1000 * ms});
  }
  streams.push_back({1, 1, 0});
  CHECK(response_times(streams, us).size() == 201);
  CHECK(response_times(std::vector<Stream>(20000, {47 * us, 2821 * ms, 0}), us).size() == 20000);
}
