// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "check/check.hpp"
#include "model/subject.hpp"

namespace lexican::codict::check {

namespace {

// Checks SubNumber, which does not count sub-index FFh, for objects without compact storage. [306: 4.6.3]
void check_sub_number(const Object& object, Findings& findings) {
  const auto number =
      std::count_if(object.subs.begin(), object.subs.end(), [](const Sub& sub) { return sub.sub_index != 0xFF; });
  if (object.compact.value != 0 || object.sub_number.is_empty() || object.sub_number.value == number) {
    return;
  }
  findings.add(rules::sub_number, object.sub_number.span,
               fmt::format("SubNumber is {}, but the number of sub-objects is {}", object.sub_number.value, number),
               fmt::format("SubNumber={}", number));
}

// Returns true if sub-index 0 is the number of entries in use, not the highest sub-index. [301: 7.5.2.5, 7.5.2.36]
bool counts_entries(const Object& object, const Sub& zero) {
  const bool is_mapping =
      (object.index >= 0x1600 && object.index < 0x1800) || (object.index >= 0x1A00 && object.index < 0x1C00);
  return object.index == 0x1003 || is_mapping || is_writable(zero.access.value);
}

void check_sub_zero(const Object& object, Findings& findings) {
  const Sub* const zero = object.find(0);
  if (zero == nullptr) {
    findings.add(rules::sub_zero_missing, object.span, "sub-index 0 is missing",
                 fmt::format("add it as UNSIGNED8 with default value {}", highest_sub(object)));
    return;
  }
  const std::uint8_t highest = highest_sub(object);
  if (!zero->has_value() && !zero->is_implied) {
    findings.add(rules::sub_zero_value, zero->span,
                 fmt::format("sub-index 0 has no default value, {} is used", highest),
                 fmt::format("DefaultValue={}", highest));
  }
  const Value& value = zero->default_value;
  const std::string differs =
      fmt::format("sub-index 0 is {}, but the highest sub-index is {}", text_of(value), highest);
  if (value.is_integer() && value.integer < Integer(highest) && !counts_entries(object, *zero)) {
    findings.add(rules::sub_zero_small, value.span, differs, fmt::format("write {}", highest));
  } else if (value.is_integer() && Integer(highest) < value.integer && !counts_entries(object, *zero)) {
    findings.add(rules::sub_zero_large, value.span, differs,
                 fmt::format("write {}, or describe the missing sub-objects", highest));
  }
}

bool is_number(const Value& value) { return value.is_integer() || value.kind == Value::Kind::real; }

// Compares values. False if only one of them contains $NODEID, as the result then depends on the node-ID.
bool is_less(const Value& a, const Value& b) {
  if (a.kind == Value::Kind::real || b.kind == Value::Kind::real) {
    return a.kind == b.kind && a.real < b.real;
  }
  return a.adds_node_id == b.adds_node_id && a.integer < b.integer;
}

void check_limits(const Entry& entry, Findings& findings) {
  const bool has_low = is_number(entry.low_limit);
  const bool has_high = is_number(entry.high_limit);
  if (has_low && has_high && is_less(entry.high_limit, entry.low_limit)) {
    findings.add(rules::limit_order, entry.low_limit->span,
                 fmt::format("LowLimit {} is above HighLimit {}", text_of(entry.low_limit), text_of(entry.high_limit)),
                 "exchange or correct the limits");
    return;
  }
  for (const Value* value : {&entry.default_value, &*entry.actual_value}) {
    if (!is_number(*value)) {
      continue;
    }
    const std::string title =
        fmt::format("{} value {}", value == &entry.default_value ? "default" : "configured", text_of(*value));
    if (has_low && is_less(*value, entry.low_limit)) {
      findings.add(rules::limit, value->span, fmt::format("{} is below LowLimit {}", title, text_of(entry.low_limit)),
                   "raise the value or lower the limit");
    }
    if (has_high && is_less(entry.high_limit, *value)) {
      findings.add(rules::limit, value->span, fmt::format("{} is above HighLimit {}", title, text_of(entry.high_limit)),
                   "lower the value or raise the limit");
    }
  }
}

}  // namespace

void check_objects(const Device& device, Findings& findings) {
  for (const Object& object : device.objects) {
    if (has_sub_objects(object.object_code.value)) {
      check_sub_number(object, findings);
      check_sub_zero(object, findings);
    }
  }
  for_each_variable(device,
                    [&findings](std::uint16_t, std::uint8_t, const Entry& entry) { check_limits(entry, findings); });
}

}  // namespace lexican::codict::check
