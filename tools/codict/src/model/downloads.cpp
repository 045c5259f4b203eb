// SPDX-License-Identifier: Apache-2.0
#include "model/downloads.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "model/cob_id.hpp"
#include "model/pdo.hpp"

namespace lexican::codict {

namespace {

constexpr std::uint32_t refuses_download = 1;  // ObjFlags, bit 0

std::string little_endian(std::uint64_t value, unsigned bytes) {
  std::string result;
  for (unsigned n = 0; n < bytes; ++n) {
    result += static_cast<char>(value >> (8 * n) & 0xFFU);
  }
  return result;
}

std::string real_bytes(double value, unsigned bits) {
  if (bits == 32) {
    const auto single = static_cast<float>(value);
    std::uint32_t pattern = 0;
    std::memcpy(&pattern, &single, sizeof pattern);
    return little_endian(pattern, 4);
  }
  std::uint64_t pattern = 0;
  std::memcpy(&pattern, &value, sizeof pattern);
  return little_endian(pattern, 8);
}

bool is_communication(std::uint16_t index) {
  return (index >= 0x1400 && index < 0x1600) || (index >= 0x1800 && index < 0x1A00);
}
bool is_mapping(std::uint16_t index) {
  return (index >= 0x1600 && index < 0x1800) || (index >= 0x1A00 && index < 0x1C00);
}

using Uncoded = std::function<void(std::uint16_t, std::uint8_t, const Entry&)>;

class DownloadList {
 public:
  DownloadList(const Device& device, std::uint8_t node_id, const Uncoded& uncoded)
      : device_(device), node_id_(node_id), uncoded_(uncoded) {}

  void add_objects();
  void add_pdos();
  std::vector<Download> take_downloads() { return std::move(downloads_); }

 private:
  bool is_configured(const Entry* entry) const {
    return entry != nullptr && entry->actual_value->kind != Value::Kind::none && is_writable(entry->access.value) &&
           (entry->flags->value & refuses_download) == 0;
  }
  bool is_configured(const Object& object) const {
    return std::any_of(object.subs.begin(), object.subs.end(),
                       [this](const codict::Sub& sub) { return is_configured(&sub); });
  }
  void add(std::uint16_t index, std::uint8_t sub_index, const Entry& entry);
  void add_number(std::uint16_t index, std::uint8_t sub_index, std::uint64_t value, unsigned bytes,
                  bool is_intermediate) {
    downloads_.push_back({index, sub_index, little_endian(value, bytes), communication_, is_intermediate});
  }
  std::optional<std::uint64_t> number(std::uint16_t index, std::uint8_t sub_index) const;
  void add_communication(const Object& object);
  void add_mapping(const Object& object);
  void add_pdo(const Pdo& pdo);

