// SPDX-License-Identifier: Apache-2.0
// Description of the device that a plan implements, for the configuration of a master.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "gen/plan.hpp"
#include "model/access.hpp"

namespace lexican::codict::gen {

namespace {

bool is_same(const Value& a, const Value& b) {
  return a.kind == b.kind && a.adds_node_id == b.adds_node_id && a.integer == b.integer;
}

// Returns the initial value of a variable without a default value.
Value zero_of(const Form& form) {
  Value zero;
  const bool is_real = data_type(form.code).kind == TypeKind::real;
  zero.kind = is_real ? Value::Kind::real : Value::Kind::integer;
  zero.text = is_real ? "0.0" : "0";
  zero.is_given = true;
  return zero;
}

// Entries of 1003h have no value until an error occurs: until then the stack aborts their upload. [301:7.5.2.6]
bool is_error_field(const Item& item) { return item.index == 0x1003 && item.sub_index != 0; }

Value value_of(const Entry& entry, const Item& item) {
  if (is_error_field(item)) {
    return {};
  }
  const bool is_of_application =
      item.storage == Storage::external || item.storage == Storage::application || item.storage == Storage::shared;
  if (item.value.kind == Value::Kind::none && item.form->bytes != 0 && !is_of_application) {
    return zero_of(*item.form);
  }
  if (item.value.kind == Value::Kind::none) {
    return {};
  }
  const Value& said = value_in_force(entry);
  if (said.is_given && is_same(said, item.value)) {
    return said;
  }
  Value value = item.value;
  value.text = value.is_integer() ? value.written_integer() : "";
  value.is_given = true;
  return value;
}

void set_entry(Entry& entry, const Item& item) {
  entry.default_value = value_of(entry, item);
  entry.actual_value = {};
  entry.access.value = item.access;
  if (item.place != nullptr && entry.data_type.value != item.form->code) {
    entry.data_type.value = item.form->code;
    entry.type = {};
  }
  if (item.pdo != entry.pdo_mapping.value) {
    entry.pdo_mapping.value = item.pdo;
    entry.pdo_mapping.text = "1";
    entry.pdo_mapping.is_given = true;
  }
  if (item.storage == Storage::string) {
    Field<std::uint32_t>& length = entry.node.edit().string_length_min.edit();
    length.value = item.capacity / item.form->alignment;
    length.text = std::to_string(length.value);
    length.is_given = true;
  }
}

Sub highest_sub_of(const Item& item) {
  Sub sub;
  sub.name.text = item.name;
  sub.name.is_given = true;
  sub.object_code.value = ObjectCode::variable;
  sub.data_type.value = item.form->code;
  return sub;
}

void set_subs(Object& object, const Plan& plan) {
  const Item* const number = plan.find(object.index, 0);
  if (number != nullptr && object.find(0) == nullptr) {
    object.subs.insert(object.subs.begin(), highest_sub_of(*number));
  }
  const auto has_no_entry = [&](const Sub& sub) { return plan.find(object.index, sub.sub_index) == nullptr; };
  object.subs.erase(std::remove_if(object.subs.begin(), object.subs.end(), has_no_entry), object.subs.end());
  // Compact storage (CompactSubObj) cannot express default values of single sub-objects.
  const bool has_values = std::any_of(object.subs.begin(), object.subs.end(),
                                      [](const Sub& sub) { return sub.is_implied && sub.actual_value->is_given; });
  object.compact = has_values ? Field<std::uint8_t>() : object.compact;
  for (Sub& sub : object.subs) {
    set_entry(sub, *plan.find(object.index, sub.sub_index));
    sub.is_implied = sub.is_implied && !has_values;
  }
}

bool is_type(const Object& object) { return object.index < 0x00A0 && !object.node->disabled->value; }

bool has_entry(const Object& object, const Plan& plan) {
  const auto place = std::lower_bound(plan.items.begin(), plan.items.end(), object.index,
                                      [](const Item& item, std::uint16_t index) { return item.index < index; });
  return place != plan.items.end() && place->index == object.index;
}

std::uint16_t number_of(const Plan& plan, std::uint16_t first, std::uint16_t last) {
  const auto is_pdo = [&](const Item& item) {
    return item.index >= first && item.index <= last && item.sub_index == 1;
  };
  return static_cast<std::uint16_t>(std::count_if(plan.items.begin(), plan.items.end(), is_pdo));
}

void set_count(Field<std::uint16_t>& field, std::uint16_t count) {
  field.value = count;
  field.text = std::to_string(count);
  field.is_given = true;
}

}  // namespace

Device described(Device device, const Plan& plan) {
  Device result = std::move(device);
  result.commissioning = {};
  const auto has_no_entry = [&](const Object& object) { return !has_entry(object, plan) && !is_type(object); };
  result.objects.erase(std::remove_if(result.objects.begin(), result.objects.end(), has_no_entry),
                       result.objects.end());
  for (Object& object : result.objects) {
    const Item* const item = plan.find(object.index, 0);
    if (!is_type(object) && has_sub_objects(object.object_code.value)) {
      set_subs(object, plan);
    } else if (item != nullptr) {
      set_entry(object, *item);
    }
  }
  set_count(result.features.rx_pdos, number_of(plan, 0x1400, 0x15FF));
  set_count(result.features.tx_pdos, number_of(plan, 0x1800, 0x19FF));
  return result;
}

}  // namespace lexican::codict::gen
