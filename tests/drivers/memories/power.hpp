// SPDX-License-Identifier: Apache-2.0
/// \file power.hpp
/// Supply of a modelled memory, which fails at a given operation.
#pragma once

#include <cstdint>

namespace test {

/// State in which an interrupted operation leaves the bytes that it changes.
enum class Partial : std::uint8_t {
  untouched,  ///< as before
  half,       ///< the first half is changed
  erased,     ///< reads FFh throughout, but is not erased completely
  garbage,    ///< wrong bytes in the whole page; with an error-correcting code they cannot be read
  done,       ///< completely changed
};

constexpr Partial all_partial[] = {Partial::untouched, Partial::half, Partial::erased, Partial::garbage, Partial::done};

/// The supply. An operation is a unit that is programmed, a page that is erased or written, or a byte of a FRAM.
struct Power {
  std::uint64_t operations = 0;  ///< operations begun
  std::uint64_t cut_at = 0;      ///< operation that is interrupted, from 1; 0: none
  Partial partial = Partial::untouched;
  bool is_off = false;

  /// Begins an operation. Returns true if it is executed completely; otherwise the power is off.
  bool begins() {
    is_off = is_off || ++operations == cut_at;
    return !is_off;
  }

  /// Restores the power. \a cut: operation at which it fails again.
  void restore(std::uint64_t cut = 0, Partial how = Partial::untouched) { *this = {0, cut, how, false}; }
};

}  // namespace test
