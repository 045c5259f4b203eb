// SPDX-License-Identifier: Apache-2.0
// Assertions of unity.h, with values that pass and values that fail.
#include "support/unity.h"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct Report {
  UNITY_KIND kind;
  std::string file;
  int line;
  std::string text;
};

std::vector<Report> reports;

void record(UNITY_KIND kind, const char* file, int line, const char* text) {
  reports.push_back({kind, file, line, text});
}

/// Runs a test as RUN_TEST does. Returns its reports, and does not pass them to doctest.
std::vector<Report> reports_of(void (*test)()) {
  reports.clear();
  const UNITY_SINK before = unity_report_to(record);
  unity_run(test, "inner", "inner.c", 1);
  unity_report_to(before);
  return reports;
}

bool only(const std::vector<Report>& all, UNITY_KIND kind) { return all.size() == 1 && all[0].kind == kind; }

std::string failure_of(void (*test)()) {
  const auto all = reports_of(test);
  return only(all, UNITY_FAILED) ? all[0].text : "<no failure>";
}

const int one_two[] = {1, 2};
const int one_three[] = {1, 3};
const int two_two[] = {2, 2};
const std::int16_t minus[] = {-1, -2};
const std::uint64_t wide[] = {UINT64_MAX, 1};
const std::uint8_t bytes[] = {0x80, 0x7F};
const char* const words[] = {"a", "b"};
const char* const others[] = {"a", "c"};
const char* const same_words[] = {"a", "a"};
std::size_t sizes[] = {3, 3};

}  // namespace

// Check that a test with this body passes or fails. The body is a lambda without captures.
#define PASSES(...) CHECK(only(reports_of([] { __VA_ARGS__; }), UNITY_PASSED))
#define FAILS(...) CHECK(only(reports_of([] { __VA_ARGS__; }), UNITY_FAILED))

