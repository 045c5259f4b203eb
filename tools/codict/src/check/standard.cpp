// SPDX-License-Identifier: Apache-2.0
// Checks of communication profile objects against CiA 301. [301: 7.5.2]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "check/check.hpp"
#include "model/subject.hpp"

namespace lexican::codict::check {

namespace {

constexpr std::uint16_t code8 = type_code::unsigned8;
constexpr std::uint16_t code16 = type_code::unsigned16;
constexpr std::uint16_t code32 = type_code::unsigned32;
constexpr std::uint16_t text_code = type_code::visible_string;

struct Indexes {
  std::uint16_t first;
  std::uint16_t last;

  constexpr bool has(std::uint16_t index) const { return index >= first && index <= last; }
};

struct Kind {
  Indexes indexes;
  ObjectCode code;
};

constexpr std::array<Kind, 15> kinds = {{
    {{0x1000, 0x1002}, ObjectCode::variable},
    {{0x1003, 0x1003}, ObjectCode::array},
    {{0x1005, 0x100A}, ObjectCode::variable},
    {{0x100C, 0x100D}, ObjectCode::variable},
    {{0x1010, 0x1011}, ObjectCode::array},
    {{0x1012, 0x1015}, ObjectCode::variable},
    {{0x1016, 0x1016}, ObjectCode::array},
    {{0x1017, 0x1017}, ObjectCode::variable},
    {{0x1018, 0x1018}, ObjectCode::record},
    {{0x1019, 0x1019}, ObjectCode::variable},
    {{0x1020, 0x1020}, ObjectCode::array},
    {{0x1021, 0x1021}, ObjectCode::domain},
    {{0x1026, 0x1029}, ObjectCode::array},
    {{0x1200, 0x12FF}, ObjectCode::record},
    {{0x1400, 0x1BFF}, ObjectCode::record},
}};

constexpr std::uint8_t last_sub = 0xFE;

struct Type {
  Indexes indexes;
  std::uint8_t first_sub;
  std::uint8_t last_sub;
  std::uint16_t code;
};

// Data types by sub-index. A VAR has sub-index 0 only; sub-index 0 of all other objects is UNSIGNED8 and not listed.
constexpr std::array<Type, 33> types = {{
    {{0x1000, 0x1000}, 0, 0, code32},        {{0x1001, 0x1001}, 0, 0, code8},
    {{0x1002, 0x1002}, 0, 0, code32},        {{0x1003, 0x1003}, 1, last_sub, code32},
    {{0x1005, 0x1007}, 0, 0, code32},        {{0x1008, 0x100A}, 0, 0, text_code},
    {{0x100C, 0x100C}, 0, 0, code16},        {{0x100D, 0x100D}, 0, 0, code8},
    {{0x1010, 0x1011}, 1, last_sub, code32}, {{0x1012, 0x1014}, 0, 0, code32},
    {{0x1015, 0x1015}, 0, 0, code16},        {{0x1016, 0x1016}, 1, last_sub, code32},
    {{0x1017, 0x1017}, 0, 0, code16},        {{0x1018, 0x1018}, 1, 4, code32},
    {{0x1019, 0x1019}, 0, 0, code8},         {{0x1020, 0x1020}, 1, last_sub, code32},
    {{0x1026, 0x1026}, 1, last_sub, code8},  {{0x1027, 0x1027}, 1, last_sub, code16},
    {{0x1028, 0x1028}, 1, last_sub, code32}, {{0x1029, 0x1029}, 1, last_sub, code8},
    {{0x1200, 0x12FF}, 1, 2, code32},        {{0x1200, 0x12FF}, 3, 3, code8},
    {{0x1400, 0x15FF}, 1, 1, code32},        {{0x1400, 0x15FF}, 2, 2, code8},
    {{0x1400, 0x15FF}, 3, 3, code16},        {{0x1400, 0x15FF}, 5, 5, code16},
    {{0x1600, 0x17FF}, 1, 0x40, code32},     {{0x1800, 0x19FF}, 1, 1, code32},
    {{0x1800, 0x19FF}, 2, 2, code8},         {{0x1800, 0x19FF}, 3, 3, code16},
    {{0x1800, 0x19FF}, 5, 5, code16},        {{0x1800, 0x19FF}, 6, 6, code8},
    {{0x1A00, 0x1BFF}, 1, 0x40, code32},
}};

void check_kind(const Object& object, Findings& findings) {
  const auto* const kind =
      std::find_if(kinds.begin(), kinds.end(), [&object](const Kind& each) { return each.indexes.has(object.index); });
  if (kind != kinds.end() && !object.object_code.is_empty() && object.object_code.value != kind->code) {
    findings.add(
        rules::standard_kind, object.object_code.span,
        fmt::format("object type {}, but CiA 301 defines {}", name_of(object.object_code.value), name_of(kind->code)),
        fmt::format("use {}", name_of(kind->code)));
  }
}

void check_type(const Entry& entry, std::uint16_t wanted, Findings& findings) {
  if (entry.data_type.value != 0 && entry.data_type.value != wanted) {
    findings.add(
        rules::standard_type, entry.data_type.span,
        fmt::format("data type {}, but CiA 301 defines {}", type_text(entry.data_type.value), type_text(wanted)),
        "use " + type_text(wanted));
  }
}

}  // namespace

void check_standard(const Device& device, Findings& findings) {
  for (const Object& object : device.objects) {
    check_kind(object, findings);
  }
  for_each_variable(device, [&](std::uint16_t index, std::uint8_t sub_index, const Entry& entry) {
    const auto* const type = std::find_if(types.begin(), types.end(), [index, sub_index](const Type& each) {
      return each.indexes.has(index) && sub_index >= each.first_sub && sub_index <= each.last_sub;
    });
    if (type != types.end()) {
      check_type(entry, type->code, findings);
    }
  });
}

}  // namespace lexican::codict::check
