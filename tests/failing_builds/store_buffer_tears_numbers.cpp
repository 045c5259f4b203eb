// SPDX-License-Identifier: Apache-2.0
// expect: CO_STORE_BUFFER: a multiple of 8 with USE_REAL_TIME, or stored numbers may be torn
// Another thread has the turn between two pieces of what is stored: a number must not lie in both.
#define USE_REAL_TIME 1
#define CO_STORE_BUFFER 12
#include "co_core.h"
