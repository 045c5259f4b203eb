// SPDX-License-Identifier: Apache-2.0
#include "co_can_fdcan.h"
#include "co_nvm_flash_pages.h"
#include "co_timer_systick.h"

const CO_IF_CAN_DRV_EX* Can = &FdcanCanDriver;
const CO_IF_NVM_DRV_EX* Nvm = &FlashPagesNvmDriver;
const CO_IF_TIMER_DRV_EX* Timer = &SysTickDriver;
