// SPDX-License-Identifier: Apache-2.0
#include "describe/configuration.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "eds/write.hpp"
#include "model/cob_id.hpp"
#include "model/downloads.hpp"
#include "model/parse.hpp"
#include "model/pdo.hpp"

namespace lexican::describe {
namespace {

constexpr std::uint32_t no_upload_on_scan = 2;  // ObjFlags, bit 1. [306]
constexpr std::uint32_t module_profile = 401;
constexpr std::uint32_t drive_profile = 402;

struct Commands {
  std::uint16_t first;
  std::uint16_t last;
};

/// Objects of a device profile with which something moves at once, at the first logical device; those of the others
/// follow at each axis_distance.
struct Motion {
  std::uint32_t profile;
  std::uint16_t first;
  std::uint16_t last;
  Part part;
  std::uint8_t last_sub_index = 255;
};

constexpr std::uint16_t first_of_profiles = 0x6000;
constexpr std::uint16_t behind_profiles = 0xA000;
constexpr unsigned axis_distance = 0x800;

constexpr Motion motions[] = {
    {drive_profile, 0x6040, 0x6040, Part::command},       // controlword
    {drive_profile, 0x6042, 0x6042, Part::set_point},     // vl target velocity
    {drive_profile, 0x6071, 0x6071, Part::set_point},     // target torque
    {drive_profile, 0x607A, 0x607A, Part::set_point},     // target position
    {drive_profile, 0x60B0, 0x60B2, Part::set_point},     // offsets of position, velocity and torque
    {drive_profile, 0x60C1, 0x60C1, Part::set_point},     // interpolation data record
    {drive_profile, 0x60FE, 0x60FE, Part::set_point, 1},  // physical outputs, such as the brake; 2: their mask
    {drive_profile, 0x60FF, 0x60FF, Part::set_point},     // target velocity
    {module_profile, 0x6200, 0x6200, Part::set_point},    // outputs of 8 bits
    {module_profile, 0x6220, 0x6227, Part::set_point},    // of 1 bit
    {module_profile, 0x6300, 0x6300, Part::set_point},    // of 16 bits
    {module_profile, 0x6320, 0x6320, Part::set_point},    // of 32 bits
    {module_profile, 0x6410, 0x6414, Part::set_point},    // analogue outputs
};

/// Errors are cleared, parameters stored and restored, the configuration marked as verified, commands executed,
/// programs loaded, and NMT commands sent.
constexpr Commands commands[] = {{0x1003, 0x1003}, {0x1010, 0x1011}, {0x1020, 0x1020},
                                 {0x1023, 0x1026}, {0x1F50, 0x1F5F}, {0x1F82, 0x1F82}};

bool is_command(std::uint16_t index) {
  return std::any_of(std::begin(commands), std::end(commands),
                     [=](const Commands& range) { return index >= range.first && index <= range.last; });
}

/// Returns the row of an object; null: nothing moves with it. A device whose type is unknown can be any of them.
const Motion* motion_of(const codict::Device& device, const EntryKey& key) {
  const std::uint16_t index = key.first;
  const std::uint8_t sub_index = key.second;
  if (index < first_of_profiles || index >= behind_profiles) {
    return nullptr;
  }
  const codict::Entry* const type = device.find(device_type.first, device_type.second);
  const bool is_type_known = type != nullptr && codict::value_in_force(*type).is_integer();
  const std::uint64_t profile = is_type_known ? codict::value_in_force(*type).integer.bits() & 0xFFFFU : 0U;
  const unsigned of_profile = first_of_profiles + (index - first_of_profiles) % axis_distance;
  const auto* const found = std::find_if(std::begin(motions), std::end(motions), [=](const Motion& row) {
    const bool is_profile = !is_type_known || row.profile == profile;
    return is_profile && of_profile >= row.first && of_profile <= row.last && sub_index <= row.last_sub_index;
  });
  return found != std::end(motions) ? found : nullptr;
}

codict::Entry* entry_of(codict::Device& device, const EntryKey& key) {
  codict::Object* const object = device.find(key.first);
  if (object == nullptr || device.find(key.first, key.second) == nullptr) {
    return nullptr;
  }
  return object->subs.empty() ? static_cast<codict::Entry*>(object) : object->find(key.second);
}

/// Returns the COB-ID, without node-ID, that CiA 301 gives a service at first; 0: none. [301:7.3.5]
std::uint32_t predefined_base(const EntryKey& key) {
  const auto [index, sub_index] = key;
  if (index == 0x1014 && sub_index == 0) {
    return 0x080;
  }
  const bool is_pdo = (index >= 0x1400 && index < 0x1404) || (index >= 0x1800 && index < 0x1804);
  return is_pdo && sub_index == 1 ? (index < 0x1800 ? 0x200U : 0x180U) + (index & 3U) * 0x100U : 0U;
}

/// Returns whether a number is the sum of the node-ID and a base, which is the same for other nodes.
bool is_relative(const codict::Entry& entry, const EntryKey& key, std::uint8_t node, std::uint64_t number) {
  constexpr std::uint64_t identifier = 0x1FFFFFFF;
  const bool has_node = (number & 0x7FU) == node;
  const std::uint32_t base = predefined_base(key);
  return has_node &&
         (entry.default_value.adds_node_id || (base != 0 && (number & identifier) == base + std::uint64_t{node}));
}

/// Returns a number as the description writes its default, in decimal or hexadecimal digits.
std::string written(const codict::Entry& entry, const codict::Integer& number, unsigned bits) {
  const std::string& like = entry.default_value.text;
  const bool is_hexadecimal = like.size() > 2 && like[0] == '0' && (like[1] == 'x' || like[1] == 'X');
  return is_hexadecimal && !number.is_negative ? fmt::format("0x{:0{}X}", number.magnitude, (bits + 3) / 4)
                                               : fmt::format("{}{}", number.is_negative ? "-" : "", number.magnitude);
}

/// Returns the text of a value in a DCF; empty: it has none.
std::string text_of(const codict::Entry& entry, const codict::DataType& type, const EntryKey& key, std::uint8_t node,
                    const Bytes& bytes) {
  const std::uint64_t number = bytes.size() <= sizeof number ? number_of(bytes) : 0U;
  switch (type.kind) {
    case codict::TypeKind::boolean:
    case codict::TypeKind::unsigned_integer:
      return is_relative(entry, key, node, number) ? fmt::format("$NODEID+0x{:X}", number - node)
                                                   : written(entry, number, type.bits);
    case codict::TypeKind::signed_integer: return written(entry, codict::sign_extended(number, type.bits), type.bits);
    case codict::TypeKind::real: {
      const std::optional<ValueType> real = value_type(type.bits == 32 ? "r32" : "r64");
      return show(*real, bytes).text;
    }
    case codict::TypeKind::visible_string: {
      return visible_text(bytes);
    }
    case codict::TypeKind::octet_string: {
      std::string text;
      for (const std::uint8_t byte : bytes) {
        text += fmt::format("{:02X}", byte);
      }
      return text;
    }
    default: return {};
  }
}

template <typename T>
void set(codict::Field<T>& field, T value) {
  field.value = value;
  field.text = std::to_string(value);
  field.is_given = true;
}

}  // namespace

std::string keys_text(const std::vector<EntryKey>& keys) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t n = 0; n < keys.size() && n < most; ++n) {
    const auto [index, sub_index] = keys[n];
    text += (n == 0 ? "" : ", ") + key_of(index, sub_index, sub_index != 0);
  }
  return text + (keys.size() > most ? fmt::format(" and {} more", keys.size() - most) : "");
}

