// SPDX-License-Identifier: Apache-2.0
#include "gen/forms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

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

constexpr Place form_places[] = {
    {0x1003, 0x1003, 0, 0, "CO_TEMCY_HIST", 1, Service::value, false, "USE_EMCY"},
    {0x1003, 0x1003, 1, 254, "CO_TEMCY_HIST", 4, Service::fixed, false, "USE_EMCY"},
    {0x1005, 0x1005, 0, 0, "CO_TSYNC_ID", 4, Service::value, true, "USE_SYNC"},
    {0x1006, 0x1006, 0, 0, "CO_TSYNC_CYCLE", 4, Service::value, false, "USE_SYNC"},
    {0x1007, 0x1007, 0, 0, "CO_TSYNC_WINDOW", 4, Service::value, false, "USE_SYNC"},
    {0x1010, 0x1010, 0, 0, "CO_TPARA_STORE", 1, Service::value, false, "USE_PARA"},
    {0x1010, 0x1010, 1, 127, "CO_TPARA_STORE", 4, Service::group, false, "USE_PARA"},
    {0x1011, 0x1011, 0, 0, "CO_TPARA_RESTORE", 1, Service::value, false, "USE_PARA"},
    {0x1011, 0x1011, 1, 127, "CO_TPARA_RESTORE", 4, Service::group, false, "USE_PARA"},
    {0x1012, 0x1012, 0, 0, "CO_TTIME_ID", 4, Service::value, true, "USE_TIME"},
    {0x1014, 0x1014, 0, 0, "CO_TEMCY_ID", 4, Service::value, true, "USE_EMCY"},
    {0x1016, 0x1016, 0, 0, "CO_THB_CONS", 1, Service::value, false, ""},
    {0x1016, 0x1016, 1, 127, "CO_THB_CONS", 4, Service::consumer, false, ""},
    {0x1017, 0x1017, 0, 0, "CO_THB_PROD", 2, Service::value, false, ""},
    {0x1019, 0x1019, 0, 0, "CO_TSYNC_COUNT", 1, Service::value, false, "USE_SYNC"},
    {0x1020, 0x1020, 1, 2, "CO_TVERIFY_CONFIG", 4, Service::fixed, false, "USE_PARA"},
    {0x1021, 0x1021, 0, 0, "CO_TDOMAIN_RO", 0, Service::eds, false, ""},
    {0x1022, 0x1022, 0, 0, "CO_TUNSIGNED16", 2, Service::value, false, ""},
    {0x1023, 0x1023, 1, 1, "CO_TOS_COMMAND", 0, Service::shared, false, "USE_OBJ_EX"},
    {0x1023, 0x1023, 2, 2, "CO_TOS_STATUS", 1, Service::shared, false, "USE_OBJ_EX"},
    {0x1023, 0x1023, 3, 3, "CO_TOS_REPLY", 0, Service::shared, false, "USE_OBJ_EX"},
    {0x1024, 0x1024, 0, 0, "CO_TOS_MODE", 1, Service::shared, false, "USE_OBJ_EX"},
    {0x1025, 0x1025, 1, 1, "CO_TOS_COMMAND", 0, Service::shared, false, "USE_OBJ_EX"},
    {0x1025, 0x1025, 2, 2, "CO_TOS_STATUS", 1, Service::shared, false, "USE_OBJ_EX"},
    {0x1025, 0x1025, 3, 3, "CO_TOS_REPLY", 0, Service::shared, false, "USE_OBJ_EX"},
    {0x1026, 0x1026, 1, 1, "CO_TOS_STDIN", 1, Service::shared, false, ""},
    {0x1026, 0x1026, 2, 3, "CO_TOS_STDOUT", 1, Service::shared, false, ""},
    {0x1027, 0x1027, 0, 0, "CO_TMODULE_LIST", 1, Service::shared, false, ""},
    {0x1027, 0x1027, 1, 254, "CO_TMODULE_LIST", 2, Service::shared, false, ""},
    {0x1028, 0x1028, 1, 127, "CO_TEMCY_CONS", 4, Service::value, false, "USE_EMCY"},
    {0x1029, 0x1029, 1, 254, "CO_TERROR_BEHAVIOUR", 1, Service::value, false, ""},
    {0x1200, 0x12FF, 1, 2, "CO_TSDO_ID", 4, Service::value, true, ""},
    {0x1300, 0x1300, 0, 0, "CO_TGFC", 1, Service::value, false, "USE_GFC"},
    {0x1301, 0x1340, 1, 1, "CO_TSRDO_COM", 1, Service::value, false, ""},
    {0x1301, 0x1340, 2, 2, "CO_TSRDO_COM", 2, Service::value, false, ""},
    {0x1301, 0x1340, 3, 4, "CO_TSRDO_COM", 1, Service::value, false, ""},
    {0x1301, 0x1340, 5, 6, "CO_TSRDO_COM", 4, Service::value, false, ""},
    {0x1381, 0x13C0, 0, 0, "CO_TSRDO_MAP", 1, Service::value, false, ""},
    {0x1381, 0x13C0, 1, 16, "CO_TSRDO_MAP", 4, Service::value, false, ""},
    {0x13FE, 0x13FE, 0, 0, "CO_TSRDO_VALID", 1, Service::fixed, false, ""},
    {0x13FF, 0x13FF, 1, 64, "CO_TSRDO_SIGNATURE", 2, Service::value, false, ""},
    {0x1400, 0x15FF, 1, 1, "CO_TPDO_ID", 4, Service::value, true, ""},
    {0x1400, 0x15FF, 2, 2, "CO_TPDO_TYPE", 1, Service::value, false, ""},
    {0x1400, 0x15FF, 3, 3, "CO_TPDO_INHIBIT", 2, Service::value, false, ""},
    {0x1400, 0x15FF, 5, 5, "CO_TPDO_EVENT", 2, Service::value, false, ""},
    {0x1600, 0x17FF, 0, 0, "CO_TPDO_NUM", 1, Service::value, false, ""},
    {0x1600, 0x17FF, 1, 64, "CO_TPDO_MAP", 4, Service::value, false, ""},
    {0x1800, 0x19FF, 1, 1, "CO_TPDO_ID", 4, Service::value, true, ""},
    {0x1800, 0x19FF, 2, 2, "CO_TPDO_TYPE", 1, Service::value, false, ""},
    {0x1800, 0x19FF, 3, 3, "CO_TPDO_INHIBIT", 2, Service::value, false, ""},
    {0x1800, 0x19FF, 5, 5, "CO_TPDO_EVENT", 2, Service::value, false, ""},
    {0x1800, 0x19FF, 6, 6, "CO_TPDO_START", 1, Service::value, false, ""},
    {0x1A00, 0x1BFF, 0, 0, "CO_TPDO_NUM", 1, Service::value, false, ""},
    {0x1A00, 0x1BFF, 1, 64, "CO_TPDO_MAP", 4, Service::value, false, ""},
    {0x1F80, 0x1F80, 0, 0, "CO_TNMT_STARTUP", 4, Service::value, false, ""},
    {0x1FA0, 0x1FCF, 1, 254, "CO_TPDO_SCAN", 4, Service::value, false, "USE_MPDO"},
    {0x1FD0, 0x1FFF, 1, 254, "CO_TPDO_DISPATCH", 8, Service::value, false, "USE_MPDO"},
};

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

const Place* place_of(std::uint16_t index, std::uint8_t sub_index, bool has_subs) {
  for (const Place& place : form_places) {
    const bool is_number = place.first == 0x1003 || place.first == 0x1016 || place.type == "CO_TPDO_NUM" ||
                           place.first == 0x1010 || place.first == 0x1011 || place.type == "CO_TSRDO_MAP" ||
                           place.type == "CO_TMODULE_LIST";
    const bool has_shape = sub_index != 0 || has_subs == is_number;
    if (index >= place.first && index <= place.last && sub_index >= place.first_sub && sub_index <= place.last_sub &&
        has_shape) {
      return &place;
    }
  }
  return nullptr;
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
