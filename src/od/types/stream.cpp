// SPDX-License-Identifier: Apache-2.0
// Extensible streams without memory: only an extension can access them.
#include "co_od.h"

#if USE_OD

extern "C" {

const OD_TYPE ODTStream = OD_STREAM(nullptr, OD_DISABLED);

}  // extern "C"

#endif
