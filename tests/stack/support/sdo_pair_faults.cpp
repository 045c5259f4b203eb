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

Milliseconds longest_delay(const FaultsAtFrames& faults) {
  Milliseconds longest{0};
  for (const FaultAtFrame& fault : faults) {
    longest = std::max(longest, fault.what.delay);
  }
  return longest;
}

// Returns the longest duration of a transfer. A client counts its time-out during a block upload in quarters; the first
// quarter may begin before the last frame, so that the time-out is up to a quarter longer. If a block of a single
// segment is lost, the client waits as long as the server repeats its response, until the time-out of the server.
Milliseconds limit_of(const FaultsAtFrames& faults, Milliseconds time_out) {
  const Milliseconds of_client = time_out + time_out / 4;
  const Milliseconds of_one = CO_SDO_BUF_SEG == 1 ? std::max(of_client, server_time_out) : of_client;
  return static_cast<int>(faults.size()) * (of_one + Milliseconds{10});
}

// Adds the rules for the faults to the bus as long as the object exists.
class AppliedFaults {
 public:
  AppliedFaults(SdoPair& pair, const FaultsAtFrames& faults)
      : bus_(pair.line.bus), faults_(faults), seen_(faults.size()) {
    for (std::size_t n = 0; n < faults.size(); ++n) {
      const FrameFault& what = faults[n].what;
      const auto hits = [this, n](const VirtualBus::Traffic& traffic) { return is_hit(n, traffic); };
      bus_.add_rule({what.kind, hits, 1, 1, what.delay});
    }
    others_ = bus_.add_rule({Fault::none, {}, 1, VirtualBus::always});
  }
  ~AppliedFaults() { bus_.clear_rules(); }
  AppliedFaults(const AppliedFaults&) = delete;
  AppliedFaults& operator=(const AppliedFaults&) = delete;

  std::uint32_t number_applied() const {
    std::uint32_t all = 0;
    for (std::size_t rule = 0; rule < faults_.size(); ++rule) {
      all += bus_.struck(rule);
    }
    return all;
  }
  std::uint32_t frames() const { return number_applied() + bus_.struck(others_); }
  bool has_faulty_abort() const { return has_faulty_abort_; }

 private:
  bool is_hit(std::size_t n, const VirtualBus::Traffic& traffic) {
    const bool hit = ++seen_[n] == faults_[n].position;
    const bool is_abort = traffic.frame.Identifier == client_request && traffic.frame.Data[0] == 0x80;
    has_faulty_abort_ = has_faulty_abort_ || (hit && is_abort);
    return hit;
  }

  VirtualBus& bus_;
  const FaultsAtFrames& faults_;
  std::vector<std::uint32_t> seen_;
  std::size_t others_;
  bool has_faulty_abort_ = false;
};

bool any_reorders(const FaultsAtFrames& faults) {
  const auto is_swapped = [](const FaultAtFrame& fault) { return fault.what.kind == Fault::reorder; };
  return std::any_of(faults.begin(), faults.end(), is_swapped);
}

}  // namespace

// An additional transfer is necessary before the next one succeeds
// - after a reordered frame, which is held until the next frame of its sender and may arrive in the next transfer;
// - if the client's abort was disturbed: within a block, the server receives the next initiate as a segment, and leaves
//   the block only when the client aborts that transfer, too. [301:7.2.4.3.10]
FaultyTransfer disturb(SdoPair& pair, Direction direction, const FaultsAtFrames& faults, Milliseconds time_out) {
  FaultyTransfer result{};
  bool needs_more = any_reorders(faults);
  {
    const AppliedFaults applied(pair, faults);
    result.code = pair.run(direction, SdoPair::object, time_out, limit_of(faults, time_out));
    result.frames = applied.frames();
    result.all_applied = applied.number_applied() == faults.size();
    needs_more = needs_more || applied.has_faulty_abort();
  }
  if (needs_more) {
    pair.run(Direction::upload, SdoPair::value, Milliseconds{1000}, Milliseconds{1000});
  }
  pair.check_next();
  REQUIRE(pair.becomes_idle(longest_delay(faults) + server_time_out));
  pair.check_next();
  return result;
}

bool all_faults() {
  const char* const wanted = std::getenv("LEXICAN_SDO_FAULTS");
  return wanted != nullptr && std::string(wanted) == "all";
}

}  // namespace test

#endif
