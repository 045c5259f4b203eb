// SPDX-License-Identifier: Apache-2.0
#include "callback_place.h"
#include "co_core.h"

void COIfCanReceive(CO_IF_FRM* frm) {
  (void)frm;
  CallsOfTheCallback++;
}
