// SPDX-License-Identifier: Apache-2.0
// Types whose objects can be extended.
#include "co_od.h"

#if USE_OD

extern "C" {

// Extensible numbers of 8, 16 and 32 bits, REAL32 and BOOLEAN.
const OD_TYPE ODTInt8 = OD_VALUE(&COTInt8, OD_ORIGINAL);
const OD_TYPE ODTInt16 = OD_VALUE(&COTInt16, OD_ORIGINAL);
const OD_TYPE ODTInt32 = OD_VALUE(&COTInt32, OD_ORIGINAL);
const OD_TYPE ODTReal32 = OD_VALUE(&COTReal32, OD_ORIGINAL);
const OD_TYPE ODTBoolean = OD_VALUE(&COTBoolean, OD_ORIGINAL);

// Extensible numbers of 24, 40, 48, 56 and 64 bits, and REAL64.
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

// Extensible TIME_OF_DAY and TIME_DIFFERENCE.
const OD_TYPE ODTTimeOfDay = OD_VALUE(&COTTimeOfDay, OD_ORIGINAL);

// Extensible strings.
const OD_TYPE ODTString = OD_STREAM(&COTString, OD_ORIGINAL);
const OD_TYPE ODTVisibleString = OD_STREAM(&COTVisibleString, OD_ORIGINAL);
const OD_TYPE ODTOctetString = OD_STREAM(&COTOctetString, OD_ORIGINAL);
const OD_TYPE ODTUnicodeString = OD_STREAM(&COTUnicodeString, OD_ORIGINAL);

// Extensible domains.
const OD_TYPE ODTDomain = OD_STREAM(&COTDomain, OD_ORIGINAL);

// Extensible numbers without memory: only an extension can access them.
const OD_TYPE ODTNumber = OD_VALUE(nullptr, OD_DISABLED);

// Extensible streams without memory: only an extension can access them.
const OD_TYPE ODTStream = OD_STREAM(nullptr, OD_DISABLED);

}  // extern "C"

#endif