  const Device& device_;
  std::uint8_t node_id_;
  const Uncoded& uncoded_;
  std::uint16_t communication_ = 0;  // of the PDO whose downloads are added
  std::vector<Download> downloads_;
};

/// Returns the value in force; nothing if it is no number.
std::optional<std::uint64_t> DownloadList::number(std::uint16_t index, std::uint8_t sub_index) const {
  const Entry* const entry = device_.find(index, sub_index);
  const bool is_coded = entry != nullptr && sdo_bytes(device_, *entry, value_in_force(*entry), node_id_);
  return is_coded && value_in_force(*entry).is_integer()
             ? std::optional(value_in_force(*entry).integer_for(node_id_).bits())
             : std::nullopt;
}

void DownloadList::add(std::uint16_t index, std::uint8_t sub_index, const Entry& entry) {
  const std::optional<std::string> bytes = sdo_bytes(device_, entry, entry.actual_value, node_id_);
  if (bytes) {
    downloads_.push_back({index, sub_index, *bytes, communication_, false});
  } else {
    uncoded_(index, sub_index, entry);
  }
}

void DownloadList::add_objects() {
  for_each_variable(device_, [this](std::uint16_t index, std::uint8_t sub_index, const Entry& entry) {
    // A value that is written to 1010h or 1011h is a command, "save" or "load".
    const bool is_command = index == 0x1010 || index == 0x1011;
    if (!is_communication(index) && !is_mapping(index) && !is_command && is_configured(&entry)) {
      add(index, sub_index, entry);
    }
  });
}

void DownloadList::add_communication(const Object& object) {
  for (const codict::Sub& sub : object.subs) {
    if (sub.sub_index > 1 && is_configured(&sub)) {
      add(object.index, sub.sub_index, sub);
    }
  }
}

// Sets the number of mapped objects to 0 while the mapping changes. [301: 7.5.2.36]
void DownloadList::add_mapping(const Object& object) {
  const codict::Sub* const count = object.find(0);
  const bool has_entries = std::any_of(object.subs.begin(), object.subs.end(), [this](const codict::Sub& sub) {
    return sub.sub_index != 0 && is_configured(&sub);
  });
  const bool is_changeable = count != nullptr && is_writable(count->access.value);
  if (is_configured(count) && !number(object.index, 0)) {
    uncoded_(object.index, 0, *count);
    return;
  }
  if (is_changeable && has_entries) {
    add_number(object.index, 0, 0, 1, true);
  }
  for (const codict::Sub& sub : object.subs) {
    if (sub.sub_index != 0 && is_configured(&sub)) {
      add(object.index, sub.sub_index, sub);
    }
  }
  if (is_changeable && (has_entries || is_configured(count))) {
    add_number(object.index, 0, number(object.index, 0).value_or(0), 1, false);
  }
}

// Disables the PDO (bit 31 of its COB-ID) while its parameters and its mapping change. [301: 7.5.2.36] The COB-ID that
// is written at the end enables it, unless it is configured as disabled.
void DownloadList::add_pdo(const Pdo& pdo) {
  const bool changes_mapping = pdo.mapping != nullptr && is_configured(*pdo.mapping);
  const bool is_changed = changes_mapping || (pdo.communication != nullptr && is_configured(*pdo.communication));
  if (!is_changed) {
    return;
  }
  if (pdo.communication == nullptr) {
    add_mapping(*pdo.mapping);
    return;
  }
  const Entry* const cob_id = pdo.parameter(1);
  const std::optional<std::uint64_t> value = number(pdo.communication->index, 1);
  if (is_configured(cob_id) && !value) {
    uncoded_(pdo.communication->index, 1, *cob_id);
    return;
  }
  const bool is_switched = cob_id != nullptr && is_writable(cob_id->access.value) && value;
  if (is_switched) {
    add_number(pdo.communication->index, 1, *value | cob_id_invalid, 4, (*value & cob_id_invalid) == 0);
  }
  add_communication(*pdo.communication);
  if (changes_mapping) {
    add_mapping(*pdo.mapping);
  }
  if (is_switched && (*value & cob_id_invalid) == 0) {
    add_number(pdo.communication->index, 1, *value, 4, false);
  }
}

void DownloadList::add_pdos() {
  for (const Pdo& pdo : pdos_of(device_)) {
    communication_ = static_cast<std::uint16_t>((pdo.is_transmit ? 0x1800 : 0x1400) + pdo.number - 1);
    add_pdo(pdo);
  }
}

}  // namespace

std::optional<std::string> sdo_bytes(const Device& device, const Entry& entry, const Value& value,
                                     std::uint8_t node_id) {
  const DataType& type = data_type_of(device, entry.data_type.value);
  switch (value.kind) {
    case Value::Kind::integer:
      if (type.bits == 0 || type.bits > 64 || type.kind == TypeKind::real) {
        return std::nullopt;
      }
      if (value.adds_node_id && !fits_unsigned(value.integer_for(node_id), type.bits)) {
        return std::nullopt;
      }
      return little_endian(value.integer_for(node_id).bits(), (type.bits + 7U) / 8U);
    case Value::Kind::real: return real_bytes(value.real, type.bits);
    case Value::Kind::octets: return value.octets;
    case Value::Kind::text: return type.kind == TypeKind::visible_string ? std::optional(value.text) : std::nullopt;
    case Value::Kind::none:
    case Value::Kind::malformed: break;
  }
  return std::nullopt;
}

std::vector<Download> downloads_of(const Device& device, std::uint8_t node_id, const Uncoded& uncoded) {
  DownloadList list(device, node_id, uncoded);
  list.add_objects();
  list.add_pdos();
  return list.take_downloads();
}

}  // namespace lexican::codict
