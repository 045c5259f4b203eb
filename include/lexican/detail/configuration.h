// SPDX-License-Identifier: Apache-2.0
/// \file lexican/detail/configuration.h
/// Prevents linking a program with a library that was compiled with other values of co_cfg.h: structures would differ
/// in size, and CONodeInit() would write beyond the program's CO_NODE. In a program that includes co_core.h the linker
/// symbols of CONodeInit(), CONodeInitEx() and CONodeInitCtx() end in a number, which the preprocessor computes from
/// all settings. The library defines only the symbols of its configuration, so the linker reports:
///
///     undefined reference to `CONodeInit_of_a_library_with_the_same_co_cfg_values_013213220321'
///
/// Remedy: compile library and program with the same definitions (-D), the same preset and the same co_cfg.h. The check
/// adds no code and no data. Objects that use the plain symbol CONodeInit, without this header, are linked unchecked.
/// Only for ELF; on other targets nothing is checked.
#ifndef LEXICAN_DETAIL_CONFIGURATION_H_
#define LEXICAN_DETAIL_CONFIGURATION_H_

#include "co_cfg.h"

/// \cond internal
// Each setting of co_cfg.h; tests/compat/configuration.sh names one that is missing. Sums and products of the
// preprocessor have 64 bits.
#define CO_CONFIGURATION_MIX(hash, a, b, c, d) \
  (((((hash)*1000003u + (a)) * 1000003u + (b)) * 1000003u + (c)) * 1000003u + (d))
#define CO_CONFIGURATION_1 CO_CONFIGURATION_MIX(1u, CO_SSDO_N, USE_DICT_CHECK, USE_FAST_PATHS, USE_OBJ_EX)
#define CO_CONFIGURATION_2 CO_CONFIGURATION_MIX(CO_CONFIGURATION_1, USE_OD, USE_CSDO, CO_CSDO_N, USE_SDO_BLOCK)
#define CO_CONFIGURATION_3 CO_CONFIGURATION_MIX(CO_CONFIGURATION_2, CO_CSDO_BLOCK, CO_SDO_TIMEOUT, CO_RPDO_N, CO_TPDO_N)
#define CO_CONFIGURATION_4 CO_CONFIGURATION_MIX(CO_CONFIGURATION_3, USE_PDO_BITS, USE_PDO_RTR, USE_MPDO, CO_MPDO_SCAN_N)
#define CO_CONFIGURATION_5 \
  CO_CONFIGURATION_MIX(CO_CONFIGURATION_4, CO_MPDO_DISPATCH_N, CO_TPDO_ON_START, CO_RESTRICTED_IDS, USE_SYNC)
#define CO_CONFIGURATION_6 CO_CONFIGURATION_MIX(CO_CONFIGURATION_5, USE_TIME, USE_EMCY, CO_EMCY_N, CO_EMCY_QUEUE_N)
#define CO_CONFIGURATION_7 \
  CO_CONFIGURATION_MIX(CO_CONFIGURATION_6, CO_EMCY_CONS_N, CO_HBCONS_N, USE_GUARDING, USE_NMT_MASTER)
#define CO_CONFIGURATION_8 CO_CONFIGURATION_MIX(CO_CONFIGURATION_7, USE_LED, USE_LSS, USE_LSS_MASTER, USE_PARA)
#define CO_CONFIGURATION_9 \
  CO_CONFIGURATION_MIX(CO_CONFIGURATION_8, CO_PARA_PERIOD, CO_STORE_BUFFER, USE_REAL_TIME, CO_TX_QUEUE_N)
#define CO_CONFIGURATION_10 \
  CO_CONFIGURATION_MIX(CO_CONFIGURATION_9, CO_SDO_BUF_SEG, CO_SDO_BLOCK_PACE, CO_LSS_IN_OPERATIONAL, USE_ACCESS_HOOK)
#define CO_CONFIGURATION_11 \
  CO_CONFIGURATION_MIX(CO_CONFIGURATION_10, CO_PARA_BUDGET, CO_SYNC_PERIOD_MIN, USE_CALLBACKS, USE_CSDO_BLOCK)
#define CO_CONFIGURATION_12 CO_CONFIGURATION_MIX(CO_CONFIGURATION_11, USE_CSDO_OWN, USE_GFC, CO_SRDO_N, CO_SRDO_GAP)
#define CO_CONFIGURATION_13 CO_CONFIGURATION_MIX(CO_CONFIGURATION_12, USE_EMCY_QUEUE, USE_RECORDER, 0, 0)

