// SPDX-License-Identifier: Apache-2.0
/// \file command_words.hpp
/// Text that is typed on the screen of `lexican top`, as the words of a command line.
#pragma once

#include <string>
#include <vector>

#include "program/verb.hpp"

namespace lexican::program {

struct CommandWords {
  std::vector<std::string> words;
  std::string type;                  ///< of --type
  bool verifies = false;             ///< --verify
  bool is_forced = false;            ///< --force
  std::vector<std::string> options;  ///< these options as they were typed
  std::string fault;                 ///< empty: none
  Common common;
};

/// Splits a text at spaces outside of quotes.
CommandWords words_of(const std::string& text);

/// Returns the words with spaces between them: a name of an object.
std::string joined(const std::vector<std::string>& words);

/// Returns the line that a shell splits into these words.
std::string command_line(const std::vector<std::string>& words);

/// Returns a character in UTF-8.
std::string utf8_of(std::uint32_t code);

void erase_last_character(std::string& text);

}  // namespace lexican::program
