// SPDX-License-Identifier: Apache-2.0
// Fuzzes the monitor with any frames at any times: texts are printable and bounded, each frame is counted and has at
// most one event and one SDO transfer, and the stored data are bounded.
#include "describe/monitor.hpp"

#include <algorithm>
#include <string>

#include "fuzz/fuzz.hpp"

namespace {

using namespace lexican;
using namespace lexican::describe;

const Network& network() {
  static const Network drives = [] {
    Network all;
    std::string why;
    fuzz::require(all.add(LEXICAN_FUZZ_DESCRIPTION, why), "the description of the drive is read");
    return all;
  }();
  return drives;
}

/// Returns an identifier: mostly of a service, of one of three nodes, so that transfers arise.
std::uint32_t identifier(fuzz::Input& input) {
  constexpr std::uint32_t services[] = {0x000, 0x080, 0x180, 0x200, 0x580, 0x600, 0x580, 0x600, 0x700, 0x7E4};
  const std::uint32_t kind = input.byte();
  if (kind < 0xF0) {
    return services[kind % 10] + (kind / 10) % 4;
  }
  if (kind == 0xFF) {
    return input.number();
  }
  return (input.word() & 0x7FFU) | ((kind & 1U) != 0 ? CO_IF_FRM_RTR : 0U);
}

void check(const Event& event) {
  fuzz::require(!event.text.empty() && event.text.size() < 2000, "a text has a length");
  for (const char c : event.text) {
    fuzz::require(c >= ' ' && c != '\x7F', "a text is one printable line");
  }
  fuzz::require(event.node <= 127, "a node-ID is valid");
  if (event.sdo != nullptr) {
    fuzz::require(event.sdo->data.size() <= SdoFollower::most_data, "the data of a transfer are bounded");
    fuzz::require(event.sdo->data.size() <= event.sdo->size, "the data of a transfer have been transferred");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  std::uint64_t events = 0;
  std::uint64_t transfers = 0;
  Monitor monitor(network(), [&](const Event& event) {
    check(event);
    ++(event.sdo != nullptr ? transfers : events);
  });
  host_bus::Entry entry;
  entry.time = 1'000'000;
  std::uint64_t frames = 0;
  while (!input.is_empty()) {
    entry.frame.Identifier = identifier(input);
    const std::uint32_t control = input.byte();
    entry.frame.DLC = (control & 0x10U) != 0 ? std::uint8_t{8} : static_cast<std::uint8_t>(control & 0x0FU);
    for (unsigned n = 0; n < std::min<unsigned>(entry.frame.DLC, 8); ++n) {
      entry.frame.Data[n] = input.byte();
    }
    entry.time += (control & 0x20U) != 0 ? input.number() : 1000;
    entry.time -= (control & 0x40U) != 0 ? input.number() : 0;  // may wrap
    monitor.process(entry);
    ++frames;
  }
  monitor.expire(entry.time + 2 * SdoFollower::answer_time);
  monitor.finish();
  const Statistics& statistics = monitor.statistics();
  fuzz::require(statistics.frames + statistics.errors == frames, "each frame is counted");
  fuzz::require(statistics.by_identifier.size() <= Statistics::most_identifiers, "the identifiers are bounded");
  fuzz::require(statistics.last >= statistics.first, "the duration is not negative");
  fuzz::require(events <= frames, "a frame has one event");
  fuzz::require(transfers <= frames, "a transfer has a frame");
  return 0;
}
