// SPDX-License-Identifier: Apache-2.0
// Implements the functions of unity.h.
#include "unity.h"

#include <doctest/doctest.h>

#include <cinttypes>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <utility>

namespace {

struct Left {};  // exception of an assertion that ends its test

struct Run {  // current RUN_TEST
  std::jmp_buf start;
  UNITY_KIND outcome;
};

struct Total {
  unsigned tests;
  unsigned failures;
  unsigned ignored;
};

Run* run = nullptr;
Total total = {};
UNITY_SINK sink = nullptr;
const char* current_name = "";
std::string reason;  // reason why the last comparison failed

bool in_doctest() {
  const auto* options = doctest::getContextOptions();
  return options != nullptr && options->currentTest != nullptr;
}

const char* word(UNITY_KIND kind) {
  constexpr const char* words[] = {"PASS", "FAIL", "IGNORE", "INFO"};
  return words[kind];
}

void to_output(UNITY_KIND kind, const char* file, int line, const char* text) {
  const char* colon = text[0] != '\0' ? ": " : "";
  std::printf("%s:%d:%s:%s%s%s\n", file, line, current_name, word(kind), colon, text);
}

void to_doctest(UNITY_KIND kind, const char* file, int line, const char* text) {
  const std::string named = (run == nullptr ? "" : current_name + std::string(": ")) + text;
  if (kind == UNITY_FAILED) {
    DOCTEST_ADD_FAIL_CHECK_AT(file, line, named);
  } else if (kind != UNITY_PASSED) {
    DOCTEST_ADD_MESSAGE_AT(file, line, named);
  }
}

void tell(UNITY_KIND kind, const char* file, int line, const char* text) {
  const UNITY_SINK automatic = in_doctest() ? to_doctest : to_output;
  (sink != nullptr ? sink : automatic)(kind, file, line, text);
}

void note_outcome(UNITY_KIND kind) {
  const bool stronger = kind == UNITY_FAILED || (kind == UNITY_IGNORED && run->outcome == UNITY_PASSED);
  if (stronger) {
    run->outcome = kind;
  }
}

void count(UNITY_KIND outcome) {
  total.tests += 1;
  total.failures += outcome == UNITY_FAILED ? 1 : 0;
  total.ignored += outcome == UNITY_IGNORED ? 1 : 0;
}

bool wanted(const char* name) {
  const char* const only = std::getenv("UNITY_ONLY");
  return only == nullptr || std::strcmp(only, name) == 0;
}

/// Runs setUp, the test or tearDown. Returns false if an assertion or an exception ended it early.
bool run_part(void (*part)(), const char* file, int line) {
  try {
    if (setjmp(run->start) != 0) {
      return false;
    }
    part();
    return true;
  } catch (const Left&) {
  } catch (const std::exception& error) {
    reason.clear();
    unity_report(UNITY_FAILED, file, line, error.what());
  } catch (...) {
    reason.clear();
    unity_report(UNITY_FAILED, file, line, "exception");
  }
  return false;
}

std::int64_t narrow(unsigned type, std::int64_t value) {
  const unsigned unused = 64 - 8 * (type & 0x0Fu);
  const auto shifted = static_cast<std::uint64_t>(value) << unused;
  const bool is_signed = (type & UNITY_SIGNED) != 0;
  return is_signed ? static_cast<std::int64_t>(shifted) >> unused : static_cast<std::int64_t>(shifted >> unused);
}

bool less(unsigned type, std::int64_t left, std::int64_t right) {
  if ((type & UNITY_SIGNED) != 0) {
    return left < right;
  }
  return static_cast<std::uint64_t>(left) < static_cast<std::uint64_t>(right);
}

std::string show(unsigned type, std::int64_t value) {
  char text[24];
  const auto bits = static_cast<std::uint64_t>(value);
  if ((type & UNITY_SIGNED) != 0) {
    std::snprintf(text, sizeof(text), "%" PRId64, value);
  } else if ((type & UNITY_UNSIGNED) != 0) {
    std::snprintf(text, sizeof(text), "%" PRIu64, bits);
  } else if ((type & UNITY_CHAR) != 0 && bits >= 0x20 && bits < 0x7F) {
    std::snprintf(text, sizeof(text), "'%c'", static_cast<char>(bits));
  } else {
    std::snprintf(text, sizeof(text), "0x%0*" PRIX64, static_cast<int>(2 * (type & 0x0Fu)), bits);
  }
  return text;
}

int refuse(std::string why) {
  reason = std::move(why);
  return 0;
}

int refuse_at(std::size_t element, const std::string& why) {
  return refuse("Element " + std::to_string(element) + " " + why);
}

std::string expected_was(const std::string& expected, const std::string& actual) {
  return "Expected " + expected + " Was " + actual;
}

bool near(unsigned type, std::uint64_t delta, std::int64_t expected, std::int64_t actual) {
  const bool below = less(type, actual, expected);
  const auto high = static_cast<std::uint64_t>(below ? expected : actual);
  const auto low = static_cast<std::uint64_t>(below ? actual : expected);
  return high - low <= delta;
}

bool holds(UNITY_RELATION relation, unsigned type, std::int64_t expected, std::int64_t actual) {
  switch (relation) {
    case UNITY_EQUAL: return actual == expected;
    case UNITY_NOT_EQUAL: return actual != expected;
    case UNITY_GREATER_THAN: return less(type, expected, actual);
    case UNITY_LESS_THAN: return less(type, actual, expected);
    case UNITY_GREATER_OR_EQUAL: return !less(type, actual, expected);
    case UNITY_LESS_OR_EQUAL: return !less(type, expected, actual);
  }
  return false;
}

std::int64_t load(unsigned type, const void* array, std::size_t element) {
  const std::size_t width = type & 0x0Fu;
  const auto* bytes = static_cast<const unsigned char*>(array) + element * width;
  if (width == 1) {
    return narrow(type, *bytes);
  }
  if (width == 8) {
    std::int64_t value;
    std::memcpy(&value, bytes, sizeof(value));
    return value;
  }
  std::uint32_t value = 0;
  std::uint16_t half = 0;
  std::memcpy(width == 4 ? static_cast<void*>(&value) : &half, bytes, width);
  return narrow(type, width == 4 ? value : half);
}

bool comparable(const void* expected, const void* actual, std::size_t num) {
  if (num == 0) {
    refuse("Nothing to compare");
  } else if (expected == nullptr || actual == nullptr) {
    refuse(expected == nullptr ? "Expected is NULL" : "Actual is NULL");
  } else {
    return true;
  }
  return false;
}

bool equal_element(std::size_t element, unsigned type, std::uint64_t delta, std::int64_t expected,
                   std::int64_t actual) {
  if (near(type, delta, expected, actual)) {
    return true;
  }
  return refuse_at(element, expected_was(show(type, expected), show(type, actual))) != 0;
}

std::string quoted(const char* text) { return text == nullptr ? "NULL" : '\'' + std::string(text) + '\''; }

bool same_string(const char* expected, const char* actual, std::size_t max) {
  if (expected == nullptr || actual == nullptr) {
    return expected == actual;
  }
  return std::strncmp(expected, actual, max) == 0;
}

int compare_string(std::size_t element, const char* expected, const char* actual) {
  return same_string(expected, actual, PTRDIFF_MAX)
             ? 1
             : refuse_at(element, expected_was(quoted(expected), quoted(actual)));
}

/// Compares \a num blocks of \a len bytes. \a step: distance of the expected blocks in bytes; 0: all blocks are
/// compared with the first one.
int compare_memory(const void* expected, const void* actual, std::size_t len, std::size_t num, std::size_t step) {
  if (!comparable(expected, actual, len * num)) {
    return 0;
  }
  for (std::size_t i = 0; i < len * num; ++i) {
    const auto left = static_cast<const unsigned char*>(expected)[i / len * step + i % len];
    const auto right = static_cast<const unsigned char*>(actual)[i];
    if (left != right) {
      return refuse_at(i / len, "Byte " + std::to_string(i % len) + " " +
                                    expected_was(show(UNITY_HEX | 1u, left), show(UNITY_HEX | 1u, right)));
    }
  }
  return 1;
}

}  // namespace

