// SPDX-License-Identifier: Apache-2.0
// Decoder of error frames. Only programs whose CAN driver names it (CO_IF_CAN_DRV_EX.Report) link it.
#include "co_core.h"
#include "wire/can_error.hpp"

extern "C" void CONodeCanReport(void*, CO_NODE* node, const CO_IF_FRM* frm) {
  ASSERT_PTR_FATAL(node);
  ASSERT_PTR_FATAL(frm);
  if ((frm->Identifier & CO_IF_FRM_ERROR) == 0) {
    return;
  }
  for (uint8_t event = 0; event < CO_CAN_EVENT_NUM; ++event) {
    if (co::wire::reports(*frm, static_cast<CO_CAN_EVENT>(event))) {
      CONodeCanEvent(node, static_cast<CO_CAN_EVENT>(event));
    }
  }
}
