// SPDX-License-Identifier: Apache-2.0
// Fuzzes the JSON reader with any bytes: it returns, all positions that it reports are within the source, and a device
// that is written is read back unchanged.
#include <cstddef>
#include <cstdint>
#include <string>

#include "fuzz/fuzz.hpp"
#include "json/read.hpp"
#include "json/write.hpp"

namespace {

using namespace lexican::codict;

using fuzz::require;

// Returns the description, which is empty if the reader refuses the input.
Description description_of(const std::string& bytes) {
  Findings findings;
  const json::Document document(Source("fuzz.json", bytes));
  const std::string why = json::refusal(document);
  require(why.find('\n') == std::string::npos, "a refusal is one line");
  if (!why.empty()) {
    return {};
  }
  Description description = json::read(document, findings);
  for (const Finding& finding : findings.all()) {
    require(finding.span.begin <= finding.span.end && finding.span.end <= bytes.size(), "findings are in the source");
  }
  for (const Device& device : description.devices) {
    for_each_variable(device, [&bytes](std::uint16_t, std::uint8_t, const Entry& entry) {
      const Span span = entry.default_value.span;
      require(span.begin <= span.end && span.end <= bytes.size(), "values are in the source");
    });
  }
  return description;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Description description = description_of(std::string(reinterpret_cast<const char*>(data), size));
  if (!description.devices.empty()) {
    const std::string written = json::write(description);
    require(json::write(description_of(written)) == written, "what is written is read as the same");
  }
  return 0;
}
