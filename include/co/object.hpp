// SPDX-License-Identifier: Apache-2.0
/// \file co/object.hpp
/// Objects as values of C++ types.
///
///     const auto speed = co::object<std::uint32_t>(node, 0x2100, 1);  // looked up once
///     if (const auto now = speed.get()) { use(now.value()); }
///     const CO_ERR error = speed.set(1500);
///
/// The values are those of the application: access rights of the network do not limit it.
///
/// Context: the loop (see co_obj.h).
#pragma once

extern "C++" {  // co_core.h may be included inside extern "C" { }

#include <cstdint>
#include <type_traits>

#include "co_core.h"

#ifndef CO_DATA_INTEGER
#include "co/dictionary.hpp"
#endif

namespace co {

/// A value, or the reason why there is none.
template <class T>
class [[nodiscard]] Result {
 public:
  constexpr Result(T value) noexcept : value_(value) {}
  constexpr Result(CO_ERR error) noexcept : error_(error) {}

  constexpr explicit operator bool() const noexcept { return error_ == CO_ERR_NONE; }
  /// T() if there is no value.
  constexpr T value() const noexcept { return value_; }
  constexpr T value_or(T other) const noexcept { return error_ == CO_ERR_NONE ? value_ : other; }
  constexpr CO_ERR error() const noexcept { return error_; }

 private:
  T value_{};
  CO_ERR error_ = CO_ERR_NONE;
};

/// std::is_signed, also for enumerations.
template <class T>
constexpr bool is_signed() {
  if constexpr (std::is_enum_v<T>) {
    return std::is_signed_v<std::underlying_type_t<T>>;
  } else {
    return std::is_signed_v<T>;
  }
}

/// An entry of the dictionary of a node, as a T: bool, an integer, an enumeration, float or double.
/// The integers of 3 and of 5, 6, 7 bytes are read and written as those of 4 and 8.
/// Refers to the node and the entry: not to be used when entries were moved since.
template <class T>
class Object {
  static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);

  // A byte that holds neither 0 nor 1 must not become a bool.
  using Stored = std::conditional_t<std::is_same_v<T, bool>, std::uint8_t, T>;

 public:
  /// CO_ERR_OBJ_NOT_FOUND: \a entry is null; CO_ERR_OBJ_SIZE: its length is not that of a T.
  Object(CO_NODE& node, CO_OBJ* entry) noexcept : node_(&node), entry_(entry) {
    const std::uint32_t width = COObjGetSize(entry, &node, sizeof(T));
    if (entry == nullptr) {
      error_ = CO_ERR_OBJ_NOT_FOUND;
    } else if (is_width(width)) {
      width_ = static_cast<std::uint8_t>(width);
      error_ = CO_ERR_NONE;
    }
  }

  /// For an entry whose length is known.
  constexpr Object(CO_NODE& node, CO_OBJ* entry, std::uint8_t width) noexcept
      : node_(&node), entry_(entry), error_(is_width(width) ? CO_ERR_NONE : CO_ERR_OBJ_SIZE), width_(width) {}

  /// Can an object of \a width bytes be a T?
  static constexpr bool is_width(std::uint32_t width) {
    constexpr bool has_odd_widths = (std::is_integral_v<T> || std::is_enum_v<T>)&&sizeof(T) >= 4;
    return width == sizeof(T) || (has_odd_widths && width > sizeof(T) / 2 && width < sizeof(T));
  }

  constexpr explicit operator bool() const noexcept { return error_ == CO_ERR_NONE; }
  constexpr CO_ERR error() const noexcept { return error_; }
  constexpr CO_OBJ* entry() const noexcept { return entry_; }

  /// Errors: error(), and those of COObjRdValue().
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

  /// Errors: error(), CO_ERR_OBJ_RANGE if the object has too few bytes for the value, and those of COObjWrValue().
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
  // Where a number of width_ bytes lies in a larger one.
  std::uint8_t* bytes(Stored& stored) const noexcept {
    auto* const first = reinterpret_cast<std::uint8_t*>(&stored);
    return __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? first + (sizeof(T) - width_) : first;
  }

  // The number that the low width_ bytes are.
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

/// Looks an object up. What went wrong is told by Object::error(), and by every access.
template <class T>
Object<T> object(CO_NODE& node, std::uint16_t index, std::uint8_t sub) noexcept {
  const std::uint32_t key = std::uint32_t{index} << 16 | std::uint32_t{sub} << 8;
  return Object<T>(node, CODictFind(&node.Dict, key));
}

#ifndef CO_DATA_INTEGER

/// Exists only where a T can hold the values of the entry.
template <class T, class Index, class Sub, bool Fits>
struct ValueType {
  static_assert(Fits, "ValueType<T, index, sub-index, false>: the entry has values of another type");
  static constexpr bool proved = true;
};

namespace dictionary {

/// The C++ type of the values of an object type: unsigned where a type serves both.
template <Value Kind, std::uint8_t Width>
constexpr auto natural() {
  if constexpr (Kind == Value::boolean) {
    return bool{};
  } else if constexpr (Kind == Value::real) {
    return std::conditional_t<Width == 4, float, double>{};
  } else if constexpr (Kind == Value::bytes || Kind == Value::of_application) {
    return;  // no such type: it must be named
  } else {
    constexpr bool is_signed = Kind == Value::signed_integer;
    using Narrow = std::conditional_t<Width == 1, std::uint8_t, std::uint16_t>;
    using Wide = std::conditional_t<(Width <= 4), std::uint32_t, std::uint64_t>;
    using Unsigned = std::conditional_t<(Width <= 2), Narrow, Wide>;
    return std::conditional_t<is_signed, std::make_signed_t<Unsigned>, Unsigned>{};
  }
}

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

/// Types of the application are taken at the caller's word; Object asks them for their length.
template <class T>
constexpr bool can_hold(const Type& type) {
  if constexpr (std::is_void_v<T>) {
    return false;
  } else {
    return type.value == Value::of_application || (is_kind<T>(type.value) && Object<T>::is_width(type.width));
  }
}

template <const auto& Od, std::uint16_t Index, std::uint8_t Sub>
inline constexpr Type type_at = type_of(*co::entry<Od, Index, Sub>());

template <const auto& Od, std::uint16_t Index, std::uint8_t Sub>
using Natural = decltype(natural<type_at<Od, Index, Sub>.value, type_at<Od, Index, Sub>.width>());

}  // namespace dictionary

/// An object that the compiler has looked up in the constexpr dictionary of the node, and whose type it has checked. T
/// is needed only for signed values (one type object serves both), enumerations and types of the application.
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
