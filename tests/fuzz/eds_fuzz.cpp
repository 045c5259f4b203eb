// SPDX-License-Identifier: Apache-2.0
// Fuzzes the EDS reader with any bytes: the document keeps every byte, rewriting values as they were read changes
// nothing, and a key that is added is found.
#include "eds/document.hpp"
#include "eds/format.hpp"
#include "eds/read.hpp"

#include <string>
#include <utility>

#include "catalogue/suppress.hpp"
#include "check/check.hpp"
#include "eds/recognise.hpp"
#include "eds/suppressions.hpp"
#include "fuzz/fuzz.hpp"

namespace {

using namespace lexican::codict;

constexpr std::size_t sections_tried = 4;
constexpr const char* new_key = "ByTheFuzzer";

eds::Document document_of(std::string bytes) {
  Findings findings;
  return {Source("fuzz.eds", std::move(bytes)), findings};
}

void check_places(const Findings& findings, const Source& source) {
  for (const Finding& finding : findings.all()) {
    const bool is_inside = finding.span.begin <= finding.span.end && finding.span.end <= source.size();
    fuzz::require(is_inside, "a finding has its place in the source");
    fuzz::require(source.position(finding.span.begin).line <= source.lines(), "a finding has its line in the source");
  }
}

void rewrite_values(const eds::Document& document) {
  Edits edits;
  for (const eds::Section& section : document.sections()) {
    for (const eds::Key& key : section.keys) {
      document.set_value(key, document.text(key.value), edits);
    }
  }
  fuzz::require(edits.applied_to(document.source().bytes()) == document.source().bytes(),
                "values that are written as they were read change nothing");
}

void add_keys(const eds::Document& document) {
  for (std::size_t n = 0; n < document.sections().size() && n < sections_tried; ++n) {
    if (document.find(document.sections()[n], new_key) != nullptr) {
      continue;
    }
    Edits edits;
    if (!document.add_key(document.sections()[n], new_key, "1", edits)) {
      continue;
    }
    const eds::Document changed = document_of(edits.applied_to(document.source().bytes()));
    fuzz::require(changed.sections().size() == document.sections().size(), "a new key makes no section");
    const eds::Key* const key = changed.find(changed.sections()[n], new_key);
    fuzz::require(key != nullptr && changed.raw(key->value) == "1", "a new key is found in its section");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(data, data + size);
  Findings findings;
  const eds::Document document(Source("fuzz.eds", bytes), findings);
  fuzz::require(document.source().bytes() == bytes, "no byte is lost");
  fuzz::require(eds::refusal(document).find('\n') == std::string::npos, "a refusal is one line");
  const std::string formatted = eds::formatted(document);
  fuzz::require(eds::formatted(document_of(formatted)) == formatted, "the normal form of a normal form is itself");
  const Description description = eds::read(document, findings);
  check::check_all(description.devices.front(), findings);
  catalogue::suppress(document.source(), eds::suppressions(document), catalogue::Origin::checks, findings);
  check_places(findings, document.source());
  rewrite_values(document);
  add_keys(document);
  return 0;
}
