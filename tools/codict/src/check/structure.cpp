// SPDX-License-Identifier: Apache-2.0
// Checks of relations between objects: types, links, modules of bus couplers, objects that exist in pairs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "model/subject.hpp"

namespace lexican::codict::check {

namespace {

// Types ------------------------------------------------------------------------------------------------------------

void check_type(const Device& device, const Entry& entry, Findings& findings) {
  const DataType& type = data_type_of(device, entry.data_type.value);
  if (type.kind == TypeKind::structure) {
    findings.add(rules::type_complex, entry.data_type.span,
                 fmt::format("data type {:04X}h is a structure, but this is one value", entry.data_type.value),
                 "use a basic type, or a RECORD with sub-objects");
  } else if (type.kind == TypeKind::domain && entry.pdo_mapping.value != PdoMapping::no) {
    findings.add(rules::unmappable, entry.pdo_mapping.span, "DOMAIN with PDO mapping", "set PDOMapping=0");
  }
}

// Returns true for elements of an ARRAY: sub-index 0 is their number, FFh describes the structure.
bool is_element(const Sub& sub) { return sub.sub_index != 0 && sub.sub_index != 0xFF && sub.data_type.value != 0; }

void check_elements(const Object& elements, Findings& findings) {
  const auto first = std::find_if(elements.subs.begin(), elements.subs.end(), is_element);
  const auto other = std::find_if(first, elements.subs.end(), [first](const Sub& sub) {
    return is_element(sub) && sub.data_type.value != first->data_type.value;
  });
  if (other != elements.subs.end()) {
    findings.add(rules::array_types, other->data_type.span,
                 fmt::format("element is {}, but sub-index {} is {}", type_text(other->data_type.value),
                             first->sub_index, type_text(first->data_type.value)),
                 "use one data type, or describe the object as a RECORD");
  }
}

void check_capacity(const Entry& entry, Findings& findings) {
  const Value& value = entry.default_value;
  const std::size_t size = value.kind == Value::Kind::octets ? value.octets->size() : value.text.size();
  const bool is_string = value.kind == Value::Kind::octets || value.kind == Value::Kind::text;
  if (is_string && !entry.node->byte_length->is_empty() && size > entry.node->byte_length->value) {
    findings.add(
        rules::string_capacity, value.span,
        fmt::format("default value has {} bytes, but CO_byteLength is {}", size, entry.node->byte_length->value),
        "raise CO_byteLength, or shorten the value");
  }
}

// Objects that other parts of the description refer to ----------------------------------------------------------------

bool is_of_module(const Device& device, std::uint16_t index) {
  return std::any_of(device.modules.begin(), device.modules.end(), [index](const Module& module) {
    return std::any_of(module.fixed.begin(), module.fixed.end(),
                       [index](const Object& object) { return object.index == index; });
  });
}

void check_links(const Device& device, const Object& object, Findings& findings) {
  for (const Field<std::uint16_t>& link : object.links) {
    if (link.value != 0 && device.find(link.value) == nullptr && !is_of_module(device, link.value)) {
      findings.add(rules::link, link.span, fmt::format("linked object {:04X}h does not exist", link.value),
                   "correct or remove the link");
    }
  }
}

void check_fixed_objects(const Device& device, const Module& module, Findings& findings) {
  for (const Object& object : module.fixed) {
    if (device.find(object.index) != nullptr) {
      findings.add(rules::module_object, object.span,
                   fmt::format("module {} defines an object of the bus coupler", module.number),
                   "remove one of the objects, or correct its index");
    }
  }
}

void check_connected_modules(const Device& device, Findings& findings) {
  for (const Field<std::uint16_t>& connected : device.connected_modules) {
    const bool is_described =
        std::any_of(device.modules.begin(), device.modules.end(),
                    [&connected](const Module& module) { return module.number == connected.value; });
    if (connected.value != 0 && !is_described) {  // 0: a slot without a module
      findings.add(rules::module_number, connected.span,
                   fmt::format("connected module {} is not described", connected.value),
                   "correct the number, or describe the module");
    }
  }
}

void check_modules(const Device& device, Findings& findings) {
  if (!device.modules.empty() && device.find(0x1027) == nullptr) {
    findings.add(rules::module_list, {}, "modules are described, but object 1027h is missing", "describe it");
  }
  for (const Module& module : device.modules) {
    check_fixed_objects(device, module, findings);
  }
  check_connected_modules(device, findings);
}

// Objects of former editions of CiA 301, which are now reserved.
constexpr std::array<std::uint16_t, 4> former_objects = {0x1004, 0x100B, 0x100E, 0x100F};

void check_former(const Device& device, Findings& findings) {
  for (const std::uint16_t index : former_objects) {
    if (const Object* const object = device.find(index)) {
      findings.add(rules::former, object->span, "object is no longer defined by CiA 301", "remove it");
    }
  }
}

std::vector<std::uint8_t> sub_indexes_of(const Object& object) {
  std::vector<std::uint8_t> all;
  for (const Sub& sub : object.subs) {
    all.push_back(sub.sub_index);
  }
  return all;
}

void check_store(const Device& device, Findings& findings) {
  const Object* const store = device.find(0x1010);
  const Object* const restore = device.find(0x1011);
  if (store != nullptr && restore != nullptr && sub_indexes_of(*store) != sub_indexes_of(*restore)) {
    findings.add(rules::store_pair, restore->span, "sub-indexes differ from those of 1010h", "use the same in both");
  }
}

}  // namespace

void check_structure(const Device& device, Findings& findings) {
  for (const Object& object : device.objects) {
    check_links(device, object, findings);
    if (object.object_code.value == ObjectCode::array) {
      check_elements(object, findings);
    }
  }
  for_each_variable(device, [&](std::uint16_t, std::uint8_t, const Entry& entry) {
    check_type(device, entry, findings);
    check_capacity(entry, findings);
  });
  check_modules(device, findings);
  check_former(device, findings);
  check_store(device, findings);
  constexpr std::uint8_t most_granular = 64;
  if (device.features.granularity.value > most_granular) {
    findings.add(rules::granularity, device.features.granularity.span,
                 fmt::format("granularity {} is above {} bits", device.features.granularity.value, most_granular),
                 "write 0 to 64");
  }
}

}  // namespace lexican::codict::check
