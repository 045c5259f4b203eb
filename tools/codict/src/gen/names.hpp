// SPDX-License-Identifier: Apache-2.0
/// \file names.hpp
/// Identifiers of C and C++ from the words of a description.
#pragma once

#include <string>
#include <string_view>

namespace lexican::codict::gen {

/// "Time of day (UTC)" becomes "time_of_day_utc"; empty if nothing is left. No keyword of C or C++.
std::string identifier(std::string_view words);
std::string upper(std::string_view identifier);
/// Printable ASCII that may stand in a comment.
std::string comment_text(std::string_view words);
/// A string literal of C, with its quotes.
std::string string_literal(std::string_view bytes);

}  // namespace lexican::codict::gen
