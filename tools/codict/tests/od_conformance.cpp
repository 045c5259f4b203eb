// SPDX-License-Identifier: Apache-2.0
#include "od_conformance.hpp"

#include <fmt/format.h>

#include <cstring>

namespace test {

using namespace lexican::codict;

namespace {

constexpr std::uint32_t refuses_download = 1;  // ObjFlags: a scan must not write the object
constexpr std::uint32_t refuses_upload = 2;
constexpr std::uint8_t structure_sub = 0xFF;

const char* const no_object = "abort 06020000";
const char* const no_sub_index = "abort 06090011";
const char* const not_readable = "abort 06010001";
const char* const not_writable = "abort 06010002";
const char* const wrong_signature = "abort 08000020";
const char* const too_high = "abort 06090031";
const char* const too_low = "abort 06090032";
const char* const pdo_is_valid = "abort 06010000";
const char* const not_mappable = "abort 06040041";
const char* const no_error_there = "abort 08000024";

std::string place_of(std::uint16_t index, std::uint8_t sub_index) {
  return fmt::format("{:04X}h:{:02X}", index, sub_index);
}

std::string octets(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) {
    text += fmt::format("{}{:02X}", text.empty() ? "" : " ", static_cast<unsigned char>(byte));
  }
  return text;
}

// Returns a number as hexadecimal bytes, low byte first as on the bus.
std::string octets(std::uint64_t number, unsigned size) {
  std::string bytes;
  for (unsigned n = 0; n < size; ++n) {
    bytes += static_cast<char>(number >> 8 * n);
  }
  return octets(bytes);
}

template <typename Real, typename Bits>
std::string octets_of(double value) {
  const auto real = static_cast<Real>(value);
  Bits bits = 0;
  std::memcpy(&bits, &real, sizeof bits);
  return octets(bits, sizeof bits);
}

// Converts UTF-8 up to U+07FF to 2 bytes per character, which the fixtures do not exceed.
std::string wide(const std::string& utf8) {
  std::string bytes;
  for (std::size_t n = 0; n < utf8.size(); ++n) {
    auto code = static_cast<unsigned char>(utf8[n]) & 0xFFU;
    if (code >= 0xC0) {
      code = (code & 0x1FU) << 6 | (static_cast<unsigned char>(utf8[++n]) & 0x3FU);
    }
    bytes += {static_cast<char>(code), static_cast<char>(code >> 8)};
  }
  return octets(bytes);
}

unsigned size_of(const DataType& type) { return (type.bits + 7U) / 8U; }

bool is_answer(const std::string& read) { return read.compare(0, 5, "abort") != 0 && read.compare(0, 2, "no") != 0; }

bool is_error_field(std::uint16_t index, std::uint8_t sub_index) { return index == 0x1003 && sub_index != 0; }

// Returns true for entries that accept only the signature "save" or "load". [301:7.5.2.13]
bool is_command(std::uint16_t index, std::uint8_t sub_index) {
  return (index == 0x1010 || index == 0x1011) && sub_index != 0;
}

bool is_mapping(std::uint16_t index) {
  return (index >= 0x1600 && index <= 0x17FF) || (index >= 0x1A00 && index <= 0x1BFF);
}

// Returns true if sub-index 0 is a number of entries, not the highest sub-index. [301:7.5.2.6, 7.5.2.36]
bool counts_otherwise(std::uint16_t index) { return index == 0x1003 || is_mapping(index); }

bool takes(std::uint16_t index, std::uint8_t sub_index, const std::string& answer) {
  if (is_command(index, sub_index)) {
    return answer == wrong_signature;
  }
  return answer == "ok" || (is_mapping(index) && answer == pdo_is_valid);
}

void note(Contradictions& found, std::uint16_t index, std::uint8_t sub_index, const char* what, const std::string& is,
          const std::string& should_be) {
  found.push_back(fmt::format("{} {}: {}, not {}", place_of(index, sub_index), what, is, should_be));
}

}  // namespace

template <typename Check>
Contradictions OdConformance::for_each(Check check) {
  Contradictions found;
  for_each_variable(described_, [&](std::uint16_t index, std::uint8_t sub_index, const Entry& entry) {
    if (is_in_area(index) && sub_index != structure_sub) {
      check(index, sub_index, entry, found);
    }
  });
  return found;
}

// Returns bytes for a write access: the present value, else zeros of the right length.
std::string OdConformance::content_of(std::uint16_t index, std::uint8_t sub_index, const Entry& entry) {
  const unsigned size = size_of(data_type_of(described_, entry.data_type.value));
  const std::string present = is_readable(entry.access.value) ? node_.read(index, sub_index) : "";
  if (is_answer(present) && !present.empty()) {
    return present;
  }
  return octets(0, size != 0 ? size : 2);
}

