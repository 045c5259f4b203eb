// SPDX-License-Identifier: Apache-2.0
/// \file stride.hpp
/// Sweeps try everything. On an emulated CPU, and where other lanes make them whole (LEXICAN_THIN_SWEEPS), the long
/// ones try a part of it, always the same: each n-th, or so many times less.
#pragma once

namespace test {

/// The step of such a sweep: 1, or \a n.
constexpr unsigned stride([[maybe_unused]] unsigned n) {
#ifdef LEXICAN_THIN_SWEEPS
  return n;
#else
  return 1;
#endif
}

}  // namespace test
