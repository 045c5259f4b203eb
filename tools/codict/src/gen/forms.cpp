// SPDX-License-Identifier: Apache-2.0
#include "gen/forms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lexican/detail/objects.h"

namespace lexican::codict::gen {

namespace {

constexpr Form forms[] = {
    {"CO_TBOOLEAN", "uint8_t", 0x01, 1, 1, 1},
    {"CO_TSIGNED8", "int8_t", 0x02, 1, 1, 1},
    {"CO_TSIGNED16", "int16_t", 0x03, 2, 2, 2},
    {"CO_TSIGNED32", "int32_t", 0x04, 4, 4, 4},
    {"CO_TUNSIGNED8", "uint8_t", 0x05, 1, 1, 1},
    {"CO_TUNSIGNED16", "uint16_t", 0x06, 2, 2, 2},
    {"CO_TUNSIGNED32", "uint32_t", 0x07, 4, 4, 4},
    {"CO_TREAL32", "float", 0x08, 4, 4, 4},
    {"CO_TVISIBLE_STRING", "", 0x09, 0, 1, 0},
    {"CO_TOCTET_STRING", "", 0x0A, 0, 1, 0},
    {"CO_TUNICODE_STRING", "", 0x0B, 0, 2, 0},
    {"CO_TTIME_OF_DAY", "CO_TIME_OF_DAY", 0x0C, 8, 4, 6},
    {"CO_TTIME_DIFFERENCE", "CO_TIME_OF_DAY", 0x0D, 8, 4, 6},
    {"CO_TDOMAIN", "", 0x0F, 0, 1, 0},
    {"CO_TSIGNED24", "int32_t", 0x10, 4, 4, 3},
    {"CO_TREAL64", "double", 0x11, 8, 8, 8},
    {"CO_TSIGNED40", "int64_t", 0x12, 8, 8, 5},
    {"CO_TSIGNED48", "int64_t", 0x13, 8, 8, 6},
    {"CO_TSIGNED56", "int64_t", 0x14, 8, 8, 7},
    {"CO_TSIGNED64", "int64_t", 0x15, 8, 8, 8},
    {"CO_TUNSIGNED24", "uint32_t", 0x16, 4, 4, 3},
    {"CO_TUNSIGNED40", "uint64_t", 0x18, 8, 8, 5},
    {"CO_TUNSIGNED48", "uint64_t", 0x19, 8, 8, 6},
    {"CO_TUNSIGNED56", "uint64_t", 0x1A, 8, 8, 7},
    {"CO_TUNSIGNED64", "uint64_t", 0x1B, 8, 8, 8},
};

// The stack's own list, and objects with a plain type. The setting of a row is a name here.
#define CODICT_PLACE(rule, type, functions, first, last, first_sub, last_sub, bytes, flags, value, use, setting) \
  {first, last, first_sub, last_sub, #type, bytes, Service::use, #flags, #setting},
constexpr Place form_places[] = {{0x1021, 0x1021, 0, 0, "CO_TDOMAIN_RO", 0, Service::eds, "", ""},
                                 {0x1022, 0x1022, 0, 0, "CO_TUNSIGNED16", 2, Service::value, "", ""},
                                 CO_OBJECTS(CODICT_PLACE)};
#undef CODICT_PLACE

// Returns an unsigned C literal: decimal below 10000h, else hexadecimal.
std::string unsigned_literal(std::uint64_t number, std::uint8_t size) {
  const char* const suffix = size == 8 ? "ull" : "u";
  return number < 0x10000 ? fmt::format("{}{}", number, suffix) : fmt::format("0x{:X}{}", number, suffix);
}

// Writes the lowest number of a width as an expression: C has no negative literals.
std::string signed_literal(const Integer& number, std::uint8_t size) {
  const char* const suffix = size == 8 ? "ll" : "";
  if (!number.is_negative) {
    return fmt::format("{}{}", number.magnitude, suffix);
  }
  const std::uint64_t smallest = std::uint64_t{1} << (8U * size - 1U);
  return size >= 4 && number.magnitude == smallest ? fmt::format("(-{}{} - 1)", smallest - 1, suffix)
                                                   : fmt::format("-{}{}", number.magnitude, suffix);
}

std::string real_literal(double number, std::uint8_t size) {
  if (!std::isfinite(number)) {
    return std::isnan(number) ? "NAN" : (number < 0 ? "(-INFINITY)" : "INFINITY");
  }
  const char* const suffix = size == 4 ? "f" : "";
  std::string digits = size == 4 ? fmt::format("{}", static_cast<float>(number)) : fmt::format("{}", number);
  if (digits.find_first_of(".e") == std::string::npos) {
    digits += ".0";
  }
  return digits + suffix;
}

std::string time_literal(const Value& value) {
  const std::uint64_t bits = value.is_integer() ? value.integer.bits() : 0;
  return fmt::format("{{{}, {}}}", unsigned_literal(bits & 0x0FFFFFFF, 4), unsigned_literal(bits >> 32 & 0xFFFF, 2));
}

}  // namespace

const Form* form_of(std::uint16_t code) {
  for (const Form& form : forms) {
    if (form.code == code) {
      return &form;
    }
  }
  return nullptr;
}

const Form& unsigned_form(std::uint8_t bytes) {
  return *std::find_if(std::begin(forms), std::end(forms), [bytes](const Form& form) {
    return form.bytes == bytes && data_type(form.code).kind == TypeKind::unsigned_integer;
  });
}

bool Place::contains(std::uint16_t index, std::uint8_t sub_index) const {
  constexpr std::uint16_t from_rpdo_to_tpdo = 0x0400;
  const bool of_tpdo = flags.find('T') != std::string_view::npos && index >= first + from_rpdo_to_tpdo;
  const int of_row = of_tpdo ? index - from_rpdo_to_tpdo : index;
  return of_row >= first && of_row <= last && sub_index >= first_sub && sub_index <= last_sub &&
         service != Service::none;
}

const Place* place_of(std::uint16_t index, std::uint8_t sub_index, bool has_subs) {
  const auto find = [index](std::uint8_t sub) {
    const Place* const found = std::find_if(std::begin(form_places), std::end(form_places),
                                            [=](const Place& place) { return place.contains(index, sub); });
    return found != std::end(form_places) ? found : nullptr;
  };
  const Place* const place = find(sub_index);
  if (place == nullptr || sub_index != 0) {
    return place;
  }
  const Place* const other = find(1);
  const bool is_number = other != nullptr && other->first == place->first;
  return place->last_sub == 0 && has_subs == is_number ? place : nullptr;
}

std::string literal(const Integer& number, const Form& form) {
  return data_type(form.code).kind == TypeKind::signed_integer ? signed_literal(number, form.size)
                                                               : unsigned_literal(number.bits(), form.size);
}

std::string literal(const Value& value, const Form& form) {
  switch (data_type(form.code).kind) {
    case TypeKind::real: return real_literal(value.real, form.size);
    case TypeKind::time: return time_literal(value);
    default: return literal(value.integer, form);
  }
}

std::u16string utf16(std::string_view utf8) {
  std::u16string characters;
  std::uint32_t code = 0;
  for (std::size_t n = 0; n < utf8.size(); ++n) {
    const auto byte = static_cast<unsigned char>(utf8[n]);
    constexpr std::uint32_t beginnings[] = {0x7F, 0x1F, 0x0F, 0x07};
    const bool continues = (byte & 0xC0U) == 0x80;
    const unsigned more = byte < 0xC0 ? 0 : (byte < 0xE0 ? 1 : (byte < 0xF0 ? 2 : 3));
    code = continues ? code << 6 | (byte & 0x3FU) : byte & beginnings[more];
    const bool is_complete = n + 1 == utf8.size() || (static_cast<unsigned char>(utf8[n + 1]) & 0xC0U) != 0x80;
    if (is_complete && code > 0xFFFF) {
      characters += static_cast<char16_t>(0xD7C0U + (code >> 10));
      characters += static_cast<char16_t>(0xDC00U | (code & 0x3FFU));
    } else if (is_complete) {
      characters += static_cast<char16_t>(code);
    }
  }
  return characters;
}

}  // namespace lexican::codict::gen
