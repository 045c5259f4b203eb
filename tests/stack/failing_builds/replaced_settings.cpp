// SPDX-License-Identifier: Apache-2.0
// expect: USE_EMCY_QUEUE was replaced: CO_EMCY_QUEUE_N 0
// expect: USE_CSDO_BLOCK was replaced: CO_CSDO_BLOCK 0
// expect: CO_MPDO_N is the length of both lists
// Settings of earlier versions: the message names the successor.
#define USE_EMCY_QUEUE 0
#define USE_CSDO_BLOCK 0
#define USE_MPDO 1
#include "co_core.h"
