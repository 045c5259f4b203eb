// SPDX-License-Identifier: Apache-2.0
// Extensible numbers without memory: only an extension can access them.
#include "co_od.h"

#if USE_OD

extern "C" {

const OD_TYPE ODTNumber = OD_VALUE(nullptr, OD_DISABLED);

}  // extern "C"

#endif
