// SPDX-License-Identifier: Apache-2.0
/// \file lexican/detail/needs.h
/// Names the setting of co_cfg.h that a function or an object type needs. Functions that the configuration excludes are
/// declared, but calling one, or taking its address, is a compile error:
///
///     error: 'CONmtCommand' is unavailable: needs USE_NMT_MASTER above 0 in co_cfg.h
///
/// With gcc from 12 on, and clang. Older versions of gcc give a warning with the same text, and the linker rejects the
/// call. With other compilers, and where the setting is an expression instead of the number 0, only the linker rejects
/// it.
#ifndef LEXICAN_DETAIL_NEEDS_H_
#define LEXICAN_DETAIL_NEEDS_H_

#include "co_cfg.h"

// Settings that are gone. Here, because an application may have a co_cfg.h that replaces the one of the library.
#ifdef USE_CSDO_BLOCK
#error "USE_CSDO_BLOCK was replaced: CO_CSDO_BLOCK 0 omits the block transfer of SDO clients"
#endif
#if defined(USE_MPDO) || defined(CO_MPDO_SCAN_N) || defined(CO_MPDO_DISPATCH_N)
#error "USE_MPDO, CO_MPDO_SCAN_N and CO_MPDO_DISPATCH_N were replaced: CO_MPDO_N is the length of both lists"
#endif
#ifdef USE_EMCY_QUEUE
#error "USE_EMCY_QUEUE was replaced: CO_EMCY_QUEUE_N 0 omits the queue of EMCY messages"
#endif

/// Follows the declaration of a function or of a variable, or precedes one that has several names:
/// CO_ERR COTimeSend(struct CO_NODE_T* node) CO_NEEDS(USE_TIME);
#define CO_NEEDS(setting) CO_IF_ZERO(setting, CO_LEFT_OUT("needs " #setting " above 0 in co_cfg.h"), )

/// \cond internal
// Expands to then if value is the number 0, else to otherwise. CO_ZERO_ and the value become one token, which is a
// macro only for 0: its comma makes then the second argument. A parenthesis cannot be pasted: CO_EXPRESSION replaces
// it.
#define CO_IF_ZERO(value, then, otherwise) CO_IF_ZERO_OF(CO_SECOND_OF(CO_EXPRESSION value, value, ~), then, otherwise)
#define CO_IF_ZERO_OF(token, then, otherwise) CO_IF_ZERO_PASTED(token, then, otherwise)
#define CO_IF_ZERO_PASTED(token, then, otherwise) CO_SECOND_OF(CO_ZERO_##token then, otherwise, ~)
#define CO_ZERO_0 ~,
#define CO_ZERO_0u ~,
#define CO_ZERO_0U ~,
#define CO_EXPRESSION(...) ~, 1
#define CO_SECOND_OF(...) CO_SECOND(__VA_ARGS__)
#define CO_SECOND(first, second, ...) second

#if defined(__has_attribute)
#if __has_attribute(unavailable)
#define CO_LEFT_OUT(message) __attribute__((unavailable(message)))
#endif
#endif
#if !defined(CO_LEFT_OUT) && defined(__GNUC__)
#define CO_LEFT_OUT(message) __attribute__((deprecated(message)))
#elif !defined(CO_LEFT_OUT)
#define CO_LEFT_OUT(message)
#endif
/// \endcond

#endif
