// SPDX-License-Identifier: Apache-2.0
// Fuzzes the XDD reader with any bytes: it returns with bounded memory, all positions that it reports are within the
// source, and a device that is written contains all of its objects.
#include <cstddef>
#include <cstdint>
#include <string>

#include "catalogue/suppress.hpp"
#include "check/check.hpp"
#include "fuzz/fuzz.hpp"
#include "xdd/document.hpp"
#include "xdd/read.hpp"
#include "xdd/recognise.hpp"
#include "xdd/suppressions.hpp"
#include "xdd/write.hpp"

namespace {

using namespace lexican::codict;

using fuzz::require;

// Returns the description, which is empty if the reader refuses the input.
Description description_of(const std::string& bytes) {
  const Source source("fuzz.xdd", bytes);
  if (!xdd::refusal(source).empty()) {
    return {};
  }
  Findings findings;
  xdd::Document document(source, findings);
  if (!xdd::refusal(document).empty()) {
    return {};
  }
  Description description = xdd::read(document, findings);
  for (const Device& device : description.devices) {
    check::check_all(device, findings);
  }
  catalogue::suppress(document.source(), xdd::suppressions(document), catalogue::Origin::checks, findings);
  for (const Finding& finding : findings.all()) {
    require(finding.span.begin <= finding.span.end && finding.span.end <= bytes.size(), "findings are in the source");
  }
  for (const Device& device : description.devices) {
    for_each_variable(device, [&](std::uint16_t, std::uint8_t, const Entry& entry) {
      const Span span = entry.default_value.span;
      require(span.begin <= span.end && span.end <= bytes.size(), "values are in the source");
      Edits edits;
      if (entry.default_value.is_given && document.set_text(span, "1", edits)) {
        require(edits.applied_to(bytes).size() + span.size() <= bytes.size() + 1 || edits.is_empty(),
                "an edit changes one value");
      }
    });
  }
  return description;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Description description = description_of(std::string(reinterpret_cast<const char*>(data), size));
  for (const Device& device : description.devices) {
    for (const xdd::Edition edition : {xdd::Edition::v10, xdd::Edition::v11}) {
      const Description again = description_of(xdd::write(device, edition));
      require(again.devices.size() == 1, "what is written is read");
      // A preserved element may be interpreted at its new place, so there may be more objects.
      for (const Object& object : device.objects) {
        require(again.devices[0].find(object.index) != nullptr, "no object is lost");
      }
    }
  }
  return 0;
}
