// SPDX-License-Identifier: Apache-2.0
/// \file lexican/object.hpp
/// Access to objects as values of C++ types.
///
///     const auto speed = co::object<std::uint32_t>(node, 0x2100, 1);  // looked up once
///     if (const auto now = speed.get()) { use(now.value()); }
///     const CO_ERR error = speed.set(1500);
///
/// Access rights of the network are not checked. No heap is used, and no exception is thrown.
///
/// Context: the loop (see co_obj.h).
#pragma once

extern "C++" {  // co_core.h may be included inside extern "C" { }

#include <cstdint>
#include <type_traits>

#include "co_core.h"

#ifndef CO_DATA_INTEGER
#include "lexican/dictionary.hpp"
#endif

/// The C++ interface of the stack and of its drivers.
namespace co {

/// A value, or the error because of which there is none.
template <class T>
class [[nodiscard]] Result {
 public:
  /// Constructs a result with a value.
  constexpr Result(T value) noexcept : value_(value) {}
  /// Constructs a result without value. \a error: not CO_ERR_NONE.
  constexpr Result(CO_ERR error) noexcept : error_(error) {}

  /// Returns true if there is a value.
  constexpr explicit operator bool() const noexcept { return error_ == CO_ERR_NONE; }
  /// Returns the value, T() if there is none.
  constexpr T value() const noexcept { return value_; }
  /// Returns the value, \a other if there is none.
  constexpr T value_or(T other) const noexcept { return error_ == CO_ERR_NONE ? value_ : other; }
  /// Returns the error, CO_ERR_NONE if there is a value.
  constexpr CO_ERR error() const noexcept { return error_; }

 private:
  T value_{};
  CO_ERR error_ = CO_ERR_NONE;
};

/// Returns std::is_signed of a T; of its underlying type if T is an enumeration.
template <class T>
constexpr bool is_signed() {
  if constexpr (std::is_enum_v<T>) {
    return std::is_signed_v<std::underlying_type_t<T>>;
  } else {
    return std::is_signed_v<T>;
  }
}

/// Access to an entry of a node's dictionary as a T: bool, an integer, an enumeration, float or double. Integers of 3
/// bytes are accessed as integers of 4 bytes, integers of 5, 6 and 7 bytes as integers of 8 bytes.
///
/// An Object refers to the node and the entry, which must outlive it. It is invalid after entries of a table in RAM
/// were moved. Context: the loop.
template <class T>
class Object {
  static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);

  // Prevents that a byte other than 0 or 1 becomes a bool.
  using Stored = std::conditional_t<std::is_same_v<T, bool>, std::uint8_t, T>;

 public:
  /// Refers to \a entry of the dictionary of \a node; the length of the object is checked once, here. error() is then:
  /// - CO_ERR_NONE: the object can be accessed;
  /// - CO_ERR_OBJ_NOT_FOUND: \a entry is null;
  /// - CO_ERR_OBJ_SIZE: the length of the object is not that of a T.
  Object(CO_NODE& node, CO_OBJ* entry) noexcept : node_(&node), entry_(entry) {
    const std::uint32_t width = COObjGetSize(entry, &node, sizeof(T));
    if (entry == nullptr) {
      error_ = CO_ERR_OBJ_NOT_FOUND;
    } else if (is_width(width)) {
      width_ = static_cast<std::uint8_t>(width);
      error_ = CO_ERR_NONE;
    }
  }

  /// Refers to an entry whose length, \a width bytes, is known at compile time. \a entry must not be null. error() is
  /// CO_ERR_NONE, or CO_ERR_OBJ_SIZE if \a width is not the length of a T.
  constexpr Object(CO_NODE& node, CO_OBJ* entry, std::uint8_t width) noexcept
      : node_(&node), entry_(entry), error_(is_width(width) ? CO_ERR_NONE : CO_ERR_OBJ_SIZE), width_(width) {}

  /// Returns whether an object of \a width bytes can be accessed as a T.
  static constexpr bool is_width(std::uint32_t width) {
    constexpr bool has_odd_widths = (std::is_integral_v<T> || std::is_enum_v<T>)&&sizeof(T) >= 4;
    return width == sizeof(T) || (has_odd_widths && width > sizeof(T) / 2 && width < sizeof(T));
  }

  /// Returns true if the object can be accessed: error() is CO_ERR_NONE.
  constexpr explicit operator bool() const noexcept { return error_ == CO_ERR_NONE; }
  /// Returns the error that the constructor has detected.
  constexpr CO_ERR error() const noexcept { return error_; }
  /// Returns the entry, null if it was not found.
  constexpr CO_OBJ* entry() const noexcept { return entry_; }

  /// Reads the value. The result has the value, or the error of COObjRdValue(), or one of these:
  /// \retval CO_ERR_OBJ_NOT_FOUND  there is no such entry
  /// \retval CO_ERR_OBJ_SIZE       the length of the object is not that of a T
  Result<T> get() const noexcept {
    Stored stored{};
    CO_ERR error = error_;
    if (error == CO_ERR_NONE) {
      error = COObjRdValue(entry_, node_, bytes(stored), width_);
    }
    if (error != CO_ERR_NONE) {
      return error;
    }
    if constexpr (std::is_same_v<T, bool>) {
      return stored != 0;
    } else {
      return extended(stored);
    }
  }

  /// Writes the value. Returns the result of COObjWrValue(), or:
  /// \retval CO_ERR_OBJ_NOT_FOUND  there is no such entry
  /// \retval CO_ERR_OBJ_SIZE       the length of the object is not that of a T
  /// \retval CO_ERR_OBJ_RANGE      the object has too few bytes for the value
  CO_ERR set(T value) const noexcept {
    auto stored = static_cast<Stored>(value);
    if (error_ != CO_ERR_NONE) {
      return error_;
    }
    if (!fits(stored)) {
      return CO_ERR_OBJ_RANGE;
    }
    return COObjWrValue(entry_, node_, bytes(stored), width_);
  }

 private:
  // Returns the address of the width_ bytes that hold the value in a larger number.
  std::uint8_t* bytes(Stored& stored) const noexcept {
    auto* const first = reinterpret_cast<std::uint8_t*>(&stored);
    return __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? first + (sizeof(T) - width_) : first;
  }

  // Returns the low width_ bytes of a number, sign-extended if T is signed.
  Stored extended(Stored stored) const noexcept {
    if constexpr (is_width(sizeof(T) - 1)) {
      const unsigned unused = 8 * static_cast<unsigned>(sizeof(T) - width_);
      using Unsigned = std::make_unsigned_t<Stored>;
      using Signed = std::make_signed_t<Stored>;
      const auto high = static_cast<Unsigned>(static_cast<Unsigned>(stored) << unused);
      return is_signed<T>() ? static_cast<Stored>(static_cast<Signed>(high) >> unused)
                            : static_cast<Stored>(high >> unused);
    } else {
      return stored;
    }
  }

  bool fits(Stored stored) const noexcept {
    if constexpr (std::is_floating_point_v<T>) {
      return true;
    } else {
      return extended(stored) == stored;
    }
  }

  CO_NODE* node_;
  CO_OBJ* entry_;
  CO_ERR error_ = CO_ERR_OBJ_SIZE;
  std::uint8_t width_ = 0;
};

/// Finds an object of the node's dictionary at run time. If it does not exist, or has another length than a T,
/// Object::error() and every access return the error.
template <class T>
Object<T> object(CO_NODE& node, std::uint16_t index, std::uint8_t sub) noexcept {
  const std::uint32_t key = std::uint32_t{index} << 16 | std::uint32_t{sub} << 8;
  return Object<T>(node, CODictFind(&node.Dict, key));
}

#ifndef CO_DATA_INTEGER

/// Compiles only if a T can hold the values of the entry; the template arguments name type and entry.
template <class T, class Index, class Sub, bool Fits>
struct ValueType {
  static_assert(Fits, "ValueType<T, index, sub-index, false>: the entry has values of another type");
  static constexpr bool proved = true;  ///< used in an expression, it makes the compiler check the assertion
};

namespace dictionary {

/// Returns a value of the C++ type for an object type; unsigned for types of signed and unsigned integers. Returns
/// nothing for strings, domains, times of day and types of the application.
template <Value Kind, std::uint8_t Width>
constexpr auto natural() {
  if constexpr (Kind == Value::boolean) {
    return bool{};
  } else if constexpr (Kind == Value::real) {
    return std::conditional_t<Width == 4, float, double>{};
  } else if constexpr (Kind == Value::bytes || Kind == Value::of_application) {
    return;  // no such type: the caller has to name one
  } else {
    constexpr bool is_signed = Kind == Value::signed_integer;
    using Narrow = std::conditional_t<Width == 1, std::uint8_t, std::uint16_t>;
    using Wide = std::conditional_t<(Width <= 4), std::uint32_t, std::uint64_t>;
    using Unsigned = std::conditional_t<(Width <= 2), Narrow, Wide>;
    return std::conditional_t<is_signed, std::make_signed_t<Unsigned>, Unsigned>{};
  }
}

/// Returns whether a T is a C++ type for values of this kind, of any length; false for bytes and of_application.
template <class T>
constexpr bool is_kind(Value kind) {
  constexpr bool whole = (std::is_integral_v<T> && !std::is_same_v<T, bool>) || std::is_enum_v<T>;
  switch (kind) {
    case Value::boolean: return std::is_same_v<T, bool>;
    case Value::real: return std::is_floating_point_v<T>;
    case Value::integer: return whole;
    case Value::unsigned_integer: return whole && !is_signed<T>();
    case Value::signed_integer: return whole && is_signed<T>();
    case Value::bytes:
    case Value::of_application: break;
  }
  return false;
}

/// Returns whether a T can hold the values of an object type. True for types of the application, whose length Object
/// checks at run time.
template <class T>
constexpr bool can_hold(const Type& type) {
  if constexpr (std::is_void_v<T>) {
    return false;
  } else {
    return type.value == Value::of_application || (is_kind<T>(type.value) && Object<T>::is_width(type.width));
  }
}

/// Properties of the type of an entry, which must exist.
template <const auto& Od, std::uint16_t Index, std::uint8_t Sub>
inline constexpr Type type_at = type_of(*co::entry<Od, Index, Sub>());

/// C++ type for the values of an entry; void if the caller has to name one.
template <const auto& Od, std::uint16_t Index, std::uint8_t Sub>
using Natural = decltype(natural<type_at<Od, Index, Sub>.value, type_at<Od, Index, Sub>.width>());

}  // namespace dictionary

/// Returns access to an object of the node's constexpr dictionary, an Object<T>. The compiler finds the entry and
/// checks its type: an entry that does not exist, or has values of another type, is a compile error. T is needed only
/// for signed values of 8, 16, 32 and 64 bits (CO_TSIGNED16 and CO_TUNSIGNED16 are one type object, and so on), for
/// enumerations and for types of the application.
///
///     const auto speed = co::object<od, 0x2100, 1>(node);
template <const auto& Od, std::uint16_t Index, std::uint8_t Sub, class T = dictionary::Natural<Od, Index, Sub>>
auto object(CO_NODE& node) noexcept {
  constexpr dictionary::Type type = dictionary::type_at<Od, Index, Sub>;
  constexpr bool fits = dictionary::can_hold<T>(type);
  static_assert(ValueType<T, dictionary::IndexOf<Index>, dictionary::SubOf<Sub>, fits>::proved);
  if constexpr (!fits) {
    return;
  } else if constexpr (type.value == dictionary::Value::of_application) {
    return Object<T>(node, entry<Od, Index, Sub>());
  } else {
    return Object<T>(node, entry<Od, Index, Sub>(), type.width);
  }
}

#endif

}  // namespace co

}  // extern "C++"
