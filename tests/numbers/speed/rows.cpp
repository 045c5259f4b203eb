// SPDX-License-Identifier: Apache-2.0
// Defines the measured transfers, the hardware, and the budgets.
#include <algorithm>
#include <random>

#include "frame_bits.hpp"
#include "ideal.hpp"
#include "pair.hpp"
#include "row.hpp"

namespace speed {
namespace {

constexpr std::uint32_t fastest = 1000000;  // bit/s

struct Case {
  const char* name;
  Way way;
  bool upload;
  std::size_t number;
  std::size_t bytes;
  double budget;        // least share of the limit
  double known_micros;  // published limit of one transfer at the highest bit rate, with random data
  const char* peers;    // published results of other stacks at the highest bit rate
};

constexpr Case cases[] = {
    {"expedited upload, 4 bytes", Way::expedited, true, 1000, 4, 0.95, 250, ""},
    {"expedited download, 4 bytes", Way::expedited, false, 1000, 4, 0.95, 250, ""},
    {"segmented upload, 1000 bytes", Way::segmented, true, 1, 1000, 0.90, 34600, "254 and 270 ms"},
    {"segmented download, 1000 bytes", Way::segmented, false, 1, 1000, 0.90, 34600, "254 and 270 ms"},
    {"block upload, 100000 bytes", Way::block, true, 1, 100000, 0.97, 1671000, "1840 and 2316 ms"},
    {"block download, 100000 bytes", Way::block, false, 1, 100000, 0.97, 1671000, "1840 and 2316 ms"},
};

struct Setup {
  const char* name;
  Hardware hardware;
};

constexpr std::size_t many_buffers = 10;

const Setup setups[] = {
    {"1 Mbit/s", {fastest, many_buffers}},
    {"1 Mbit/s, 3 transmit buffers, loop every 100 µs", {fastest, 3, Time{100}}},
    {"500 kbit/s", {500000, many_buffers}},
    {"250 kbit/s", {250000, many_buffers}},
    {"125 kbit/s", {125000, many_buffers}},
};

Transfers transfers_of(const Case& what) {
  std::mt19937 random(what.number + what.bytes);
  Transfers transfers{what.way, what.upload, {}};
  for (std::size_t n = 0; n < what.number; ++n) {
    Bytes data(what.bytes);
    std::generate(data.begin(), data.end(), [&] { return static_cast<std::uint8_t>(random()); });
    transfers.data.push_back(std::move(data));
  }
  return transfers;
}

// Returns the duration of \a bits, without the intermission after the last frame.
double micros_of(std::uint64_t bits, const Hardware& hardware) {
  return static_cast<double>(bits - co::intermission_bits) * 1e6 / hardware.bit_rate;
}

// Returns true if a row has a budget. Where each frame waits for a response, the period of the main loop determines the
// speed, not the stack.
bool has_budget(const Setup& setup, const Case& what) {
  return setup.hardware.loop == Time{0} || what.way == Way::block;
}

Row measure_row(const Setup& setup, const Case& what) {
  const Transfers transfers = transfers_of(what);
  const Result result = measure(setup.hardware, transfers);
  const auto micros = static_cast<double>(result.time.count());
  const bool comparable = setup.hardware.bit_rate == fastest;
  Row row{};
  row.hardware = setup.name;
  row.transfer = what.name;
  row.number = what.number;
  row.micros = micros;
  row.ideal_micros = micros_of(ideal_bits(transfers), setup.hardware);
  row.load = micros_of(result.bits, setup.hardware) / micros;
  row.known_micros = comparable ? what.known_micros * static_cast<double>(what.number) : 0;
  row.budget = has_budget(setup, what) ? what.budget : 0;
  row.peers = comparable ? what.peers : "";
  return row;
}

}  // namespace

std::vector<Row> measure_rows() {
  std::vector<Row> rows;
  for (const Setup& setup : setups) {
    for (const Case& what : cases) {
      rows.push_back(measure_row(setup, what));
    }
  }
  return rows;
}

}  // namespace speed
