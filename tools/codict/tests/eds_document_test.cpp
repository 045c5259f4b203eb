// SPDX-License-Identifier: Apache-2.0
// EDS documents keep all bytes of the source; an edit changes one line.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "eds/document.hpp"
#include "eds/read.hpp"
#include "eds/suppressions.hpp"
#include "program.hpp"
#include "reading.hpp"

using namespace lexican::codict;
using eds::Document;

namespace {

Document document_of(std::string bytes) {
  Findings findings;
  return {Source("device.eds", std::move(bytes)), findings};
}

std::string changed(const std::string& bytes, const char* section, const char* key, const char* value) {
  const Document document = document_of(bytes);
  Edits edits;
  CHECK(document.set_value(*document.find(*document.find(section), key), value, edits));
  return edits.applied_to(bytes);
}

std::string added(const std::string& bytes, const char* section, const char* key, const char* value) {
  const Document document = document_of(bytes);
  Edits edits;
  CHECK(document.add_key(*document.find(section), key, value, edits));
  return edits.applied_to(bytes);
}

}  // namespace

TEST_CASE("EDS: without a change the written bytes are those read") {
  for (const auto& entry : std::filesystem::directory_iterator(test::fixture(""))) {
    if (!entry.is_regular_file()) {
      continue;
    }
    const std::string bytes = test::bytes_of(entry.path());
    CHECK(Edits().applied_to(document_of(bytes).source().bytes()) == bytes);
  }
}

TEST_CASE("EDS: the first line may have a byte order mark and blanks behind it") {
  const std::string mark = "\xEF\xBB\xBF";
  CHECK(document_of(mark + " [2000]\n").find("2000") != nullptr);
  CHECK(eds::suppressions(document_of(mark + "; codict: ignore od-limit\n[2000]\n")).size() == 1);
}

TEST_CASE("EDS: any bytes are read and kept") {
  std::string bytes;
  for (unsigned n = 0; n < 20000; ++n) {
    bytes += "[]=;#\r\n10Asub $\x80\xFF"[(n * n * 7 + n / 3) % 18];
  }
  Findings findings;
  const Document document(Source("any", bytes), findings);
  CHECK(document.source().bytes() == bytes);
  eds::read(document, findings);
}

TEST_CASE("EDS: sections and keys are case-insensitive") {
  const Document document = document_of("[FileInfo]\nFileName = a.eds \n[1A00sub1]\nDataType=5\n");
  CHECK(document.sections().size() == 2);
  CHECK(document.find("1a00SUB1") == &document.sections()[1]);
  const eds::Key* const key = document.find(document.sections()[0], "filename");
  REQUIRE(key != nullptr);
  CHECK(document.raw(key->value) == "a.eds");
  CHECK(key->line == 2);
  CHECK(document.find("Missing") == nullptr);
  CHECK(document.find(document.sections()[1], "FileName") == nullptr);
}

TEST_CASE("EDS: a new value replaces only the old one") {
  const std::string bytes = "[2000]\r\nDefaultValue = \t5 \r\n;end\r\n";
  CHECK(changed(bytes, "2000", "DefaultValue", "17") == "[2000]\r\nDefaultValue = \t17 \r\n;end\r\n");
  CHECK(changed("[2000]\nDefaultValue=\n", "2000", "defaultvalue", "1") == "[2000]\nDefaultValue=1\n");
  CHECK(changed("[2000]\nDefaultValue= ", "2000", "DefaultValue", "1") == "[2000]\nDefaultValue=1 ");
}

TEST_CASE("EDS: a new key is added at the end of its section with the formatting of adjacent lines") {
  CHECK(added("[2000]\r\nA = 1\r\n\r\n[2001]\r\n", "2000", "B", "2") == "[2000]\r\nA = 1\r\nB = 2\r\n\r\n[2001]\r\n");
  CHECK(added("[2000]\n\n[2001]\n", "2000", "B", "2") == "[2000]\nB=2\n\n[2001]\n");
  CHECK(added("[2000]\r\nA=1", "2000", "B", "2") == "[2000]\r\nA=1\r\nB=2");
  CHECK(added("[2000]", "2000", "B", "2") == "[2000]\nB=2");
}

TEST_CASE("EDS: a new value is written in the encoding of the file if it contains the characters") {
  const std::string dos = "[2000]\nParameterName=Gr\x94\xE1\x65\n";
  CHECK(changed(dos, "2000", "ParameterName", u8"Öl") == "[2000]\nParameterName=\x99l\n");
  const Document document = document_of(dos);
  const eds::Key& key = *document.find(*document.find("2000"), "ParameterName");
  Edits edits;
  CHECK_FALSE(document.set_value(key, u8"Ω→", edits));
  CHECK_FALSE(document.set_value(key, "two\nlines", edits));
  CHECK(edits.is_empty());
}

TEST_CASE("EDS: the comments of a section follow its name") {
  const Document document = document_of("; before\n[2000]\n;one\nA=1;no\n ;two\n[2001]\n;three\n");
  const std::vector<Span> comments = document.comments(document.sections()[0]);
  REQUIRE(comments.size() == 2);
  CHECK(document.raw(comments[0]) == "one");
  CHECK(document.raw(comments[1]) == "two");
}
