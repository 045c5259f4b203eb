// SPDX-License-Identifier: Apache-2.0
/// \file flash_stm32.h
/// Flash memories of STM32 controllers.
#ifndef FLASH_STM32_H_
#define FLASH_STM32_H_

#include "co_nvm_flash_pages.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_FLASH_PAGES FlashStm32f4;  ///< flash_stm32.c
extern const CO_FLASH_PAGES FlashStm32g4;  ///< flash_stm32.c
extern const CO_FLASH_PAGES FlashStm32h7;  ///< flash_stm32h7.c

/// Notes that a damaged double word of the parameters was read. Call it in NMI_Handler() of an STM32G4.
/// \retval false  the NMI has another reason: the program is damaged, for example
bool FlashStm32g4Nmi(void);

#ifdef __cplusplus
}
#endif

#endif
