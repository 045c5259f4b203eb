// SPDX-License-Identifier: Apache-2.0
// The drivers at work, for lane instructions: each receives and sends frames of 8 bytes. callgrind writes a file for
// each direction of each driver, of which tests/numbers/bench/callgrind/read.py evaluates the driver's functions.
// Prints lines: name, frames, frames, register accesses (bytes on SPI) per frame.
#define DOCTEST_CONFIG_IMPLEMENT
#include "bench.hpp"

#include <cstdio>

#include <valgrind/callgrind.h>

namespace {

using test::Bench;
using test::Controller;

constexpr unsigned number = 8;

// Transfers all frames once to reach a steady state, then counts.
template <class Transfer>
void count(const std::string& name, const test::CanWire& wire, Transfer transfer) {
  std::uint64_t accesses = 0;
  for (unsigned n = 0; n < 2 * number; ++n) {
    if (n == number) {
      CALLGRIND_ZERO_STATS;
      accesses = wire.accesses();
    }
    transfer();
  }
  CALLGRIND_DUMP_STATS_AT(name.c_str());
  accesses = wire.accesses() - accesses;
  std::printf("%s\t%u\t%u\t%.4g\n", name.c_str(), number, number, static_cast<double>(accesses) / number);
}

}  // namespace

int main() {
  doctest::Context context;
  context.setAsDefaultForAssertsOutOfTestCases();
  context.setAssertHandler([](const doctest::AssertData& data) {
    std::printf("%s:%d: %s\n", data.m_file, data.m_line, data.m_expr);
    std::exit(1);
  });
  for (const test::Kind kind : test::all_kinds) {
    Bench bench;
    Controller& can = bench.add(kind);
    const test::CanFrame frame = test::standard_frame(0x123, {1, 2, 3, 4, 5, 6, 7, 8});
    const CO_IF_FRM frm = test::to_driver(frame);
    count(test::name_of(kind) + ", received", bench.wire, [&] {
      bench.receive(frame);
      REQUIRE(can.read() == "123#0102030405060708");
    });
    count(test::name_of(kind) + ", sent", bench.wire, [&] {
      REQUIRE(can.takes(frm));
      bench.run(150);
    });
    REQUIRE(bench.peer.received.size() == 2 * number);
  }
}
