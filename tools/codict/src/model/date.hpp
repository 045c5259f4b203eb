// SPDX-License-Identifier: Apache-2.0
/// \file date.hpp
/// Days and times as XML Schema writes them.
#pragma once

#include <string>

namespace lexican::codict {

/// "12-31-2020" of an EDS is 2020-12-31. What is no such date stays.
std::string schema_date(const std::string& text);

/// "09:30AM" of an EDS is 09:30:00. What is no such time stays.
std::string schema_time(const std::string& text);

}  // namespace lexican::codict
