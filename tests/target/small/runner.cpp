// SPDX-License-Identifier: Apache-2.0
// Runs the cases of doctest/doctest.h, and ends with the two lines that doctest ends with.
#include <doctest/doctest.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <vector>

#include "program.hpp"

namespace doctest::detail {
namespace {

using Way = std::vector<std::pair<const char*, int>>;  // into sub-cases: name and line

Case* first = nullptr;
Case** last = &first;

struct Run {  // of the case that is running
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

void check(bool good, const char* file, int line, const char* text) {
  ++asserts;
  if (!good) {
    ++run.failures;
    tell(file, line, text);
  }
}

void require(bool good, const char* file, int line, const char* text) {
  check(good, file, line, text);
  if (!good) {
    std::longjmp(run.start, 1);
  }
}

Subcase::Subcase(const char* name, int line) {
  if (run.way.size() < run.deepest) {  // behind another one that was entered on this level
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

}  // namespace doctest::detail

int main() {
  using namespace doctest::detail;
  Totals totals;
  for (const Case* one = first; one != nullptr; one = one->next) {
    ++(one->skipped ? totals.skipped : passes(*one) ? totals.passed : totals.failed);
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
