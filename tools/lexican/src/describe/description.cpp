// SPDX-License-Identifier: Apache-2.0
#include "describe/description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "describe/library.hpp"
#include "json/input.hpp"
#include "text/file.hpp"
#include "text/number.hpp"
#include "trace/text.hpp"

namespace lexican::describe {
namespace {

constexpr std::size_t most_shown = 64;  // bytes of a value in a line

struct Standard {
  std::uint16_t first;
  std::uint16_t last;
  std::string_view name;
  /// Types of sub-index 0, 1, and so on; the last one is also that of all further ones. x8 and x32: unsigned, shown in
  /// hexadecimal digits, such as COB-IDs, mappings, identity, codes and flags.
  std::string_view types;
};

/// The communication profile. [301:7.5.2]
constexpr Standard standard[] = {
    {0x1000, 0x1000, "device type", "x32"},
    {0x1001, 0x1001, "error register", "x8"},
    {0x1002, 0x1002, "manufacturer status register", "x32"},
    {0x1003, 0x1003, "pre-defined error field", "u8 x32"},
    {0x1005, 0x1005, "COB-ID SYNC", "x32"},
    {0x1006, 0x1006, "communication cycle period", "u32"},
    {0x1007, 0x1007, "synchronous window length", "u32"},
    {0x1008, 0x1008, "manufacturer device name", "string"},
    {0x1009, 0x1009, "manufacturer hardware version", "string"},
    {0x100A, 0x100A, "manufacturer software version", "string"},
    {0x100C, 0x100C, "guard time", "u16"},
    {0x100D, 0x100D, "life time factor", "u8"},
    {0x1010, 0x1010, "store parameters", "u8 x32"},
    {0x1011, 0x1011, "restore default parameters", "u8 x32"},
    {0x1012, 0x1012, "COB-ID TIME", "x32"},
    {0x1013, 0x1013, "high resolution time stamp", "u32"},
    {0x1014, 0x1014, "COB-ID EMCY", "x32"},
    {0x1015, 0x1015, "inhibit time EMCY", "u16"},
    {0x1016, 0x1016, "consumer heartbeat time", "u8 x32"},
    {0x1017, 0x1017, "producer heartbeat time", "u16"},
    {0x1018, 0x1018, "identity object", "u8 x32"},
    {0x1019, 0x1019, "synchronous counter overflow value", "u8"},
    {0x1020, 0x1020, "verify configuration", "u8 u32"},
    {0x1021, 0x1021, "store EDS", "bytes"},
    {0x1022, 0x1022, "storage format", "u16"},
    {0x1023, 0x1023, "OS command", "u8 bytes u8 bytes"},
    {0x1024, 0x1024, "OS command mode", "u8"},
    {0x1025, 0x1025, "OS debugger interface", "u8 bytes u8 bytes"},
    {0x1026, 0x1026, "OS prompt", "u8"},
    {0x1027, 0x1027, "module list", "u8 u16"},
    {0x1028, 0x1028, "emergency consumer object", "u8 x32"},
    {0x1029, 0x1029, "error behavior object", "u8"},
    {0x1200, 0x127F, "SDO server parameter", "u8 x32 x32 u8"},
    {0x1280, 0x12FF, "SDO client parameter", "u8 x32 x32 u8"},
    {0x1300, 0x1300, "global fail-safe command parameter", "u8"},
    {0x1301, 0x1340, "SRDO communication parameter", "u8 u8 u16 u8 u8 x32"},
    {0x1381, 0x13C0, "SRDO mapping parameter", "u8 x32"},
    {0x1400, 0x15FF, "RPDO communication parameter", "u8 x32 u8 u16 u8 u16 u8"},
    {0x1600, 0x17FF, "RPDO mapping parameter", "u8 x32"},
    {0x1800, 0x19FF, "TPDO communication parameter", "u8 x32 u8 u16 u8 u16 u8"},
    {0x1A00, 0x1BFF, "TPDO mapping parameter", "u8 x32"},
    {0x1F50, 0x1F50, "program data", "u8 bytes"},
    {0x1F51, 0x1F51, "program control", "u8"},
    {0x1F80, 0x1F80, "NMT startup", "x32"},
};

constexpr std::string_view identity_names[] = {"", "vendor-ID", "product code", "revision number", "serial number"};

std::string shown_bytes(const Bytes& bytes) {
  const std::size_t shown = std::min(bytes.size(), most_shown);
  return hex_bytes(bytes.data(), shown) + (shown < bytes.size() ? " ..." : "");
}

std::string quoted(const std::string& text) {
  return '"' + text.substr(0, most_shown) + (text.size() > most_shown ? "\" ..." : "\"");
}

/// Returns a VISIBLE_STRING.
std::string shown_text(const Bytes& bytes) {
  const std::string text = visible_text(bytes);
  const bool is_empty = std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte == 0; });
  return text.empty() && !is_empty ? shown_bytes(bytes) : quoted(text);
}

