// SPDX-License-Identifier: Apache-2.0
// Declarations of the FreeRTOS functions that the example uses, to compile and run it without FreeRTOS. Written from
// the documentation of the API; contains no code of FreeRTOS.
#ifndef FREERTOS_STUB_H_
#define FREERTOS_STUB_H_

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef long BaseType_t;
typedef unsigned long UBaseType_t;
typedef uint32_t TickType_t;
typedef uintptr_t StackType_t;

#define pdFALSE ((BaseType_t)0)
#define pdTRUE ((BaseType_t)1)
#define portMAX_DELAY ((TickType_t)0xFFFFFFFFu)
#define configTICK_RATE_HZ ((TickType_t)1000)
#define portYIELD_FROM_ISR(woken) ((void)(woken))

// Memory for the data of a task or mutex.
typedef struct StaticTask {
  uintptr_t Memory[32];
} StaticTask_t;

typedef struct StaticSemaphore {
  uintptr_t Memory[16];
} StaticSemaphore_t;

#ifdef __cplusplus
}
#endif

#endif
