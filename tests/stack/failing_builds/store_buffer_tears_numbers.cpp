// SPDX-License-Identifier: Apache-2.0
// expect: CO_STORE_BUFFER: a multiple of 8 with USE_REAL_TIME, or stored numbers may be partially written
// Another thread may get the node lock between two pieces of a stored record: a number must not span both.
#define USE_REAL_TIME 1
#define CO_STORE_BUFFER 12
#include "co_core.h"