/// Returns a value whose type is unknown.
std::string guessed(const Bytes& bytes) {
  if (bytes.empty()) {
    return "no data";
  }
  const std::string text = bytes.size() > 4 ? visible_text(bytes) : std::string();
  if (!text.empty()) {
    return quoted(text);
  }
  std::uint64_t number = 0;
  for (std::size_t n = 0; n < bytes.size() && n < sizeof number; ++n) {
    number |= std::uint64_t{bytes[n]} << (8 * n);
  }
  const bool is_number = bytes.size() == 1 || bytes.size() == 2 || bytes.size() == 4 || bytes.size() == 8;
  return is_number ? fmt::format("{:0{}X}h", number, 2 * bytes.size()) : shown_bytes(bytes);
}

/// Returns the text of a key that no standard defines; empty if the entry does not have it.
std::string_view other_key(const codict::Entry& entry, std::string_view name) {
  const auto found = std::find_if(entry.others.begin(), entry.others.end(), [=](const codict::OpaquePart& part) {
    return codict::equal_ignoring_case(part.name, name);
  });
  return found != entry.others.end() ? std::string_view(found->text.text) : std::string_view();
}

/// Returns a number of a description, such as a factor; nothing if the text is not a finite number.
std::optional<double> real_of(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc() && end == text.data() + text.size() && std::isfinite(number);
  return is_number ? std::optional(number) : std::nullopt;
}

/// How a value becomes a physical one: by the unit of an XDD, else by the keys Factor and Unit that python-canopen
/// reads from an EDS.
struct Scale {
  double offset = 0;
  double factor = 1;
  std::string_view unit;

  bool is_raw() const { return offset == 0 && factor == 1; }
  double apply(double number) const { return (number + offset) * factor; }
};

/// \retval nothing  the factor is not valid: the value remains raw, without the unit of the scaled one
std::optional<Scale> scale_of(const codict::Entry& entry) {
  const bool is_xdd = entry.unit->is_given;
  const std::string_view unit = is_xdd ? codict::text_in(entry.unit->texts.labels, "en") : other_key(entry, "Unit");
  const auto or_default = [](std::string_view text, double otherwise) {
    return text.empty() ? std::optional(otherwise) : real_of(text);
  };
  const std::optional<double> offset = or_default(entry.offset->text, 0);
  const std::optional<double> scale = or_default(entry.multiplier->text, 1);
  const std::optional<double> factor = or_default(is_xdd ? entry.unit->multiplier.text : other_key(entry, "Factor"), 1);
  const bool is_valid = offset && scale && factor && *scale * *factor != 0;
  return is_valid ? std::optional(Scale{*offset, *scale * *factor, unit}) : std::nullopt;
}

std::string physical(const codict::Entry& entry, const std::string& raw) {
  const std::optional<double> number = real_of(raw);
  const std::optional<Scale> scale = scale_of(entry);
  if (!number || !scale) {
    return raw;
  }
  constexpr int digits = 12;  // hides the rounding of 3 * 0.1
  return (scale->is_raw() ? raw : fmt::format("{:.{}g}", scale->apply(*number), digits)) +
         (scale->unit.empty() ? "" : fmt::format(" {}", scale->unit));
}

/// Returns the row of an object of the communication profile; null: it has none.
const Standard* standard_of(std::uint16_t index) {
  const auto* const row = std::find_if(std::begin(standard), std::end(standard), [=](const Standard& range) {
    return index >= range.first && index <= range.last;
  });
  return row != std::end(standard) ? row : nullptr;
}

/// Returns the type of an entry of the communication profile as in Standard::types; empty for others.
std::string_view standard_type(std::uint16_t index, std::uint8_t sub_index) {
  const Standard* const row = standard_of(index);
  std::string_view types = row != nullptr ? row->types : std::string_view();
  for (unsigned n = 0; n < sub_index && types.find(' ') != std::string_view::npos; ++n) {
    types.remove_prefix(types.find(' ') + 1);
  }
  return types.substr(0, types.find(' '));
}

bool is_hexadecimal(std::uint16_t index, std::uint8_t sub_index) {
  return standard_type(index, sub_index).substr(0, 1) == "x";
}

