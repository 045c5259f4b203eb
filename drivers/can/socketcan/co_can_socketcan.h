// SPDX-License-Identifier: Apache-2.0
/// \file co_can_socketcan.h
/// Driver for a CAN interface of Linux (SocketCAN), for C programs; C++ programs may use socketcan.hpp instead.
///
///     CO_SOCKETCAN *can = COSocketCanNew();
///     if (!COSocketCanOpen(can, "can0")) { puts(COSocketCanError(can)); }
///     ext.Can = &COSocketCanDriver;  ext.CanCtx = can;              /* CO_NODE_EXT */
///     struct pollfd wait = {COSocketCanFd(can), POLLIN, 0};         /* then CONodeProcess() */
///
/// The driver cannot set the bit rate of the interface (`ip link set can0 up type can bitrate 250000`). Send returns 0
/// while the transmit queue of the interface is full. After an error the driver opens the interface again, so call
/// COSocketCanFd() before each poll().
///
/// Context: one thread. Owner: the caller; it must outlive the node.
#ifndef CO_CAN_SOCKETCAN_H_
#define CO_CAN_SOCKETCAN_H_

#include "co_if_can.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A CAN interface; the members are private.
typedef struct CO_SOCKETCAN_T CO_SOCKETCAN;

/// Returns a closed interface; COSocketCanFree() releases it. Ends the program if there is no memory.
CO_SOCKETCAN* COSocketCanNew(void);
/// Closes and releases \a can, which may be null. The node must not use it any more.
void COSocketCanFree(CO_SOCKETCAN* can);

/// Opens the interface \a name, e.g. "can0". An interface that is down can be opened.
/// \retval true   the interface is open
/// \retval false  it cannot be used; COSocketCanError() returns the reason
bool COSocketCanOpen(CO_SOCKETCAN* can, const char* name);

/// Returns the last error in words, "" if there was none. The text is valid until the next call with \a can.
const char* COSocketCanError(const CO_SOCKETCAN* can);
/// Returns the file descriptor for poll() and the like, -1 while the interface is closed.
int COSocketCanFd(const CO_SOCKETCAN* can);
/// Returns the number of frames that were lost because the kernel's receive queue was full.
uint32_t COSocketCanLost(const CO_SOCKETCAN* can);

/// The driver; its context is a CO_SOCKETCAN.
extern const CO_IF_CAN_DRV_EX COSocketCanDriver;

#ifdef __cplusplus
}
#endif

#endif
