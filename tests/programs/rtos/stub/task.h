// SPDX-License-Identifier: Apache-2.0
#ifndef TASK_STUB_H_
#define TASK_STUB_H_

#include "FreeRTOS.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef StaticTask_t* TaskHandle_t;
typedef void (*TaskFunction_t)(void*);

TaskHandle_t xTaskCreateStatic(TaskFunction_t code, const char* name, uint32_t stackDepth, void* parameter,
                               UBaseType_t priority, StackType_t* stack, StaticTask_t* task);
TaskHandle_t xTaskGetCurrentTaskHandle(void);
TickType_t xTaskGetTickCount(void);
void vTaskDelay(TickType_t ticks);
uint32_t ulTaskNotifyTake(BaseType_t clearOnExit, TickType_t ticks);
BaseType_t xTaskNotifyGive(TaskHandle_t task);
void vTaskNotifyGiveFromISR(TaskHandle_t task, BaseType_t* woken);
void taskENTER_CRITICAL(void);
void taskEXIT_CRITICAL(void);

#ifdef __cplusplus
}
#endif

#endif
