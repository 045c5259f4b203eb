// SPDX-License-Identifier: Apache-2.0
#include "node_task.h"

static NODE_TASK* TaskOf(void* ctx) { return (NODE_TASK*)ctx; }

// The CAN driver. Interrupt and task share only the ring.
static void Init(void* ctx) {
  NODE_TASK* const self = TaskOf(ctx);
  self->Can->Stop(self->CanCtx);
  (void)CORingInit(&self->Received, self->ReceivedMem, NODE_TASK_FRAMES);
  self->Lost = 0;
}

static void Enable(void* ctx, uint32_t baud) { TaskOf(ctx)->Can->Start(TaskOf(ctx)->CanCtx, baud); }

static int16_t Read(void* ctx, CO_IF_FRM* frame) {
  return CORingGet(&TaskOf(ctx)->Received, frame) ? (int16_t)sizeof(CO_IF_FRM) : 0;
}

static int16_t Send(void* ctx, const CO_IF_FRM* frame) {
  return TaskOf(ctx)->Can->Write(TaskOf(ctx)->CanCtx, frame) ? (int16_t)sizeof(CO_IF_FRM) : 0;
}

// Restarts the controller and empties the ring as its consumer: the interrupt may put frames meanwhile.
static void Reset(void* ctx) {
  TaskOf(ctx)->Can->Restart(TaskOf(ctx)->CanCtx);
  CORingClear(&TaskOf(ctx)->Received);
}

static void Close(void* ctx) { TaskOf(ctx)->Can->Stop(TaskOf(ctx)->CanCtx); }

static const CO_IF_CAN_DRV_EX CanDriver = {Init, Enable, Read, Send, Reset, Close, NULL, NULL};

// The timer driver: its clock is the tick of the RTOS. It has no alarm, because the task computes its waiting time.
static void InitClock(void* ctx, uint32_t freq) {
  CO_UNUSED(ctx);
  CO_UNUSED(freq);
}

static uint32_t Now(void* ctx) {
  CO_UNUSED(ctx);
  return (uint32_t)xTaskGetTickCount();
}

static const CO_IF_TIMER_DRV_EX TimerDriver = {InitClock, Now, NULL};

// Locks the objects that are mapped together: see CO_NODE_EXT.OdLock. The critical section excludes other tasks and the
// interrupts that may use objects.
static void LockObjects(void* user) {
  CO_UNUSED(user);
  taskENTER_CRITICAL();
}

static void UnlockObjects(void* user) {
  CO_UNUSED(user);
  taskEXIT_CRITICAL();
}

void NodeTaskLock(NODE_TASK* self) { (void)xSemaphoreTake(self->Mutex, portMAX_DELAY); }

// Unlocks the node, and notifies its task: the calls before may have started a timer or queued frames, which changes
// its waiting time.
void NodeTaskUnlock(NODE_TASK* self) {
  (void)xSemaphoreGive(self->Mutex);
  (void)xTaskNotifyGive(self->Task);
}

static void ReportLostFrames(NODE_TASK* self) {
  const uint16_t lost = CORingLost(&self->Received);
  if (lost != self->Lost) {
    self->Lost = lost;
    CONodeCanEvent(&self->Node, CO_CAN_OVERRUN);
  }
}

// Processes the node. Returns the ticks until its next deadline; portMAX_DELAY: none.
static TickType_t Process(NODE_TASK* self) {
  CONodeProcess(&self->Node);
  (void)COTmrService(&self->Node.Tmr);
  COTmrProcess(&self->Node.Tmr);
  ReportLostFrames(self);
  return CORingCount(&self->Received) != 0 ? 0 : (TickType_t)CONodeNextDeadline(&self->Node);
}

// Runs the node. A notification between Process() and the wait is not lost: the wait then ends at once.
static void Run(void* parameter) {
  NODE_TASK* const self = TaskOf(parameter);
  for (;;) {
    (void)xSemaphoreTake(self->Mutex, portMAX_DELAY);
    const TickType_t wait = Process(self);
    (void)xSemaphoreGive(self->Mutex);
    (void)ulTaskNotifyTake(pdTRUE, wait);
  }
}

static void NameDrivers(NODE_TASK* self) {
  self->Ext.Size = sizeof(self->Ext);
  self->Ext.Can = &CanDriver;
  self->Ext.CanCtx = self;
  self->Ext.Timer = &TimerDriver;
  self->Ext.OdLock = LockObjects;
  self->Ext.OdUnlock = UnlockObjects;
  self->Ext.User = self;
}

// Creates the task before the node, so that the first interrupt can notify it; until the node is started, the task
// waits for the lock.
CO_ERR NodeTaskStart(NODE_TASK* self, const CO_NODE_SPEC* spec) {
  CO_NODE_SPEC complete = *spec;
  complete.TmrFreq = configTICK_RATE_HZ;
  NameDrivers(self);
  self->Mutex = xSemaphoreCreateMutexStatic(&self->MutexMem);
  (void)xSemaphoreTake(self->Mutex, portMAX_DELAY);
  self->Task = xTaskCreateStatic(Run, "node", NODE_TASK_STACK, self, NODE_TASK_PRIORITY, self->Stack, &self->TaskMem);
  CONodeInitEx(&self->Node, &complete, &self->Ext);
  const CO_ERR error = CONodeGetErr(&self->Node);
  CONodeStart(&self->Node);
  NodeTaskUnlock(self);
  return error;
}

void NodeTaskReceivedFromISR(NODE_TASK* self, const CO_IF_FRM* frame) {
  BaseType_t woken = pdFALSE;
  (void)CORingPut(&self->Received, frame);
  vTaskNotifyGiveFromISR(self->Task, &woken);
  portYIELD_FROM_ISR(woken);
}

void NodeTaskSentFromISR(NODE_TASK* self) {
  BaseType_t woken = pdFALSE;
  vTaskNotifyGiveFromISR(self->Task, &woken);
  portYIELD_FROM_ISR(woken);
}
