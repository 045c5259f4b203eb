// SPDX-License-Identifier: Apache-2.0
/// \file numbered_frame.hpp
/// Frames whose identifier and data contain the same number, so that a frame mixed from two others is detected.
#pragma once

#include <cstdint>

#include "co_if_can.h"

namespace test {

inline CO_IF_FRM numbered(std::uint32_t number) {
  CO_IF_FRM frm{};
  frm.Identifier = number;
  frm.DLC = 8;
  for (unsigned i = 0; i < 8; ++i) {
    frm.Data[i] = static_cast<std::uint8_t>(number + i);
  }
  return frm;
}

inline bool is_numbered(const CO_IF_FRM& frm, std::uint32_t number) {
  const CO_IF_FRM expected = numbered(number);
  bool same = frm.Identifier == expected.Identifier && frm.DLC == expected.DLC;
  for (unsigned i = 0; i < 8; ++i) {
    same = same && frm.Data[i] == expected.Data[i];
  }
  return same;
}

}  // namespace test
