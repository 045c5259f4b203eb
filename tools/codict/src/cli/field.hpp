// SPDX-License-Identifier: Apache-2.0
/// \file field.hpp
/// What get and set call the parts of a description: an object or a section, and one of its keys.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "cli/command.hpp"
#include "eds/document.hpp"

namespace lexican::codict::cli {

/// The key of CiA 306 for one of our words ("default"), or the word itself.
std::string_view key_of(std::string_view field);

/// "field=text"
struct Assignment {
  std::string_view field;
  std::string_view text;
};

/// False if it is something else, and why is one line.
bool parse_assignment(std::string_view words, Assignment& assignment, std::string& why);

/// False if it has more, and why is one line.
bool has_one_line(std::string_view text, std::string& why);

/// The section of an object ("0x2000:1"), or the one of that name ("FileInfo"). Null if there is none, and why is one
/// line.
const eds::Section* find_section(const Input& input, const std::string& target, std::string& why);

/// Whether compact storage implies a sub-object, which has no section of its own.
bool is_implied(const Input& input, const Reference& reference);
/// The lines of an EDS that say a field of such a sub-object, which are there in lists. False if there is no list for
/// the field, and why is one line.
bool add_to_lists(const Reference& reference, const Assignment& assignment, std::string& lines, std::string& why);

/// The object that a description without sections has under this name; null if there is none, and why is one line.
const Entry* find_entry(const Input& input, const std::string& target, std::string& why);

/// One of our words, as the description writes it; null if it is none of them.
const Text* find_text(const Entry& entry, std::string_view field);

/// All of our words that an object has: call(field, text).
void for_each_text(const Entry& entry, const std::function<void(std::string_view, const Text&)>& call);

}  // namespace lexican::codict::cli
