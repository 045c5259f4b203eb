// SPDX-License-Identifier: Apache-2.0
// Runs the test cases on a board. Its arguments are those of doctest, from the command line of QEMU:
// -semihosting-config …,arg=PROGRAM,arg=ARGUMENT…
#define DOCTEST_CONFIG_IMPLEMENT
#define DOCTEST_CONFIG_NO_POSIX_SIGNALS
#define DOCTEST_CONFIG_NO_MULTITHREADING
#define DOCTEST_CONFIG_NO_MULTI_LANE_ATOMICS
#include <doctest/doctest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "program.hpp"

namespace {

/// The command line that the host gives, cut at its spaces.
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

}  // namespace

int main() {
  const Arguments arguments;
  const int status = doctest::Context(arguments.number(), arguments.words()).run();
  std::fflush(stdout);
  return status;
}
