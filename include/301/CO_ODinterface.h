// SPDX-License-Identifier: Apache-2.0
/// \file 301/CO_ODinterface.h
/// The name under which applications that come from CANopenNode include co_od.h.
#ifndef CO_301_OD_INTERFACE_H_
#define CO_301_OD_INTERFACE_H_

#include "co_od.h"

#endif
