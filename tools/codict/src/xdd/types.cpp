// SPDX-License-Identifier: Apache-2.0
// Reads data types and references to them. [311: g_simple, dataTypeList]
#include <algorithm>
#include <string>
#include <utility>

#include "xdd/parts.hpp"

namespace lexican::codict::xdd {

namespace {

constexpr std::size_t most_references = 8;  // limit of a chain of references between types

struct OtherName {
  std::string_view name;
  std::uint16_t code;
};

// Names of types in programming languages, which eltra uses.
constexpr std::array<OtherName, 9> other_names = {{{"DOUBLE", 0x11},
                                                   {"FLOAT", 0x08},
                                                   {"STRING", 0x09},
                                                   {"BOOLEAN", 0x01},
                                                   {"REAL32", 0x08},
                                                   {"UINT8", 0x05},
                                                   {"UINT16", 0x06},
                                                   {"UINT32", 0x07},
                                                   {"UINT64", 0x1B}}};

std::uint16_t code_named(std::string_view name) {
  if (const DataType* type = data_type_named(name)) {
    return type->code;
  }
  const auto* const found = std::find_if(other_names.begin(), other_names.end(), [name](const OtherName& other) {
    return equal_ignoring_case(other.name, name);
  });
  return found != other_names.end() ? found->code : std::uint16_t{0};
}

// Reads a type of maxon: <dataType><type>UNSIGNED8</type><size unit="bit">4</size></dataType>
void read_named_type(TypeUse& type, pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader) {
  std::vector<OpaquePart> opaque;
  read_children(element, opaque, reader, [&](pugi::xml_node child) {
    if (local_name(child) != "type" || type.iec.is_given) {
      return false;
    }
    type.iec = text_of(child, {}, opaque, reader);
    type.code = code_named(type.iec.text);
    if (type.code == 0) {
      reader.findings.add(rules::type_unknown, type.iec.span, in_quotes(type.iec.text) + " is not a data type",
                          "write a type of CiA 301, for example UNSIGNED8");
    }
    return true;
  });
  store_remainder(element, std::move(opaque), others, reader);
}

void interpret_bound(Field<std::int64_t>& bound) {
  const ParsedInteger number = parse_integer(bound.text);
  if (number.is_number()) {
    bound.value = static_cast<std::int64_t>(number.value.bits());
  }
}

void read_bounds(TypeDefinition& definition, pugi::xml_node element, const Reader& reader) {
  constexpr std::array<Slot<TypeDefinition::Bounds>, 2> slots = {
      {{"lowerLimit", [](TypeDefinition::Bounds& b) -> Text& { return b.lower; }},
       {"upperLimit", [](TypeDefinition::Bounds& b) -> Text& { return b.upper; }}}};
  TypeDefinition::Bounds& bounds = definition.bounds.emplace_back();
  std::vector<OpaquePart> opaque;
  read_element(bounds, element, slots, opaque, reader, [](pugi::xml_node) { return false; });
  store_remainder(element, std::move(opaque), definition.others, reader);
  interpret_bound(bounds.lower);
  interpret_bound(bounds.upper);
}

void read_member(TypeDefinition& definition, pugi::xml_node element, const Reader& reader) {
  using Member = TypeDefinition::Member;
  constexpr std::array<Slot<Member>, 3> slots = {{{"name", [](Member& m) -> Text& { return m.name; }},
                                                  {"uniqueID", [](Member& m) -> Text& { return m.id; }},
                                                  {"size", [](Member& m) -> Text& { return m.size; }}}};
  Member& member = definition.members.emplace_back();
  read_element(member, element, slots, member.others, reader, [&](pugi::xml_node child) {
    return read_label_element(member.texts, child, member.others, reader) ||
           read_type(member.type, child, member.others, reader);
  });
}

// Reads an enumValue of CiA 311, or an enumEntry of maxon, which has a name and an id in addition.
bool read_enum_value(TypeDefinition& definition, pugi::xml_node child, const Reader& reader) {
  const std::string_view name = local_name(child);
  if (name != "enumValue" && name != "enumEntry") {
    return false;
  }
  constexpr std::array<Slot<AllowedValue>, 1> slots = {{{"value", [](AllowedValue& v) -> Text& { return v.value; }}}};
  AllowedValue& value = definition.values.emplace_back();
  std::vector<OpaquePart> opaque;
  read_element(value, child, slots, opaque, reader,
               [&](pugi::xml_node word) { return read_label_element(value.texts, word, opaque, reader); });
  store_remainder(child, std::move(opaque), definition.others, reader);
  return true;
}

TypeDefinition::Kind kind_of(pugi::xml_node element) {
  const std::string_view name = local_name(element);
  return name == "array"     ? TypeDefinition::Kind::array
         : name == "enum"    ? TypeDefinition::Kind::enumeration
         : name == "derived" ? TypeDefinition::Kind::derived
                             : TypeDefinition::Kind::structure;
}

std::uint16_t code_of_reference(std::string_view id, const Reader& reader, std::size_t references);

// Returns the code of the first type that a definition names; 0 for a structure.
std::uint16_t code_of_definition(pugi::xml_node element, const Reader& reader, std::size_t references) {
  if (kind_of(element) == TypeDefinition::Kind::structure) {
    return 0;
  }
  for (const pugi::xml_node child : element.children()) {
    const std::string_view name = local_name(child);
    std::uint16_t code = code_named(name == "dataType" ? child.child_value("type") : name);
    if (name == "dataTypeIDRef" && references < most_references) {
      code = code_of_reference(raw_attribute(child, "uniqueIDRef"), reader, references + 1);
    }
    if (code != 0) {
      return code;
    }
  }
  return 0;
}

std::uint16_t code_of_reference(std::string_view id, const Reader& reader, std::size_t references) {
  const auto [place, is_new] = reader.shared.codes.try_emplace(id, std::uint16_t{0});
  if (is_new) {
    const std::uint16_t code = code_of_definition(find(reader.shared.types, id), reader, references);
    reader.shared.codes[id] = code;
    return code;
  }
  return place->second;
}

}  // namespace

bool is_definition(pugi::xml_node element) {
  const std::string_view name = local_name(element);
  return name == "array" || name == "struct" || name == "enum" || name == "derived";
}

bool read_type(TypeUse& type, pugi::xml_node child, std::vector<OpaquePart>& others, const Reader& reader) {
  const std::string_view name = local_name(child);
  if (type.iec.is_given || type.reference.is_given) {
    return false;
  }
  if (name == "dataTypeIDRef") {
    type.reference = text_of(child, "uniqueIDRef", others, reader);
    if (!find(reader.shared.types, raw_attribute(child, "uniqueIDRef"))) {
      reader.findings.add(rules::reference, type.reference.span,
                          "data type " + in_quotes(type.reference.text) + " does not exist", "correct the reference");
    }
    type.code = code_of_reference(raw_attribute(child, "uniqueIDRef"), reader, 0);
    return true;
  }
  if (name == "dataType") {
    read_named_type(type, child, others, reader);
    return true;
  }
  type.code = code_named(name);
  if (type.code == 0) {
    return false;
  }
  type.iec = {std::string(name), reader.document.tag(child), true};
  std::vector<OpaquePart> opaque;
  read_children(child, opaque, reader, [](pugi::xml_node) { return false; });
  store_remainder(child, std::move(opaque), others, reader);
  return true;
}

TypeDefinition read_definition(pugi::xml_node element, const Reader& reader) {
  constexpr std::array<Slot<TypeDefinition>, 3> slots = {{{"name", [](TypeDefinition& d) -> Text& { return d.name; }},
                                                          {"uniqueID", [](TypeDefinition& d) -> Text& { return d.id; }},
                                                          {"size", [](TypeDefinition& d) -> Text& { return d.size; }}}};
  TypeDefinition definition;
  definition.kind = kind_of(element);
  definition.span = reader.document.tag(element);
  read_element(definition, element, slots, definition.others, reader, [&](pugi::xml_node child) {
    const std::string_view name = local_name(child);
    if (name == "subrange") {
      read_bounds(definition, child, reader);
      return true;
    }
    if (name == "varDeclaration") {
      read_member(definition, child, reader);
      return true;
    }
    return read_label_element(definition.texts, child, definition.others, reader) ||
           read_enum_value(definition, child, reader) || read_type(definition.type, child, definition.others, reader);
  });
  for (AllowedValue& value : definition.values) {
    interpret_value(value.value, data_type(definition.type.code), reader);
  }
  return definition;
}

}  // namespace lexican::codict::xdd
