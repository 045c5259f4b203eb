// SPDX-License-Identifier: Apache-2.0
// Tests with descriptions of real devices in the directory LEXICAN_CORPUS, which cannot be published.
#include <doctest/doctest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "eds/document.hpp"
#include "eds/names.hpp"
#include "eds/read.hpp"
#include "eds/recognise.hpp"
#include "files.hpp"
#include "text/file.hpp"

using namespace lexican::codict;

namespace {

Source source_of(const std::string& path) {
  std::string why;
  std::optional<Source> source = read_file(path, why);
  REQUIRE_MESSAGE(source, why);
  return *source;
}

// Places of all texts that the model has read from a source.
class Places {
 public:
  explicit Places(const Device& device) {
    for (const Object& object : device.objects) {
      add(object);
    }
    add(device.others);
  }
  bool has(Span span) const { return begins_.count(span.begin) != 0; }

 private:
  void add(const Text& text) {
    if (text.is_given) {
      begins_.insert(text.span.begin);
    }
  }
  void add(const std::vector<OpaquePart>& all) {
    for (const OpaquePart& part : all) {
      add(part.text);
      add(part.children);
    }
  }
  void add(const Entry& entry) {
    for (const Text* text : std::initializer_list<const Text*>{
             &entry.name, &entry.object_code, &entry.data_type, &entry.access, &entry.pdo_mapping, &entry.default_value,
             &*entry.actual_value, &*entry.low_limit, &*entry.high_limit, &*entry.flags, &*entry.denotation,
             &*entry.upload_file, &*entry.download_file, &*entry.parameter_reference, &*entry.multiplier}) {
      add(*text);
    }
    for (const std::vector<Label>* labels : {&entry.unit->texts.labels, &entry.texts->descriptions}) {
      for (const Label& label : *labels) {
        add(label.text);
      }
    }
    add(entry.others);
  }
  void add(const Object& object) {
    add(static_cast<const Entry&>(object));
    add(object.sub_number);
    add(object.compact);
    for (const Sub& sub : object.subs) {
      add(static_cast<const Entry&>(sub));
    }
  }

  std::unordered_set<std::uint32_t> begins_;
};

bool is_object_section(eds::SectionKind kind) {
  return kind == eds::SectionKind::object || kind == eds::SectionKind::sub;
}

// Returns the first key that is missing in the model, empty if all are present.
std::string lost_key(const eds::Document& document, const Device& device) {
  const Places places(device);
  for (const eds::Section& section : document.sections()) {
    if (!is_object_section(eds::section_name(document.raw(section.name)).kind)) {
      continue;
    }
    for (const eds::Key& key : section.keys) {
      if (!places.has(key.value)) {
        return document.text(section.name) + ": " + document.text(key.name);
      }
    }
  }
  return {};
}

// Sets all values to their present texts and returns the resulting bytes.
std::string rewritten(const eds::Document& document) {
  Edits edits;
  for (const eds::Section& section : document.sections()) {
    for (const eds::Key& key : section.keys) {
      CHECK(document.set_value(key, document.text(key.value), edits));
    }
  }
  return edits.applied_to(document.source().bytes());
}

}  // namespace

TEST_CASE("corpus: all EDS and DCF are read without losing a value of an object" *
          doctest::test_suite(test::needs_corpus) * test::skipped_without_corpus()) {
  std::size_t number = 0;
  for (const std::string& path : test::files_in(test::corpus(), test::eds_endings())) {
    CAPTURE(path);
    const Source source = source_of(path);
    REQUIRE(eds::refusal(source).empty());
    Findings findings;
    const eds::Document document(source, findings);
    REQUIRE(eds::refusal(document).empty());
    const Description description = eds::read(document, findings);
    CHECK_FALSE(description.devices.at(0).objects.empty());
    CHECK(lost_key(document, description.devices.at(0)).empty());
    ++number;
  }
  CHECK(number > 0);
}

TEST_CASE("corpus: writing each value that was read changes no byte" * doctest::test_suite(test::needs_corpus) *
          test::skipped_without_corpus()) {
  for (const std::string& path : test::files_in(test::corpus(), test::eds_endings())) {
    CAPTURE(path);
    Findings findings;
    const eds::Document document(source_of(path), findings);
    CHECK(rewritten(document) == document.source().bytes());
  }
}

TEST_CASE("corpus: files that are not EDS are refused with one message" * doctest::test_suite(test::needs_corpus) *
          test::skipped_without_corpus()) {
  std::vector<std::string> foreign = test::files_in(test::corpus(), {".eds", ".dcf", ".xdc"}, true);
  for (const std::string& topology : test::files_in(test::corpus(), {".cpj"})) {
    foreign.push_back(topology);
  }
  for (const std::string& path : foreign) {
    CAPTURE(path);
    const Source source = source_of(path);
    std::string why = eds::refusal(source);
    if (why.empty()) {
      Findings findings;
      why = eds::refusal(eds::Document(source, findings));
    }
    CHECK_FALSE(why.empty());
    CHECK(why.find('\n') == std::string::npos);
  }
}
