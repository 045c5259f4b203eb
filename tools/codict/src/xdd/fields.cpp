// SPDX-License-Identifier: Apache-2.0
#include "xdd/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "model/parse.hpp"

namespace lexican::codict::xdd {

namespace {

// Names that CiA 311 defines and the model does not use.
constexpr std::array<std::string_view, 32> unused_names = {"DeviceManager",
                                                           "DeviceFunction",
                                                           "functionTypeList",
                                                           "functionInstanceList",
                                                           "variableRef",
                                                           "identity",
                                                           "readOnly",
                                                           "formatName",
                                                           "formatVersion",
                                                           "offset",
                                                           "multiplier",
                                                           "unitURI",
                                                           "lang",
                                                           "label",
                                                           "description",
                                                           "labelRef",
                                                           "descriptionRef",
                                                           "ISO15745Reference",
                                                           "ProfileDate",
                                                           "AdditionalInformation",
                                                           "IASInterfaceType",
                                                           "ExternalProfileHandle",
                                                           "schemaLocation",
                                                           "noNamespaceSchemaLocation",
                                                           "initialValue",
                                                           "signed",
                                                           "start",
                                                           "count",
                                                           "conditionalSupport",
                                                           "moduleManagement",
                                                           "rangeSelector",
                                                           "versionType"};

bool is_known(std::string_view name) {
  return std::find(unused_names.begin(), unused_names.end(), name) != unused_names.end();
}

void report_unknown(std::string_view name, Span span, std::string_view text, const Reader& reader) {
  if (reader.shared.dialect == Dialect::container && !is_known(name)) {
    reader.findings.add(rules::unknown, span, fmt::format("{} {} is unknown to CiA 311", text, in_quotes(name)),
                        "check the spelling");
  }
}

}  // namespace

bool is_syntax(pugi::xml_attribute attribute) {
  const std::string_view name = attribute.name();
  return name.substr(0, 5) == "xmlns" || name.substr(0, 4) == "xsi:";
}

bool is_leaf(pugi::xml_node element) {
  const auto children = element.children();
  const auto attributes = element.attributes();
  return std::all_of(attributes.begin(), attributes.end(), is_syntax) &&
         std::none_of(children.begin(), children.end(),
                      [](pugi::xml_node child) { return child.type() == pugi::node_element; });
}

void report_duplicate(Span place, const Reader& reader) {
  if (reader.shared.dialect == Dialect::container) {  // other dialects repeat elements with conditions
    reader.findings.add(rules::duplicate, place, "given more than once; the first is used", "remove it");
  }
}

OpaquePart opaque_part(const Document& document, pugi::xml_attribute attribute) {
  return {"@" + std::string(local_name(attribute)), document.text(attribute), {}, document.span(attribute)};
}

OpaquePart opaque_part(const Document& document, pugi::xml_node element) {
  OpaquePart result{std::string(local_name(element)), document.text(element), {}, document.whole(element)};
  for (const pugi::xml_attribute attribute : element.attributes()) {
    if (!is_syntax(attribute)) {
      result.children.push_back(opaque_part(document, attribute));
    }
  }
  for (const pugi::xml_node child : element.children()) {
    if (child.type() == pugi::node_element) {
      result.children.push_back(opaque_part(document, child));
    }
  }
  return result;
}

bool is_named(std::string_view name, std::string_view wanted, Span span, const Reader& reader) {
  if (name == wanted) {
    return true;
  }
  if (!equal_ignoring_case(name, wanted)) {
    return false;
  }
  if (reader.shared.dialect == Dialect::container) {
    reader.findings.add(rules::name_case, span, fmt::format("wrong capitals in {}", in_quotes(name)),
                        fmt::format("write {}", wanted));
  }
  return true;
}

void store_opaque(pugi::xml_attribute attribute, std::vector<OpaquePart>& others, const Reader& reader) {
  others.push_back(opaque_part(reader.document, attribute));
  report_unknown(local_name(attribute), others.back().span, "attribute", reader);
}

void store_opaque(pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader) {
  others.push_back(opaque_part(reader.document, element));
  report_unknown(local_name(element), reader.document.tag(element), "element", reader);
}

void store_remainder(pugi::xml_node element, std::vector<OpaquePart> opaque, std::vector<OpaquePart>& others,
                     const Reader& reader) {
  if (!opaque.empty()) {
    others.push_back({std::string(local_name(element)), {}, std::move(opaque), reader.document.tag(element)});
  }
}

Text text_of(pugi::xml_node element, std::string_view attribute, std::vector<OpaquePart>& others,
             const Reader& reader) {
  Text text = reader.document.text(element);
  text.is_given = !attribute.empty() ? text.is_given : true;
  std::vector<OpaquePart> opaque;
  for (const pugi::xml_attribute candidate : element.attributes()) {
    if (!attribute.empty() && !text.is_given && local_name(candidate) == attribute) {
      text = reader.document.text(candidate);
    } else if (!is_syntax(candidate)) {
      store_opaque(candidate, opaque, reader);
    }
  }
  for (const pugi::xml_node child : element.children()) {
    if (child.type() == pugi::node_element) {
      store_opaque(child, opaque, reader);
    }
  }
  store_remainder(element, std::move(opaque), others, reader);
  return text;
}

std::string_view raw_attribute(pugi::xml_node element, std::string_view name) {
  for (const pugi::xml_attribute attribute : element.attributes()) {
    if (equal_ignoring_case(local_name(attribute), name)) {
      return trimmed(attribute.value());
    }
  }
  return {};
}

Text attribute_text(pugi::xml_node element, std::string_view name, const Reader& reader) {
  for (const pugi::xml_attribute attribute : element.attributes()) {
    if (equal_ignoring_case(local_name(attribute), name)) {
      return reader.document.text(attribute);
    }
  }
  return {};
}

pugi::xml_node find(const Ids& ids, std::string_view id) {
  const auto place = ids.find(id);
  return place != ids.end() ? place->second : pugi::xml_node();
}

bool may_copy(pugi::xml_node element, const Reader& reader) {
  const std::size_t size = reader.document.whole(element).size();
  if (size > reader.shared.copies_left) {
    reader.findings.add(rules::copies, reader.document.tag(element), "too many references; this one is not read",
                        "split the element, or refer to it less often");
    return false;
  }
  reader.shared.copies_left -= size;
  return true;
}

bool read_hex(const Text& text, std::size_t digits, std::uint64_t largest, std::uint64_t& value, Findings& findings) {
  std::string_view plain = text.text;
  const bool has_prefix = plain.substr(0, 2) == "0x" || plain.substr(0, 2) == "0X";
  plain.remove_prefix(has_prefix ? 2 : 0);
  std::uint64_t number = 0;
  if (plain.empty() || !parse_hex(plain, number) || number > largest) {
    return false;
  }
  value = number;
  if (digits != 0 && (has_prefix || plain.size() != digits)) {
    findings.add(rules::hex_digits, text.span, fmt::format("{} does not have {} digits", in_quotes(text.text), digits),
                 fmt::format("write {:0{}X}", number, digits));
  }
  return true;
}

void interpret_boolean(Field<bool>& field, Findings& findings) {
  if (field.text.empty()) {
    return;
  }
  const bool is_true = field.text == "1" || equal_ignoring_case(field.text, "true");
  field.value = is_true;
  if (!is_true && field.text != "0" && !equal_ignoring_case(field.text, "false")) {
    findings.add(rules::boolean, field.span, fmt::format("{} is not a boolean, read as false", in_quotes(field.text)),
                 "write true or false");
  } else if (field.text.size() > 1 && field.text != "true" && field.text != "false") {
    findings.add(rules::boolean, field.span, fmt::format("{} is not in small letters", in_quotes(field.text)),
                 is_true ? "write true" : "write false");
  }
}

void interpret_boolean(Rare<Field<bool>>& field, Findings& findings) {
  if (Field<bool>* const given = field.if_any()) {
    interpret_boolean(*given, findings);
  }
}

}  // namespace lexican::codict::xdd
