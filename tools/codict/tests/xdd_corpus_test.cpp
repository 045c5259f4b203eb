// SPDX-License-Identifier: Apache-2.0
// Tests with XML descriptions of real devices in the directory LEXICAN_CORPUS, which cannot be published.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <unordered_set>
#include <vector>

#include "files.hpp"
#include "program.hpp"
#include "xdd/write.hpp"
#include "xdd_dump.hpp"
#include "xdd_reading.hpp"

using namespace lexican::codict;
using test::bytes_of;

namespace {

// Begins of all texts that the model has read from a source.
class Places {
 public:
  explicit Places(const Device& device) {
    for (const Object& object : device.objects) {
      add(object);
      add(object.sub_number);
      for (const Sub& sub : object.subs) {
        add(sub);
      }
    }
    for (const Entry& entry : device.parameters) {
      add(entry);
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
    for (const OpaquePart& kept : all) {
      add(kept.text);
      add(kept.children);
    }
  }
  void add(const LabelGroup& words) {
    for (const auto* labels : {&words.labels, &words.descriptions}) {
      for (const Label& label : *labels) {
        add(label.text);
      }
    }
  }
  void add(const Allowed& allowed) {
    for (const AllowedValue& value : allowed.values) {
      add(value.value);
      add(value.texts);
    }
    for (const Range& range : allowed.ranges) {
      add(range.minimum);
      add(range.maximum);
      add(range.step);
    }
  }
  void add(const NodeProperties& node) {
    for (const Text* text : std::initializer_list<const Text*>{
             &*node.disabled, &*node.count_label, &node.storage_group, &*node.srdo, &*node.string_length_min,
             &*node.byte_length, &*node.extension_io, &*node.flags_pdo}) {
      add(*text);
    }
  }
  void add(const Entry& entry) {
    for (const Text* text : std::initializer_list<const Text*>{
             &entry.name,          &entry.object_code,   &entry.data_type,       &entry.access,
             &entry.pdo_mapping,   &entry.default_value, &*entry.actual_value,   &*entry.substitute_value,
             &*entry.low_limit,    &*entry.high_limit,   &*entry.flags,          &*entry.denotation,
             &*entry.parameter_id, &entry.type->iec,     &entry.type->reference, &entry.unit->multiplier,
             &entry.unit->uri,     &*entry.access_list,  &*entry.support,        &*entry.persistent,
             &*entry.template_id}) {
      add(*text);
    }
    add(entry.texts);
    add(entry.denotations);
    add(entry.unit->texts);
    add(entry.allowed);
    add(entry.node);
    for (const Property& property : *entry.properties) {
      add(property.value);
    }
    add(entry.others);
  }

  std::unordered_set<std::uint32_t> begins_;
};

// Returns true for texts that the model stores as number or name, without their place.
bool has_no_place(std::string_view element, std::string_view name) {
  return name == "lang" || name == "URI" || name == "index" || name == "subIndex" || name == "Index" ||
         name == "SubIndex" || (element == "property" && name == "name") ||
         (name == "uniqueIDRef" && (element == "CANopenObject" || element == "CANopenSubObject"));
}

// Returns "line: name" of the first text below an element that is missing in the model, empty if all are present.
std::string lost_below(pugi::xml_node element, const test::XmlReading& reading, const Places& places) {
  const auto place = [&reading](Span span) {
    return std::to_string(reading.document.source().position(span.begin).line) + ": ";
  };
  for (const pugi::xml_attribute attribute : element.attributes()) {
    const Text text = reading.document.text(attribute);
    const std::string_view name = xdd::local_name(attribute);
    if (std::string_view(attribute.name()).substr(0, 5) != "xmlns" && !has_no_place(xdd::local_name(element), name) &&
        !places.has(text.span)) {
      return place(text.span) + std::string(name);
    }
  }
  const Text text = reading.document.text(element);
  const std::string_view name = xdd::local_name(element);
  if (!text.is_empty() && name != "index" && name != "subIndex" && !places.has(text.span)) {
    return place(text.span) + std::string(name);
  }
  for (const pugi::xml_node child : element.children()) {
    if (child.type() == pugi::node_element) {
      if (std::string lost = lost_below(child, reading, places); !lost.empty()) {
        return lost;
      }
    }
  }
  return {};
}

std::string first_lost(pugi::xml_node element, const test::XmlReading& reading, const Places& places) {
  for (const pugi::xml_node child : element.children()) {
    const std::string_view name = xdd::local_name(child);
    const bool is_whole = name == "CANopenObject" || name == "parameter" || name == "Object";
    std::string lost = is_whole ? lost_below(child, reading, places) : first_lost(child, reading, places);
    if (!lost.empty()) {
      return lost;
    }
  }
  return {};
}

bool is_of_cia311(const Device& device) {
  return device.format != Format::other_xml && device.format != Format::project_xml;
}

}  // namespace

TEST_CASE("corpus: all XML descriptions are read without losing an object or parameter" *
          doctest::test_suite(test::needs_corpus) * test::skipped_without_corpus()) {
  for (const std::string& path : test::files_in(test::corpus(), test::xml_endings())) {
    CAPTURE(path);
    const std::string bytes = bytes_of(path);
    REQUIRE(test::xml_refusal(bytes).empty());
    const test::XmlReading reading(bytes, path);
    CHECK_FALSE(reading.device.objects.empty());
    CHECK(first_lost(reading.document.root(), reading, Places(reading.device)).empty());
  }
}

TEST_CASE("corpus: a description written in either edition of CiA 311 and read again is the same" *
          doctest::test_suite(test::needs_corpus) * test::skipped_without_corpus()) {
  for (const std::string& path : test::files_in(test::corpus(), test::xml_endings())) {
    CAPTURE(path);
    const test::XmlReading reading(bytes_of(path), path);
    for (const xdd::Edition edition : {xdd::Edition::v10, xdd::Edition::v11}) {
      const std::string written = xdd::write(reading.device, edition);
      const test::XmlReading again(written, path);
      CHECK(xdd::write(again.device, edition) == written);
      if (is_of_cia311(reading.device)) {
        CHECK(dump(again.device) == dump(reading.device));
      }
    }
  }
}

TEST_CASE("corpus: XML texts that are written as they were read have the same meaning" *
          doctest::test_suite(test::needs_corpus) * test::skipped_without_corpus()) {
  for (const std::string& path : test::files_in(test::corpus(), test::xml_endings())) {
    CAPTURE(path);
    const std::string bytes = bytes_of(path);
    const test::XmlReading reading(bytes, path);
    CHECK(Edits().applied_to(reading.document.source().bytes()) == bytes);
    Edits edits;
    for_each_variable(reading.device, [&](std::uint16_t, std::uint8_t, const Entry& entry) {
      if (entry.default_value.is_given && is_of_cia311(reading.device)) {
        CHECK(reading.document.set_text(entry.default_value.span, entry.default_value.text, edits));
      }
    });
    CHECK(edits.applied_to(bytes) == bytes);
  }
}

TEST_CASE("corpus: other XML and files that are not XML are refused with one message" *
          doctest::test_suite(test::needs_corpus) * test::skipped_without_corpus()) {
  std::size_t number = 0;
  for (const std::string& path : test::files_in(test::corpus(), test::xml_endings(), true)) {
    CAPTURE(path);
    const std::string why = test::xml_refusal(bytes_of(path));
    CHECK_FALSE(why.empty());
    CHECK(why.find('\n') == std::string::npos);
    ++number;
  }
  CHECK(number > 0);
}
