// SPDX-License-Identifier: Apache-2.0
/// \file parts.hpp
/// The parts of the reader, a file for each.
#pragma once

#include <vector>

#include "xdd/fields.hpp"

namespace lexican::codict::xdd {

// words.cpp
bool read_word(Words& words, pugi::xml_node child, std::vector<Kept>& others, const Reader& reader);
/// The label of a text in a language, or its description.
Text first_of(const Words& words);
void read_unit(Unit& unit, pugi::xml_node element, std::vector<Kept>& others, const Reader& reader);
bool read_value(Value& value, pugi::xml_node element, std::vector<Kept>& others, const Reader& reader);
/// Gives the id that a template has.
Text read_allowed(Allowed& allowed, pugi::xml_node element, std::vector<Kept>& others, const Reader& reader);

// types.cpp
bool read_type(TypeUse& type, pugi::xml_node child, std::vector<Kept>& others, const Reader& reader);
TypeDefinition read_definition(pugi::xml_node element, const Reader& reader);
bool is_definition(pugi::xml_node element);

// parameters.cpp
void read_parameter(pugi::xml_node element, Entry& entry, const Reader& reader);
void read_process(pugi::xml_node element, const Reader& reader);
/// Parameters that no object has used.
void read_unused_parameters(pugi::xml_node list, const Reader& reader);

// objects.cpp
void read_object_list(pugi::xml_node element, const Reader& reader);
/// When all of them are there.
void finish_objects(const Reader& reader);
void interpret_access(Field<Access>& access, bool is_parameter, const Reader& reader);
void interpret_pdo_mapping(Field<PdoMapping>& mapping, const Reader& reader);
void interpret_value(Value& value, const DataType& type, const Reader& reader);
void interpret_allowed(Allowed& allowed, const DataType& type, const Reader& reader);
/// Of a parameter or template that is no object's.
void finish_parameter(Entry& entry, const Reader& reader);

// profile.cpp
void read_header(pugi::xml_node element, ProfileHeader& header, const Reader& reader);
void read_file_info(pugi::xml_node body, const Reader& reader);
void read_identity(pugi::xml_node element, const Reader& reader);

// network.cpp
bool read_network_part(pugi::xml_node child, std::vector<Kept>& others, const Reader& reader);

}  // namespace lexican::codict::xdd
