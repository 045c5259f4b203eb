// SPDX-License-Identifier: Apache-2.0
#include "sdo_pair_faults.hpp"

#if USE_CSDO

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace test {
namespace {

using co::VirtualBus;
using Fault = VirtualBus::Fault;

constexpr std::uint32_t client_request = 0x600 + SdoPair::server_id;
constexpr Milliseconds server_time_out{CO_SDO_TIMEOUT + 8};  // counted in eighths, each rounded up to ticks of 1 ms

Milliseconds longest_delay(const Strikes& strikes) {
  Milliseconds longest{0};
  for (const Strike& strike : strikes) {
    longest = std::max(longest, strike.what.delay);
  }
  return longest;
}

// Returns the longest duration of a transfer. A client counts its time-out during a block upload in quarters; the first
// quarter may begin before the last frame, so that the time-out is up to a quarter longer.
Milliseconds limit_of(const Strikes& strikes, Milliseconds time_out) {
  return static_cast<int>(strikes.size()) * (time_out + time_out / 4 + Milliseconds{10});
}

// Adds the rules for the faults to the bus as long as the object exists.
class Suffering {
 public:
  Suffering(SdoPair& pair, const Strikes& strikes) : bus_(pair.line.bus), strikes_(strikes), seen_(strikes.size()) {
    for (std::size_t n = 0; n < strikes.size(); ++n) {
      const FrameFault& what = strikes[n].what;
      const auto hits = [this, n](const VirtualBus::Traffic& traffic) { return is_hit(n, traffic); };
      bus_.add_rule({what.kind, hits, 1, 1, what.delay});
    }
    others_ = bus_.add_rule({Fault::none, {}, 1, VirtualBus::always});
  }
  ~Suffering() { bus_.clear_rules(); }
  Suffering(const Suffering&) = delete;
  Suffering& operator=(const Suffering&) = delete;

  std::uint32_t struck() const {
    std::uint32_t all = 0;
    for (std::size_t rule = 0; rule < strikes_.size(); ++rule) {
      all += bus_.struck(rule);
    }
    return all;
  }
  std::uint32_t frames() const { return struck() + bus_.struck(others_); }
  bool has_abort_suffered() const { return has_abort_suffered_; }

 private:
  bool is_hit(std::size_t n, const VirtualBus::Traffic& traffic) {
    const bool hit = ++seen_[n] == strikes_[n].position;
    const bool is_abort = traffic.frame.Identifier == client_request && traffic.frame.Data[0] == 0x80;
    has_abort_suffered_ = has_abort_suffered_ || (hit && is_abort);
    return hit;
  }

  VirtualBus& bus_;
  const Strikes& strikes_;
  std::vector<std::uint32_t> seen_;
  std::size_t others_;
  bool has_abort_suffered_ = false;
};

bool any_waits_for_next(const Strikes& strikes) {
  const auto is_swapped = [](const Strike& strike) { return strike.what.kind == Fault::reorder; };
  return std::any_of(strikes.begin(), strikes.end(), is_swapped);
}

}  // namespace

// An additional transfer is necessary before the next one succeeds
// - after a reordered frame, which is held until the next frame of its sender and may arrive in the next transfer;
// - if the client's abort was disturbed: within a block, the server receives the next initiate as a segment, and leaves
//   the block only when the client aborts that transfer, too. [301:7.2.4.3.10]
FaultyTransfer disturb(SdoPair& pair, Direction direction, const Strikes& strikes, Milliseconds time_out) {
  FaultyTransfer result{};
  bool needs_more = any_waits_for_next(strikes);
  {
    const Suffering suffering(pair, strikes);
    result.code = pair.run(direction, SdoPair::object, time_out, limit_of(strikes, time_out));
    result.frames = suffering.frames();
    result.all_struck = suffering.struck() == strikes.size();
    needs_more = needs_more || suffering.has_abort_suffered();
  }
  if (needs_more) {
    pair.run(Direction::upload, SdoPair::value, Milliseconds{1000}, Milliseconds{1000});
  }
  pair.check_next();
  REQUIRE(pair.comes_to_rest(longest_delay(strikes) + server_time_out));
  pair.check_next();
  return result;
}

bool all_faults() {
  const char* const wanted = std::getenv("LEXICAN_SDO_FAULTS");
  return wanted != nullptr && std::string(wanted) == "all";
}

}  // namespace test

#endif
