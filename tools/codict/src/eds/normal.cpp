// SPDX-License-Identifier: Apache-2.0
#include "eds/normal.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string>

#include "eds/slots.hpp"
#include "text/number.hpp"

namespace lexican::codict::eds {

namespace {

bool is_number_of_eds(const std::string& text) {
  const ParsedFormula formula = parse_formula(text);
  return formula.is_standard && formula.number.is_number();
}

template <typename T>
void normalise_number(Field<T>& field) {
  const ParsedInteger written = parse_integer(field.text);
  const bool is_said = written.is_number() && written.value == Integer(field.value);
  if (!field.is_empty() && !is_said && is_understood(field)) {
    field.text = std::to_string(field.value);
  }
}

void normalise_flag(Field<bool>& flag) {
  if (!flag.is_empty()) {
    flag.text = flag_text(flag);
  }
}

void normalise(Value& value) {
  if (!value.is_empty()) {
    value.text = value_text(value);
  }
}

// Converts a date of XML Schema, 2020-12-31, to 12-31-2020. Leaves other texts unchanged.
void normalise_date(Text& date) {
  const std::string& t = date.text;
  if (t.size() >= 10 && t[4] == '-' && t[7] == '-') {
    date.text = t.substr(5, 5) + "-" + t.substr(0, 4);
  }
}

void normalise_time(Text& time) {
  const std::string& t = time.text;
  const bool is_schema = t.size() >= 8 && t[2] == ':' && t[5] == ':' && is_digit(t[0]) && is_digit(t[1]);
  if (is_schema) {
    const int hour = (t[0] - '0') * 10 + (t[1] - '0');
    time.text = fmt::format("{:02}{}{}M", (hour + 11) % 12 + 1, t.substr(2, 3), hour < 12 ? 'A' : 'P');
  }
}

// Normalises a bit rate. CiA 311 writes automatic detection as a word, CiA 306 as 0.
void normalise_rate(Field<std::uint32_t>& rate) {
  if (rate.value == 0 && equal_ignoring_case(rate.text, "auto-baudRate")) {
    rate.text = "0";
  }
  normalise_number(rate);
}

// Returns whether a deviceCommissioning has only the attributes that CiA 311 requires: empty names and rates, 0 and
// false.
bool is_blank_form(const Commissioning& commissioning) {
  return commissioning.node_id.is_empty() && commissioning.node_name.is_empty() && commissioning.bit_rate.is_empty() &&
         commissioning.network_name.is_empty() && commissioning.network_number.value == 0 &&
         !commissioning.is_manager.value;
}

// Returns the access type. In CiA 306 it includes the direction of PDOs. [306: 4.6.3]
Access access_of(const Entry& entry) {
  const Access access = entry.access.value;
  if (access != Access::rw) {
    return access;
  }
  switch (entry.pdo_mapping.value) {
    case PdoMapping::tpdo: return Access::rwr;
    case PdoMapping::rpdo: return Access::rww;
    default: return access;
  }
}

}  // namespace

std::string value_text(const Value& value) {
  switch (value.kind) {
    case Value::Kind::integer: return is_number_of_eds(value.text) ? value.text : value.written_integer();
    case Value::Kind::real:
      return value.text.find(',') == std::string::npos ? value.text : fmt::format("{}", value.real);
    case Value::Kind::octets: return hexadecimal_octets(*value.octets);
    case Value::Kind::none:
    case Value::Kind::text:
    case Value::Kind::malformed: break;
  }
  return value.text;
}

Entry normal(const Device& device, const Entry& entry) {
  Entry result = entry;
  if (entry.object_code.value != ObjectCode::null) {
    result.object_code.text = fmt::format("0x{:X}", static_cast<unsigned>(entry.object_code.value));
  }
  if (is_understood(entry.data_type)) {
    result.data_type.text = fmt::format("0x{:04X}", entry.data_type.value);
  }
  const Access access = access_of(entry);
  result.access.text = access == Access::unknown || access == Access::none ? entry.access.text : name_of(access);
  const bool is_said = !entry.pdo_mapping.is_empty() || entry.pdo_mapping.value != PdoMapping::no;
  const bool is_value = data_type_of(device, entry.data_type.value).kind != TypeKind::unknown;
  if (is_said && is_value) {
    const bool is_no = entry.pdo_mapping.text == name_of(PdoMapping::no);
    result.pdo_mapping.text = is_no ? "0" : flag_text(entry.pdo_mapping);
  }
  if (Field<std::uint32_t>* const flags = result.flags.if_any()) {
    normalise_number(*flags);
  }
  normalise(result.default_value);
  for (Rare<Value>* rare : {&result.actual_value, &result.low_limit, &result.high_limit}) {
    if (Value* const value = rare->if_any()) {
      normalise(*value);
    }
  }
  return result;
}

Device normal_headers(const Device& device) {
  Device result;
  result.file = device.file;
  result.identity = device.identity;
  result.features = device.features;
  result.commissioning = device.commissioning;
  for (Field<std::uint32_t>* number :
       {&result.file.version, &result.file.revision, &result.identity.vendor_number, &result.identity.product_number,
        &result.identity.revision_number, &result.features.dynamic_channels, &result.features.compact_pdo,
        &result.commissioning.network_number, &result.commissioning.serial_number}) {
    normalise_number(*number);
  }
  normalise_rate(result.commissioning.bit_rate);
  normalise_number(result.features.granularity);
  normalise_number(result.features.rx_pdos);
  normalise_number(result.features.tx_pdos);
  normalise_number(result.commissioning.node_id);
  for_each_flag(result.features, normalise_flag);
  const bool is_of_eds = device.format == Format::eds || device.format == Format::dcf;
  if (!is_of_eds) {
    if (result.features.granularity.value == 0) {  // mandatory in an XDD; 0 is the default of an EDS
      result.features.granularity = {};
    }
    if (is_blank_form(result.commissioning)) {
      result.commissioning = {};
    }
    normalise_date(result.file.creation_date);
    normalise_date(result.file.modification_date);
    normalise_time(result.file.creation_time);
    normalise_time(result.file.modification_time);
  }
  normalise_flag(result.commissioning.is_manager);
  return result;
}

}  // namespace lexican::codict::eds
