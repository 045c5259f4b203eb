// SPDX-License-Identifier: Apache-2.0
/// \file co_types.h
/// Basic C types and the small helper macros that object types and applications share.
/// Compiles alone, as C11 and as C++17.
#ifndef CO_TYPES_H_
#define CO_TYPES_H_

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Marks a definition that an application may replace by its own of the same name. Never put it on a declaration
/// that the application includes: its own definition would become weak, too.
#define WEAK __attribute__((weak))

/// The same, for definitions that only tests replace.
#define WEAK_TEST __attribute__((weak))

/// Says that a parameter is not used on purpose.
#define CO_UNUSED(var) (void)(var)

/// Called on a null argument of a function that has no way to report it (ASSERT_PTR_FATAL). Supply your own to stop
/// the device safely; the default is an endless loop. Must not return into the program's normal flow by longjmp.
void CONodeFatalError(void);

/// \name Argument checks for functions in the style of object types: leave the function when the check fails.
/// \{
#define ASSERT_PTR(p) \
  if ((p) == 0) {     \
    return;           \
  }
#define ASSERT_PTR_ERR(p, err) \
  if ((p) == 0) {              \
    return (err);              \
  }
#define ASSERT_PTR_FATAL(p) \
  if ((p) == 0) {           \
    CONodeFatalError();     \
    return;                 \
  }
#define ASSERT_PTR_FATAL_ERR(p, err) \
  if ((p) == 0) {                    \
    CONodeFatalError();              \
    return (err);                    \
  }
#define ASSERT_EQU_ERR(var, val, err) \
  if ((var) != (val)) {               \
    return (err);                     \
  }
#define ASSERT_NOT(var, val) \
  if ((var) == (val)) {      \
    return;                  \
  }
#define ASSERT_NOT_ERR(var, val, err) \
  if ((var) == (val)) {               \
    return (err);                     \
  }
#define ASSERT_LOWER(var, limit) \
  if ((var) >= (limit)) {        \
    return;                      \
  }
#define ASSERT_LOWER_ERR(var, limit, err) \
  if ((var) >= (limit)) {                 \
    return (err);                         \
  }
/// \}

#ifdef __cplusplus
}
#endif

#endif
