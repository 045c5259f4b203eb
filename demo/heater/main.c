// SPDX-License-Identifier: Apache-2.0
// The heater on a CAN interface of Linux: heater vcan0 9. It stores its parameters in the file heater.nvm.
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>

#include "co_can_socketcan.h"
#include "co_nvm_file.h"
#include "co_timer_linux.h"
#include "heater.h"
#include "heater_od.h"

int main(int count, char** arguments) {
  CO_SOCKETCAN* can = COSocketCanNew();
  CO_LINUX_TIMER* timer = COLinuxTimerNew();
  CO_FILE_NVM* memory = COFileNvmNew();
  CO_NODE_EXT drivers = {.Can = &COSocketCanDriver, .CanCtx = can, .Timer = &COLinuxTimerDriver, .TimerCtx = timer};
  drivers.Nvm = &COFileNvmDriver;
  drivers.NvmCtx = memory;
  if (count != 3) {
    fprintf(stderr, "usage: heater INTERFACE NODE-ID\n");
    return 2;
  }
  if (!COSocketCanOpen(can, arguments[1])) {
    fprintf(stderr, "heater: %s\n", COSocketCanError(can));
    return 1;
  }
  if (!COFileNvmOpen(memory, "heater.nvm", HEATER_PARA_END)) {
    fprintf(stderr, "heater: %s\n", COFileNvmError(memory));
    return 1;
  }
  if (!HeaterStart(&drivers, (uint8_t)atoi(arguments[2]))) {
    return 1;
  }
  for (;;) {
    const uint32_t deadline = HeaterRun();
    struct pollfd wait = {COSocketCanFd(can), POLLIN, 0};
    poll(&wait, 1, COLinuxTimerPollTimeout(timer, deadline));
  }
}
