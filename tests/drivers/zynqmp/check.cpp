// SPDX-License-Identifier: Apache-2.0
#include "check.hpp"

#include "bus.hpp"
#include "machine.hpp"

namespace zynqmp {
namespace {

bool failed = false;

void begin_failure(const char* file, int line) {
  if (!failed) {
    failed = true;
    print("# ");
    print(file);
    print(":");
    print(static_cast<std::uint64_t>(line));
    print(": ");
  } else {
    print("#   then: ");
  }
}

}  // namespace

bool has_failed() { return failed; }

void fail(const char* file, int line, const char* what, const char* more, const char* still_more) {
  begin_failure(file, line);
  for (const char* text : {what, more, still_more}) {
    print(text != nullptr ? text : "");
  }
  print("\n");
}

void expect(const char* file, int line, const char* what, std::uint64_t value, std::uint64_t expected) {
  if (value == expected) {
    return;
  }
  begin_failure(file, line);
  print(what);
  print(" is ");
  print(value);
  print(", not ");
  print(expected);
  print("\n");
}

unsigned run_all(const Cases* groups, unsigned number) {
  unsigned planned = 0;
  for (unsigned n = 0; n < number; ++n) {
    planned += groups[n].number;
  }
  print("1..");
  print(planned);
  print("\n");
  unsigned bad = 0;
  for (unsigned n = 0; n < number; ++n) {
    for (unsigned i = 0; i < groups[n].number; ++i) {
      failed = false;
      groups[n].first[i].run();
      leave_bus();
      print(failed ? "not ok " : "ok ");
      print(groups[n].first[i].name);
      print("\n");
      bad += failed ? 1 : 0;
    }
  }
  return bad;
}

}  // namespace zynqmp
