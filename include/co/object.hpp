// SPDX-License-Identifier: Apache-2.0
/// \file co/object.hpp
/// Access to objects as values of C++ types.
///
///     const auto speed = co::object<std::uint32_t>(node, 0x2100, 1);  // looked up once
///     if (const auto now = speed.get()) { use(now.value()); }
///     const CO_ERR error = speed.set(1500);
///
/// Access rights of the network are not checked.
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

/// A value, or the error that explains why there is none.
template <class T>
class [[nodiscard]] Result {
 public:
  constexpr Result(T value) noexcept : value_(value) {}
  constexpr Result(CO_ERR error) noexcept : error_(error) {}

  constexpr explicit operator bool() const noexcept { return error_ == CO_ERR_NONE; }
  /// Returns T() if there is no value.
  constexpr T value() const noexcept { return value_; }
  constexpr T value_or(T other) const noexcept { return error_ == CO_ERR_NONE ? value_ : other; }
  constexpr CO_ERR error() const noexcept { return error_; }

 private:
  T value_{};
  CO_ERR error_ = CO_ERR_NONE;
};

/// Like std::is_signed, also for enumerations.
template <class T>
constexpr bool is_signed() {
  if constexpr (std::is_enum_v<T>) {
    return std::is_signed_v<std::underlying_type_t<T>>;
  } else {
    return std::is_signed_v<T>;
  }
}

/// Access to an entry of a node's dictionary as a T: bool, an integer, an enumeration, float or double. Integers of 3,
/// and of 5, 6 and 7 bytes are accessed as integers of 4 and 8. An Object refers to the node and the entry: it is
/// invalid after entries were moved.
template <class T>
class Object {
  static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);

  // Prevents that a byte other than 0 or 1 becomes a bool.
  using Stored = std::conditional_t<std::is_same_v<T, bool>, std::uint8_t, T>;

 public:
  /// error() is CO_ERR_OBJ_NOT_FOUND if \a entry is null, and CO_ERR_OBJ_SIZE if its length is not that of a T.
  Object(CO_NODE& node, CO_OBJ* entry) noexcept : node_(&node), entry_(entry) {
    const std::uint32_t width = COObjGetSize(entry, &node, sizeof(T));
    if (entry == nullptr) {
      error_ = CO_ERR_OBJ_NOT_FOUND;
    } else if (is_width(width)) {
      width_ = static_cast<std::uint8_t>(width);
      error_ = CO_ERR_NONE;
    }
  }

  /// For an entry whose length is known at compile time.
  constexpr Object(CO_NODE& node, CO_OBJ* entry, std::uint8_t width) noexcept
      : node_(&node), entry_(entry), error_(is_width(width) ? CO_ERR_NONE : CO_ERR_OBJ_SIZE), width_(width) {}

  /// Returns whether an object of \a width bytes can be accessed as a T.
  static constexpr bool is_width(std::uint32_t width) {
    constexpr bool has_odd_widths = (std::is_integral_v<T> || std::is_enum_v<T>)&&sizeof(T) >= 4;
    return width == sizeof(T) || (has_odd_widths && width > sizeof(T) / 2 && width < sizeof(T));
  }

  constexpr explicit operator bool() const noexcept { return error_ == CO_ERR_NONE; }
  constexpr CO_ERR error() const noexcept { return error_; }
  constexpr CO_OBJ* entry() const noexcept { return entry_; }

  /// Reads the value. Errors: error(), and those of COObjRdValue().
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

  /// Writes the value. Errors: error(), CO_ERR_OBJ_RANGE if the object has too few bytes for the value, and those of
  /// COObjWrValue().
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

/// Finds an object. Object::error() and every access return the error, if any.
template <class T>
Object<T> object(CO_NODE& node, std::uint16_t index, std::uint8_t sub) noexcept {
  const std::uint32_t key = std::uint32_t{index} << 16 | std::uint32_t{sub} << 8;
  return Object<T>(node, CODictFind(&node.Dict, key));
}

#ifndef CO_DATA_INTEGER

/// Compiles only if a T can hold the values of the entry.
template <class T, class Index, class Sub, bool Fits>
struct ValueType {
  static_assert(Fits, "ValueType<T, index, sub-index, false>: the entry has values of another type");
  static constexpr bool proved = true;
};

namespace dictionary {

/// Returns the C++ type for the values of an object type: unsigned for types that serve signed and unsigned integers.
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

/// Accepts any T for types of the application; Object checks their length at run time.
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

/// Returns access to an object of the node's constexpr dictionary. The compiler finds the entry and checks its type. T
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
