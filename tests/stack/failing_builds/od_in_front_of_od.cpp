// SPDX-License-Identifier: Apache-2.0
// expect: OD_TYPE_in_front_of_an_OD_TYPE
// An OD_TYPE stands in front of a type, not in front of another: with OD_ALL the name of a basic type is one.
#define USE_OD 1
#define OD_ALL
#include "co_od.h"

constexpr OD_TYPE own_type = OD_VALUE(CO_TUNSIGNED32, OD_DISABLED);
