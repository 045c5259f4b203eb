// SPDX-License-Identifier: Apache-2.0
/// \file co_types.h
/// Basic C types and the helper macros that object types and applications share. Compiles alone, as C11 and as C++17.
#ifndef CO_TYPES_H_
#define CO_TYPES_H_

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Marks a definition that an application may replace by a definition of the same name. Never use it on a declaration
/// that the application includes: the application's definition would become weak, too.
#define WEAK __attribute__((weak))

/// Like WEAK. Lexican does not use it: for sources of CANopen-Stack that do.
#define WEAK_TEST __attribute__((weak))

/// Marks a parameter that is intentionally unused.
#define CO_UNUSED(var) (void)(var)

/// Called when an argument is null in a function that cannot report it (ASSERT_PTR_FATAL). The application may define
/// it to stop the device safely; the default is an endless loop. It must not leave by longjmp into the normal flow of
/// the program.
void CONodeFatalError(void);

/// \name Argument checks for functions in the style of object types: return from the function when the check fails.
/// \{

/// Returns if \a p is null.
#define ASSERT_PTR(p) \
  if ((p) == 0) {     \
    return;           \
  }
/// Returns \a err if \a p is null.
#define ASSERT_PTR_ERR(p, err) \
  if ((p) == 0) {              \
    return (err);              \
  }
/// Calls CONodeFatalError() and returns if \a p is null.
#define ASSERT_PTR_FATAL(p) \
  if ((p) == 0) {           \
    CONodeFatalError();     \
    return;                 \
  }
/// Calls CONodeFatalError() and returns \a err if \a p is null.
#define ASSERT_PTR_FATAL_ERR(p, err) \
  if ((p) == 0) {                    \
    CONodeFatalError();              \
    return (err);                    \
  }
/// Returns \a err if \a var is not equal to \a val.
#define ASSERT_EQU_ERR(var, val, err) \
  if ((var) != (val)) {               \
    return (err);                     \
  }
/// Returns if \a var is equal to \a val.
#define ASSERT_NOT(var, val) \
  if ((var) == (val)) {      \
    return;                  \
  }
/// Returns \a err if \a var is equal to \a val.
#define ASSERT_NOT_ERR(var, val, err) \
  if ((var) == (val)) {               \
    return (err);                     \
  }
/// Returns if \a var is not lower than \a limit.
#define ASSERT_LOWER(var, limit) \
  if ((var) >= (limit)) {        \
    return;                      \
  }
/// Returns \a err if \a var is not lower than \a limit.
#define ASSERT_LOWER_ERR(var, limit, err) \
  if ((var) >= (limit)) {                 \
    return (err);                         \
  }
/// \}

#ifdef __cplusplus
}
#endif

#ifdef __cplusplus
/// \cond internal
extern "C++" {
namespace co {
template <bool condition>
struct RequiredIf;
template <>
struct RequiredIf<true> {
  char size;
};
}  // namespace co
}
/// \endcond
/// 1 if a constant condition is true; otherwise, or if it is no constant, the program does not compile.
#define CO_REQUIRED(condition) ((uint32_t)sizeof(co::RequiredIf<(condition)>))
#else
#define CO_REQUIRED(condition) ((uint32_t)(sizeof(struct { int required : (condition) ? 1 : -1; }) / sizeof(int)))
#endif

#endif
