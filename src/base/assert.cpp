// SPDX-License-Identifier: Apache-2.0
// Default callback of CO_ASSERT: a weak symbol, which a definition of the application replaces.
#include "co_assert.h"
#include "co_types.h"

#if USE_ASSERT

extern "C" WEAK void COAssertFailed(const char*, const char*, int) { CONodeFatalError(); }

#endif
