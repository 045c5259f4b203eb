// SPDX-License-Identifier: Apache-2.0
#include "program/rate.hpp"

#include <poll.h>
#include <time.h>

#include <chrono>

namespace lexican::program {
namespace {

using host_bus::Micros;
using Clock = std::chrono::steady_clock;

/// Bit rates of CiA 301 and 20 kbit/s, the usual ones first. [301:5.4]
constexpr std::uint32_t rates[] = {500'000, 250'000, 125'000, 1'000'000, 800'000, 100'000, 50'000, 20'000, 10'000};

/// Time in which an adapter may still send frames that it has received at the rate before.
constexpr Micros stale_time = 50'000;
/// Time for more frames after the first one.
constexpr Micros confirmation_time = 200'000;

Micros elapsed(Clock::time_point begin) {
  return static_cast<Micros>(std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - begin).count());
}

/// Returns the number of valid frames.
unsigned count_frames(host_bus::Bus& bus, Micros time, const Interruption& interruption) {
  const Clock::time_point begin = Clock::now();
  unsigned frames = 0;
  while (elapsed(begin) < time && !Interruption::happened() && bus.fault().empty()) {
    pollfd wanted = bus.wanted();
    constexpr timespec timeout{0, 10'000'000};
    ppoll(&wanted, 1, &timeout, &interruption.while_waiting());
    while (const std::optional<host_bus::Entry> entry = bus.receive()) {
      frames += (entry->frame.Identifier & CO_IF_FRM_ERROR) == 0 ? 1U : 0U;
    }
  }
  return frames;
}

}  // namespace

HeardRate listen_for_rate(host_bus::Bus& bus, host_bus::BusOptions options, Micros time, unsigned rounds,
                          const Interruption& interruption) {
  HeardRate heard;
  count_frames(bus, stale_time, interruption);  // and answers to the commands of opening
  for (unsigned round = 0; round < rounds; ++round, time *= 3) {
    for (const std::uint32_t rate : rates) {
      options.bit_rate = rate;
      bus.configure(options);
      count_frames(bus, stale_time, interruption);
      const Clock::time_point begin = Clock::now();
      heard.frames = count_frames(bus, time, interruption);
      if (bus.refusal().find("the command S") != std::string::npos) {
        continue;  // the adapter does not have this rate
      }
      heard.is_refused = !bus.refusal().empty();
      if (heard.is_refused || Interruption::happened() || !bus.fault().empty()) {
        return heard;
      }
      if (heard.frames != 0) {
        heard.frames += count_frames(bus, confirmation_time, interruption);
        heard.time = elapsed(begin);
        heard.bit_rate = rate;
        return heard;
      }
    }
  }
  return heard;
}

}  // namespace lexican::program
