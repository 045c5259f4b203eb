// SPDX-License-Identifier: Apache-2.0
#include "gen/names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/number.hpp"

namespace lexican::codict::gen {

namespace {

// Keywords of C and C++, and macros of C headers.
constexpr std::string_view reserved[] = {
    "alignas",   "alignof", "and",      "and_eq",       "asm",       "assert",   "auto",          "bitand",
    "bitor",     "bool",    "break",    "case",         "catch",     "char",     "class",         "compl",
    "complex",   "concept", "const",    "const_cast",   "constexpr", "continue", "decltype",      "default",
    "delete",    "do",      "double",   "dynamic_cast", "else",      "enum",     "errno",         "explicit",
    "export",    "extern",  "false",    "float",        "for",       "friend",   "goto",          "i386",
    "if",        "inline",  "int",      "linux",        "long",      "major",    "minor",         "mutable",
    "namespace", "new",     "noexcept", "noreturn",     "not",       "not_eq",   "nullptr",       "offsetof",
    "operator",  "or",      "or_eq",    "private",      "protected", "public",   "register",      "requires",
    "restrict",  "return",  "short",    "signed",       "sizeof",    "static",   "static_assert", "static_cast",
    "stderr",    "stdin",   "stdout",   "struct",       "switch",    "template", "this",          "thread_local",
    "throw",     "true",    "try",      "typedef",      "typeid",    "typename", "union",         "unix",
    "unsigned",  "using",   "virtual",  "void",         "volatile",  "wchar_t",  "while",         "xor",
    "xor_eq"};

constexpr bool is_letter(char c) { return to_lower(c) >= 'a' && to_lower(c) <= 'z'; }

}  // namespace

std::string identifier(std::string_view words) {
  std::string id;
  for (const char c : words) {
    if (is_letter(c) || is_digit(c)) {
      id += to_lower(c);
    } else if (!id.empty() && id.back() != '_') {
      id += '_';
    }
  }
  while (!id.empty() && id.back() == '_') {
    id.pop_back();
  }
  if (!id.empty() && is_digit(id.front())) {
    id.insert(0, "n");
  }
  const bool is_type = id.size() > 2 && id.compare(id.size() - 2, 2, "_t") == 0;
  if (is_type || std::find(std::begin(reserved), std::end(reserved), id) != std::end(reserved)) {
    id += '_';
  }
  return id;
}

std::string upper(std::string_view identifier) {
  std::string id(identifier);
  for (char& c : id) {
    c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return id;
}

std::string comment_text(std::string_view words) {
  std::string text(words);
  for (char& c : text) {
    const bool is_plain = c >= ' ' && c <= '~' && c != '\\' && c != '?' && c != '*';
    c = is_plain ? c : '.';
  }
  return text;
}

std::string string_literal(std::string_view bytes) {
  std::string text = "\"";
  for (const char c : bytes) {
    const bool is_plain = c >= ' ' && c <= '~' && c != '\\' && c != '?' && c != '"';
    text += is_plain ? std::string(1, c) : fmt::format("\\{:03o}", static_cast<unsigned char>(c));
  }
  return text + "\"";
}

}  // namespace lexican::codict::gen
