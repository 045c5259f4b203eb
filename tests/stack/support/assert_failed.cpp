// SPDX-License-Identifier: Apache-2.0
// Ends a test program when an invariant of the stack is violated.
#include <co_assert.h>

#include <cstdio>
#include <cstdlib>

void COAssertFailed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: an invariant of the stack is violated: %s\n", file, line, condition);
  std::abort();
}
