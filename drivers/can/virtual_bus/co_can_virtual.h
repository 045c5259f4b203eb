// SPDX-License-Identifier: Apache-2.0
/// \file co_can_virtual.h
/// A simulated CAN bus inside a program, for C programs: any number of nodes and test masters. C++ programs may use
/// virtual_bus.hpp, which also has fault injection and the timing of a real bus.
///
///     CO_VIRTUAL_BUS *bus = COVirtualBusNew();
///     ext.Can = &COVirtualBusDriver;  ext.CanCtx = COVirtualBusAttach(bus, "node 5");      /* CO_NODE_EXT */
///
///     CO_VIRTUAL_PORT *master = COVirtualBusAttach(bus, "master");   /* a port that no node uses */
///     COVirtualPortEnable(master, 0);
///     COVirtualPortSend(master, &request);
///     while (COVirtualPortRead(master, &answer) > 0) { ... }
///
/// A frame reaches every other port on the bus within COVirtualPortSend() or the node's call that sends it.
///
/// Context: one thread. Owner: the caller; the bus owns its ports and must outlive the nodes.
#ifndef CO_CAN_VIRTUAL_H_
#define CO_CAN_VIRTUAL_H_

#include "co_if_can.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A simulated bus; the members are private.
typedef struct CO_VIRTUAL_BUS_T CO_VIRTUAL_BUS;
/// A CAN controller at a bus; the members are private.
typedef struct CO_VIRTUAL_PORT_T CO_VIRTUAL_PORT;

/// Called for every frame on the bus, in the order of the bus. \a user: argument of COVirtualBusTrace(); \a sender:
/// name of the port, "" for none. \a frame and \a sender are valid during the call only.
typedef void (*CO_VIRTUAL_TRACE)(void* user, const CO_IF_FRM* frame, const char* sender);

/// Returns an empty bus; COVirtualBusFree() releases it. Ends the program if there is no memory.
CO_VIRTUAL_BUS* COVirtualBusNew(void);
/// Releases \a bus, which may be null, and its ports. No node may use them any more.
void COVirtualBusFree(CO_VIRTUAL_BUS* bus);

/// Returns a new port, off the bus. The bus owns it. \a name, which is copied, appears in traces.
CO_VIRTUAL_PORT* COVirtualBusAttach(CO_VIRTUAL_BUS* bus, const char* name);

/// Sets the function that is called for every frame, with \a user as its argument; null: none is called.
void COVirtualBusTrace(CO_VIRTUAL_BUS* bus, CO_VIRTUAL_TRACE trace, void* user);

/// Puts a port that no node uses on the bus. \a baud: bit/s; 0: sends to and receives from ports of every bit rate.
void COVirtualPortEnable(CO_VIRTUAL_PORT* port, uint32_t baud);

/// Sends a frame from a port that no node uses.
/// \retval sizeof(CO_IF_FRM)  the frame was sent
/// \retval 0                  the transmit queue is full
/// \retval -1                 the port is off the bus, or in bus-off
int16_t COVirtualPortSend(CO_VIRTUAL_PORT* port, const CO_IF_FRM* frame);

/// Reads the next received frame of a port that no node uses.
/// \retval sizeof(CO_IF_FRM)  \a frame holds it
/// \retval 0                  there is none; \a frame is unchanged
int16_t COVirtualPortRead(CO_VIRTUAL_PORT* port, CO_IF_FRM* frame);

/// The driver; its context is a CO_VIRTUAL_PORT.
extern const CO_IF_CAN_DRV_EX COVirtualBusDriver;

#ifdef __cplusplus
}
#endif

#endif
