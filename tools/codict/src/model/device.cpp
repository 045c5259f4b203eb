// SPDX-License-Identifier: Apache-2.0
#include "model/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lexican::codict {

namespace {

// Returns the iterator of the element that has a key, or the end. The elements are sorted by key.
template <typename Elements, typename Key, typename KeyOf>
auto find_sorted(Elements& elements, Key key, KeyOf key_of) {
  const auto place = std::lower_bound(elements.begin(), elements.end(), key,
                                      [key_of](const auto& element, Key wanted) { return key_of(element) < wanted; });
  return place != elements.end() && key_of(*place) == key ? place : elements.end();
}

template <typename Object>
auto* find_sub(Object& object, std::uint8_t sub_index) {
  const auto place = find_sorted(object.subs, sub_index, [](const Sub& sub) { return sub.sub_index; });
  return place != object.subs.end() ? &*place : nullptr;
}

template <typename Device>
auto* find_object(Device& device, std::uint16_t index) {
  const auto place = find_sorted(device.objects, index, [](const Object& object) { return object.index; });
  return place != device.objects.end() ? &*place : nullptr;
}

constexpr DataType structure{0, TypeKind::structure, 0, "", "", ""};

}  // namespace

std::string_view text_in(const std::vector<Label>& labels, std::string_view language) {
  for (const Label& label : labels) {
    if (equal_ignoring_case(label.language, language)) {
      return label.text.text;
    }
  }
  return labels.empty() ? std::string_view() : std::string_view(labels.front().text.text);
}

std::string_view named_group(const NodeProperties& node) {
  const std::string& name = node.storage_group.value;
  return equal_ignoring_case(name, "RAM") ? std::string_view() : std::string_view(name);
}

std::string_view name_of(Format format) {
  constexpr std::array<std::string_view, 10> names = {"EDS",     "DCF", "XDD 1.0", "XDD 1.1",         "XDC 1.0",
                                                      "XDC 1.1", "XPD", "NXDD",    "CANopenNode XML", "XML"};
  return names[static_cast<std::size_t>(format)];
}

const Sub* Object::find(std::uint8_t sub_index) const { return find_sub(*this, sub_index); }
Sub* Object::find(std::uint8_t sub_index) { return find_sub(*this, sub_index); }

std::uint8_t highest_sub(const Object& object) {
  std::uint8_t highest = 0;
  for (const Sub& sub : object.subs) {
    highest = sub.sub_index == 0xFF ? highest : sub.sub_index;
  }
  return highest;
}

const Object* Device::find(std::uint16_t index) const { return find_object(*this, index); }
Object* Device::find(std::uint16_t index) { return find_object(*this, index); }

const Entry* Device::find(std::uint16_t index, std::uint8_t sub_index) const {
  const Object* object = find(index);
  if (object == nullptr) {
    return nullptr;
  }
  if (object->subs.empty() && !has_sub_objects(object->object_code.value)) {
    return sub_index == 0 ? object : nullptr;
  }
  return object->find(sub_index);
}

void for_each_variable(const Device& device,
                       const std::function<void(std::uint16_t, std::uint8_t, const Entry&)>& call) {
  for (const Object& object : device.objects) {
    if (object.subs.empty() && !has_sub_objects(object.object_code.value)) {
      call(object.index, 0, object);
    }
    for (const Sub& sub : object.subs) {
      call(object.index, sub.sub_index, sub);
    }
  }
}

ListKind list_of(std::uint16_t index) {
  if (index == 0x1000 || index == 0x1001 || index == 0x1018) {
    return ListKind::mandatory;
  }
  return index >= 0x2000 && index < 0x6000 ? ListKind::manufacturer : ListKind::optional;
}

const std::vector<AllowedValue>& allowed_values_of(const Device& device, const Entry& entry) {
  const std::vector<AllowedValue>* values = &entry.allowed->values;
  std::string_view id = entry.type->reference.text;
  for (std::size_t steps = 0; values->empty() && steps < device.types.size(); ++steps) {  // types may form a cycle
    const auto type = std::find_if(device.types.begin(), device.types.end(),
                                   [id](const TypeDefinition& candidate) { return candidate.id.text == id; });
    if (id.empty() || type == device.types.end() || type->kind == TypeDefinition::Kind::array) {
      break;
    }
    values = &type->values;
    id = type->type.reference.text;
  }
  return *values;
}

bool is_range_type(const Object& object) {
  const Sub* const base = object.find(1);
  const bool has_form = object.index >= 0xA0 && object.index < 0x1000 && object.subs.size() == 4 &&
                        object.object_code.value == ObjectCode::record && base != nullptr &&
                        object.find(2) != nullptr && object.find(3) != nullptr && base->default_value.is_integer();
  if (!has_form || base->default_value.integer.is_negative || base->default_value.integer.magnitude > 0xFF) {
    return false;
  }
  const TypeKind kind = data_type(static_cast<std::uint16_t>(base->default_value.integer.magnitude)).kind;
  return is_integer(kind) || kind == TypeKind::real;
}

const DataType& data_type_of(const Device& device, std::uint16_t code) {
  const DataType& basic = data_type(code);
  const Object* own = basic.kind == TypeKind::unknown ? device.find(code) : nullptr;
  if (own == nullptr) {
    return basic;
  }
  if (is_range_type(*own)) {
    return data_type(static_cast<std::uint16_t>(own->find(1)->default_value.integer.magnitude));
  }
  const bool is_structure = own->object_code.value == ObjectCode::defstruct || !own->subs.empty();
  return is_structure ? structure : data_type(own->data_type.value);
}

const Value& value_in_force(const Entry& entry) {
  return entry.actual_value->kind != Value::Kind::none ? *entry.actual_value : entry.default_value;
}

std::string Value::written_integer() const {
  const char* const sign = integer.is_negative ? "-" : "";
  return adds_node_id ? fmt::format("$NODEID+{}0x{:X}", sign, integer.magnitude)
                      : fmt::format("{}{}", sign, integer.magnitude);
}

Integer Value::integer_for(std::uint8_t node_id) const {
  if (!adds_node_id) {
    return integer;
  }
  if (!integer.is_negative) {
    return integer.magnitude + node_id;
  }
  return integer.magnitude <= node_id ? Integer(node_id - integer.magnitude)
                                      : Integer(integer.magnitude - node_id, true);
}

}  // namespace lexican::codict
