// SPDX-License-Identifier: Apache-2.0
// The firmware of demo/makefile: a node with the driver templates in place of the drivers of a real controller.
#include "co_can_template.h"
#include "co_core.h"
#include "co_timer_template.h"

static uint8_t ErrorRegister;
static uint16_t HeartbeatTime = 500;  // ms

static CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // device type: no profile
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&HeartbeatTime)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},   // identity: one entry
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // vendor-ID
    CO_OBJ_DICT_ENDMARK};

static CO_IF_DRV Drivers = {&TemplateCanDriver, &TemplateTimerDriver, NULL};
static CO_NODE Node;

int main(void) {
  CO_NODE_SPEC spec = {.NodeId = 5, .Baudrate = 250000, .Dict = Dictionary, .DictLen = 6, .TmrFreq = 1000};
  spec.Drv = &Drivers;
  CONodeInit(&Node, &spec);
  CONodeStart(&Node);
  for (;;) {
    CONodeProcess(&Node);
    COTmrProcess(&Node.Tmr);  // COTmrService() runs in the timer interrupt
  }
}
