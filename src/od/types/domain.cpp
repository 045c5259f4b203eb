// SPDX-License-Identifier: Apache-2.0
// Domains that can be extended.
#include "co_od.h"

#if USE_OD

extern "C" {

const OD_TYPE ODTDomain = OD_STREAM(&COTDomain, OD_ORIGINAL);

}  // extern "C"

#endif