/// Returns the name of a value of an enumeration; empty if it has none.
std::string_view name_of_value(const codict::Device& device, const codict::Entry& entry, const std::string& shown) {
  for (const codict::AllowedValue& allowed : codict::allowed_values_of(device, entry)) {
    if (allowed.value.is_integer() && allowed.value.written_integer() == shown) {
      return codict::text_in(allowed.texts.labels, "en");
    }
  }
  return {};
}

}  // namespace

std::string_view standard_name(std::uint16_t index, std::uint8_t sub_index) {
  if (index == 0x1018 && sub_index > 0 && sub_index < std::size(identity_names)) {
    return identity_names[sub_index];
  }
  const Standard* const row = standard_of(index);
  return row != nullptr ? row->name : std::string_view();
}

std::string_view signature_of(std::uint16_t index, std::uint8_t sub_index) {
  return sub_index == 0 ? "" : index == 0x1010 ? "save" : index == 0x1011 ? "load" : "";
}

std::string key_of(std::uint16_t index, std::uint8_t sub_index, bool has_sub_objects) {
  return has_sub_objects ? fmt::format("{:04X}h:{:02X}", index, sub_index) : fmt::format("{:04X}h", index);
}

std::string Description::name_of(std::uint16_t index, std::uint8_t sub_index) const {
  const codict::Object* const object = device_ != nullptr ? device_->find(index) : nullptr;
  if (object == nullptr) {
    return std::string(standard_name(index, sub_index));
  }
  const codict::Entry* const entry = device_->find(index, sub_index);
  const std::string name = object->name.text.empty() ? std::string(standard_name(index, sub_index)) : object->name.text;
  if (entry == nullptr || static_cast<const codict::Entry*>(object) == entry || entry->name.text.empty() ||
      entry->name.text == name) {
    return name;
  }
  return name.empty() ? entry->name.text : name + ", " + entry->name.text;
}

std::string Description::object(std::uint16_t index, std::uint8_t sub_index) const {
  const codict::Object* const object = device_ != nullptr ? device_->find(index) : nullptr;
  const bool has_sub_objects = object == nullptr || codict::has_sub_objects(object->object_code.value);
  const std::string name = name_of(index, sub_index);
  return key_of(index, sub_index, has_sub_objects || sub_index != 0) + (name.empty() ? "" : ' ' + name);
}

std::optional<ValueType> Description::type_of(std::uint16_t index, std::uint8_t sub_index) const {
  const codict::Entry* const entry = device_ != nullptr ? device_->find(index, sub_index) : nullptr;
  if (entry == nullptr) {
    const std::string_view type = standard_type(index, sub_index);
    const bool is_hex = type.substr(0, 1) == "x";
    return value_type(is_hex ? 'u' + std::string(type.substr(1)) : std::string(type));
  }
  const codict::DataType& type = codict::data_type_of(*device_, entry->data_type.value);
  const unsigned bytes = (type.bits + 7U) / 8U;
  switch (type.kind) {
    case codict::TypeKind::boolean: return ValueType{ValueType::Kind::boolean, 1};
    case codict::TypeKind::signed_integer: return ValueType{ValueType::Kind::integer, bytes};
    case codict::TypeKind::unsigned_integer: return ValueType{ValueType::Kind::unsigned_integer, bytes};
    case codict::TypeKind::real: return ValueType{ValueType::Kind::real, bytes};
    case codict::TypeKind::visible_string: return ValueType{ValueType::Kind::text, 0};
    case codict::TypeKind::octet_string:
    case codict::TypeKind::unicode_string:
    case codict::TypeKind::domain: return ValueType{ValueType::Kind::bytes, 0};
    default: return std::nullopt;
  }
}

std::string Description::show(std::uint16_t index, std::uint8_t sub_index, const Bytes& bytes) const {
  const std::optional<ValueType> type = type_of(index, sub_index);
  if (type && type->kind == ValueType::Kind::text) {
    return shown_text(bytes);
  }
  if (type && type->kind == ValueType::Kind::bytes && !bytes.empty()) {
    return shown_bytes(bytes);
  }
  const Shown shown = type && !bytes.empty() ? lexican::show(*type, bytes) : Shown{{}, "unknown"};
  if (!shown.fault.empty()) {
    const char* const plural = bytes.size() == 1 ? "" : "s";
    const bool is_wrong_length = type && !bytes.empty();
    return guessed(bytes) +
           (is_wrong_length ? fmt::format(" ({} byte{} instead of {})", bytes.size(), plural, type->size) : "");
  }
  if (type->kind == ValueType::Kind::unsigned_integer && is_hexadecimal(index, sub_index)) {
    const std::string_view signature = signature_of(index, sub_index);
    const bool is_signature = std::equal(bytes.begin(), bytes.end(), signature.begin(), signature.end());
    return guessed(bytes) + (is_signature ? fmt::format(" ({})", signature) : "");
  }
  const codict::Entry* const entry = device_ != nullptr ? device_->find(index, sub_index) : nullptr;
  if (entry == nullptr) {
    return shown.text;
  }
  const std::string_view name = name_of_value(*device_, *entry, shown.text);
  return physical(*entry, shown.text) + (name.empty() ? "" : fmt::format(" ({})", name));
}

