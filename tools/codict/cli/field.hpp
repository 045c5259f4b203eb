// SPDX-License-Identifier: Apache-2.0
/// \file field.hpp
/// What get and set call the parts of a description: an object or a section, and one of its keys.
#pragma once

#include <string>
#include <string_view>

#include "cli/command.hpp"
#include "eds/document.hpp"

namespace lexican::codict::cli {

/// The key of CiA 306 for one of our words ("default"), or the word itself.
std::string_view key_of(std::string_view field);

/// The section of an object ("0x2000:1"), or the one of that name ("FileInfo"). Null if there is none, and why is one
/// line.
const eds::Section* find_section(const Input& input, const std::string& target, std::string& why);

}  // namespace lexican::codict::cli
