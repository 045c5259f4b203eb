// SPDX-License-Identifier: Apache-2.0
/// \file callback_place.h
/// Declarations for callback_place.c and callback_definition.c.
#ifndef COMPAT_CALLBACK_PLACE_H_
#define COMPAT_CALLBACK_PLACE_H_

#ifdef __cplusplus
extern "C" {
#endif

extern unsigned CallsOfTheCallback;

#ifdef __cplusplus
}
#endif

#endif
