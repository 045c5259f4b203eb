// SPDX-License-Identifier: Apache-2.0
// Counts instructions by callgrind, which writes a file for each report with the report's name; read.py evaluates the
// files.
#include "machine.hpp"

#include <cstdio>
#include <cstdlib>

#include "measure.hpp"
#include "operations.hpp"

namespace bench {

void start_clock() {}

// Makes the first report: the instructions of beginning and ending a count.
void check_clock() {
  if (RUNNING_ON_VALGRIND == 0) {
    fail("clock", "nobody counts: valgrind --tool=callgrind --collect-atstart=no");
  }
  measure("clock", Operation());
}

void report(const char* name, std::uint64_t, std::uint32_t operations, std::uint32_t units) {
  CALLGRIND_DUMP_STATS_AT(name);
  std::printf("%s\t%u\t%u\n", name, static_cast<unsigned>(operations), static_cast<unsigned>(units));
}

void fail(const char* where, const char* what) {
  std::printf("%s: %s\n", where, what);
  leave(1);
}

void leave(int status) { std::exit(status); }

}  // namespace bench

int main() { bench::run_all(); }