Contradictions OdConformance::access() {
  return for_each([this](std::uint16_t index, std::uint8_t sub_index, const Entry& entry, Contradictions& found) {
    const unsigned size = size_of(data_type_of(described_, entry.data_type.value));
    if (is_readable(entry.access.value) && (entry.flags->value & refuses_upload) == 0) {
      const std::string read = node_.read(index, sub_index);
      const bool is_empty_history = is_error_field(index, sub_index) && read == no_error_there;
      if (!is_answer(read) && !is_empty_history) {
        note(found, index, sub_index, "read", read, "a value");
      } else if (size != 0 && read.size() != 3 * size - 1 && !is_empty_history) {
        note(found, index, sub_index, "length", read, fmt::format("{} bytes", size));
      }
    }
    if (is_writable(entry.access.value) && (entry.flags->value & refuses_download) == 0) {
      const std::string answer = node_.write(index, sub_index, content_of(index, sub_index, entry));
      if (!takes(index, sub_index, answer)) {
        note(found, index, sub_index, "write", answer, "ok");
      }
    }
  });
}

std::string OdConformance::default_of(const Entry& entry) const {
  const Value& value = entry.default_value;
  const DataType& type = data_type_of(described_, entry.data_type.value);
  switch (value.kind) {
    case Value::Kind::integer: return octets(value.integer_for(GeneratedNode::id).bits(), size_of(type));
    case Value::Kind::real:
      return type.bits == 32 ? octets_of<float, std::uint32_t>(value.real)
                             : octets_of<double, std::uint64_t>(value.real);
    case Value::Kind::text: return type.kind == TypeKind::unicode_string ? wide(value.text) : octets(value.text);
    case Value::Kind::octets: return octets(*value.octets);
    case Value::Kind::none:
    case Value::Kind::malformed: break;
  }
  return {};
}

Contradictions OdConformance::defaults() {
  return for_each([this](std::uint16_t index, std::uint8_t sub_index, const Entry& entry, Contradictions& found) {
    const std::string expected = default_of(entry);
    if (!expected.empty() && is_readable(entry.access.value) && (entry.flags->value & refuses_upload) == 0) {
      const std::string read = node_.read(index, sub_index);
      if (read != expected) {
        note(found, index, sub_index, "default", read, expected);
      }
    }
  });
}

Contradictions OdConformance::read_only() {
  return for_each([this](std::uint16_t index, std::uint8_t sub_index, const Entry& entry, Contradictions& found) {
    if (is_readable(entry.access.value) && !is_writable(entry.access.value)) {
      const std::string answer = node_.write(index, sub_index, content_of(index, sub_index, entry));
      if (answer != not_writable) {
        note(found, index, sub_index, "write", answer, not_writable);
      }
    }
  });
}

Contradictions OdConformance::write_only() {
  return for_each([this](std::uint16_t index, std::uint8_t sub_index, const Entry& entry, Contradictions& found) {
    if (is_writable(entry.access.value) && !is_readable(entry.access.value)) {
      const std::string answer = node_.read(index, sub_index);
      if (answer != not_readable) {
        note(found, index, sub_index, "read", answer, not_readable);
      }
    }
  });
}

Contradictions OdConformance::structure() {
  Contradictions found;
  for (const Object& object : described_.objects) {
    if (object.subs.empty() || !is_in_area(object.index)) {
      continue;
    }
    // Bits 8 to 15: data type, of an ARRAY that of its elements; bits 0 to 7: object code. [301:7.4.5]
    const std::uint16_t type = object.data_type.is_given ? object.data_type.value : object.subs.back().data_type.value;
    const std::string expected = octets(static_cast<std::uint64_t>(object.object_code.value) | unsigned{type} << 8, 4);
    const std::string read = node_.read(object.index, structure_sub);
    if (read != no_sub_index && read != expected) {
      note(found, object.index, structure_sub, "structure", read, expected);
    }
    const std::string number = octets(highest_sub(object), 1);
    const std::string highest = node_.read(object.index, 0);
    if (!counts_otherwise(object.index) && highest != number) {
      note(found, object.index, 0, "highest sub-index", highest, number);
    }
  }
  return found;
}

Contradictions OdConformance::limits() {
  return for_each([this](std::uint16_t index, std::uint8_t sub_index, const Entry& entry, Contradictions& found) {
    const DataType& type = data_type_of(described_, entry.data_type.value);
    if (!is_writable(entry.access.value) || !is_integer(type.kind)) {
      return;
    }
    const std::uint64_t all = UINT64_MAX >> (64U - type.bits);
    const bool is_signed = type.kind == TypeKind::signed_integer;
    const std::uint64_t highest = is_signed ? all >> 1 : all;
    const std::uint64_t lowest = is_signed ? highest + 1 : 0;
    const auto write = [&](std::uint64_t bits, const char* expected) {
      const std::string answer = node_.write(index, sub_index, octets(bits, size_of(type)));
      if (answer != expected) {
        note(found, index, sub_index, octets(bits, size_of(type)).c_str(), answer, expected);
      }
    };
    const std::uint64_t low = entry.low_limit->integer_for(GeneratedNode::id).bits() & all;
    const std::uint64_t high = entry.high_limit->integer_for(GeneratedNode::id).bits() & all;
    if (entry.low_limit->is_integer()) {
      write(low, "ok");
    }
    if (entry.low_limit->is_integer() && low != lowest) {
      write(low - 1, too_low);
    }
    if (entry.high_limit->is_integer()) {
      write(high, "ok");
    }
    if (entry.high_limit->is_integer() && high != highest) {
      write(high + 1, too_high);
    }
  });
}

