// SPDX-License-Identifier: Apache-2.0
/// \file co_assert.h
/// Checks of the stack's own invariants, which USE_ASSERT (co_cfg.h) enables. Arguments of API functions are checked
/// with and without it (co_types.h), as are all data from the bus.
#ifndef CO_ASSERT_H_
#define CO_ASSERT_H_

#include "co_cfg.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \cond internal
#ifndef USE_ASSERT
#define USE_ASSERT 0
#endif
/// \endcond

/// Called when the state of the stack is wrong: by a defect of the stack, or because another part of the program has
/// overwritten its memory. \a condition is the text of what should hold at \a file and \a line. The application may
/// define it, for example to log its arguments; the default calls CONodeFatalError(). It may return: the stack then
/// continues as without USE_ASSERT.
void COAssertFailed(const char* condition, const char* file, int line);

/// Checks an invariant of the stack with USE_ASSERT 1; with 0, nothing is evaluated.
#if USE_ASSERT
#define CO_ASSERT(condition) ((condition) ? (void)0 : COAssertFailed(#condition, __FILE__, __LINE__))
#else
#define CO_ASSERT(condition) ((void)0)
#endif

#ifdef __cplusplus
}  // extern "C"
#endif

#endif
