// SPDX-License-Identifier: Apache-2.0
/// \file unity.h
/// Unity's names for tests, in C and in C++, so that the tests of a firmware team run here unchanged.
///
/// Inside a doctest case a failure is a failure of that case. In a program with a main() (UNITY_BEGIN, RUN_TEST,
/// UNITY_END) every test is a line of output and counts in the summary, and a program that ran no test fails; the
/// environment variable UNITY_ONLY names the one test to run. A failed assertion ends its test: in C++ by an exception,
/// so that destructors run; in C by a jump to RUN_TEST, so that C code needs RUN_TEST around its assertions. The
/// functions behind the names are in unity.cpp.
#ifndef LEXICAN_UNITY_H_
#define LEXICAN_UNITY_H_

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define UNITY_NORETURN [[noreturn]]
extern "C" {
#else
#define UNITY_NORETURN _Noreturn
#endif

/// Run before and after each test of RUN_TEST, also after one that failed. Defaults: empty.
void setUp(void);
void tearDown(void);

#define UNITY_BEGIN() unity_begin()
#define UNITY_END() unity_end()
#define RUN_TEST(test) unity_run((test), #test, __FILE__, __LINE__)

void unity_begin(void);
int unity_end(void);  ///< the number of tests that failed; 1 if none ran
void unity_run(void (*test)(void), const char* name, const char* file, int line);

/// Where reports go. \a file and \a line are those of the assertion; for UNITY_PASSED those of RUN_TEST.
typedef enum UNITY_KIND { UNITY_PASSED, UNITY_FAILED, UNITY_IGNORED, UNITY_TOLD } UNITY_KIND;
typedef void (*UNITY_SINK)(UNITY_KIND kind, const char* file, int line, const char* text);
/// Sends reports to \a sink, null: to the doctest case that is running, or to standard output. Returns the sink before.
UNITY_SINK unity_report_to(UNITY_SINK sink);

void unity_report(UNITY_KIND kind, const char* file, int line, const char* message);
UNITY_NORETURN void unity_leave_by_jump(void);
#ifdef __cplusplus
}
UNITY_NORETURN void unity_leave_by_exception();
#define UNITY_LEAVE() unity_leave_by_exception()
extern "C" {
#else
#define UNITY_LEAVE() unity_leave_by_jump()
#endif

#define UNITY_END_TEST(kind, message)                    \
  do {                                                   \
    unity_report((kind), __FILE__, __LINE__, (message)); \
    UNITY_LEAVE();                                       \
  } while (0)

#define UNITY_REQUIRE(passed, message)         \
  do {                                         \
    if (!(passed)) {                           \
      UNITY_END_TEST(UNITY_FAILED, (message)); \
    }                                          \
  } while (0)

/// Type of a number: width in bytes, and how it is compared and shown.
#define UNITY_SIGNED 0x10u
#define UNITY_UNSIGNED 0x20u
#define UNITY_HEX 0x40u
#define UNITY_CHAR 0x80u

typedef enum UNITY_RELATION {
  UNITY_EQUAL,
  UNITY_NOT_EQUAL,
  UNITY_GREATER_THAN,
  UNITY_LESS_THAN,
  UNITY_GREATER_OR_EQUAL,
  UNITY_LESS_OR_EQUAL
} UNITY_RELATION;

/// \name Comparisons: return 1 if passed, else keep the reason for unity_report(). Numbers are first narrowed to \a
/// type.
/// \{
int unity_number(UNITY_RELATION relation, unsigned type, int64_t expected, int64_t actual);
int unity_within(unsigned type, uint64_t delta, int64_t expected, int64_t actual);
int unity_array(unsigned type, uint64_t delta, const void* expected, const void* actual, size_t num);
int unity_each(unsigned type, int64_t expected, const void* actual, size_t num);
int unity_bits(uint64_t mask, uint64_t expected, uint64_t actual);
int unity_truth(int passed, const char* reason);
int unity_real(double delta, double expected, double actual);
int unity_string(const char* expected, const char* actual, size_t max);
int unity_strings(const char* const* expected, const char* const* actual, size_t num);
int unity_each_string(const char* expected, const char* const* actual, size_t num);
int unity_memory(const void* expected, const void* actual, size_t len, size_t num);
int unity_each_memory(const void* expected, const void* actual, size_t len, size_t num);
/// \}

#ifdef __cplusplus
}
#endif

