// SPDX-License-Identifier: Apache-2.0
#include "network/response.hpp"

#include <algorithm>
#include <cstddef>

namespace lexican::codict::network {

namespace {

// Busy periods beyond this are treated as endless: 10 minutes.
constexpr Nanoseconds longest_busy_period = Nanoseconds{600} * 1000 * 1000 * 1000;
// Busy periods are treated as endless from this load on.
constexpr double full_load = 1.0 - 1e-9;
// Limit of the iteration steps for all streams, which bounds the time for hostile input.
constexpr std::size_t most_steps = 50000000;

Nanoseconds ceiling(Nanoseconds dividend, Nanoseconds divisor) { return (dividend + divisor - 1) / divisor; }

class Analysis {
 public:
  Analysis(const std::vector<Stream>& streams, std::size_t at, Nanoseconds bit_time, Nanoseconds blocking,
           std::size_t& steps)
      : streams_(streams), at_(at), bit_time_(bit_time), blocking_(blocking), steps_(steps) {}

  std::optional<Nanoseconds> response() {
    const Stream& own = streams_[at_];
    const std::optional<Nanoseconds> busy = own.period != 0 ? busy_period() : std::nullopt;
    if (!busy) {
      return std::nullopt;
    }
    const Nanoseconds instances = ceiling(*busy + own.jitter, own.period);
    Nanoseconds worst = 0;
    Nanoseconds delay = blocking_;
    for (Nanoseconds instance = 0; instance < instances; ++instance) {
      const std::optional<Nanoseconds> queued = queuing_delay(instance, delay);
      if (!queued) {
        return std::nullopt;
      }
      worst = std::max(worst, own.jitter + *queued - instance * own.period + own.transmission);
      delay = *queued + own.transmission;
    }
    return worst;
  }

 private:
  // Returns the transmission time of all frames of the first `end` streams that arrive within `time`.
  Nanoseconds interference(std::size_t end, Nanoseconds time) const {
    Nanoseconds sum = 0;
    for (const Stream *stream = streams_.data(), *last = stream + end; stream != last; ++stream) {
      if (stream->period != 0) {
        sum += ceiling(time + stream->jitter, stream->period) * stream->transmission;
      }
    }
    return sum;
  }

  // Iterates time = start + interference(…) until it no longer changes.
  std::optional<Nanoseconds> fixed_point(Nanoseconds start, Nanoseconds first, std::size_t end, Nanoseconds offset) {
    Nanoseconds time = first;
    for (;;) {
      const Nanoseconds next = start + interference(end, time + offset);
      if (next <= time) {
        return time;
      }
      time = next;
      steps_ += end + 1;
      if (time > longest_busy_period || steps_ > most_steps) {
        return std::nullopt;
      }
    }
  }

  // Returns t: the time between two moments without queued frames of this or a higher priority.
  std::optional<Nanoseconds> busy_period() { return fixed_point(blocking_, streams_[at_].transmission, at_ + 1, 0); }

  // Returns w(q): the time from the begin of the busy period until an instance wins arbitration.
  std::optional<Nanoseconds> queuing_delay(Nanoseconds instance, Nanoseconds first) {
    const Nanoseconds start = blocking_ + instance * streams_[at_].transmission;
    return fixed_point(start, std::max(start, first), at_, bit_time_);
  }

  const std::vector<Stream>& streams_;
  std::size_t at_;
  Nanoseconds bit_time_;
  Nanoseconds blocking_;  // B: the longest frame of lower priority
  std::size_t& steps_;    // steps of all streams
};

}  // namespace

std::vector<std::optional<Nanoseconds>> response_times(const std::vector<Stream>& streams, Nanoseconds bit_time) {
  std::vector<Nanoseconds> blocking(streams.size() + 1, 0);
  for (std::size_t n = streams.size(); n-- != 0;) {
    blocking[n] = std::max(blocking[n + 1], streams[n].transmission);
  }
  std::vector<std::optional<Nanoseconds>> times(streams.size());
  std::size_t steps = 0;
  double load = 0;
  for (std::size_t n = 0; n < streams.size(); ++n) {
    if (streams[n].period != 0) {
      load += static_cast<double>(streams[n].transmission) / static_cast<double>(streams[n].period);
    }
    if (load < full_load) {
      times[n] = Analysis(streams, n, bit_time, blocking[n + 1], steps).response();
    }
  }
  return times;
}

}  // namespace lexican::codict::network
