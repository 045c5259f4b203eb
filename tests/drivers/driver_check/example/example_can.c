// SPDX-License-Identifier: Apache-2.0
#include "example_board.h"

#define RECEIVE_QUEUE_FRAMES 32u

static CO_IF_FRM ReceiveMemory[RECEIVE_QUEUE_FRAMES];
static CO_RING ReceiveQueue;
static uint16_t ReportedLost;           // lost frames (queue full) already reported
static volatile uint8_t PendingEvents;  // bit n: CO_CAN_EVENT n, set by the interrupt

// Goes off the bus and disables the interrupts, so that the queue is not used while it is initialised.
static void Init(void) {
  ExampleCan.Control = 0;
  ExampleCan.Transmit.Request = 0;
  (void)CORingInit(&ReceiveQueue, ReceiveMemory, RECEIVE_QUEUE_FRAMES);
  ReportedLost = 0;
  PendingEvents = 0;
}

// Sets 16 time quanta per bit, with the sample point after 14 of them: 87.5 %.
static void Enable(uint32_t baud) {
  ExampleCan.BitTiming = (13u << 24) | (2u << 16) | (EXAMPLE_CLOCK / (16u * baud));
  ExampleCan.Control = EXAMPLE_CAN_ON | EXAMPLE_CAN_INTERRUPTS;
}

static int16_t Read(CO_IF_FRM* frm) { return CORingGet(&ReceiveQueue, frm) ? (int16_t)sizeof(CO_IF_FRM) : 0; }

static uint32_t Word(const uint8_t* bytes) {
  return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

// Sends a frame. The flags of the hardware's identifier have the same positions as in CO_IF_FRM.
static int16_t Send(CO_IF_FRM* frm) {
  const bool on = (ExampleCan.Control & EXAMPLE_CAN_ON) != 0;
  if (!on || ExampleCan.Transmit.Request != 0) {
    return 0;
  }
  ExampleCan.Transmit.Id = frm->Identifier;
  ExampleCan.Transmit.Length = frm->DLC;
  ExampleCan.Transmit.Data[0] = Word(&frm->Data[0]);
  ExampleCan.Transmit.Data[1] = Word(&frm->Data[4]);
  ExampleCan.Transmit.Request = 1;
  return (int16_t)sizeof(CO_IF_FRM);
}

static void Reset(void) {
  ExampleCan.Control = EXAMPLE_CAN_INTERRUPTS;  // off the bus and on again: ends bus-off
  ExampleCan.Transmit.Request = 0;
  CORingClear(&ReceiveQueue);
  ExampleCan.Control = EXAMPLE_CAN_ON | EXAMPLE_CAN_INTERRUPTS;
}

static void Close(void) {
  ExampleCan.Control = 0;
  ExampleCan.Transmit.Request = 0;
  CORingClear(&ReceiveQueue);
}

const CO_IF_CAN_DRV ExampleCanDriver = {Init, Enable, Read, Send, Reset, Close};

static void PutBytes(uint8_t* bytes, uint32_t word) {
  for (uint8_t n = 0; n < 4; ++n) {
    bytes[n] = (uint8_t)(word >> (8 * n));
  }
}

static void TakeFrame(void) {
  CO_IF_FRM frm;
  frm.Identifier = ExampleCan.Receive.Id;
  frm.DLC = (uint8_t)(ExampleCan.Receive.Length > 8 ? 8 : ExampleCan.Receive.Length);
  PutBytes(&frm.Data[0], ExampleCan.Receive.Data[0]);
  PutBytes(&frm.Data[4], ExampleCan.Receive.Data[1]);
  ExampleCan.Release = 1;
  (void)CORingPut(&ReceiveQueue, &frm);
}

// Fills the queue as its only producer, and stores events: only the loop may use the node.
void ExampleCanInterrupt(void) {
  const uint32_t status = ExampleCan.Status;
  if ((status & EXAMPLE_CAN_RECEIVED) != 0) {
    TakeFrame();
  }
  if ((status & EXAMPLE_CAN_LOST) != 0) {
    PendingEvents = PendingEvents | (uint8_t)(1u << CO_CAN_OVERRUN);
  }
  if ((status & EXAMPLE_CAN_BUS_OFF) != 0) {
    PendingEvents = PendingEvents | (uint8_t)(1u << CO_CAN_BUS_OFF);
  }
  ExampleCan.Clear = status & ~EXAMPLE_CAN_RECEIVED;
}

// Reads and clears the events with the interrupts of the controller disabled, so that none is lost.
static uint8_t TakeEvents(void) {
  const uint32_t control = ExampleCan.Control;
  ExampleCan.Control = control & ~EXAMPLE_CAN_INTERRUPTS;
  const uint8_t events = PendingEvents;
  PendingEvents = 0;
  ExampleCan.Control = control;
  return events;
}

void ExampleCanReport(CO_NODE* node) {
  const uint8_t events = PendingEvents == 0 ? 0 : TakeEvents();
  const uint16_t lost = CORingLost(&ReceiveQueue);
  if ((events & (1u << CO_CAN_OVERRUN)) != 0 || lost != ReportedLost) {
    ReportedLost = lost;
    CONodeCanEvent(node, CO_CAN_OVERRUN);
  }
  if ((events & (1u << CO_CAN_BUS_OFF)) != 0) {
    CONodeCanEvent(node, CO_CAN_BUS_OFF);
  }
}

bool ExampleCanHasWork(void) {
  return CORingCount(&ReceiveQueue) != 0 || PendingEvents != 0 || CORingLost(&ReceiveQueue) != ReportedLost;
}
