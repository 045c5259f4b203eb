// SPDX-License-Identifier: Apache-2.0
#include "co_can_socketcan.h"

#include "socketcan.hpp"

namespace {

co::SocketCan* of(CO_SOCKETCAN* can) { return reinterpret_cast<co::SocketCan*>(can); }
const co::SocketCan* of(const CO_SOCKETCAN* can) { return reinterpret_cast<const co::SocketCan*>(can); }

}  // namespace

extern "C" {

CO_SOCKETCAN* COSocketCanNew(void) { return reinterpret_cast<CO_SOCKETCAN*>(new co::SocketCan); }

void COSocketCanFree(CO_SOCKETCAN* can) { delete of(can); }

bool COSocketCanOpen(CO_SOCKETCAN* can, const char* name) { return of(can)->open(name); }

const char* COSocketCanError(const CO_SOCKETCAN* can) { return of(can)->error().c_str(); }

int COSocketCanFd(const CO_SOCKETCAN* can) { return of(can)->fd(); }

uint32_t COSocketCanLost(const CO_SOCKETCAN* can) { return of(can)->lost(); }

}  // extern "C"
