// SPDX-License-Identifier: Apache-2.0
#include "co_can_template.h"

#include "co_ring.h"

// Length of the receive queue, frames. It has to hold the frames that arrive while the loop is busy: at 1 Mbit/s a
// frame takes at least 47 us (no data, 11-bit identifier), one with 8 bytes about 110 us.
#define RECEIVE_QUEUE_FRAMES 32u

static CO_IF_FRM ReceiveMemory[RECEIVE_QUEUE_FRAMES];
static CO_RING ReceiveQueue;
static uint16_t ReportedLost;           // lost frames (queue full) that are already reported to the node
static volatile uint8_t PendingEvents;  // bit n: CO_CAN_EVENT n, set by the interrupt

// Context: the loop, in CONodeInit(). Prepare the controller (clock, pins, interrupt), but stay off the bus: the bit
// rate is not known yet. Called again, before Enable, when LSS changes the bit rate.
static void Init(void) {
  // Here: disable the controller's interrupts, enter its initialisation mode, clear the transmit mailboxes. The
  // interrupt does not use the queue after that.
  (void)CORingInit(&ReceiveQueue, ReceiveMemory, RECEIVE_QUEUE_FRAMES);
  ReportedLost = 0;
  PendingEvents = 0;
}

// Context: the loop. Set the bit timing for baud bit/s (sample point at 87.5 % of the bit for CANopen) and go on the
// bus. Receive all identifiers, or set the filters (CO_IF_CAN_DRV_EX.Filter).
static void Enable(uint32_t baud) {
  CO_UNUSED(baud);  // Here: bit timing registers, normal mode, receive, transmit and error interrupts on.
}

// Context: the loop. Returns sizeof(CO_IF_FRM): a frame was read; 0: none received; -1: the controller reports an
// error.
static int16_t Read(CO_IF_FRM* frm) { return CORingGet(&ReceiveQueue, frm) ? (int16_t)sizeof(CO_IF_FRM) : 0; }

// Context: the loop. Must not block or reorder frames: if the controller has several transmit mailboxes, set them to
// send in the order of writing, or use one.
// Returns sizeof(CO_IF_FRM): the controller has accepted the frame; 0: no free mailbox, or off the bus; -1: error.
// After 0 and -1 the stack tries again.
static int16_t Send(CO_IF_FRM* frm) {
  CO_UNUSED(frm);
  // Here: return 0 if no mailbox is free; else write
  //   CO_GET_ID(frm) & CO_IF_FRM_ID     the identifier; 29 bits if CO_IF_FRM_EXT is set in CO_GET_ID(frm), else 11
  //   CO_GET_ID(frm) & CO_IF_FRM_RTR    remote frame
  //   CO_GET_DLC(frm), frm->Data        the data; the first byte on the bus is Data[0]
  // start the transmission and return (int16_t)sizeof(CO_IF_FRM).
  return 0;
}

// Context: the loop, at an NMT reset. Clear errors and queues, and go back on the bus (leave bus-off).
static void Reset(void) {
  // Here: clear the transmit mailboxes, restart the controller if it is in bus-off.
  CORingClear(&ReceiveQueue);
}

// Context: the loop, in CONodeStop(), and when LSS changes the bit rate. Go off the bus.
static void Close(void) {
  // Here: disable the interrupts, enter the initialisation mode, clear the transmit mailboxes.
  CORingClear(&ReceiveQueue);
}

const CO_IF_CAN_DRV TemplateCanDriver = {Init, Enable, Read, Send, Reset, Close};

// Context: the interrupt of the controller, the only producer of the queue. If the queue is full, the frame is counted
// as lost. Events are only stored: the node may be used by the loop only. If transmission has a separate interrupt, it
// only has to wake the loop.
void TemplateCanInterrupt(void) {
  const bool received = false;  // Here: is there a frame in the controller?
  if (received) {
    CO_IF_FRM frm = {0, {0}, 0};
    // Here: CO_SET_ID(&frm, identifier | flags), CO_SET_DLC(&frm, length, 8 at most), copy the data, release the
    // mailbox.
    (void)CORingPut(&ReceiveQueue, &frm);
  }
  const uint8_t events = 0;  // Here: bit CO_CAN_OVERRUN, CO_CAN_PASSIVE, CO_CAN_BUS_OFF, CO_CAN_RECOVERED, if new
  PendingEvents = (uint8_t)(PendingEvents | events);
}

// Returns and clears the events stored by the interrupt, which must not add one between the two steps.
static uint8_t TakeEvents(void) {
  // Here: disable the controller's interrupts.
  const uint8_t events = PendingEvents;
  PendingEvents = 0;
  // Here: enable them again.
  return events;
}

void TemplateCanReport(CO_NODE* node) {
  uint8_t events = PendingEvents == 0 ? 0 : TakeEvents();
  const uint16_t lost = CORingLost(&ReceiveQueue);
  if (lost != ReportedLost) {
    ReportedLost = lost;
    events = (uint8_t)(events | 1u << CO_CAN_OVERRUN);
  }
  for (uint8_t event = 0; event < CO_CAN_EVENT_NUM; ++event) {
    if ((events & 1u << event) != 0) {
      CONodeCanEvent(node, (CO_CAN_EVENT)event);
    }
  }
}

bool TemplateCanHasWork(void) {
  return CORingCount(&ReceiveQueue) != 0 || PendingEvents != 0 || CORingLost(&ReceiveQueue) != ReportedLost;
}