// Digits of base 4: the upper 24 bits of a product with the golden ratio.
#define CO_CONFIGURATION_DIGIT(place) (((CO_CONFIGURATION_13 * 0x9E3779B97F4A7C15u) >> (40 + 2 * (place))) % 4)
#if CO_CONFIGURATION_DIGIT(0) == 0
#define CO_CONFIGURATION_D0 "0"
#elif CO_CONFIGURATION_DIGIT(0) == 1
#define CO_CONFIGURATION_D0 "1"
#elif CO_CONFIGURATION_DIGIT(0) == 2
#define CO_CONFIGURATION_D0 "2"
#else
#define CO_CONFIGURATION_D0 "3"
#endif
#if CO_CONFIGURATION_DIGIT(1) == 0
#define CO_CONFIGURATION_D1 "0"
#elif CO_CONFIGURATION_DIGIT(1) == 1
#define CO_CONFIGURATION_D1 "1"
#elif CO_CONFIGURATION_DIGIT(1) == 2
#define CO_CONFIGURATION_D1 "2"
#else
#define CO_CONFIGURATION_D1 "3"
#endif
#if CO_CONFIGURATION_DIGIT(2) == 0
#define CO_CONFIGURATION_D2 "0"
#elif CO_CONFIGURATION_DIGIT(2) == 1
#define CO_CONFIGURATION_D2 "1"
#elif CO_CONFIGURATION_DIGIT(2) == 2
#define CO_CONFIGURATION_D2 "2"
#else
#define CO_CONFIGURATION_D2 "3"
#endif
#if CO_CONFIGURATION_DIGIT(3) == 0
#define CO_CONFIGURATION_D3 "0"
#elif CO_CONFIGURATION_DIGIT(3) == 1
#define CO_CONFIGURATION_D3 "1"
#elif CO_CONFIGURATION_DIGIT(3) == 2
#define CO_CONFIGURATION_D3 "2"
#else
#define CO_CONFIGURATION_D3 "3"
#endif
#if CO_CONFIGURATION_DIGIT(4) == 0
#define CO_CONFIGURATION_D4 "0"
#elif CO_CONFIGURATION_DIGIT(4) == 1
#define CO_CONFIGURATION_D4 "1"
#elif CO_CONFIGURATION_DIGIT(4) == 2
#define CO_CONFIGURATION_D4 "2"
#else
#define CO_CONFIGURATION_D4 "3"
#endif
#if CO_CONFIGURATION_DIGIT(5) == 0
#define CO_CONFIGURATION_D5 "0"
#elif CO_CONFIGURATION_DIGIT(5) == 1
#define CO_CONFIGURATION_D5 "1"
#elif CO_CONFIGURATION_DIGIT(5) == 2
#define CO_CONFIGURATION_D5 "2"
#else
#define CO_CONFIGURATION_D5 "3"
#endif
#if CO_CONFIGURATION_DIGIT(6) == 0
#define CO_CONFIGURATION_D6 "0"
#elif CO_CONFIGURATION_DIGIT(6) == 1
#define CO_CONFIGURATION_D6 "1"
#elif CO_CONFIGURATION_DIGIT(6) == 2
#define CO_CONFIGURATION_D6 "2"
#else
#define CO_CONFIGURATION_D6 "3"
#endif
#if CO_CONFIGURATION_DIGIT(7) == 0
#define CO_CONFIGURATION_D7 "0"
#elif CO_CONFIGURATION_DIGIT(7) == 1
#define CO_CONFIGURATION_D7 "1"
#elif CO_CONFIGURATION_DIGIT(7) == 2
#define CO_CONFIGURATION_D7 "2"
#else
#define CO_CONFIGURATION_D7 "3"
#endif
#if CO_CONFIGURATION_DIGIT(8) == 0
#define CO_CONFIGURATION_D8 "0"
#elif CO_CONFIGURATION_DIGIT(8) == 1
#define CO_CONFIGURATION_D8 "1"
#elif CO_CONFIGURATION_DIGIT(8) == 2
#define CO_CONFIGURATION_D8 "2"
#else
#define CO_CONFIGURATION_D8 "3"
#endif
#if CO_CONFIGURATION_DIGIT(9) == 0
#define CO_CONFIGURATION_D9 "0"
#elif CO_CONFIGURATION_DIGIT(9) == 1
#define CO_CONFIGURATION_D9 "1"
#elif CO_CONFIGURATION_DIGIT(9) == 2
#define CO_CONFIGURATION_D9 "2"
#else
#define CO_CONFIGURATION_D9 "3"
#endif
#if CO_CONFIGURATION_DIGIT(10) == 0
#define CO_CONFIGURATION_D10 "0"
#elif CO_CONFIGURATION_DIGIT(10) == 1
#define CO_CONFIGURATION_D10 "1"
#elif CO_CONFIGURATION_DIGIT(10) == 2
#define CO_CONFIGURATION_D10 "2"
#else
#define CO_CONFIGURATION_D10 "3"
#endif
#if CO_CONFIGURATION_DIGIT(11) == 0
#define CO_CONFIGURATION_D11 "0"
#elif CO_CONFIGURATION_DIGIT(11) == 1
#define CO_CONFIGURATION_D11 "1"
#elif CO_CONFIGURATION_DIGIT(11) == 2
#define CO_CONFIGURATION_D11 "2"
#else
#define CO_CONFIGURATION_D11 "3"
#endif

#if defined(__ELF__) && defined(__GNUC__)
#define CO_CONFIGURED_SYMBOL(function)                                                                                \
  function "_of_a_library_with_the_same_co_cfg_values_" CO_CONFIGURATION_D11 CO_CONFIGURATION_D10 CO_CONFIGURATION_D9 \
      CO_CONFIGURATION_D8 CO_CONFIGURATION_D7 CO_CONFIGURATION_D6 CO_CONFIGURATION_D5 CO_CONFIGURATION_D4             \
          CO_CONFIGURATION_D3 CO_CONFIGURATION_D2 CO_CONFIGURATION_D1 CO_CONFIGURATION_D0
#endif

#ifdef CO_CONFIGURED_SYMBOL
#define CO_CONFIGURED(function) __asm__(CO_CONFIGURED_SYMBOL(function))
#else
#define CO_CONFIGURED(function)
#endif
/// \endcond

#endif
