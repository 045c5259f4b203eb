// SPDX-License-Identifier: Apache-2.0
/// \file 301/CO_ODinterface.h
/// Includes co_od.h under the name that applications for CANopenNode use.
#ifndef CO_301_OD_INTERFACE_H_
#define CO_301_OD_INTERFACE_H_

#include "co_od.h"

#endif
