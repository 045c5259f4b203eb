// SPDX-License-Identifier: Apache-2.0
#include "sdo_request.h"

#define TIME_OUT 600000u  // ms for each response: minutes, because the test runs on busy machines

// State of each client: the waiting task, and the result. To be accessed with the lock of the node held.
static struct {
  TaskHandle_t Waits;
  uint32_t Code;
  bool Over;
} Requests[CO_CSDO_N];

// Ends the wait of the task. Called in the task of the node, with the lock held.
static void Done(CO_CSDO* client, uint16_t index, uint8_t sub, uint32_t code) {
  CO_UNUSED(index);
  CO_UNUSED(sub);
  for (uint8_t n = 0; n < CO_CSDO_N; ++n) {
    if (COCSdoFind(client->Node, n) == client) {
      Requests[n].Code = code;
      Requests[n].Over = true;
      (void)xTaskNotifyGive(Requests[n].Waits);
    }
  }
}

static CO_ERR Start(SDO_REQUEST* self, CO_CSDO* client, uint32_t key, uint8_t* buffer, uint32_t size, bool reads) {
  Requests[self->Client].Waits = xTaskGetCurrentTaskHandle();
  Requests[self->Client].Over = false;
  return reads ? COCSdoRequestUpload(client, key, buffer, size, Done, TIME_OUT)
               : COCSdoRequestDownload(client, key, buffer, size, Done, TIME_OUT);
}

// Transfers the data and waits for the end. The task may be notified for another reason, so Over is checked.
static uint32_t Transfer(SDO_REQUEST* self, uint32_t key, uint8_t* buffer, uint32_t size, uint32_t* num, bool reads) {
  NodeTaskLock(self->Node);
  CO_CSDO* const client = COCSdoFind(&self->Node->Node, self->Client);
  const bool started = Start(self, client, key, buffer, size, reads) == CO_ERR_NONE;
  while (started && !Requests[self->Client].Over) {
    NodeTaskUnlock(self->Node);
    (void)ulTaskNotifyTake(pdTRUE, portMAX_DELAY);
    NodeTaskLock(self->Node);
  }
  const uint32_t code = started ? Requests[self->Client].Code : CO_SDO_ERR_TOS_STATE;
  *num = COCSdoGetNum(client);
  NodeTaskUnlock(self->Node);
  return code;
}

uint32_t SdoRead(SDO_REQUEST* self, uint32_t key, uint8_t* buffer, uint32_t size, uint32_t* num) {
  return Transfer(self, key, buffer, size, num, true);
}

uint32_t SdoWrite(SDO_REQUEST* self, uint32_t key, const uint8_t* buffer, uint32_t size) {
  uint32_t num = 0;
  return Transfer(self, key, (uint8_t*)buffer, size, &num, false);
}
