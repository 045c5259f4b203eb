// SPDX-License-Identifier: Apache-2.0
// The driver check for ports (docs/porting.md) on the FlexCAN driver, with the second controller as peer.
#include "board.h"
#include "co_driver_check.h"

static CO_DRIVER_CHECK Check;
static CO_NODE_EXT Own;
static CO_NODE_EXT Peer;

static void PrintLine(void* user, const char* line) {
  CO_UNUSED(user);
  BoardPrint(line);
  BoardPrint("\n");
}

int main(void) {
  BoardStart();
  Own.Size = sizeof(Own);
  Own.Can = &FlexcanCanDriver;
  Own.CanCtx = &BoardCan[0];
  Peer.Size = sizeof(Peer);
  Peer.Can = &FlexcanCanDriver;
  Peer.CanCtx = &BoardCan[1];
  Check.Ext = &Own;
  Check.Print = PrintLine;
  Check.Bus = CO_CHECK_PEER;
  Check.Peer = &Peer;
  Check.Frames = CO_CHECK_29_BIT;  // QEMU 11 does not store RTR of received frames
  Check.Patience = 100000;
  const int status = CODriverCheck(&Check) == 0 ? 0 : 1;
  BoardPrint("1..");
  BoardPrintNumber((uint32_t)Check.Passed + Check.Failed);
  BoardPrint("\n");
  return status;
}
