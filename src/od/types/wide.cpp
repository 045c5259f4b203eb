// SPDX-License-Identifier: Apache-2.0
// Extensible numbers of 24, 40, 48, 56 and 64 bits, and REAL64.
#include "co_od.h"

#if USE_OD

extern "C" {

const OD_TYPE ODTInt64 = OD_VALUE(&COTInt64, OD_ORIGINAL);
const OD_TYPE ODTUnsigned24 = OD_VALUE(&COTUnsigned24, OD_ORIGINAL);
const OD_TYPE ODTUnsigned40 = OD_VALUE(&COTUnsigned40, OD_ORIGINAL);
const OD_TYPE ODTUnsigned48 = OD_VALUE(&COTUnsigned48, OD_ORIGINAL);
const OD_TYPE ODTUnsigned56 = OD_VALUE(&COTUnsigned56, OD_ORIGINAL);
const OD_TYPE ODTSigned24 = OD_VALUE(&COTSigned24, OD_ORIGINAL);
const OD_TYPE ODTSigned40 = OD_VALUE(&COTSigned40, OD_ORIGINAL);
const OD_TYPE ODTSigned48 = OD_VALUE(&COTSigned48, OD_ORIGINAL);
const OD_TYPE ODTSigned56 = OD_VALUE(&COTSigned56, OD_ORIGINAL);
const OD_TYPE ODTReal64 = OD_VALUE(&COTReal64, OD_ORIGINAL);

}  // extern "C"

#endif
