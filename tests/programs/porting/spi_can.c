// SPDX-License-Identifier: Apache-2.0
// Example of docs/porting.md: a CAN controller behind SPI. The port has to define the five functions of the board.
#include <stdbool.h>

#include "co_if_can.h"
#include "co_ring.h"

void BoardCanInterruptOff(void);                      // masks the interrupt of the controller's INT pin
void BoardCanInterruptOn(void);                       // lets it in again
bool BoardCanIntIsLow(void);                          // level of the INT pin
bool BoardSpiReadFrame(CO_IF_FRM* frm);               // fetches a received frame and releases its buffer
bool BoardSpiWriteFrame(const CO_IF_FRM* frm);        // false: no transmit buffer is free
int16_t SpiCanSend(void* ctx, const CO_IF_FRM* frm);  // CO_IF_CAN_DRV_EX.Send
void SpiCanInterrupt(void);                           // handler of the INT pin, falling edge

static CO_RING ReceiveQueue;

// Context: the interrupt of the INT pin. The pin stays low until every received frame has been fetched; an edge that
// comes meanwhile is lost, so ask for the level.
void SpiCanInterrupt(void) {
  CO_IF_FRM frm;
  while (BoardCanIntIsLow() && BoardSpiReadFrame(&frm)) {
    (void)CORingPut(&ReceiveQueue, &frm);
  }
}

// Context: the loop. The interrupt also uses the SPI, so keep it away for one transaction (about 15 us at 10 MHz).
int16_t SpiCanSend(void* ctx, const CO_IF_FRM* frm) {
  (void)ctx;
  BoardCanInterruptOff();
  const bool taken = BoardSpiWriteFrame(frm);
  SpiCanInterrupt();  // what has arrived meanwhile made no edge that the handler could see
  BoardCanInterruptOn();
  return taken ? (int16_t)sizeof(CO_IF_FRM) : 0;
}
