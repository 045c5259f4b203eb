// SPDX-License-Identifier: Apache-2.0
/// \file lexican/detail/address.hpp
/// The address of any object, used as bytes: replaces a `uint8_t *` member in C++, so that it can be initialised with
/// `&structure`. Size and layout are those of the C type (uint8_t *).
#pragma once

extern "C++" {  // co_core.h may be included inside extern "C" { }

#include <stdint.h>

#include <type_traits>

namespace co {

/// An address that is used like a `uint8_t *`, and that can be initialised with the address of an object of any type:
///
///     Address a = &parameters;
///     memcpy(a, source, 4);  uint8_t second = a[1];  uint8_t *p = a;  if (a == nullptr) { … }
///     auto *typed = (struct Parameters *)a;  auto number = (uintptr_t)a;
///
/// Addresses of constants are accepted, too, because default values are in read-only memory.
union Address {
  /// Leaves the address undefined; `Address a{};` is null.
  Address() = default;

  /// Stores the address of an object, or null.
  constexpr Address(const volatile void* address) noexcept : address_(const_cast<void*>(address)) {}

  /// Returns the address as that of bytes; an implicit conversion.
  operator uint8_t*() const noexcept { return static_cast<uint8_t*>(address_); }

  /// Returns the address as a pointer to a T or to void; only by a cast.
  template <class T, std::enable_if_t<std::is_object_v<T> || std::is_void_v<T>, int> = 0>
  explicit operator T*() const noexcept {
    return static_cast<T*>(address_);
  }

  /// Returns the address as an integer of the width of a pointer; only by a cast.
  template <class T, std::enable_if_t<std::is_integral_v<T> && sizeof(T) == sizeof(void*), int> = 0>
  explicit operator T() const noexcept {
    return reinterpret_cast<T>(address_);
  }

 private:
  void* address_;
  // Declares to the link-time optimiser that C code may access the same memory as a pointer.
  unsigned char bytes_[sizeof(void*)];
};

static_assert(sizeof(Address) == sizeof(uint8_t*));
static_assert(alignof(Address) == alignof(uint8_t*));
static_assert(std::is_trivial_v<Address> && std::is_standard_layout_v<Address>);

}  // namespace co

}  // extern "C++"
