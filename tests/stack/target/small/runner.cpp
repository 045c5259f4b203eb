// SPDX-License-Identifier: Apache-2.0
// Runs the cases of doctest/doctest.h, and prints doctest's two lines of summary. Arguments:
//   -part=N/M   runs only every M-th case, beginning with the N-th
//   -d          prints the duration of each case
#include <doctest/doctest.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <vector>

#include "../arguments.hpp"

namespace doctest::detail {
namespace {

using Way = std::vector<std::pair<const char*, int>>;  // entered sub-cases: name and line

Case* first = nullptr;
Case** last = &first;

struct Run {  // state of the running case
  std::jmp_buf start;
  const Case* one = nullptr;
  unsigned failures = 0;
  Way way;
  std::vector<Way> done;
  std::size_t deepest = 0;
  bool again = false;
};

Run run;

struct Totals {
  unsigned passed = 0;
  unsigned failed = 0;
  unsigned skipped = 0;
};

unsigned long asserts = 0;

void print(const char* text) { board::print(text); }

void print(unsigned long number) { board::print(std::to_string(number).c_str()); }

void run_once() {
  run.again = false;
  run.deepest = 0;
  run.way.clear();
  if (setjmp(run.start) == 0) {
    run.one->function();
  }
}

bool passes(const Case& one) {
  run.one = &one;
  run.failures = 0;
  run.done.clear();
  do {
    run_once();
  } while (run.again);
  const bool good = (run.failures != 0) == one.should_fail;
  if (!good && one.should_fail) {
    print(one.name);
    print(": should have failed\n");
  }
  return good;
}

void tell(const char* file, int line, const char* text) {
  if (run.one->should_fail) {
    return;
  }
  print(run.one->name);
  print("\n  ");
  print(file);
  print(":");
  print(static_cast<unsigned long>(line));
  print(": ");
  print(text);
  print("\n");
}

}  // namespace

bool add(Case& one) {
  *last = &one;
  last = &one.next;
  return true;
}

void pass() { ++asserts; }

void fail(const char* file, int line, const char* text) {
  ++asserts;
  ++run.failures;
  tell(file, line, text);
}

void end(const char* file, int line, const char* text) {
  fail(file, line, text);
  std::longjmp(run.start, 1);
}

Subcase::Subcase(const char* name, int line) {
  if (run.way.size() < run.deepest) {  // another sub-case was entered on this level
    run.again = true;
    return;
  }
  run.way.emplace_back(name, line);
  if (std::find(run.done.begin(), run.done.end(), run.way) != run.done.end()) {
    run.way.pop_back();
    return;
  }
  run.deepest = run.way.size();
  entered_ = true;
}

Subcase::~Subcase() {
  if (!entered_) {
    return;
  }
  if (!run.again) {
    run.done.push_back(run.way);
  }
  run.way.pop_back();
}

namespace {

struct Options {
  unsigned part = 1;
  unsigned parts = 1;
  bool tells_time = false;
};

Options options_of(const Arguments& arguments) {
  Options options;
  for (int n = 1; n < arguments.number(); ++n) {
    const char* const word = arguments.words()[n];
    if (std::sscanf(word, "-part=%u/%u", &options.part, &options.parts) == 0) {
      options.tells_time = options.tells_time || std::strcmp(word, "-d") == 0;
    }
  }
  return options;
}

unsigned hundredths() {
  constexpr std::uint32_t clock = 0x10;
  return static_cast<unsigned>(board::ask_host(clock, nullptr));
}

bool passes_in_time(const Case& one, bool tells_time) {
  const unsigned begin = tells_time ? hundredths() : 0;
  const bool good = passes(one);
  if (tells_time) {
    const unsigned time = hundredths() - begin;
    char text[30];
    std::snprintf(text, sizeof text, "%u.%02u s: ", time / 100, time % 100);
    print(text);
    print(one.name);
    print("\n");
  }
  return good;
}

}  // namespace
}  // namespace doctest::detail

int main() {
  using namespace doctest::detail;
  const Options options = options_of(Arguments());
  Totals totals;
  unsigned number = 0;
  for (const Case* one = first; one != nullptr; one = one->next) {
    const bool skipped = one->skipped || number++ % options.parts != options.part - 1;
    ++(skipped ? totals.skipped : passes_in_time(*one, options.tells_time) ? totals.passed : totals.failed);
  }
  const unsigned all = totals.passed + totals.failed;
  char line[200];
  std::snprintf(line, sizeof line, "[doctest] test cases: %u | %u passed | %u failed | %u skipped\n", all,
                totals.passed, totals.failed, totals.skipped);
  board::print(line);
  std::snprintf(line, sizeof line, "[doctest] assertions: %lu\n", asserts);
  board::print(line);
  return totals.failed == 0 ? 0 : 1;
}
