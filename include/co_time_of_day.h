// SPDX-License-Identifier: Apache-2.0
/// \file co_time_of_day.h
/// TIME_OF_DAY and TIME_DIFFERENCE: 6 bytes on the bus. [CiA 301, 7.1.6.5, 7.1.6.6] Data: a CO_TIME_OF_DAY.
#ifndef CO_TIME_OF_DAY_H_
#define CO_TIME_OF_DAY_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A time of day, or a time difference.
typedef struct CO_TIME_OF_DAY_T {
  uint32_t Ms;    ///< milliseconds after midnight, 28 bits; the 4 bits above are read and written as 0
  uint16_t Days;  ///< days since 1984-01-01, or days of difference
} CO_TIME_OF_DAY;

extern const CO_OBJ_TYPE COTTimeOfDay;  ///< functions of both types

#define CO_TTIME_OF_DAY ((const CO_OBJ_TYPE*)&COTTimeOfDay)      ///< TIME_OF_DAY
#define CO_TTIME_DIFFERENCE ((const CO_OBJ_TYPE*)&COTTimeOfDay)  ///< TIME_DIFFERENCE

#ifdef __cplusplus
}
#endif

#endif
