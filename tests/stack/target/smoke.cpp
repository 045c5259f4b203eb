// SPDX-License-Identifier: Apache-2.0
// Tests a node on a board without heap and C++ library, so that the program fits the smallest board. Prints a line for
// each case, and the number of cases.
#include <cstddef>
#include <cstdint>

#include "board.hpp"
#include "smoke_cases.hpp"
#include "smoke_node.hpp"

namespace {

using smoke::Node;

/// Reads the words of a script (smoke_cases.hpp).
class Script {
 public:
  explicit Script(const char* text) : next_(text) {}

  bool is_at_end() const { return *next_ == '\0'; }
  char action() { return *next_++; }

  std::uint32_t number(std::uint32_t base) {
    std::uint32_t value = 0;
    for (std::uint32_t digit = digit_of(*next_); digit < base; digit = digit_of(*++next_)) {
      value = value * base + digit;
    }
    skip_space();
    return value;
  }

  CO_IF_FRM frame() {
    CO_IF_FRM frm{};
    for (; *next_ != '#'; ++next_) {
      frm.Identifier = frm.Identifier * 16 + digit_of(*next_);
    }
    for (++next_; *next_ != ' ' && *next_ != '\0'; next_ += 2) {
      frm.Data[frm.DLC++] = static_cast<std::uint8_t>(digit_of(next_[0]) * 16 + digit_of(next_[1]));
    }
    skip_space();
    return frm;
  }

 private:
  static std::uint32_t digit_of(char digit) {
    const bool decimal = digit >= '0' && digit <= '9';
    const bool letter = digit >= 'A' && digit <= 'F';
    return static_cast<std::uint32_t>(decimal ? digit - '0' : letter ? digit - 'A' + 10 : 99);
  }

  void skip_space() { next_ += *next_ == ' ' ? 1 : 0; }

  const char* next_;
};

bool same(const CO_IF_FRM& one, const CO_IF_FRM& other) {
  bool all = one.Identifier == other.Identifier && one.DLC == other.DLC;
  for (std::size_t i = 0; i < one.DLC; ++i) {
    all = all && one.Data[i] == other.Data[i];
  }
  return all;
}

void print(const CO_IF_FRM& frm) {
  board::print("# sent ");
  board::print_hex(frm.Identifier);
  for (std::size_t i = 0; i < frm.DLC; ++i) {
    board::print(" ");
    board::print_hex(frm.Data[i]);
  }
  board::print("\n");
}

bool is_next(Node& node, const CO_IF_FRM& expected) {
  CO_IF_FRM sent{};
  if (!node.take(sent)) {
    board::print("# sent nothing\n");
    return false;
  }
  if (!same(sent, expected)) {
    print(sent);
    return false;
  }
  return true;
}

bool is_silent(Node& node) {
  CO_IF_FRM sent{};
  const bool silent = !node.take(sent);
  if (!silent) {
    print(sent);
  }
  return silent;
}

bool step(Node& node, Script& script) {
  const char action = script.action();
  if (action == '<') {
    return is_next(node, script.frame());
  }
  const bool silent = is_silent(node);  // no frame was sent that the script does not expect
  switch (action) {
    case '>': node.receive(script.frame()); break;
    case '+': node.pass(script.number(10)); break;
    case '!': node.set_error(static_cast<std::uint8_t>(script.number(10))); break;
    case '?': node.clear_error(static_cast<std::uint8_t>(script.number(10))); break;
    default: return false;
  }
  return silent;
}

bool passes(Node& node, const char* text) {
  node.start();
  Script script{text};
  bool good = true;
  while (good && !script.is_at_end()) {
    good = step(node, script);
  }
  return good && is_silent(node);
}

// Static, as it is too large for the stack.
Node node;

}  // namespace

int main() {
  std::size_t failed = 0;
  for (const smoke::Case& one : smoke::cases) {
    const bool good = passes(node, one.script);
    failed += good ? 0 : 1;
    board::print(good ? "ok " : "not ok ");
    board::print(one.name);
    board::print("\n");
  }
  board::print("1..");
  board::print(smoke::number_of_cases);
  board::print("\n");
  return failed == 0 ? 0 : 1;
}
