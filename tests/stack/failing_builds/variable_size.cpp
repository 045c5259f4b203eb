// SPDX-License-Identifier: Apache-2.0
// expect: negative
// A variable of 1 byte for a type of 4.
#include "co_core.h"

uint8_t speed;

constexpr CO_OBJ od[] = {{CO_KEY(0x2000, 0, CO_OBJ_____RW), CO_VAR(UNSIGNED32, speed)}};
