// SPDX-License-Identifier: Apache-2.0
// A virtual CAN bus for nodes in different threads.
#ifndef DEMO_TWO_THREADS_BUS_H_
#define DEMO_TWO_THREADS_BUS_H_

#include "co_if_can.h"

#ifdef __cplusplus
extern "C" {
#endif

// CAN driver (CO_NODE_EXT.Can). Its functions may be called in any thread.
extern const CO_IF_CAN_DRV_EX BusDriver;

// Returns a new controller on the bus, which is the context of the driver (CO_NODE_EXT.CanCtx).
void* BusAttach(void);

#ifdef __cplusplus
}
#endif

#endif