extern "C" {

__attribute__((weak)) void setUp(void) {}
__attribute__((weak)) void tearDown(void) {}

void unity_begin(void) { total = {}; }

int unity_end(void) {
  const bool passed = total.tests > 0 && total.failures == 0;
  if (!in_doctest()) {
    std::printf("\n-----------------------\n%u Tests %u Failures %u Ignored\n%s\n", total.tests, total.failures,
                total.ignored, passed ? "OK" : "FAIL");
  }
  return total.tests == 0 ? 1 : static_cast<int>(total.failures);
}

void unity_run(void (*test)(void), const char* name, const char* file, int line) {
  if (run == nullptr && !wanted(name)) {
    return;
  }
  Run here = {};
  Run* const outer = run;
  const char* const outer_name = current_name;
  run = &here;
  current_name = name;
  if (run_part(setUp, file, line)) {
    run_part(test, file, line);
  }
  run_part(tearDown, file, line);
  if (here.outcome == UNITY_PASSED) {
    tell(UNITY_PASSED, file, line, "");
  }
  if (outer == nullptr) {
    count(here.outcome);
  }
  run = outer;
  current_name = outer_name;
}

UNITY_SINK unity_report_to(UNITY_SINK new_sink) { return std::exchange(sink, new_sink); }

void unity_report(UNITY_KIND kind, const char* file, int line, const char* message) {
  const char* const separator = reason.empty() || message == nullptr ? "" : ". ";
  const std::string text = std::exchange(reason, {}) + separator + (message == nullptr ? "" : message);
  if (run != nullptr) {
    note_outcome(kind);
  }
  tell(kind, file, line, text.c_str());
}

void unity_leave_by_jump(void) {
  if (run == nullptr) {
    std::fprintf(stderr, "an assertion in C code needs RUN_TEST around it\n");
    std::abort();
  }
  std::longjmp(run->start, 1);
}

int unity_number(UNITY_RELATION relation, unsigned type, int64_t expected, int64_t actual) {
  constexpr const char* words[] = {"",
                                   "to be not equal to ",
                                   "to be greater than ",
                                   "to be less than ",
                                   "to be greater or equal to ",
                                   "to be less or equal to "};
  const std::int64_t left = narrow(type, expected);
  const std::int64_t right = narrow(type, actual);
  if (holds(relation, type, left, right)) {
    return 1;
  }
  if (relation == UNITY_EQUAL) {
    return refuse(expected_was(show(type, left), show(type, right)));
  }
  return refuse("Expected " + show(type, right) + " " + words[relation] + show(type, left));
}

int unity_within(unsigned type, uint64_t delta, int64_t expected, int64_t actual) {
  const std::int64_t left = narrow(type, expected);
  const std::int64_t right = narrow(type, actual);
  if (near(type, delta, left, right)) {
    return 1;
  }
  return refuse("Values Not Within Delta " + std::to_string(delta) + " " +
                expected_was(show(type, left), show(type, right)));
}

int unity_array(unsigned type, uint64_t delta, const void* expected, const void* actual, size_t num) {
  if (expected == actual && num != 0) {
    return 1;
  }
  if (!comparable(expected, actual, num)) {
    return 0;
  }
  for (std::size_t i = 0; i < num; ++i) {
    if (!equal_element(i, type, delta, load(type, expected, i), load(type, actual, i))) {
      return 0;
    }
  }
  return 1;
}

int unity_each(unsigned type, int64_t expected, const void* actual, size_t num) {
  if (!comparable(&expected, actual, num)) {
    return 0;
  }
  for (std::size_t i = 0; i < num; ++i) {
    if (!equal_element(i, type, 0, narrow(type, expected), load(type, actual, i))) {
      return 0;
    }
  }
  return 1;
}

int unity_bits(uint64_t mask, uint64_t expected, uint64_t actual) {
  if (((expected ^ actual) & mask) == 0) {
    return 1;
  }
  constexpr unsigned type = UNITY_HEX | 8u;
  return refuse("Bits " + expected_was(show(type, static_cast<std::int64_t>(expected & mask)),
                                       show(type, static_cast<std::int64_t>(actual & mask))));
}

int unity_truth(int passed, const char* why) { return passed != 0 ? 1 : refuse(why); }

int unity_real(double delta, double expected, double actual) {
  const bool both_nan = std::isnan(expected) && std::isnan(actual);
  const bool near_enough = std::isfinite(expected) && std::fabs(expected - actual) <= delta;
  if (both_nan || near_enough || (std::isinf(expected) && expected == actual)) {
    return 1;
  }
  return refuse(expected_was(std::to_string(expected), std::to_string(actual)));
}

int unity_string(const char* expected, const char* actual, size_t max) {
  return same_string(expected, actual, max) ? 1 : refuse(expected_was(quoted(expected), quoted(actual)));
}

int unity_strings(const char* const* expected, const char* const* actual, size_t num) {
  if (expected == actual && num != 0) {
    return 1;
  }
  if (!comparable(expected, actual, num)) {
    return 0;
  }
  for (std::size_t i = 0; i < num; ++i) {
    if (compare_string(i, expected[i], actual[i]) == 0) {
      return 0;
    }
  }
  return 1;
}

int unity_each_string(const char* expected, const char* const* actual, size_t num) {
  if (!comparable(actual, actual, num)) {
    return 0;
  }
  for (std::size_t i = 0; i < num; ++i) {
    if (compare_string(i, expected, actual[i]) == 0) {
      return 0;
    }
  }
  return 1;
}

int unity_memory(const void* expected, const void* actual, size_t len, size_t num) {
  const bool same = expected == actual && len * num != 0;
  return same ? 1 : compare_memory(expected, actual, len, num, len);
}

int unity_each_memory(const void* expected, const void* actual, size_t len, size_t num) {
  return compare_memory(expected, actual, len, num, 0);
}

}  // extern "C"

void unity_leave_by_exception() {
  if (run == nullptr && in_doctest()) {
    doctest::detail::throwException();
  }
  throw Left{};
}
