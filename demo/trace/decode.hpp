// SPDX-License-Identifier: Apache-2.0
/// \file decode.hpp
/// CAN frames in the words of CiA 301: NMT, heartbeat and SDO of the pre-defined connection set. [301:7.3.3]
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "co_if_can.h"

namespace demo::trace {

/// How the value of an object is best read.
enum class Form { decimal, hex, characters };

struct ObjectName {
  std::uint16_t index;
  std::uint8_t sub;
  const char* name;
  Form form;
};

/// What the objects of the node are called; any order.
using Names = std::vector<ObjectName>;

/// What \a frame means. A frame of no known service is shown in the notation of candump: "123#DEADBEEF".
std::string decode(const CO_IF_FRM& frame, const Names& names);

/// Whether \a frame belongs to the middle of a segmented SDO transfer: carries a segment that is not the last, requests
/// a segment, or confirms one. A long transfer has many of these.
bool is_segment(const CO_IF_FRM& frame);

/// Meaning of an SDO abort code; "unknown abort code" if it is none of CiA 301. [301:7.2.4.3.17]
const char* abort_meaning(std::uint32_t code);

/// An abort code as the standard writes it: 0609 0030h.
std::string abort_code(std::uint32_t code);

}  // namespace demo::trace
