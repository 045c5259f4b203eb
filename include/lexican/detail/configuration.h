// SPDX-License-Identifier: Apache-2.0
/// \file lexican/detail/configuration.h
/// Prevents linking a program with a library that was compiled with other values of co_cfg.h: structures would differ
/// in size, and CONodeInit() would write beyond the program's CO_NODE. In a program that includes co_core.h the linker
/// symbols of CONodeInit(), CONodeInitEx() and CONodeInitCtx() end in the values of all settings. The library defines
/// only the symbols of its configuration, so the linker reports the program's configuration:
///
///     undefined reference to `CONodeInit_SSDO1_RPDO16_TPDO4_USECSDO1_CSDO1_SYNC1…'
///
/// This prints the library's: nm liblexican.a | grep CONodeInit_
///
/// Remedy: compile library and program with the same definitions (-D), the same preset and the same co_cfg.h. The check
/// adds no code and no data. Objects that use the plain symbol CONodeInit, without this header, are linked unchecked.
/// Only for ELF, and only if the value of each setting is a plain number: where one is an expression such as (4 + 2),
/// which no symbol can contain, nothing is checked; 4 and 4u are different.
#ifndef LEXICAN_DETAIL_CONFIGURATION_H_
#define LEXICAN_DETAIL_CONFIGURATION_H_

#include "lexican/detail/needs.h"

/// \cond internal
// X(name in the symbol, setting) for each setting of co_cfg.h; tests/stack/compat/configuration.sh names one that is
// missing.
// clang-format off
#define CO_CONFIGURATION(X) \
  X(SSDO, CO_SSDO_N) X(RPDO, CO_RPDO_N) X(TPDO, CO_TPDO_N) X(USECSDO, USE_CSDO) X(CSDO, CO_CSDO_N) X(SYNC, USE_SYNC) \
  X(USEEMCY, USE_EMCY) X(EMCY, CO_EMCY_N) X(EMCYQUEUE, CO_EMCY_QUEUE_N) \
  X(EMCYCONS, CO_EMCY_CONS_N) X(HBCONS, CO_HBCONS_N) X(GUARDING, USE_GUARDING) X(TIME, USE_TIME) X(TIMEHIGHRES, USE_TIME_HIGH_RES) X(GFC, USE_GFC) \
  X(SRDO, CO_SRDO_N) X(SRDOGAP, CO_SRDO_GAP) X(LSS, USE_LSS) X(LSSOPERATIONAL, CO_LSS_IN_OPERATIONAL) \
  X(LSSMASTER, USE_LSS_MASTER) X(NMTMASTER, USE_NMT_MASTER) X(LED, USE_LED) X(PARA, USE_PARA) \
  X(PARAPERIOD, CO_PARA_PERIOD) X(PARABUDGET, CO_PARA_BUDGET) X(STOREBUFFER, CO_STORE_BUFFER) X(OD, USE_OD) \
  X(SDOBLOCK, USE_SDO_BLOCK) X(SDOBLOCKPACE, CO_SDO_BLOCK_PACE) X(SDOBUF, CO_SDO_BUF_SEG) \
  X(SDOTIMEOUT, CO_SDO_TIMEOUT) X(CSDOBLOCK, CO_CSDO_BLOCK) X(CSDOOWN, USE_CSDO_OWN) \
  X(PDOBITS, USE_PDO_BITS) X(PDORTR, USE_PDO_RTR) X(TPDOSTART, CO_TPDO_ON_START) X(MPDO, CO_MPDO_N) \
  X(SYNCMIN, CO_SYNC_PERIOD_MIN) \
  X(RESTRICTEDIDS, CO_RESTRICTED_IDS) X(TXQUEUE, CO_TX_QUEUE_N) X(CALLBACKS, USE_CALLBACKS) \
  X(ACCESSHOOK, USE_ACCESS_HOOK) X(OBJEX, USE_OBJ_EX) X(DICTCHECK, USE_DICT_CHECK) X(FASTPATHS, USE_FAST_PATHS) \
  X(REALTIME, USE_REAL_TIME) X(RECORDER, USE_RECORDER)
// clang-format on

// Whether a value is a number without operators: not 4 + 2, because 4 + 2 * 9 is not (4 + 2) * 9; not 2 * 3, because
// 999999 / 2 * 3 is not 999999 / (2 * 3); and not (4 + 2).
// NOLINTBEGIN(bugprone-macro-parentheses): the expressions without parentheses are what is compared
#define CO_IS_PLAIN(name, setting)                                                           \
  &&CO_SECOND_OF(CO_IN_PARENTHESES setting, 1, ~) && (setting * 9 + 5) == (setting)*9 + 5 && \
      ((setting) == 0 || 999999 / setting == 999999 / (setting))
#define CO_IN_PARENTHESES(...) ~, 0
// NOLINTEND(bugprone-macro-parentheses)

#if defined(__ELF__) && defined(__GNUC__) && 1 CO_CONFIGURATION(CO_IS_PLAIN)
#define CO_TEXT_OF(value) #value
#define CO_NAME_AND_VALUE(name, setting) "_" #name CO_TEXT_OF(setting)
#define CO_CONFIGURED_SYMBOL(function) function CO_CONFIGURATION(CO_NAME_AND_VALUE)
#define CO_CONFIGURED(function) __asm__(CO_CONFIGURED_SYMBOL(function))
#else
#define CO_CONFIGURED(function)
#endif
/// \endcond

#endif
