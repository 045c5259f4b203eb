// SPDX-License-Identifier: Apache-2.0
// expect: CO_CSDO_BLOCK needs USE_SDO_BLOCK
// Block transfer of the clients requires the setting for block transfer as a whole.
#define USE_SDO_BLOCK 0
#define CO_CSDO_BLOCK 29
#include "co_core.h"
