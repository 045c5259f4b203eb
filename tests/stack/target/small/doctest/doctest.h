// SPDX-License-Identifier: Apache-2.0
/// \file doctest.h
/// The subset of doctest that the tests use, for a target with the headers of a C++ library only: no streams, no
/// exceptions. A failed assertion prints its expression, without values. A failed REQUIRE ends the case by longjmp(),
/// so that destructors do not run.
#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>

namespace doctest {

class String {
 public:
  String(const char* text = "") : text_(text) {}
  const char* c_str() const { return text_.c_str(); }
  std::size_t size() const { return text_.size(); }

 private:
  std::string text_;
};

template <class T, class = void>
struct StringMaker {
  static String convert(const T&) { return "{?}"; }
};

template <class T>
struct StringMaker<T, std::enable_if_t<std::is_integral_v<T>>> {
  static String convert(T value) { return std::to_string(value).c_str(); }
};

template <>
struct StringMaker<std::string> {
  static String convert(const std::string& text) { return text.c_str(); }
};

template <class T>
String toString(const T& value) {
  if constexpr (std::is_convertible_v<const T&, const char*>) {
    return String(value);
  } else {
    return StringMaker<T>::convert(value);
  }
}

struct should_fail {
  bool value = true;
};

struct skip {
  bool value = true;
};

namespace detail {

/// A test case: a static object in a list of all cases.
struct Case {
  void (*function)();
  const char* file;
  const char* name = "";
  bool should_fail = false;
  bool skipped = false;
  Case* next = nullptr;

  Case(void (*run)(), const char* where) : function(run), file(where) {}
};

inline Case operator*(Case one, const char* name) { return one.name = name, one; }
inline Case operator*(Case one, doctest::should_fail decorator) { return one.should_fail = decorator.value, one; }
inline Case operator*(Case one, doctest::skip decorator) { return one.skipped = decorator.value, one; }

bool add(Case& one);

/// Text of an assertion or a message.
class Message {
 public:
  template <class T>
  Message& operator<<(const T& part) {
    text_ += toString(part).c_str();
    return *this;
  }
  template <class T>
  Message& operator,(const T& part) {
    return *this << part;
  }
  const char* text() const { return text_.c_str(); }

 private:
  std::string text_;
};

/// Report an assertion: it passed, it failed, or it failed and the case ends.
void pass();
void fail(const char* file, int line, const char* text);
void end(const char* file, int line, const char* text);

/// Sub-case of a test case, which runs repeatedly: each combination of nested sub-cases is entered in exactly one run.
class Subcase {
 public:
  Subcase(const char* name, int line);
  ~Subcase();
  Subcase(const Subcase&) = delete;
  Subcase& operator=(const Subcase&) = delete;
  explicit operator bool() const { return entered_; }

 private:
  bool entered_ = false;
};

}  // namespace detail
}  // namespace doctest

#define DOCTEST_JOIN_(a, b) a##b
#define DOCTEST_JOIN(a, b) DOCTEST_JOIN_(a, b)
#define DOCTEST_CASE_(function, ...)                                  \
  static void function();                                             \
  static doctest::detail::Case DOCTEST_JOIN(function, _case) =        \
      doctest::detail::Case(function, __FILE__) * __VA_ARGS__;        \
  [[maybe_unused]] static const bool DOCTEST_JOIN(function, _added) = \
      doctest::detail::add(DOCTEST_JOIN(function, _case));            \
  static void function()
#define TEST_CASE(...) DOCTEST_CASE_(DOCTEST_JOIN(doctest_case_, __COUNTER__), __VA_ARGS__)
#define SUBCASE(name) if (const doctest::detail::Subcase doctest_subcase{name, __LINE__})

// The text of a message is composed only if the assertion fails.
#define DOCTEST_ASSERT(how, good, text) \
  (static_cast<bool>(good) ? doctest::detail::pass() : doctest::detail::how(__FILE__, __LINE__, text))
#define CHECK(...) DOCTEST_ASSERT(fail, (__VA_ARGS__), #__VA_ARGS__)
#define CHECK_FALSE(...) DOCTEST_ASSERT(fail, !(__VA_ARGS__), "not " #__VA_ARGS__)
#define CHECK_MESSAGE(good, ...) DOCTEST_ASSERT(fail, good, DOCTEST_TEXT(__VA_ARGS__))
#define REQUIRE(...) DOCTEST_ASSERT(end, (__VA_ARGS__), #__VA_ARGS__)
#define REQUIRE_FALSE(...) DOCTEST_ASSERT(end, !(__VA_ARGS__), "not " #__VA_ARGS__)
#define REQUIRE_MESSAGE(good, ...) DOCTEST_ASSERT(end, good, DOCTEST_TEXT(__VA_ARGS__))
#define ADD_FAIL_CHECK_AT(file, line, ...) doctest::detail::fail(file, line, DOCTEST_TEXT(__VA_ARGS__))
#define FAIL_CHECK(...) ADD_FAIL_CHECK_AT(__FILE__, __LINE__, __VA_ARGS__)
#define FAIL(...) doctest::detail::end(__FILE__, __LINE__, DOCTEST_TEXT(__VA_ARGS__))
#define DOCTEST_TEXT(...) (doctest::detail::Message{} << __VA_ARGS__).text()
#define CAPTURE(value) static_cast<void>(value)
#define INFO(...) static_cast<void>(0)
#define MESSAGE(...) static_cast<void>(0)
