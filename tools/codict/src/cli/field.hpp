// SPDX-License-Identifier: Apache-2.0
/// \file field.hpp
/// Names of objects, sections and fields in the arguments of get and set.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "cli/command.hpp"
#include "eds/document.hpp"

namespace lexican::codict::cli {

/// Returns the key of CiA 306 for a field name of codict ("default"), or the key in a comment (";StorageLocation");
/// empty for properties that an EDS cannot express. Other words are returned unchanged.
std::string_view key_of(std::string_view field);
/// Returns the property of CANopenNode for a field name ("CO_flagsPDO"); empty for other fields.
std::string_view property_of(std::string_view field);

/// Find and add a key, also in a comment, by the name that key_of() returns.
std::optional<eds::Key> find_key(const eds::Document& document, const eds::Section& section, std::string_view key);
bool add_key(const eds::Document& document, const eds::Section& section, std::string_view key, std::string_view text,
             Edits& edits);

/// Argument "field=text".
struct Assignment {
  std::string_view field;
  std::string_view text;
};

/// Parses an assignment. Returns false if it is malformed; why is then the reason in one line.
bool parse_assignment(std::string_view text, Assignment& assignment, std::string& why);

/// Returns false if the text has several lines; why is then the reason in one line.
bool has_one_line(std::string_view text, std::string& why);

/// Returns the section of an object ("0x2000:1") or the section of this name ("FileInfo"). Null if it is missing; why
/// is then the reason in one line.
const eds::Section* find_section(const Input& input, const std::string& target, std::string& why);

/// Returns true for a sub-object that compact storage implies, which has no section in the file.
bool is_implied(const Input& input, const Reference& reference);
/// Appends the EDS lines that set a field of an implied sub-object in a list of compact storage. Returns false if there
/// is no list for the field; why is then the reason in one line.
bool add_to_lists(const Reference& reference, const Assignment& assignment, std::string& lines, std::string& why);

/// Returns the object of this name in a description without sections. Null if it is missing; why is then the reason in
/// one line.
const Entry* find_entry(const Input& input, const std::string& target, std::string& why);

/// Returns a field of an entry as the description writes it; null if codict has no field of this name.
const Text* find_text(const Entry& entry, std::string_view field);

/// Calls call(field, text) for each field that the description gives for an entry.
void for_each_text(const Entry& entry, const std::function<void(std::string_view, const Text&)>& call);

}  // namespace lexican::codict::cli
