// SPDX-License-Identifier: Apache-2.0
// Numbers of an extension alone: types that can be extended.
#include "co_od.h"

#if USE_OD

extern "C" {

const OD_TYPE ODTNumber = OD_VALUE(nullptr, OD_DISABLED);

}  // extern "C"

#endif
