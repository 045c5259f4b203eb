// SPDX-License-Identifier: Apache-2.0
/// \file co_nmt_startup.h
/// 1F80h, NMT startup. [CiA 302-2] Data: a uint32_t, or the value itself (flag D).
///
/// Bit 2 = 0: self-start: after CONodeStart() and after every reset the node enters Operational, once, as soon as it is
/// in Pre-operational. Bit 2 = 1, or no such object: it stays in Pre-operational. A mode that CONmtModeChange()
/// requests has priority. The other bits configure how an NMT master boots a network (bit 0: this node is the master;
/// bits 1 and 3…6: how it starts the other nodes and reacts to missing ones). This is implemented by the application,
/// with CONmtCommand(): the node ignores these bits and refuses to change them (CO_ERR_OBJ_RANGE, 0609 0030h).
#ifndef CO_NMT_STARTUP_H_
#define CO_NMT_STARTUP_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CO_NMT_STARTUP_STAY 0x04u  ///< bit 2: no self-start

extern const CO_OBJ_TYPE COTNmtStartup;  ///< functions of CO_TNMT_STARTUP

#define CO_TNMT_STARTUP ((const CO_OBJ_TYPE*)&COTNmtStartup)  ///< type of 1F80h

#ifdef __cplusplus
}
#endif

#endif