#define TEST_FAIL_MESSAGE(message) UNITY_END_TEST(UNITY_FAILED, (message))
#define TEST_FAIL() UNITY_END_TEST(UNITY_FAILED, NULL)
#define TEST_IGNORE_MESSAGE(message) UNITY_END_TEST(UNITY_IGNORED, (message))
#define TEST_IGNORE() UNITY_END_TEST(UNITY_IGNORED, NULL)
#define TEST_PASS_MESSAGE(message) UNITY_END_TEST(UNITY_TOLD, (message))
#define TEST_PASS() UNITY_LEAVE()
#define TEST_MESSAGE(message) unity_report(UNITY_TOLD, __FILE__, __LINE__, (message))

#define TEST_ASSERT_MESSAGE(condition, message) \
  UNITY_REQUIRE(unity_truth((condition) ? 1 : 0, "Expression Evaluated To FALSE"), message)
#define TEST_ASSERT(condition) TEST_ASSERT_MESSAGE(condition, NULL)
#define TEST_ASSERT_TRUE_MESSAGE(condition, message) \
  UNITY_REQUIRE(unity_truth((condition) ? 1 : 0, "Expected TRUE Was FALSE"), message)
#define TEST_ASSERT_TRUE(condition) TEST_ASSERT_TRUE_MESSAGE(condition, NULL)
#define TEST_ASSERT_FALSE_MESSAGE(condition, message) \
  UNITY_REQUIRE(unity_truth((condition) ? 0 : 1, "Expected FALSE Was TRUE"), message)
#define TEST_ASSERT_FALSE(condition) TEST_ASSERT_FALSE_MESSAGE(condition, NULL)
#define TEST_ASSERT_UNLESS_MESSAGE(condition, message) TEST_ASSERT_FALSE_MESSAGE(condition, message)
#define TEST_ASSERT_UNLESS(condition) TEST_ASSERT_FALSE(condition)
#define TEST_ASSERT_NULL_MESSAGE(pointer, message) \
  UNITY_REQUIRE(unity_truth((pointer) == NULL, "Expected NULL"), message)
#define TEST_ASSERT_NULL(pointer) TEST_ASSERT_NULL_MESSAGE(pointer, NULL)
#define TEST_ASSERT_NOT_NULL_MESSAGE(pointer, message) \
  UNITY_REQUIRE(unity_truth((pointer) != NULL, "Expected Non-NULL"), message)
#define TEST_ASSERT_NOT_NULL(pointer) TEST_ASSERT_NOT_NULL_MESSAGE(pointer, NULL)
#define TEST_ASSERT_EMPTY_MESSAGE(string, message) \
  UNITY_REQUIRE(unity_truth((string)[0] == 0, "Expected Empty"), message)
#define TEST_ASSERT_EMPTY(string) TEST_ASSERT_EMPTY_MESSAGE(string, NULL)
#define TEST_ASSERT_NOT_EMPTY_MESSAGE(string, message) \
  UNITY_REQUIRE(unity_truth((string)[0] != 0, "Expected Non-Empty"), message)
#define TEST_ASSERT_NOT_EMPTY(string) TEST_ASSERT_NOT_EMPTY_MESSAGE(string, NULL)

#define TEST_ASSERT_BITS_MESSAGE(mask, expected, actual, message) \
  UNITY_REQUIRE(unity_bits((uint64_t)(mask), (uint64_t)(expected), (uint64_t)(actual)), message)
