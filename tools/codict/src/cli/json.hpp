// SPDX-License-Identifier: Apache-2.0
/// \file json.hpp
/// JSON that commands print. json.cpp serialises it with nlohmann-json, whose header takes seconds to compile in each
/// file that builds values with it.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace lexican::codict::cli {

/// JSON value. Members of objects keep their order.
class Json {
 public:
  enum class Kind : unsigned char { null, boolean, integer, string, array, object };
  struct Member;

  Json() = default;
  Json(const char* text) : kind_(Kind::string), text_(text) {}             // NOLINT: implicit, as in a literal
  Json(std::string_view text) : kind_(Kind::string), text_(text) {}        // NOLINT
  Json(std::string text) : kind_(Kind::string), text_(std::move(text)) {}  // NOLINT
  template <typename Number, std::enable_if_t<std::is_integral_v<Number>, int> = 0>
  Json(Number number)  // NOLINT
      : kind_(std::is_same_v<Number, bool> ? Kind::boolean : Kind::integer),
        is_signed_(std::is_signed_v<Number>),
        number_(static_cast<std::uint64_t>(number)) {}
  template <typename Element>
  Json(const std::vector<Element>& elements) : kind_(Kind::array) {  // NOLINT
    for (const Element& element : elements) {
      push_back(element);
    }
  }
  /// Constructs an object: Json{{"name", 1}, {"other", "text"}}.
  Json(std::initializer_list<Member> members);

  static Json array(std::initializer_list<Json> elements = {});
  static Json object();

  Kind kind() const { return kind_; }
  bool is_string() const { return kind_ == Kind::string; }
  bool is_array() const { return kind_ == Kind::array; }
  const std::string& text() const { return text_; }
  bool boolean() const { return number_ != 0; }
  bool is_signed() const { return is_signed_; }
  std::uint64_t number() const { return number_; }
  /// Returns the elements of an array.
  const std::vector<Json>& elements() const { return elements_; }
  /// Returns the members of an object.
  const std::vector<Member>& members() const { return members_; }

  /// Appends to an array; null becomes one.
  void push_back(Json element);
  /// Returns the member of this name and adds it if there is none; null becomes an object.
  Json& operator[](std::string_view name);

  /// Serialises the value. indentation: blanks per level, -1 for one line. Invalid UTF-8 is replaced.
  std::string dump(int indentation = -1) const;

 private:
  Kind kind_ = Kind::null;
  bool is_signed_ = false;
  std::uint64_t number_ = 0;
  std::string text_;
  std::vector<Json> elements_;
  std::vector<Member> members_;
};

struct Json::Member {
  std::string name;
  Json value;
};

}  // namespace lexican::codict::cli
