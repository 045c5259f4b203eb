// SPDX-License-Identifier: Apache-2.0
// Fuzzes the readers of logs with any bytes: reading ends, every frame is valid, and what the writers write of it is
// read again.
#include "bus/log.hpp"

#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "fuzz/fuzz.hpp"

namespace {

using namespace lexican::host_bus;

std::vector<Entry> read_all(const std::string& bytes, std::size_t most, std::uint64_t& malformed) {
  std::vector<Entry> entries;
  std::istringstream stream(bytes);
  std::string why;
  const std::unique_ptr<LogReader> reader = read_log(stream, why);
  fuzz::require((reader == nullptr) == !why.empty(), "a refusal has a reason");
  while (reader != nullptr) {
    const std::optional<Entry> entry = reader->next();
    if (!entry.has_value()) {
      malformed = reader->malformed();
      break;
    }
    fuzz::require(entry->channel < reader->channels().size(), "a frame has a channel");
    fuzz::require(entry->frame.DLC <= 8, "a frame has at most 8 bytes");
    entries.push_back(*entry);
    fuzz::require(entries.size() <= most, "a frame is read once");
  }
  return entries;
}

/// Returns a frame as an adapter may have received it.
Entry received(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  Entry entry;
  entry.time = input.number();
  entry.frame.Identifier = input.number();
  if ((entry.frame.Identifier & (CO_IF_FRM_EXT | CO_IF_FRM_ERROR)) == 0) {
    entry.frame.Identifier &= CO_IF_FRM_RTR | 0x7FF;
  }
  entry.frame.DLC = static_cast<std::uint8_t>(input.below(16));
  for (std::uint8_t& byte : entry.frame.Data) {
    byte = input.byte();
  }
  entry.direction = input.flag() ? Direction::received : Direction::sent;
  return entry;
}

bool is_same(const Entry& a, const Entry& b) {
  return a.time == b.time && a.direction == b.direction && to_text(a.frame) == to_text(b.frame);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::uint64_t malformed = 0;
  std::vector<Entry> entries = read_all(std::string(data, data + size), size, malformed);
  entries.push_back(received(data, size));
  for (const char* const name : {"a.log", "a.pcapng"}) {
    std::ostringstream written;
    const std::unique_ptr<LogWriter> writer = write_log(written, name, "can0");
    for (const Entry& entry : entries) {
      writer->write(entry);
    }
    const std::vector<Entry> again = read_all(written.str(), entries.size(), malformed);
    fuzz::require(malformed == 0, "the writer writes no malformed frame");
    fuzz::require(again.size() == entries.size(), "each frame that is written is read");
    for (std::size_t n = 0; n < entries.size(); ++n) {
      fuzz::require(is_same(entries[n], again[n]), "a frame is read as it was written");
    }
  }
  return 0;
}
