// SPDX-License-Identifier: Apache-2.0
/// \file co_time_clock.h
/// The node's clock (co_time.h) as an object of data type TIME_OF_DAY: reading returns the time, 0 until it was set;
/// writing sets it. A time of 24 h or more is refused (0609 0030h). 6 bytes, which may be mapped into PDOs. Data: 0,
/// not used.
///
///     {CO_KEY(0x2101, 0, CO_OBJ____PRW), CO_TTIME_CLOCK, 0}
#ifndef CO_TIME_CLOCK_H_
#define CO_TIME_CLOCK_H_

#include "co_needs.h"
#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTTimeClock CO_NEEDS(USE_TIME);  ///< functions of CO_TTIME_CLOCK

#define CO_TTIME_CLOCK ((const CO_OBJ_TYPE*)&COTTimeClock)  ///< type of the clock; Data: 0

#ifdef __cplusplus
}
#endif

#endif
