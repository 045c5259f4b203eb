// SPDX-License-Identifier: Apache-2.0
// Extensible TIME_OF_DAY and TIME_DIFFERENCE.
#include "co_od.h"

#if USE_OD

extern "C" {

const OD_TYPE ODTTimeOfDay = OD_VALUE(&COTTimeOfDay, OD_ORIGINAL);

}  // extern "C"

#endif
