// SPDX-License-Identifier: Apache-2.0
// Extensible numbers of 8, 16 and 32 bits, REAL32 and BOOLEAN.
#include "co_od.h"

#if USE_OD

extern "C" {

const OD_TYPE ODTInt8 = OD_VALUE(&COTInt8, OD_ORIGINAL);
const OD_TYPE ODTInt16 = OD_VALUE(&COTInt16, OD_ORIGINAL);
const OD_TYPE ODTInt32 = OD_VALUE(&COTInt32, OD_ORIGINAL);
const OD_TYPE ODTReal32 = OD_VALUE(&COTReal32, OD_ORIGINAL);
const OD_TYPE ODTBoolean = OD_VALUE(&COTBoolean, OD_ORIGINAL);

}  // extern "C"

#endif