#define TEST_ASSERT_BITS(mask, expected, actual) TEST_ASSERT_BITS_MESSAGE(mask, expected, actual, NULL)
#define TEST_ASSERT_BITS_HIGH_MESSAGE(mask, actual, message) TEST_ASSERT_BITS_MESSAGE(mask, UINT64_MAX, actual, message)
#define TEST_ASSERT_BITS_HIGH(mask, actual) TEST_ASSERT_BITS_HIGH_MESSAGE(mask, actual, NULL)
#define TEST_ASSERT_BITS_LOW_MESSAGE(mask, actual, message) TEST_ASSERT_BITS_MESSAGE(mask, 0, actual, message)
#define TEST_ASSERT_BITS_LOW(mask, actual) TEST_ASSERT_BITS_LOW_MESSAGE(mask, actual, NULL)
#define TEST_ASSERT_BIT_HIGH_MESSAGE(bit, actual, message) \
  TEST_ASSERT_BITS_HIGH_MESSAGE(UINT64_C(1) << (bit), actual, message)
#define TEST_ASSERT_BIT_HIGH(bit, actual) TEST_ASSERT_BIT_HIGH_MESSAGE(bit, actual, NULL)
#define TEST_ASSERT_BIT_LOW_MESSAGE(bit, actual, message) \
  TEST_ASSERT_BITS_LOW_MESSAGE(UINT64_C(1) << (bit), actual, message)
#define TEST_ASSERT_BIT_LOW(bit, actual) TEST_ASSERT_BIT_LOW_MESSAGE(bit, actual, NULL)

#define TEST_ASSERT_EQUAL_STRING_MESSAGE(expected, actual, message) \
  UNITY_REQUIRE(unity_string((const char*)(expected), (const char*)(actual), PTRDIFF_MAX), message)
#define TEST_ASSERT_EQUAL_STRING(expected, actual) TEST_ASSERT_EQUAL_STRING_MESSAGE(expected, actual, NULL)
#define TEST_ASSERT_EQUAL_STRING_LEN_MESSAGE(expected, actual, len, message) \
  UNITY_REQUIRE(unity_string((const char*)(expected), (const char*)(actual), (size_t)(len)), message)
#define TEST_ASSERT_EQUAL_STRING_LEN(expected, actual, len) \
  TEST_ASSERT_EQUAL_STRING_LEN_MESSAGE(expected, actual, len, NULL)
#define TEST_ASSERT_EQUAL_STRING_ARRAY_MESSAGE(expected, actual, num, message) \
  UNITY_REQUIRE(unity_strings((const char* const*)(expected), (const char* const*)(actual), (size_t)(num)), message)
#define TEST_ASSERT_EQUAL_STRING_ARRAY(expected, actual, num) \
  TEST_ASSERT_EQUAL_STRING_ARRAY_MESSAGE(expected, actual, num, NULL)
#define TEST_ASSERT_EACH_EQUAL_STRING_MESSAGE(expected, actual, num, message) \
  UNITY_REQUIRE(unity_each_string((const char*)(expected), (const char* const*)(actual), (size_t)(num)), message)
#define TEST_ASSERT_EACH_EQUAL_STRING(expected, actual, num) \
  TEST_ASSERT_EACH_EQUAL_STRING_MESSAGE(expected, actual, num, NULL)

#define TEST_ASSERT_EQUAL_MEMORY_MESSAGE(expected, actual, len, message) \
  UNITY_REQUIRE(unity_memory((expected), (actual), (size_t)(len), 1), message)
#define TEST_ASSERT_EQUAL_MEMORY(expected, actual, len) TEST_ASSERT_EQUAL_MEMORY_MESSAGE(expected, actual, len, NULL)
#define TEST_ASSERT_EQUAL_MEMORY_ARRAY_MESSAGE(expected, actual, len, num, message) \
  UNITY_REQUIRE(unity_memory((expected), (actual), (size_t)(len), (size_t)(num)), message)
