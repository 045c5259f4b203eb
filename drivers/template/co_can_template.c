// SPDX-License-Identifier: Apache-2.0
#include "co_can_template.h"

#include "co_ring.h"

// Frames between the interrupt and the loop. Long enough for what the bus can bring while the loop is busy elsewhere:
// at 1 Mbit/s a frame takes 47 us at least (no data, 11-bit identifier), one with 8 bytes about 110 us.
#define RECEIVE_QUEUE_FRAMES 32u

static CO_IF_FRM ReceiveMemory[RECEIVE_QUEUE_FRAMES];
static CO_RING ReceiveQueue;

// Context: the loop, in CONodeInit(). Prepare the controller (clock, pins, interrupt), but stay off the bus: the bit
// rate is not known yet. May be called again, with Enable, to change the bit rate.
static void Init(void) {
  // Here: receive interrupt off, controller in its initialisation mode.
  (void)CORingInit(&ReceiveQueue, ReceiveMemory, RECEIVE_QUEUE_FRAMES);
}

// Context: the loop. Set the bit timing for baud bit/s (sample point at 87.5 % of the bit for CANopen) and go on the
// bus. Let everything be received, or set the filters (CO_IF_CAN_DRV_EX.Filter).
static void Enable(uint32_t baud) {
  CO_UNUSED(baud);  // Here: bit timing registers, normal mode, receive interrupt on.
}

// Context: the loop (or a task of its own that calls CONodeProcess(): then it may block until a frame is there).
// Returns sizeof(CO_IF_FRM): a frame, 0: none, -1: the controller reports an error.
static int16_t Read(CO_IF_FRM* frm) { return CORingGet(&ReceiveQueue, frm) ? (int16_t)sizeof(CO_IF_FRM) : 0; }

// Context: the loop. Must not block, and must not let frames overtake each other: if the controller has several
// transmit mailboxes, set them to send in the order of writing, or use one.
// Returns sizeof(CO_IF_FRM): the controller has taken the frame, 0: no room, the stack asks again, -1: error, likewise.
static int16_t Send(CO_IF_FRM* frm) {
  CO_UNUSED(frm);
  // Here: return 0 if no mailbox is free; else write
  //   CO_GET_ID(frm) & CO_IF_FRM_ID     the identifier; 29 bits if CO_IF_FRM_EXT is set in CO_GET_ID(frm), else 11
  //   CO_GET_ID(frm) & CO_IF_FRM_RTR    remote frame
  //   CO_GET_DLC(frm), frm->Data        the data
  // start the transmission and return (int16_t)sizeof(CO_IF_FRM).
  return 0;
}

// Context: the loop, at an NMT reset. Clear errors and queues, and go back on the bus (leave bus-off).
static void Reset(void) {
  CO_IF_FRM old;
  while (CORingGet(&ReceiveQueue, &old)) {
  }
  // Here: drop what waits in the transmit mailboxes, restart the controller if it is in bus-off.
}

// Context: the loop, in CONodeStop(). Go off the bus.
static void Close(void) {
  // Here: receive interrupt off, controller in its initialisation mode.
}

const CO_IF_CAN_DRV TemplateCanDriver = {Init, Enable, Read, Send, Reset, Close};

// Context: the receive interrupt, the one producer of the queue. A full queue counts the frame as lost; the loop can
// look at CORingLost() and tell the node with CONodeCanEvent(&node, CO_CAN_OVERRUN). In the same way, let an error
// interrupt leave a note for the loop, which calls CONodeCanEvent() with CO_CAN_PASSIVE, CO_CAN_BUS_OFF or
// CO_CAN_RECOVERED.
void TemplateCanReceiveInterrupt(void) {
  const bool pending = false;  // Here: is there a frame in the controller?
  if (pending) {
    CO_IF_FRM frm = {0, {0}, 0};
    // Here: CO_SET_ID(&frm, identifier | flags), CO_SET_DLC(&frm, length), copy the data, release the mailbox.
    (void)CORingPut(&ReceiveQueue, &frm);
  }
}
