// SPDX-License-Identifier: Apache-2.0
#include "example_main.h"

#include "example_cpu.h"

CO_NODE Node;

static CO_IF_DRV Drivers = {&ExampleCanDriver, &ExampleTimerDriver, &ExampleNvmDriver};
static volatile bool Happened;  // an interrupt, since the loop has begun its turn

void CAN_IRQHandler(void) {
  ExampleCanInterrupt();
  Happened = true;
}

void TIMER_IRQHandler(void) {
  ExampleTimerInterrupt();
  (void)COTmrService(&Node.Tmr);
  Happened = true;
}

// Keep TIMER_IRQHandler() away while the timer lists change. They do not nest.
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

// WFI ends with an interrupt that is pending, also where interrupts are disabled; it is taken when they are enabled
// again. So none can come between the question and the sleep and be slept through.
static void SleepUntilInterrupt(void) {
  CpuDisableInterrupts();
  if (!Happened) {
    CpuWaitForInterrupt();
  }
  CpuEnableInterrupts();
}

void NodeTurn(void) {
  Happened = false;
  CONodeProcess(&Node);
  COTmrProcess(&Node.Tmr);
  ExampleCanReport(&Node);
  if (!ExampleCanHasWork() && CONodeNextDeadline(&Node) != 0) {
    SleepUntilInterrupt();
  }
}