#define TEST_ASSERT_EQUAL_MEMORY_ARRAY(expected, actual, len, num) \
  TEST_ASSERT_EQUAL_MEMORY_ARRAY_MESSAGE(expected, actual, len, num, NULL)
#define TEST_ASSERT_EACH_EQUAL_MEMORY_MESSAGE(expected, actual, len, num, message) \
  UNITY_REQUIRE(unity_each_memory((expected), (actual), (size_t)(len), (size_t)(num)), message)
#define TEST_ASSERT_EACH_EQUAL_MEMORY(expected, actual, len, num) \
  TEST_ASSERT_EACH_EQUAL_MEMORY_MESSAGE(expected, actual, len, num, NULL)

#define TEST_ASSERT_EQUAL_PTR_MESSAGE(expected, actual, message) \
  UNITY_REQUIRE(unity_number(UNITY_EQUAL, UNITY_HEX | sizeof(void*), (intptr_t)(expected), (intptr_t)(actual)), message)
#define TEST_ASSERT_EQUAL_PTR(expected, actual) TEST_ASSERT_EQUAL_PTR_MESSAGE(expected, actual, NULL)
#define TEST_ASSERT_EQUAL_PTR_ARRAY_MESSAGE(expected, actual, num, message) \
  UNITY_REQUIRE(unity_array(UNITY_HEX | sizeof(void*), 0, (expected), (actual), (size_t)(num)), message)
#define TEST_ASSERT_EQUAL_PTR_ARRAY(expected, actual, num) \
  TEST_ASSERT_EQUAL_PTR_ARRAY_MESSAGE(expected, actual, num, NULL)
#define TEST_ASSERT_EACH_EQUAL_PTR_MESSAGE(expected, actual, num, message) \
  UNITY_REQUIRE(unity_each(UNITY_HEX | sizeof(void*), (intptr_t)(expected), (actual), (size_t)(num)), message)
#define TEST_ASSERT_EACH_EQUAL_PTR(expected, actual, num) \
  TEST_ASSERT_EACH_EQUAL_PTR_MESSAGE(expected, actual, num, NULL)

/// Relative precision of the "equal" of real numbers, as Unity has it by default.
#define UNITY_FLOAT_PRECISION 0.00001
#define UNITY_DOUBLE_PRECISION 1e-12
#define UNITY_MAGNITUDE(value) ((value) < 0 ? -(double)(value) : (double)(value))

#define TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(delta, expected, actual, message) \
  UNITY_REQUIRE(unity_real((double)(delta), (double)(expected), (double)(actual)), message)
#define TEST_ASSERT_DOUBLE_WITHIN(delta, expected, actual) \
  TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(delta, expected, actual, NULL)
#define TEST_ASSERT_EQUAL_DOUBLE_MESSAGE(expected, actual, message) \
  TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(UNITY_MAGNITUDE(expected) * UNITY_DOUBLE_PRECISION, expected, actual, message)
#define TEST_ASSERT_EQUAL_DOUBLE(expected, actual) TEST_ASSERT_EQUAL_DOUBLE_MESSAGE(expected, actual, NULL)
#define TEST_ASSERT_FLOAT_WITHIN_MESSAGE(delta, expected, actual, message) \
  TEST_ASSERT_DOUBLE_WITHIN_MESSAGE((float)(delta), (float)(expected), (float)(actual), message)
#define TEST_ASSERT_FLOAT_WITHIN(delta, expected, actual) \
  TEST_ASSERT_FLOAT_WITHIN_MESSAGE(delta, expected, actual, NULL)
#define TEST_ASSERT_EQUAL_FLOAT_MESSAGE(expected, actual, message) \
  TEST_ASSERT_FLOAT_WITHIN_MESSAGE(UNITY_MAGNITUDE(expected) * UNITY_FLOAT_PRECISION, expected, actual, message)
#define TEST_ASSERT_EQUAL_FLOAT(expected, actual) TEST_ASSERT_EQUAL_FLOAT_MESSAGE(expected, actual, NULL)

#include "unity_numbers.h"

#endif