Contradictions OdConformance::absence() {
  Contradictions found;
  for (std::uint32_t wide = area_.first; wide <= area_.last; ++wide) {
    const auto index = static_cast<std::uint16_t>(wide);
    const Object* const object = described_.find(index);
    if (object == nullptr) {
      const std::string read = node_.read(index, 0);
      if (read != no_object) {
        note(found, index, 0, "not described", read, no_object);
      }
      continue;
    }
    for (unsigned sub = 0; sub < structure_sub; ++sub) {
      const auto sub_index = static_cast<std::uint8_t>(sub);
      const bool is_described = object->subs.empty() ? sub == 0 : object->find(sub_index) != nullptr;
      const std::string read = is_described ? no_sub_index : node_.read(index, sub_index);
      if (read != no_sub_index) {
        note(found, index, sub_index, "not described", read, no_sub_index);
      }
    }
  }
  return found;
}

void OdConformance::map_to(std::uint16_t mapping, std::uint16_t index, std::uint8_t sub_index, const Entry& entry,
                           Contradictions& found) {
  const bool receives = mapping < 0x1800;
  const unsigned bits = 8 * size_of(data_type_of(described_, entry.data_type.value));
  const bool is_possible = entry.pdo_mapping.value != PdoMapping::no &&
                           (receives ? is_writable(entry.access.value) : is_readable(entry.access.value));
  const std::uint64_t link = std::uint64_t{index} << 16 | std::uint64_t{sub_index} << 8 | bits;
  const std::string answer = node_.write(mapping, 1, octets(link, 4));
  const std::string expected = is_possible ? "ok" : not_mappable;
  if (answer != expected) {
    note(found, index, sub_index, receives ? "mapped to an RPDO" : "mapped to a TPDO", answer, expected);
  }
}

Contradictions OdConformance::mapping() {
  Contradictions found;
  for (const std::uint16_t parameter : {std::uint16_t{0x1400}, std::uint16_t{0x1800}}) {
    const auto mapping = static_cast<std::uint16_t>(parameter + 0x200);
    const Entry* const cob_id = described_.find(parameter, 1);
    const Entry* const first = described_.find(mapping, 1);
    if (cob_id == nullptr || first == nullptr || !is_writable(cob_id->access.value) ||
        !is_writable(first->access.value)) {
      continue;
    }
    node_.write(parameter, 1, octets(0x80000000U | std::uint32_t{GeneratedNode::id}, 4));
    node_.write(mapping, 0, "00");
    const Contradictions more =
        for_each([&](std::uint16_t index, std::uint8_t sub_index, const Entry& entry, Contradictions& list) {
          const unsigned bits = data_type_of(described_, entry.data_type.value).bits;
          if (bits >= 8 && bits <= 64) {
            map_to(mapping, index, sub_index, entry, list);
          }
        });
    found.insert(found.end(), more.begin(), more.end());
  }
  return found;
}

Contradictions OdConformance::flags() {
  return for_each([this](std::uint16_t index, std::uint8_t sub_index, const Entry& entry, Contradictions& found) {
    const CO_OBJ* const obj = CODictFind(&node_.node.Dict, CO_DEV(index, sub_index));
    const bool is_described = entry.pdo_mapping.value != PdoMapping::no;
    const bool is_mappable = obj != nullptr && (obj->Key & CO_OBJ____P__) != 0;
    if (is_mappable != is_described) {
      note(found, index, sub_index, "mappable", is_mappable ? "yes" : "no", is_described ? "yes" : "no");
    }
  });
}

Contradictions OdConformance::identity() {
  Contradictions found;
  const Field<std::uint32_t>* const fields[] = {&described_.identity.vendor_number, &described_.identity.product_number,
                                                &described_.identity.revision_number};
  std::uint8_t sub_index = 0;
  for (const Field<std::uint32_t>* const field : fields) {
    const std::string read = node_.read(0x1018, ++sub_index);
    if (field->is_given && read != octets(field->value, 4)) {
      note(found, 0x1018, sub_index, "identity", read, octets(field->value, 4));
    }
  }
  return found;
}

}  // namespace test
