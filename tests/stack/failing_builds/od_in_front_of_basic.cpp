// SPDX-License-Identifier: Apache-2.0
// expect to compile
// With OD_ALL a basic type itself has another name.
#define USE_OD 1
#define OD_ALL
#include "co_od.h"

const CO_OBJ_TYPE own = {};
inline constexpr OD_TYPE own_type = OD_VALUE(&own, OD_ORIGINAL);
inline constexpr OD_TYPE number_type = OD_VALUE(&COTInt32, OD_DISABLED);
inline constexpr OD_TYPE domain_type = OD_STREAM(&COTDomain, OD_DISABLED);
inline constexpr OD_TYPE nothing_type = OD_STREAM(nullptr, OD_DISABLED);
