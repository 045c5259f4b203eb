// SPDX-License-Identifier: Apache-2.0
/// \file stride.hpp
/// Sweeps test all values. With LEXICAN_THIN_SWEEPS (on an emulated CPU, and in lanes whose sweeps run completely in
/// other lanes) long sweeps test every n-th value only.
#pragma once

namespace test {

/// Returns the step of a sweep: 1, or \a n with LEXICAN_THIN_SWEEPS.
constexpr unsigned stride([[maybe_unused]] unsigned n) {
#ifdef LEXICAN_THIN_SWEEPS
  return n;
#else
  return 1;
#endif
}

}  // namespace test