void forget_values(codict::Device& device) {
  for (codict::Object& object : device.objects) {
    object.actual_value.reset();
    for (codict::Sub& sub : object.subs) {
      sub.actual_value.reset();
    }
  }
}

bool is_equal(const codict::Device& device, const EntryKey& key, Bytes one, Bytes other) {
  const codict::Entry* const entry = device.find(key.first, key.second);
  if (entry != nullptr &&
      codict::data_type_of(device, entry->data_type.value).kind == codict::TypeKind::visible_string) {
    for (Bytes* bytes : {&one, &other}) {
      while (!bytes->empty() && bytes->back() == 0) {
        bytes->pop_back();
      }
    }
  }
  return one == other;
}

std::set<EntryKey> mapped_entries(const codict::Device& device) {
  std::set<EntryKey> mapped;
  for (const codict::Pdo& pdo : codict::pdos_of(device)) {
    const codict::Entry* const cob_id = pdo.parameter(1);
    const codict::Value* const value = cob_id != nullptr ? &codict::value_in_force(*cob_id) : nullptr;
    const bool is_valid =
        value != nullptr && value->is_integer() && (value->integer.bits() & codict::cob_id_invalid) == 0;
    for (const codict::MappedObject& object : pdo.mapped) {
      if (is_valid) {
        mapped.emplace(object.index, object.sub_index);
      }
    }
  }
  return mapped;
}

