// SPDX-License-Identifier: Apache-2.0
/// \file co_pdo_inhibit.h
/// 1800h…, sub 3: inhibit time. [CiA 301, 7.5.2.37] Data: a uint16_t in units of 100 µs, or the value itself (flag D);
/// 0: none. Minimum time between two transmissions of an event-driven TPDO. A change while the PDO exists is refused
/// (0609 0030h). With a plain CO_TUNSIGNED16 instead, a change takes effect when the PDO is switched on. An RPDO
/// (1400h…) may have the entry, which has no effect.
#ifndef CO_PDO_INHIBIT_H_
#define CO_PDO_INHIBIT_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTPdoInhibit;  ///< functions of CO_TPDO_INHIBIT

#define CO_TPDO_INHIBIT ((const CO_OBJ_TYPE*)&COTPdoInhibit)  ///< type of 1800h…, sub 3

#ifdef __cplusplus
}
#endif

#endif
