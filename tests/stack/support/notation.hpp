// SPDX-License-Identifier: Apache-2.0
/// \file notation.hpp
/// CAN frames in the notation of can-utils: 123#1122 (11 bit), 00000123#1122 (29 bit), 123#R (remote frame),
/// 20000040#… (error frame, as in SocketCAN), 123#1122334455667788_9 (8 bytes with DLC code 9…F).
#pragma once

#include <ostream>
#include <string>
#include <string_view>

#include "co_if_can.h"

namespace test {

/// Parses the notation. An invalid text ends the test case.
CO_IF_FRM frame(std::string_view text);

/// Returns the notation of a frame, in capitals.
std::string notation(const CO_IF_FRM& frm);

}  // namespace test
