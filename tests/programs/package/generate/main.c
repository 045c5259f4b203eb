/* SPDX-License-Identifier: Apache-2.0 */
#include "clock_od.h"

CO_OBJ_DOM clock_2002_0 = {0, 0, 0};

int speed(void) { return clock_drive.speed; }
