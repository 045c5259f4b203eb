// SPDX-License-Identifier: Apache-2.0
// Example of docs/porting.md: the driver check on a port.
#include "co_driver_check.h"
#include "example_board.h"

uint16_t CheckMyPort(void (*print)(void* user, const char* line));
void TIMER_IRQHandler(void);

static CO_DRIVER_CHECK Check;

void TIMER_IRQHandler(void) {
  ExampleTimerInterrupt();
  CODriverCheckService(&Check);
}

uint16_t CheckMyPort(void (*print)(void* user, const char* line)) {
  static const CO_IF_DRV drivers = {&ExampleCanDriver, &ExampleTimerDriver, &ExampleNvmDriver};
  Check.Drv = &drivers;
  Check.Print = print;
  Check.Bus = CO_CHECK_FEED;
  Check.Frames = CO_CHECK_29_BIT | CO_CHECK_REMOTE;
  Check.Burst = 32;
  Check.TmrFreq = 10000;
  Check.Late = 2;
  Check.NvmSize = EXAMPLE_EEPROM_SIZE;
  return CODriverCheck(&Check);
}
