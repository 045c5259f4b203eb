// SPDX-License-Identifier: Apache-2.0
/// \file lexican/detail/needs.h
/// Names the setting of co_cfg.h that a function or an object type needs. Functions that the configuration excludes are
/// declared, but calling one, or taking its address, is a compile error:
///
///     error: 'CONmtCommand' is unavailable: needs USE_NMT_MASTER 1 in co_cfg.h
///
/// With gcc from 12 on, and clang. Older versions of gcc give a warning with the same text, and the linker rejects the
/// call. With other compilers only the linker rejects it.
#ifndef LEXICAN_DETAIL_NEEDS_H_
#define LEXICAN_DETAIL_NEEDS_H_

#include "co_cfg.h"

/// Follows the declaration of a function or of a variable, or precedes one that has several names:
/// CO_ERR COTimeSend(struct CO_NODE_T* node) CO_NEEDS(USE_TIME);
#define CO_NEEDS(setting) CO_NEEDS_##setting

/// \cond internal
#if defined(__has_attribute)
#if __has_attribute(unavailable)
#define CO_LEFT_OUT(setting) __attribute__((unavailable("needs " setting " in co_cfg.h")))
#endif
#endif
#if !defined(CO_LEFT_OUT) && defined(__GNUC__)
#define CO_LEFT_OUT(setting) __attribute__((deprecated("needs " setting " in co_cfg.h")))
#elif !defined(CO_LEFT_OUT)
#define CO_LEFT_OUT(setting)
#endif

#if USE_CSDO
#define CO_NEEDS_USE_CSDO
#else
#define CO_NEEDS_USE_CSDO CO_LEFT_OUT("USE_CSDO 1")
#endif
#if USE_EMCY
#define CO_NEEDS_USE_EMCY
#else
#define CO_NEEDS_USE_EMCY CO_LEFT_OUT("USE_EMCY 1")
#endif
#if USE_GFC
#define CO_NEEDS_USE_GFC
#else
#define CO_NEEDS_USE_GFC CO_LEFT_OUT("USE_GFC 1")
#endif
#if USE_LED
#define CO_NEEDS_USE_LED
#else
#define CO_NEEDS_USE_LED CO_LEFT_OUT("USE_LED 1")
#endif
#if USE_LSS_MASTER
#define CO_NEEDS_USE_LSS_MASTER
#else
#define CO_NEEDS_USE_LSS_MASTER CO_LEFT_OUT("USE_LSS_MASTER 1")
#endif
#if USE_MPDO
#define CO_NEEDS_USE_MPDO
#else
#define CO_NEEDS_USE_MPDO CO_LEFT_OUT("USE_MPDO 1")
#endif
#if USE_NMT_MASTER
#define CO_NEEDS_USE_NMT_MASTER
#else
#define CO_NEEDS_USE_NMT_MASTER CO_LEFT_OUT("USE_NMT_MASTER 1")
#endif
#if USE_OBJ_EX
#define CO_NEEDS_USE_OBJ_EX
#else
#define CO_NEEDS_USE_OBJ_EX CO_LEFT_OUT("USE_OBJ_EX 1")
#endif
#if USE_OD
#define CO_NEEDS_USE_OD
#else
#define CO_NEEDS_USE_OD CO_LEFT_OUT("USE_OD 1")
#endif
#if USE_PARA
#define CO_NEEDS_USE_PARA
#else
#define CO_NEEDS_USE_PARA CO_LEFT_OUT("USE_PARA 1")
#endif
#if USE_REAL_TIME
#define CO_NEEDS_USE_REAL_TIME
#else
#define CO_NEEDS_USE_REAL_TIME CO_LEFT_OUT("USE_REAL_TIME 1")
#endif
#if USE_RECORDER
#define CO_NEEDS_USE_RECORDER
#else
#define CO_NEEDS_USE_RECORDER CO_LEFT_OUT("USE_RECORDER 1")
#endif
#if USE_SYNC
#define CO_NEEDS_USE_SYNC
#else
#define CO_NEEDS_USE_SYNC CO_LEFT_OUT("USE_SYNC 1")
#endif
#if USE_TIME
#define CO_NEEDS_USE_TIME
#else
#define CO_NEEDS_USE_TIME CO_LEFT_OUT("USE_TIME 1")
#endif
#if CO_EMCY_CONS_N > 0
#define CO_NEEDS_CO_EMCY_CONS_N
#else
#define CO_NEEDS_CO_EMCY_CONS_N CO_LEFT_OUT("CO_EMCY_CONS_N above 0")
#endif
#if CO_HBCONS_N > 0
#define CO_NEEDS_CO_HBCONS_N
#else
#define CO_NEEDS_CO_HBCONS_N CO_LEFT_OUT("CO_HBCONS_N above 0")
#endif
#if CO_SRDO_N > 0
#define CO_NEEDS_CO_SRDO_N
#else
#define CO_NEEDS_CO_SRDO_N CO_LEFT_OUT("CO_SRDO_N above 0")
#endif
#if USE_LSS && USE_PARA
#define CO_NEEDS_LSS_STORAGE
#else
#define CO_NEEDS_LSS_STORAGE CO_LEFT_OUT("USE_LSS 1 and USE_PARA 1")
#endif
#if USE_OD && USE_PARA
#define CO_NEEDS_OD_STORAGE
#else
#define CO_NEEDS_OD_STORAGE CO_LEFT_OUT("USE_OD 1 and USE_PARA 1")
#endif
/// \endcond

#endif
