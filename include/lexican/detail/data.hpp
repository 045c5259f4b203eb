// SPDX-License-Identifier: Apache-2.0
/// \file lexican/detail/data.hpp
/// CO_DATA in C++: the address of an object's data, or the value itself, in one word. Size and layout are those of the
/// C type (uintptr_t).
#pragma once

extern "C++" {  // co_core.h may be included inside extern "C" { }

#include <stdint.h>

#include <type_traits>

/// The member CO_OBJ.Data: an address or a value. It converts from and to both like the C type:
///
///     (CO_DATA)(&variable)  (CO_DATA)(5)  (CO_DATA)(&function)
///     (uint32_t *)obj->Data  (uint8_t)obj->Data  obj->Data == 0
///
/// The conversion to addresses and enumerations is explicit, to integers implicit.
///
/// A table of entries is a constant expression: it is placed in read-only memory and needs no code at start-up. Casts
/// between numbers and pointers are not constant expressions. Therefore the address of a register is written as
/// `(CO_DATA)(0x40005400)`, and that of a variable without a cast to uintptr_t. In a constexpr table such a cast is a
/// compile error; a const table would be initialised at start-up.
union CO_DATA {
  /// Leaves the content undefined; `CO_DATA{}` is 0.
  CO_DATA() = default;

  /// Constructs from a value (flag D).
  template <class T, std::enable_if_t<std::is_integral_v<T> || std::is_enum_v<T>, int> = 0>
  constexpr CO_DATA(T value) noexcept : value_(static_cast<uintptr_t>(value)) {}

  /// Constructs from the address of a variable.
  constexpr CO_DATA(const volatile void* address) noexcept : address_(address) {}

  /// Constructs from the address of a function, for types of the application. The conditional makes the cast a constant
  /// expression: compilers fold both its branches if the condition is __builtin_constant_p.
  template <class F, std::enable_if_t<std::is_function_v<F>, int> = 0>
  constexpr CO_DATA(F* function) noexcept
      // NOLINTNEXTLINE(bugprone-branch-clone): see above
      : function_(__builtin_constant_p(reinterpret_cast<uintptr_t>(function)) ? reinterpret_cast<uintptr_t>(function)
                                                                              : reinterpret_cast<uintptr_t>(function)) {
  }

  /// Returns the content as a number; an implicit conversion. A constant expression if the content is a value.
  constexpr operator uintptr_t() const noexcept { return value_; }

  /// Returns the content as an enumeration; only by a cast. A constant expression if the content is a value.
  template <class E, std::enable_if_t<std::is_enum_v<E>, int> = 0>
  constexpr explicit operator E() const noexcept {
    return static_cast<E>(value_);
  }

  /// Returns the content as the address of a variable or function; only by a cast. Reads the member that a table was
  /// initialised with, so that the compiler can track an address through it.
  template <class T>
  explicit operator T*() const noexcept {
    if constexpr (std::is_function_v<T>) {
      return reinterpret_cast<T*>(function_);
    } else {
      return static_cast<T*>(const_cast<void*>(address_));
    }
  }

  /// \name Content, for constant expressions
  /// One of the two is a constant expression, depending on the initialiser; neither is for a function.
  /// \{

  /// Returns the content if it was initialised with a value.
  constexpr uintptr_t value() const noexcept { return value_; }
  /// Returns the content if it was initialised with the address of a variable.
  constexpr const volatile void* address() const noexcept { return address_; }
  /// \}

 private:
  uintptr_t value_;
  const volatile void* address_;
  uintptr_t function_;  // separate from value_, so that a constant expression can distinguish them
  // Declares to the link-time optimiser that C code may access the same memory as an integer.
  unsigned char bytes_[sizeof(uintptr_t)];
};

static_assert(sizeof(CO_DATA) == sizeof(uintptr_t));
static_assert(alignof(CO_DATA) == alignof(uintptr_t));
static_assert(std::is_trivial_v<CO_DATA> && std::is_standard_layout_v<CO_DATA>);

}  // extern "C++"
