// SPDX-License-Identifier: Apache-2.0
// Implements the declarations of FreeRTOS.h with POSIX threads: a task is a thread, a tick is a millisecond.
#define _POSIX_C_SOURCE 200809L

#include <assert.h>
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <time.h>

#include "semphr.h"
#include "task.h"

#define NS_PER_TICK 1000000L
#define NS_PER_SECOND 1000000000L

typedef struct TASK_T {
  pthread_t Thread;
  pthread_mutex_t Mutex;
  pthread_cond_t Changed;
  uint32_t Notifications;
  TaskFunction_t Code;
  void* Parameter;
} TASK;

static_assert(sizeof(TASK) <= sizeof(StaticTask_t), "memory of a task");
static_assert(sizeof(pthread_mutex_t) <= sizeof(StaticSemaphore_t), "memory of a mutex");

static _Thread_local TaskHandle_t Current;
static pthread_mutex_t Critical = PTHREAD_MUTEX_INITIALIZER;

static void Check(int error) {
  if (error != 0) {
    abort();
  }
}

static TASK* Of(TaskHandle_t task) { return (TASK*)(void*)task; }

static pthread_mutex_t* MutexOf(SemaphoreHandle_t mutex) { return (pthread_mutex_t*)(void*)mutex; }

static struct timespec Now(void) {
  struct timespec now;
  Check(clock_gettime(CLOCK_MONOTONIC, &now));
  return now;
}

static void Prepare(TASK* task) {
  pthread_condattr_t attributes;
  Check(pthread_condattr_init(&attributes));
  Check(pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC));
  Check(pthread_mutex_init(&task->Mutex, NULL));
  Check(pthread_cond_init(&task->Changed, &attributes));
  task->Notifications = 0;
}

static void* Run(void* parameter) {
  Current = (TaskHandle_t)parameter;
  Of(Current)->Code(Of(Current)->Parameter);
  return NULL;
}

TaskHandle_t xTaskCreateStatic(TaskFunction_t code, const char* name, uint32_t stackDepth, void* parameter,
                               UBaseType_t priority, StackType_t* stack, StaticTask_t* task) {
  (void)name;
  (void)stackDepth;
  (void)priority;
  (void)stack;
  Prepare(Of(task));
  Of(task)->Code = code;
  Of(task)->Parameter = parameter;
  Check(pthread_create(&Of(task)->Thread, NULL, Run, task));
  return task;
}

// Returns the current task; the main thread also becomes one.
TaskHandle_t xTaskGetCurrentTaskHandle(void) {
  static StaticTask_t first;
  if (Current == NULL) {
    Prepare(Of(&first));
    Current = &first;
  }
  return Current;
}

TickType_t xTaskGetTickCount(void) {
  const struct timespec now = Now();
  return (TickType_t)((uint64_t)now.tv_sec * 1000u + (uint64_t)(now.tv_nsec / NS_PER_TICK));
}

void vTaskDelay(TickType_t ticks) {
  const struct timespec time = {(time_t)(ticks / 1000u), (long)(ticks % 1000u) * NS_PER_TICK};
  (void)nanosleep(&time, NULL);
}

static struct timespec TickAfter(TickType_t ticks) {
  struct timespec time = Now();
  time.tv_sec += (time_t)(ticks / 1000u);
  time.tv_nsec = (time.tv_nsec / NS_PER_TICK + (long)(ticks % 1000u)) * NS_PER_TICK;
  time.tv_sec += time.tv_nsec / NS_PER_SECOND;
  time.tv_nsec %= NS_PER_SECOND;
  return time;
}

uint32_t ulTaskNotifyTake(BaseType_t clearOnExit, TickType_t ticks) {
  TASK* const self = Of(xTaskGetCurrentTaskHandle());
  const struct timespec end = TickAfter(ticks);
  int error = 0;
  Check(pthread_mutex_lock(&self->Mutex));
  while (self->Notifications == 0 && ticks != 0 && error != ETIMEDOUT) {
    error = ticks == portMAX_DELAY ? pthread_cond_wait(&self->Changed, &self->Mutex)
                                   : pthread_cond_timedwait(&self->Changed, &self->Mutex, &end);
  }
  const uint32_t before = self->Notifications;
  self->Notifications = clearOnExit != pdFALSE || before == 0 ? 0 : before - 1;
  Check(pthread_mutex_unlock(&self->Mutex));
  return before;
}

BaseType_t xTaskNotifyGive(TaskHandle_t task) {
  Check(pthread_mutex_lock(&Of(task)->Mutex));
  ++Of(task)->Notifications;
  Check(pthread_cond_signal(&Of(task)->Changed));
  Check(pthread_mutex_unlock(&Of(task)->Mutex));
  return pdTRUE;
}

void vTaskNotifyGiveFromISR(TaskHandle_t task, BaseType_t* woken) {
  *woken = pdTRUE;
  (void)xTaskNotifyGive(task);
}

void taskENTER_CRITICAL(void) { Check(pthread_mutex_lock(&Critical)); }

void taskEXIT_CRITICAL(void) { Check(pthread_mutex_unlock(&Critical)); }

SemaphoreHandle_t xSemaphoreCreateMutexStatic(StaticSemaphore_t* memory) {
  Check(pthread_mutex_init(MutexOf(memory), NULL));
  return memory;
}

// Takes the mutex; a time-out is not supported. RTOS_STUB_WITHOUT_MUTEX: takes nothing, so that the thread sanitizer
// must detect data races.
BaseType_t xSemaphoreTake(SemaphoreHandle_t mutex, TickType_t ticks) {
  Check(ticks == portMAX_DELAY ? 0 : 1);
#ifndef RTOS_STUB_WITHOUT_MUTEX
  Check(pthread_mutex_lock(MutexOf(mutex)));
#else
  (void)mutex;
#endif
  return pdTRUE;
}

BaseType_t xSemaphoreGive(SemaphoreHandle_t mutex) {
#ifndef RTOS_STUB_WITHOUT_MUTEX
  Check(pthread_mutex_unlock(MutexOf(mutex)));
#else
  (void)mutex;
#endif
  return pdTRUE;
}
