// SPDX-License-Identifier: Apache-2.0
// Extensible strings.
#include "co_od.h"

#if USE_OD

extern "C" {

const OD_TYPE ODTString = OD_STREAM(&COTString, OD_ORIGINAL);
const OD_TYPE ODTVisibleString = OD_STREAM(&COTVisibleString, OD_ORIGINAL);
const OD_TYPE ODTOctetString = OD_STREAM(&COTOctetString, OD_ORIGINAL);
const OD_TYPE ODTUnicodeString = OD_STREAM(&COTUnicodeString, OD_ORIGINAL);

}  // extern "C"

#endif
