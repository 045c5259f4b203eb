// SPDX-License-Identifier: Apache-2.0
// Streams of an extension alone: types that can be extended.
#include "co_od.h"

#if USE_OD

extern "C" {

const OD_TYPE ODTStream = OD_STREAM(nullptr, OD_DISABLED);

}  // extern "C"

#endif
