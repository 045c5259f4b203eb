// SPDX-License-Identifier: Apache-2.0
/// \file arguments.hpp
/// Command line that the host passes to a program on a board, split at its spaces. For QEMU:
/// -semihosting-config …,arg=PROGRAM,arg=ARGUMENT…
#pragma once

#include <cstring>
#include <vector>

#include "program.hpp"

class Arguments {
 public:
  Arguments() {
    struct {
      char* text;
      std::uint32_t length;
    } answer = {line_, sizeof line_};
    constexpr std::uint32_t get_command_line = 0x15;
    if (board::ask_host(get_command_line, &answer) != 0) {
      return;
    }
    for (char* next = line_; next != nullptr; next = end_of_word(next)) {
      words_.push_back(next);
    }
  }

  int number() const { return static_cast<int>(words_.size()); }
  const char* const* words() const { return words_.data(); }

 private:
  static char* end_of_word(char* word) {
    char* const space = std::strchr(word, ' ');
    if (space == nullptr) {
      return nullptr;
    }
    *space = '\0';
    return space + 1;
  }

  char line_[1000] = {};
  std::vector<const char*> words_;
};
