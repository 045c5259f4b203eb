// SPDX-License-Identifier: Apache-2.0
#include "model/access.hpp"

#include <array>
#include <string>
#include <utility>

#include "text/number.hpp"

namespace lexican::codict {

namespace {

// Indexed by Access.
constexpr std::array<std::string_view, 8> access_words = {"unknown", "no", "ro", "wo", "rw", "rwr", "rww", "const"};
constexpr std::array<std::string_view, 5> mapping_words = {"no", "optional", "default", "TPDO", "RPDO"};

}  // namespace

std::string_view name_of(Access access) { return access_words[static_cast<std::size_t>(access)]; }

Access access_named(std::string_view word) {
  for (std::size_t n = 1; n < access_words.size(); ++n) {
    if (equal_ignoring_case(word, access_words[n])) {
      return static_cast<Access>(n);
    }
  }
  return Access::unknown;
}

Access access_meant_by(std::string_view word) {
  std::string letters;
  for (const char c : word) {
    if (to_lower(c) >= 'a' && to_lower(c) <= 'z') {
      letters += to_lower(c);
    }
  }
  for (const auto& [meant, words] :
       {std::pair(Access::ro, " r read readonly "), std::pair(Access::wo, " w write writeonly "),
        std::pair(Access::rw, " rw wr readwrite "), std::pair(Access::constant, " c constant ")}) {
    if (std::string_view(words).find(" " + letters + " ") != std::string_view::npos) {
      return meant;
    }
  }
  return Access::unknown;
}

std::string_view name_of(PdoMapping mapping) { return mapping_words[static_cast<std::size_t>(mapping)]; }

std::string_view name_of(ObjectCode code) {
  switch (code) {
    case ObjectCode::null: return "NULL";
    case ObjectCode::domain: return "DOMAIN";
    case ObjectCode::deftype: return "DEFTYPE";
    case ObjectCode::defstruct: return "DEFSTRUCT";
    case ObjectCode::variable: return "VAR";
    case ObjectCode::array: return "ARRAY";
    case ObjectCode::record: return "RECORD";
  }
  return {};
}

}  // namespace lexican::codict
