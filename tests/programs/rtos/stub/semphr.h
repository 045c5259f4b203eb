// SPDX-License-Identifier: Apache-2.0
#ifndef SEMPHR_STUB_H_
#define SEMPHR_STUB_H_

#include "FreeRTOS.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef StaticSemaphore_t* SemaphoreHandle_t;

SemaphoreHandle_t xSemaphoreCreateMutexStatic(StaticSemaphore_t* memory);
BaseType_t xSemaphoreTake(SemaphoreHandle_t mutex, TickType_t ticks);
BaseType_t xSemaphoreGive(SemaphoreHandle_t mutex);

#ifdef __cplusplus
}
#endif

#endif
