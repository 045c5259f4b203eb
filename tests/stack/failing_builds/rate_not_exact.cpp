// SPDX-License-Identifier: Apache-2.0
// expect: RequiredIf
// expect: CO_CAN_FDCAN_RATE_OF
// 170 MHz is not a multiple of 800 kbit/s with any number of quanta.
#include "../../../drivers/can/fdcan/co_can_fdcan.h"

constexpr CO_CAN_FDCAN_RATE rates[] = {CO_CAN_FDCAN_RATE_OF(170000000, 800000, 170)};