// Checks every relation of a type, with values that pass and values that fail.
#define CHECK_RELATIONS(TYPE)                             \
  PASSES(TEST_ASSERT_EQUAL_##TYPE(5, 5));                 \
  FAILS(TEST_ASSERT_EQUAL_##TYPE(5, 6));                  \
  PASSES(TEST_ASSERT_NOT_EQUAL_##TYPE(5, 6));             \
  FAILS(TEST_ASSERT_NOT_EQUAL_##TYPE(5, 5));              \
  PASSES(TEST_ASSERT_GREATER_THAN_##TYPE(5, 6));          \
  FAILS(TEST_ASSERT_GREATER_THAN_##TYPE(5, 5));           \
  PASSES(TEST_ASSERT_LESS_THAN_##TYPE(5, 4));             \
  FAILS(TEST_ASSERT_LESS_THAN_##TYPE(5, 5));              \
  PASSES(TEST_ASSERT_GREATER_OR_EQUAL_##TYPE(5, 5));      \
  FAILS(TEST_ASSERT_GREATER_OR_EQUAL_##TYPE(5, 4));       \
  PASSES(TEST_ASSERT_LESS_OR_EQUAL_##TYPE(5, 5));         \
  FAILS(TEST_ASSERT_LESS_OR_EQUAL_##TYPE(5, 6));          \
  PASSES(TEST_ASSERT_##TYPE##_WITHIN(2, 5, 7));           \
  PASSES(TEST_ASSERT_##TYPE##_WITHIN(2, 5, 3));           \
  FAILS(TEST_ASSERT_##TYPE##_WITHIN(2, 5, 8));            \
  FAILS(TEST_ASSERT_##TYPE##_WITHIN(2, 5, 2));            \
  FAILS(TEST_ASSERT_EQUAL_##TYPE##_MESSAGE(5, 6, "why")); \
  FAILS(TEST_ASSERT_GREATER_THAN_##TYPE##_MESSAGE(5, 5, "why"))

// Checks the array assertions of a type.
#define CHECK_ARRAYS(TYPE, ELEMENT)                                                                              \
  PASSES(const ELEMENT a[] = {1, 2}; const ELEMENT b[] = {1, 2}; TEST_ASSERT_EQUAL_##TYPE##_ARRAY(a, b, 2));     \
  FAILS(const ELEMENT a[] = {1, 2}; const ELEMENT b[] = {1, 3}; TEST_ASSERT_EQUAL_##TYPE##_ARRAY(a, b, 2));      \
  PASSES(const ELEMENT a[] = {1, 2}; const ELEMENT b[] = {1, 3}; TEST_ASSERT_EQUAL_##TYPE##_ARRAY(a, b, 1));     \
  PASSES(const ELEMENT a[] = {1, 2}; const ELEMENT b[] = {2, 3}; TEST_ASSERT_##TYPE##_ARRAY_WITHIN(1, a, b, 2)); \
  FAILS(const ELEMENT a[] = {1, 2}; const ELEMENT b[] = {1, 4}; TEST_ASSERT_##TYPE##_ARRAY_WITHIN(1, a, b, 2));  \
  PASSES(const ELEMENT a[] = {7, 7}; TEST_ASSERT_EACH_EQUAL_##TYPE(7, a, 2));                                    \
  FAILS(const ELEMENT a[] = {7, 8}; TEST_ASSERT_EACH_EQUAL_##TYPE(7, a, 2))

TEST_CASE("Unity: every relation holds for the right values of every integer type") {
  CHECK_RELATIONS(INT);
  CHECK_RELATIONS(INT8);
  CHECK_RELATIONS(INT16);
  CHECK_RELATIONS(INT32);
  CHECK_RELATIONS(INT64);
  CHECK_RELATIONS(UINT);
  CHECK_RELATIONS(UINT8);
  CHECK_RELATIONS(UINT16);
  CHECK_RELATIONS(UINT32);
  CHECK_RELATIONS(UINT64);
  CHECK_RELATIONS(HEX);
  CHECK_RELATIONS(HEX8);
  CHECK_RELATIONS(HEX16);
  CHECK_RELATIONS(HEX32);
  CHECK_RELATIONS(HEX64);
  CHECK_RELATIONS(CHAR);
  CHECK_RELATIONS(size_t);
}

TEST_CASE("Unity: arrays are compared element by element, in the width of their type") {
  CHECK_ARRAYS(INT, int);
  CHECK_ARRAYS(INT8, std::int8_t);
  CHECK_ARRAYS(INT16, std::int16_t);
  CHECK_ARRAYS(INT32, std::int32_t);
  CHECK_ARRAYS(INT64, std::int64_t);
  CHECK_ARRAYS(UINT, unsigned);
  CHECK_ARRAYS(UINT8, std::uint8_t);
  CHECK_ARRAYS(UINT16, std::uint16_t);
  CHECK_ARRAYS(UINT32, std::uint32_t);
  CHECK_ARRAYS(UINT64, std::uint64_t);
  CHECK_ARRAYS(HEX, std::uint32_t);
  CHECK_ARRAYS(HEX8, std::uint8_t);
  CHECK_ARRAYS(HEX16, std::uint16_t);
  CHECK_ARRAYS(HEX32, std::uint32_t);
  CHECK_ARRAYS(HEX64, std::uint64_t);
  CHECK_ARRAYS(CHAR, char);
  CHECK_ARRAYS(size_t, std::size_t);
}

TEST_CASE("Unity: assertions without a width compare the widest type") {
  PASSES(TEST_ASSERT_EQUAL(1, 1));
  FAILS(TEST_ASSERT_EQUAL(1, 2));
  FAILS(TEST_ASSERT_EQUAL(1, INT64_C(0x100000001)));
  PASSES(TEST_ASSERT_NOT_EQUAL(1, 2));
  FAILS(TEST_ASSERT_NOT_EQUAL(1, 1));
  PASSES(TEST_ASSERT_GREATER_THAN(1, 2));
  FAILS(TEST_ASSERT_GREATER_THAN(2, 1));
  PASSES(TEST_ASSERT_LESS_THAN(2, 1));
  FAILS(TEST_ASSERT_LESS_THAN(1, 2));
  PASSES(TEST_ASSERT_GREATER_OR_EQUAL(1, 1));
  FAILS(TEST_ASSERT_GREATER_OR_EQUAL(2, 1));
  PASSES(TEST_ASSERT_LESS_OR_EQUAL(1, 1));
  FAILS(TEST_ASSERT_LESS_OR_EQUAL(1, 2));
}

TEST_CASE("Unity: numbers are converted to their type and compared with its sign") {
  PASSES(TEST_ASSERT_EQUAL_HEX8(0xFF, -1));
  PASSES(TEST_ASSERT_EQUAL_HEX32(0xFFFFFFFF, -1));
  FAILS(TEST_ASSERT_EQUAL_HEX64(0xFFFFFFFF, -1));
  PASSES(TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, -1));
  PASSES(TEST_ASSERT_GREATER_THAN_UINT64(INT64_MAX, UINT64_MAX));
  PASSES(TEST_ASSERT_LESS_THAN_INT8(0, 0x80));
  PASSES(TEST_ASSERT_GREATER_THAN_UINT8(0x7F, 0x80));
  PASSES(TEST_ASSERT_UINT64_WITHIN(UINT64_MAX, 0, UINT64_MAX));
  PASSES(TEST_ASSERT_INT64_WITHIN(UINT64_MAX, INT64_MIN, INT64_MAX));
  FAILS(TEST_ASSERT_INT8_WITHIN(254, -128, 127));
  PASSES(TEST_ASSERT_EQUAL_INT16_ARRAY(minus, minus, 2));
  PASSES(TEST_ASSERT_EACH_EQUAL_UINT64(UINT64_MAX, wide, 1));
  PASSES(TEST_ASSERT_EACH_EQUAL_INT8(-128, bytes, 1));
}

TEST_CASE("Unity: a report contains the expected and the actual value, then the message") {
  CHECK(failure_of([] { TEST_ASSERT_EQUAL(5, -6); }) == "Expected 5 Was -6");
  CHECK(failure_of([] { TEST_ASSERT_EQUAL_MESSAGE(5, 6, "why"); }) == "Expected 5 Was 6. why");
  CHECK(failure_of([] { TEST_ASSERT_EQUAL_HEX16(0x5, 0xABCD); }) == "Expected 0x0005 Was 0xABCD");
  CHECK(failure_of([] { TEST_ASSERT_EQUAL_UINT8(1, 255); }) == "Expected 1 Was 255");
  CHECK(failure_of([] { TEST_ASSERT_EQUAL_CHAR('a', '\n'); }) == "Expected 'a' Was 0x0A");
  CHECK(failure_of([] { TEST_ASSERT_GREATER_THAN(5, 5); }) == "Expected 5 to be greater than 5");
  CHECK(failure_of([] { TEST_ASSERT_INT_WITHIN(1, 5, 7); }) == "Values Not Within Delta 1 Expected 5 Was 7");
  CHECK(failure_of([] { TEST_ASSERT_EQUAL_INT_ARRAY(one_two, one_three, 2); }) == "Element 1 Expected 2 Was 3");
  CHECK(failure_of([] { TEST_ASSERT_BITS(0xF, 0x5, 0x4); }) ==
        "Bits Expected 0x0000000000000005 Was 0x0000000000000004");
  CHECK(failure_of([] { TEST_ASSERT_EQUAL_STRING("a", "b"); }) == "Expected 'a' Was 'b'");
  CHECK(failure_of([] { TEST_ASSERT_EQUAL_STRING("a", NULL); }) == "Expected 'a' Was NULL");
  CHECK(failure_of([] { TEST_ASSERT_EQUAL_MEMORY("ab", "ac", 2); }) == "Element 0 Byte 1 Expected 0x62 Was 0x63");
  CHECK(failure_of([] { TEST_FAIL_MESSAGE("why"); }) == "why");
}

TEST_CASE("Unity: a report contains file and line of the assertion") {
  const int line = __LINE__ + 1;
  const auto all = reports_of([] { TEST_FAIL(); });
  REQUIRE(all.size() == 1);
  CHECK(all[0].file == __FILE__);
  CHECK(all[0].line == line);
}

TEST_CASE("Unity: truth, null and empty are checked") {
  PASSES(TEST_ASSERT(1));
  FAILS(TEST_ASSERT(0));
  PASSES(TEST_ASSERT_TRUE(2));
  FAILS(TEST_ASSERT_TRUE(0));
  PASSES(TEST_ASSERT_FALSE(0));
  FAILS(TEST_ASSERT_FALSE(2));
  PASSES(TEST_ASSERT_UNLESS(0));
  FAILS(TEST_ASSERT_UNLESS(1));
  PASSES(TEST_ASSERT_NULL(static_cast<void*>(nullptr)));
  FAILS(TEST_ASSERT_NULL(one_two));
  PASSES(TEST_ASSERT_NOT_NULL(one_two));
  FAILS(TEST_ASSERT_NOT_NULL(static_cast<void*>(nullptr)));
  PASSES(TEST_ASSERT_EMPTY(""));
  FAILS(TEST_ASSERT_EMPTY("a"));
  PASSES(TEST_ASSERT_NOT_EMPTY("a"));
  FAILS(TEST_ASSERT_NOT_EMPTY(""));
  FAILS(TEST_ASSERT_TRUE_MESSAGE(0, "why"));
  FAILS(TEST_ASSERT_NULL_MESSAGE(one_two, "why"));
}

TEST_CASE("Unity: bits under a mask are checked") {
  PASSES(TEST_ASSERT_BITS(0xF0, 0x51, 0x52));
  FAILS(TEST_ASSERT_BITS(0xF0, 0x51, 0x61));
  PASSES(TEST_ASSERT_BITS_HIGH(0x30, 0x3F));
  FAILS(TEST_ASSERT_BITS_HIGH(0x30, 0x1F));
  PASSES(TEST_ASSERT_BITS_LOW(0x30, 0xCF));
  FAILS(TEST_ASSERT_BITS_LOW(0x30, 0xDF));
  PASSES(TEST_ASSERT_BIT_HIGH(31, 0x80000000));
  FAILS(TEST_ASSERT_BIT_HIGH(31, 0x7FFFFFFF));
  PASSES(TEST_ASSERT_BIT_LOW(0, 0xFE));
  FAILS(TEST_ASSERT_BIT_LOW(0, 0x01));
}

TEST_CASE("Unity: strings are compared") {
  PASSES(TEST_ASSERT_EQUAL_STRING("ab", std::string("ab").c_str()));
  FAILS(TEST_ASSERT_EQUAL_STRING("ab", "abc"));
  PASSES(TEST_ASSERT_EQUAL_STRING(NULL, NULL));
  FAILS(TEST_ASSERT_EQUAL_STRING(NULL, "a"));
  PASSES(TEST_ASSERT_EQUAL_STRING_LEN("abX", "abY", 2));
  FAILS(TEST_ASSERT_EQUAL_STRING_LEN("abX", "abY", 3));
  PASSES(TEST_ASSERT_EQUAL_STRING_ARRAY(words, others, 1));
  FAILS(TEST_ASSERT_EQUAL_STRING_ARRAY(words, others, 2));
  PASSES(TEST_ASSERT_EACH_EQUAL_STRING("a", same_words, 2));
  FAILS(TEST_ASSERT_EACH_EQUAL_STRING("a", words, 2));
}

TEST_CASE("Unity: memory and pointers are compared") {
  PASSES(TEST_ASSERT_EQUAL_MEMORY("abX", "abY", 2));
  FAILS(TEST_ASSERT_EQUAL_MEMORY("abX", "abY", 3));
  PASSES(TEST_ASSERT_EQUAL_MEMORY_ARRAY(one_two, one_three, sizeof(int), 1));
  FAILS(TEST_ASSERT_EQUAL_MEMORY_ARRAY(one_two, one_three, sizeof(int), 2));
  PASSES(TEST_ASSERT_EACH_EQUAL_MEMORY(&two_two[0], two_two, sizeof(int), 2));
  FAILS(TEST_ASSERT_EACH_EQUAL_MEMORY(&one_two[0], one_two, sizeof(int), 2));
  PASSES(TEST_ASSERT_EQUAL_PTR(one_two, &one_two[0]));
  FAILS(TEST_ASSERT_EQUAL_PTR(one_two, &one_two[1]));
  PASSES(TEST_ASSERT_EQUAL_PTR_ARRAY(words, others, 1));
  FAILS(TEST_ASSERT_EQUAL_PTR_ARRAY(words, others, 2));
  PASSES(TEST_ASSERT_EACH_EQUAL_PTR(same_words[0], same_words, 2));
  FAILS(TEST_ASSERT_EACH_EQUAL_PTR(words[0], words, 2));
  PASSES(TEST_ASSERT_EACH_EQUAL_size_t(3, sizes, 2));
}

TEST_CASE("Unity: a comparison of no elements or with one null pointer fails") {
  CHECK(failure_of([] { TEST_ASSERT_EQUAL_MEMORY("a", "b", 0); }) == "Nothing to compare");
  CHECK(failure_of([] { TEST_ASSERT_EQUAL_INT_ARRAY(one_two, one_two, 0); }) == "Nothing to compare");
  CHECK(failure_of([] { TEST_ASSERT_EACH_EQUAL_INT(1, one_two, 0); }) == "Nothing to compare");
  CHECK(failure_of([] { TEST_ASSERT_EQUAL_MEMORY(NULL, "b", 1); }) == "Expected is NULL");
  CHECK(failure_of([] { TEST_ASSERT_EQUAL_INT_ARRAY(one_two, NULL, 1); }) == "Actual is NULL");
  PASSES(TEST_ASSERT_EQUAL_MEMORY(NULL, NULL, 1));
}

TEST_CASE("Unity: real numbers are compared; infinity and NaN equal themselves") {
  PASSES(TEST_ASSERT_EQUAL_FLOAT(1.0F, 1.000001F));
  FAILS(TEST_ASSERT_EQUAL_FLOAT(1.0F, 1.0001F));
  PASSES(TEST_ASSERT_FLOAT_WITHIN(0.5F, -1.0F, -1.5F));
  FAILS(TEST_ASSERT_FLOAT_WITHIN(0.5F, -1.0F, -1.6F));
  PASSES(TEST_ASSERT_EQUAL_DOUBLE(-2.0, -2.0));
  FAILS(TEST_ASSERT_EQUAL_DOUBLE(1.0, 1.00000001));
  PASSES(TEST_ASSERT_DOUBLE_WITHIN(0.25, 1.0, 1.25));
  FAILS(TEST_ASSERT_DOUBLE_WITHIN(0.25, 1.0, 1.26));
  PASSES(TEST_ASSERT_EQUAL_DOUBLE(HUGE_VAL, HUGE_VAL));
  FAILS(TEST_ASSERT_EQUAL_DOUBLE(HUGE_VAL, 1.0));
  PASSES(TEST_ASSERT_EQUAL_DOUBLE(std::nan(""), std::nan("")));
  FAILS(TEST_ASSERT_EQUAL_DOUBLE(1.0, std::nan("")));
}

namespace {
int after = 0;
bool destroyed = false;
struct Witness {
  ~Witness() { destroyed = true; }
};
}  // namespace

TEST_CASE("Unity: a test ends at its first failure, TEST_IGNORE or TEST_PASS, and its objects are destroyed") {
  after = 0;
  destroyed = false;
  CHECK(only(reports_of([] {
               const Witness witness;
               TEST_FAIL();
               ++after;
             }),
             UNITY_FAILED));
  CHECK(destroyed);
  CHECK(only(reports_of([] {
               TEST_IGNORE();
               ++after;
             }),
             UNITY_IGNORED));
  CHECK(only(reports_of([] {
               TEST_PASS();
               ++after;
             }),
             UNITY_PASSED));
  CHECK(after == 0);
}

TEST_CASE("Unity: messages do not change the result of a test") {
  const auto all = reports_of([] {
    TEST_MESSAGE("one");
    TEST_PASS_MESSAGE("two");
  });
  REQUIRE(all.size() == 3);
  CHECK(all[0].text == "one");
  CHECK(all[1].text == "two");
  CHECK(all[2].kind == UNITY_PASSED);
}

TEST_CASE("Unity: an unexpected exception is a failure") {
  CHECK(failure_of([] { throw std::runtime_error("lost"); }) == "lost");
  CHECK(failure_of([] { throw 5; }) == "exception");
}

TEST_CASE("Unity: the summary counts failures; a run without tests fails") {
  UNITY_BEGIN();
  CHECK(UNITY_END() == 1);
  UNITY_BEGIN();
  reports_of([] {});
  reports_of([] { TEST_IGNORE(); });
  CHECK(UNITY_END() == 0);
  reports_of([] { TEST_FAIL(); });
  reports_of([] { TEST_ASSERT_EQUAL(1, 2); });
  CHECK(UNITY_END() == 2);
}

TEST_CASE("Unity: assertions work directly in a doctest case") {
  TEST_ASSERT_EQUAL_HEX32(0x12345678, 0x12345678);
  TEST_ASSERT_EQUAL_STRING("a", "a");
}

TEST_CASE("Unity: a failed assertion fails the doctest case and ends it" * doctest::should_fail()) {
  TEST_ASSERT_EQUAL_HEX32(1, 2);
  std::abort();
}

TEST_CASE("Unity: a test that fails in RUN_TEST fails the doctest case" * doctest::should_fail()) {
  UNITY_BEGIN();
  unity_run([] { TEST_FAIL_MESSAGE("as it should"); }, "failing", __FILE__, __LINE__);
  UNITY_END();
}
