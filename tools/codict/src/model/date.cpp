// SPDX-License-Identifier: Apache-2.0
#include "model/date.hpp"

#include <fmt/format.h>

#include "text/number.hpp"

namespace lexican::codict {

std::string schema_date(const std::string& text) {
  const bool is_eds = text.size() == 10 && text[2] == '-' && text[5] == '-';
  return is_eds ? text.substr(6) + "-" + text.substr(0, 5) : text;
}

std::string schema_time(const std::string& text) {
  const bool is_eds = text.size() == 7 && text[2] == ':' && (text[5] == 'A' || text[5] == 'P') && text[6] == 'M' &&
                      is_digit(text[0]) && is_digit(text[1]);
  if (!is_eds) {
    return text;
  }
  const int hour = ((text[0] - '0') * 10 + (text[1] - '0')) % 12 + (text[5] == 'P' ? 12 : 0);
  return fmt::format("{:02}{}:00", hour, text.substr(2, 3));
}

}  // namespace lexican::codict
