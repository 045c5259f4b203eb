// SPDX-License-Identifier: Apache-2.0
#include "example_main.h"

#include "example_cpu.h"

CO_NODE Node;

static CO_IF_DRV Drivers = {&ExampleCanDriver, &ExampleTimerDriver, &ExampleNvmDriver};
static volatile bool Happened;  // an interrupt has occurred since the current iteration of the loop began

void CAN_IRQHandler(void) {
  ExampleCanInterrupt();
  Happened = true;
}

void TIMER_IRQHandler(void) {
  ExampleTimerInterrupt();
  (void)COTmrService(&Node.Tmr);
  Happened = true;
}

// Prevent TIMER_IRQHandler() while the timer lists change. The calls do not nest.
void COTmrLock(void) { CpuDisableInterrupts(); }
void COTmrUnlock(void) { CpuEnableInterrupts(); }

bool NodeStart(CO_NODE_SPEC* spec) {
  spec->Drv = &Drivers;
  CONodeInit(&Node, spec);
  if (CONodeGetErr(&Node) != CO_ERR_NONE) {
    return false;
  }
  CONodeStart(&Node);
  return true;
}

// Sleeps unless an interrupt has occurred. WFI returns when an interrupt is pending, even if interrupts are disabled;
// the interrupt is served when they are enabled again. So no interrupt can be missed between the check and WFI.
static void SleepUntilInterrupt(void) {
  CpuDisableInterrupts();
  if (!Happened) {
    CpuWaitForInterrupt();
  }
  CpuEnableInterrupts();
}

void NodeRunOnce(void) {
  Happened = false;
  CONodeProcess(&Node);
  COTmrProcess(&Node.Tmr);
  ExampleCanReport(&Node);
  if (!ExampleCanHasWork() && CONodeNextDeadline(&Node) != 0) {
    SleepUntilInterrupt();
  }
}