std::optional<double> Description::number(std::uint16_t index, std::uint8_t sub_index, const Bytes& bytes) const {
  const std::optional<ValueType> type = type_of(index, sub_index);
  if (!type && !bytes.empty() && bytes.size() <= sizeof(std::uint64_t)) {
    return static_cast<double>(number_of(bytes));
  }
  const bool is_number = type && type->kind != ValueType::Kind::text && type->kind != ValueType::Kind::bytes;
  const std::optional<double> raw =
      is_number && !bytes.empty() ? real_of(lexican::show(*type, bytes).text) : std::nullopt;
  const codict::Entry* const entry = device_ != nullptr ? device_->find(index, sub_index) : nullptr;
  const std::optional<Scale> scale = entry != nullptr ? scale_of(*entry) : std::nullopt;
  return raw && scale ? std::optional(scale->apply(*raw)) : raw;
}

std::string Description::unit_of(std::uint16_t index, std::uint8_t sub_index) const {
  const codict::Entry* const entry = device_ != nullptr ? device_->find(index, sub_index) : nullptr;
  const std::optional<Scale> scale = entry != nullptr ? scale_of(*entry) : std::nullopt;
  return scale ? std::string(scale->unit) : std::string();
}

std::optional<Description> read_description(const std::string& path, std::string& why) {
  std::optional<codict::Source> source = codict::read_file(path, why);
  if (!source) {
    return std::nullopt;
  }
  const std::string name = source->name();
  std::optional<codict::Input> input = codict::read(std::move(*source), why);
  why = why.empty() ? why : name + ": " + why;
  return input ? std::optional(Description(std::move(input->description.devices.front()))) : std::nullopt;
}

bool Network::add(const std::string& argument, std::string& why) {
  const std::size_t equals = argument.find('=');
  unsigned node = 0;
  const char* const end = argument.data() + std::min(equals, argument.size());
  const auto [stop, error] = std::from_chars(argument.data(), end, node);
  const bool has_node = equals != std::string::npos && stop == end && error != std::errc::invalid_argument;
  if (has_node && (error != std::errc() || node == 0 || node > 127)) {
    why = argument + ": node-IDs are 1 to 127";
    return false;
  }
  const std::string path = has_node ? argument.substr(equals + 1) : argument;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    if (has_node) {
      why = argument + ": a directory describes several nodes; name one file, or leave out the node-ID";
      return false;
    }
    return add_directory(path, why);
  }
  return add_file(static_cast<std::uint8_t>(node), path, why);
}

bool Network::add_file(std::uint8_t node, const std::string& path, std::string& why) {
  std::optional<Description> description = read_description(path, why);
  if (!description) {
    return false;
  }
  const std::uint8_t commissioned = description->device()->commissioning.node_id.value;
  const std::uint8_t described = node != 0 ? node : commissioned <= 127 ? commissioned : std::uint8_t{0};
  if (described == 0 && nodes_.count(0) != 0) {
    why = path + ": a second description without node-ID; name the node with NODE=FILE";
    return false;
  }
  nodes_[described] = std::move(*description);
  return true;
}

bool Network::add_directory(const std::string& path, std::string& why) {
  std::error_code error;
  const std::vector<std::string> files = description_files(path, error);
  if (error) {
    why = path + ": " + error.message();
    return false;
  }
  if (files.empty()) {
    why = path + " has no EDS, DCF, XDD or XDC file";
    return false;
  }
  return std::all_of(files.begin(), files.end(), [&](const std::string& file) { return add_file(0, file, why); });
}

void Network::describe(std::uint8_t node, Description description) { nodes_[node] = std::move(description); }

const Description& Network::of(std::uint8_t node) const {
  static const Description unknown;
  const auto found = nodes_.find(node);
  const auto other = nodes_.find(0);
  return found != nodes_.end() ? found->second : other != nodes_.end() ? other->second : unknown;
}

}  // namespace lexican::describe
