// SPDX-License-Identifier: Apache-2.0
/// \file names.hpp
/// Identifiers of C and C++ from names in descriptions.
#pragma once

#include <string>
#include <string_view>

namespace lexican::codict::gen {

/// Returns a name as an identifier that is no keyword of C or C++: "time_of_day_utc" from "Time of day (UTC)"; empty if
/// no character can be used.
std::string identifier(std::string_view words);
std::string upper(std::string_view identifier);
/// Returns the text with printable ASCII characters only, safe within a C comment.
std::string comment_text(std::string_view words);
/// Returns a C string literal, with its quotes.
std::string string_literal(std::string_view bytes);

}  // namespace lexican::codict::gen
