// SPDX-License-Identifier: Apache-2.0
#include "notation.hpp"

#include <cstdint>

namespace zynqmp {
namespace {

constexpr unsigned digits_of_extended = 8;

std::uint32_t value_of(char digit) {
  return static_cast<std::uint32_t>(digit <= '9' ? digit - '0' : (digit & ~0x20) - 'A' + 10);
}

char* write_hex(char* to, std::uint32_t value, unsigned digits) {
  while (digits != 0) {
    --digits;
    *to++ = "0123456789ABCDEF"[(value >> (4 * digits)) & 0xF];
  }
  return to;
}

}  // namespace

CO_IF_FRM frame(const char* text) {
  CO_IF_FRM made = {};
  const char* place = text;
  for (; *place != '#'; ++place) {
    made.Identifier = (made.Identifier << 4) | value_of(*place);
  }
  made.Identifier |= place - text == digits_of_extended ? CO_IF_FRM_EXT : 0;
  ++place;
  if (*place == 'R') {
    made.Identifier |= CO_IF_FRM_RTR;
    return made;
  }
  for (; *place != '\0'; place += 2) {
    made.Data[made.DLC++] = static_cast<std::uint8_t>((value_of(place[0]) << 4) | value_of(place[1]));
  }
  return made;
}

Text notation(const CO_IF_FRM& frame) {
  Text text = {};
  const std::uint32_t flags = CO_IF_FRM_EXT | CO_IF_FRM_RTR;
  char* place = write_hex(text.characters, frame.Identifier & ~flags, (frame.Identifier & CO_IF_FRM_EXT) != 0 ? 8 : 3);
  *place++ = '#';
  if ((frame.Identifier & CO_IF_FRM_RTR) != 0) {
    *place = 'R';
    return text;
  }
  for (unsigned n = 0; n < frame.DLC; ++n) {
    place = write_hex(place, frame.Data[n], 2);
  }
  return text;
}

bool is_same(const CO_IF_FRM& a, const CO_IF_FRM& b) {
  bool same = a.Identifier == b.Identifier && a.DLC == b.DLC;
  const bool remote = (a.Identifier & CO_IF_FRM_RTR) != 0;
  for (unsigned n = 0; n < a.DLC && !remote && same; ++n) {
    same = a.Data[n] == b.Data[n];
  }
  return same;
}

}  // namespace zynqmp
