// SPDX-License-Identifier: Apache-2.0
/// \file paced_wire.hpp
/// Computes when frames begin and end on a wire of a given bit rate. It counts in bits, so that consecutive frames do
/// not drift at any rate; only the returned times are rounded up to microseconds.
#ifndef CO_DRIVERS_PACED_WIRE_HPP_
#define CO_DRIVERS_PACED_WIRE_HPP_

#include <chrono>
#include <cstdint>

#include "frame_bits.hpp"

namespace co {

/// A wire on which frames take time.
class PacedWire {
 public:
  using Time = std::chrono::microseconds;  ///< since any epoch

  /// Constructs an idle wire. \a bit_rate: bit/s, not 0.
  explicit PacedWire(std::uint32_t bit_rate) : rate_(bit_rate) {}

  /// Starts a frame at \a from, or at the end of the last intermission if that is later. \a bits: frame_bits().
  void occupy(Time from, unsigned bits) {
    if (from > free()) {
      begin_ = from;
      used_ = 0;
    }
    begin_ += std::chrono::seconds{used_ / rate_};  // keeps the counter small
    used_ = used_ % rate_ + bits + intermission_bits;
  }

  /// Returns the time at which the last bit of the frame ends.
  Time received() const { return after(used_ - intermission_bits); }
  /// Returns the time at which the intermission after the frame ends.
  Time free() const { return after(used_); }

 private:
  Time after(std::uint64_t bits) const {
    constexpr std::uint64_t micros_per_second = 1000000;
    return begin_ + Time{(bits * micros_per_second + rate_ - 1) / rate_};
  }

  std::uint64_t rate_;
  Time begin_{0};
  std::uint64_t used_ = 0;  // bits since begin_ that are occupied
};

}  // namespace co

#endif
