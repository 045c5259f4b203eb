// SPDX-License-Identifier: Apache-2.0
/// \file date.hpp
/// Dates and times in the form of XML Schema.
#pragma once

#include <string>

namespace lexican::codict {

/// Converts the date of an EDS "12-31-2020" to 2020-12-31. Returns other texts unchanged.
std::string schema_date(const std::string& text);

/// Converts the time of an EDS "09:30AM" to 09:30:00. Returns other texts unchanged.
std::string schema_time(const std::string& text);

}  // namespace lexican::codict
