// SPDX-License-Identifier: Apache-2.0
/// \file parts.hpp
/// Functions of the reader, grouped by the files that define them.
#pragma once

#include <vector>

#include "xdd/fields.hpp"

namespace lexican::codict::xdd {

// labels.cpp
/// Returns whether an element is a label or description, or a reference to one.
bool is_label_element(pugi::xml_node element);
bool read_label_element(LabelGroup& texts, pugi::xml_node child, std::vector<OpaquePart>& others, const Reader& reader);
/// Returns the text of the first label, else of the first description.
Text first_of(const LabelGroup& texts);
void read_unit(Unit& unit, pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader);
bool read_value(Value& value, pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader);
/// Reads allowedValues. Returns the id of a template; not given for others.
Text read_allowed(Allowed& allowed, pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader);

// types.cpp
bool read_type(TypeUse& type, pugi::xml_node child, std::vector<OpaquePart>& others, const Reader& reader);
TypeDefinition read_definition(pugi::xml_node element, const Reader& reader);
bool is_definition(pugi::xml_node element);

// parameters.cpp
void read_parameter(pugi::xml_node element, Entry& entry, const Reader& reader);
void read_process(pugi::xml_node element, const Reader& reader);
/// Reads the parameters that no object refers to, and reports them.
void read_unused_parameters(pugi::xml_node list, const Reader& reader);

// objects.cpp
/// Counts the objects that refer to each parameter, so that the last of them frees it.
void count_references(pugi::xml_node element, const Reader& reader);
void read_object_list(pugi::xml_node element, const Reader& reader);
/// Interprets the values and checks the counts, after all objects have been read.
void finish_objects(const Reader& reader);
void interpret_access(Field<Access>& access, bool is_parameter, const Reader& reader);
void interpret_pdo_mapping(Field<PdoMapping>& mapping, const Reader& reader);
void interpret_value(Value& value, const DataType& type, const Reader& reader);
void interpret_value(Rare<Value>& value, const DataType& type, const Reader& reader);
void interpret_allowed(Allowed& allowed, const DataType& type, const Reader& reader);
/// Interprets a parameter or template that does not belong to an object.
void finish_parameter(Entry& entry, const Reader& reader);

// profile.cpp
void read_header(pugi::xml_node element, ProfileHeader& header, const Reader& reader);
void read_file_info(pugi::xml_node body, const Reader& reader);
void read_identity(pugi::xml_node element, const Reader& reader);

// network.cpp
bool read_network_part(pugi::xml_node child, std::vector<OpaquePart>& others, const Reader& reader);

}  // namespace lexican::codict::xdd
