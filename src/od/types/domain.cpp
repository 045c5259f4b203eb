// SPDX-License-Identifier: Apache-2.0
// Extensible domains.
#include "co_od.h"

#if USE_OD

extern "C" {

const OD_TYPE ODTDomain = OD_STREAM(&COTDomain, OD_ORIGINAL);

}  // extern "C"

#endif
