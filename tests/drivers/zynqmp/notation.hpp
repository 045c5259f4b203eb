// SPDX-License-Identifier: Apache-2.0
/// \file notation.hpp
/// CAN frames as can-utils write them: 123#1122 (11 bit), 00000123#1122 (29 bit), 123#R (remote frame).
#pragma once

#include "co_if_can.h"

namespace zynqmp {

CO_IF_FRM frame(const char* text);

struct Text {
  char characters[32];
};
Text notation(const CO_IF_FRM& frame);

bool is_same(const CO_IF_FRM& a, const CO_IF_FRM& b);

}  // namespace zynqmp
