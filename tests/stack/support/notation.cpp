// SPDX-License-Identifier: Apache-2.0
#include "notation.hpp"

#include <doctest/doctest.h>

#include <charconv>
#include <cstdio>

namespace test {
namespace {

std::uint32_t hex(std::string_view digits) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  const bool good = error == std::errc{} && end == digits.data() + digits.size();
  REQUIRE_MESSAGE(good, "not a hexadecimal number: ", std::string(digits));
  return value;
}

std::uint32_t identifier(std::string_view digits) {
  const std::uint32_t id = hex(digits);
  const bool extended = digits.size() == 8 && (id & CO_IF_FRM_ERROR) == 0;
  return extended ? (id | CO_IF_FRM_EXT) : id;
}

void fill(CO_IF_FRM& frm, std::string_view bytes) {
  const bool fits = bytes.size() % 2 == 0 && bytes.size() <= 16;
  REQUIRE_MESSAGE(fits, "not 0…8 bytes: ", std::string(bytes));
  for (std::size_t i = 0; i < bytes.size() / 2; ++i) {
    frm.Data[i] = static_cast<std::uint8_t>(hex(bytes.substr(2 * i, 2)));
  }
  frm.DLC = static_cast<std::uint8_t>(bytes.size() / 2);
}

}  // namespace

CO_IF_FRM frame(std::string_view text) {
  const std::size_t hash = text.find('#');
  REQUIRE_MESSAGE(hash != std::string_view::npos, "not a frame: ", std::string(text));
  CO_IF_FRM frm{};
  frm.Identifier = identifier(text.substr(0, hash));
  std::string_view bytes = text.substr(hash + 1);
  if (!bytes.empty() && bytes.front() == 'R') {
    frm.Identifier |= CO_IF_FRM_RTR;
    frm.DLC = bytes.size() > 1 ? static_cast<std::uint8_t>(hex(bytes.substr(1))) : std::uint8_t{0};
    return frm;
  }
  const std::size_t low_line = bytes.find('_');
  fill(frm, bytes.substr(0, low_line));
  if (low_line != std::string_view::npos) {
    frm.DLC = static_cast<std::uint8_t>(hex(bytes.substr(low_line + 1)));
  }
  return frm;
}

std::string notation(const CO_IF_FRM& frm) {
  const bool wide = (frm.Identifier & (CO_IF_FRM_EXT | CO_IF_FRM_ERROR)) != 0;
  const auto id = static_cast<unsigned>(frm.Identifier & ~(CO_IF_FRM_EXT | CO_IF_FRM_RTR));
  char text[16];
  std::snprintf(text, sizeof text, wide ? "%08X#" : "%03X#", id);
  std::string all = text;
  if ((frm.Identifier & CO_IF_FRM_RTR) != 0) {
    return all + "R";
  }
  for (unsigned i = 0; i < frm.DLC && i < 8; ++i) {
    std::snprintf(text, sizeof text, "%02X", frm.Data[i]);
    all += text;
  }
  if (frm.DLC > 8) {
    std::snprintf(text, sizeof text, "_%X", frm.DLC);
    all += text;
  }
  return all;
}

}  // namespace test
