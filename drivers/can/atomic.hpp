// SPDX-License-Identifier: Apache-2.0
/// \file atomic.hpp
/// Access to members that the interrupt of a CAN driver and the loop share. Each member has one writer, so atomic loads
/// and stores suffice.
#ifndef CO_DRIVERS_ATOMIC_HPP_
#define CO_DRIVERS_ATOMIC_HPP_

namespace co::atomic {
/// \cond internal

/// Returns a value that the other context may change. Later accesses are not moved before it.
template <typename Number>
Number load(const Number& number) {
  return __atomic_load_n(&number, __ATOMIC_ACQUIRE);
}

/// Changes a value that the other context may read. Earlier accesses are not moved behind it.
template <typename Number>
void store(Number& number, Number value) {
  __atomic_store_n(&number, value, __ATOMIC_RELEASE);
}

/// \endcond
}  // namespace co::atomic

#endif