Part part_of(const codict::Device& device, const EntryKey& key, const std::set<EntryKey>& mapped) {
  const codict::Entry& entry = *device.find(key.first, key.second);
  const codict::Access access = entry.access.value;
  if (is_command(key.first)) {
    return Part::command;
  }
  const Motion* const motion = motion_of(device, key);
  if (motion != nullptr && codict::is_writable(access)) {
    return motion->part;
  }
  if (codict::data_type_of(device, entry.data_type.value).kind == codict::TypeKind::domain) {
    return Part::domain;
  }
  if (!codict::is_readable(access) || (entry.flags->value & no_upload_on_scan) != 0) {
    return Part::write_only;
  }
  return mapped.count(key) != 0        ? Part::process_value
         : codict::is_writable(access) ? Part::configuration
                                       : Part::read_only;
}

bool store_value(codict::Device& device, const EntryKey& key, std::uint8_t node, const Bytes& bytes) {
  codict::Entry* const entry = entry_of(device, key);
  if (entry == nullptr) {
    return false;
  }
  const codict::DataType& type = codict::data_type_of(device, entry->data_type.value);
  codict::Value value;
  value.text = text_of(*entry, type, key, node, bytes);
  value.is_given = true;
  codict::Findings ignored;
  codict::interpret(value, type, ignored);
  const std::optional<std::string> meant = codict::sdo_bytes(device, *entry, value, node);
  const bool is_meant = meant && is_equal(device, key, {meant->begin(), meant->end()}, bytes);
  const bool is_trimmed = value.text.empty() || (value.text.front() != ' ' && value.text.back() != ' ');
  if (!is_meant || !is_trimmed) {
    return false;
  }
  entry->actual_value.edit() = std::move(value);
  return true;
}

void store_device_type(codict::Device& device, std::uint32_t value) {
  if (codict::Entry* const entry = entry_of(device, device_type)) {
    entry->default_value.kind = codict::Value::Kind::integer;
    entry->default_value.integer = value;
    entry->default_value.text = fmt::format("0x{:08X}", value);
    entry->default_value.is_given = true;
  }
}

std::string to_dcf(codict::Device device, std::uint8_t node, std::uint32_t bit_rate, const std::string& file_name) {
  device.file.last_eds = device.file.file_name;
  device.file.file_name.text = file_name;
  device.file.file_name.is_given = true;
  device.commissioning.is_given = true;
  set(device.commissioning.node_id, node);
  if (bit_rate != 0) {
    set(device.commissioning.bit_rate, bit_rate / 1000);
  }
  codict::eds::WriteOptions options;
  options.as_dcf = true;
  return codict::eds::write(device, options);
}

}  // namespace lexican::describe
