// SPDX-License-Identifier: Apache-2.0
/// \file rare.hpp
/// Memory on demand for members that most objects do not use.
#pragma once

#include <memory>
#include <utility>

namespace lexican::codict {

/// A value that needs only a pointer until it is edited. It is copied with its owner. Reading it without memory yields
/// a default value.
template <typename T>
class Rare {
 public:
  Rare() = default;
  Rare(T value) : value_(std::make_unique<T>(std::move(value))) {}  // NOLINT(*-explicit-*): a value is a rare value
  Rare(const Rare& other) : value_(other.value_ ? std::make_unique<T>(*other.value_) : nullptr) {}
  Rare(Rare&&) noexcept = default;
  Rare& operator=(const Rare& other) {
    value_ = Rare(other).value_;
    return *this;
  }
  Rare& operator=(Rare&&) noexcept = default;
  ~Rare() = default;

  const T& operator*() const { return value_ ? *value_ : nothing(); }
  const T* operator->() const { return &**this; }
  operator const T&() const { return **this; }  // NOLINT(*-explicit-*): a rare value is read like any other

  /// Returns the value, for which it allocates memory.
  T& edit() {
    if (!value_) {
      value_ = std::make_unique<T>();
    }
    return *value_;
  }
  /// Returns the value if it has memory, else null.
  T* if_any() { return value_.get(); }
  void reset() { value_.reset(); }

 private:
  static const T& nothing() {
    static const T value{};
    return value;
  }

  std::unique_ptr<T> value_;
};

}  // namespace lexican::codict
