// SPDX-License-Identifier: Apache-2.0
// Files that are no EDS or DCF are refused, with one message that names their kind.
#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "eds/document.hpp"
#include "eds/read.hpp"
#include "eds/recognise.hpp"
#include "eds/rules.hpp"

using namespace lexican::codict;

namespace {

std::string refusal_of(std::string bytes) {
  const Source source("device.eds", std::move(bytes));
  std::string why = eds::refusal(source);
  if (why.empty()) {
    Findings findings;
    why = eds::refusal(eds::Document(source, findings));
  }
  return why;
}

bool says(const std::string& why, const char* word) { return why.find(word) != std::string::npos; }

}  // namespace

TEST_CASE("no EDS: an empty file is refused") {
  CHECK(says(refusal_of(""), "empty"));
  CHECK(says(refusal_of(" \r\n\t\n"), "empty"));
  CHECK(says(refusal_of("\xEF\xBB\xBF\n"), "empty"));
}

TEST_CASE("no EDS: UTF-16, binary bytes and XML are refused") {
  CHECK(says(refusal_of(std::string("\xFF\xFE[\0F\0", 6)), "UTF-16"));
  CHECK(says(refusal_of(std::string("[FileInfo]\na\0", 13)), "NUL byte at 2:2 (offset 12)"));
  CHECK(says(refusal_of("\xEF\xBB\xBF<?xml version=\"1.0\"?>"), "XML"));
}

TEST_CASE("no EDS: an EDS of ODVA is refused") {
  CHECK(says(refusal_of("$ Made by hand\n[File]\n  DescText = \"x\";\n[Device]\n  VendCode = 1;\n"), "ODVA"));
}

TEST_CASE("no EDS: the target of a symbolic link stored as text is refused") {
  CHECK(says(refusal_of("../../common/Motor.dcf"), "../../common/Motor.dcf"));
}

TEST_CASE("no EDS: constraints of an FPGA design are refused") {
  CHECK(says(refusal_of("###CLOCK\nset_property PACKAGE_PIN F19 [get_ports reset]\n"), "FPGA"));
}

TEST_CASE("no EDS: types as words, in the dialect of socanmatic, are refused") {
  CHECK(says(refusal_of("[2000]\nParameterName=x\nObjectType=VAR\nDataType=UNSIGNED32\n"), "socanmatic"));
}

TEST_CASE("no EDS: the topology of a network is refused") {
  CHECK(says(refusal_of("[TOPOLOGY]\nNetName=None\nNodes=0x01\n"), "topology"));
}

TEST_CASE("no EDS: any other text is refused") {
  CHECK(says(refusal_of("[general]\nname=value\n"), "no section"));
  CHECK(says(refusal_of("Dear reader,\nthis is a letter.\n"), "no section"));
}

TEST_CASE("no EDS: more than 16 MB or 100000 sections are refused") {
  CHECK(says(refusal_of(std::string(17 * 1024 * 1024, ';')), "16 MB"));
  std::string sections;
  for (int n = 0; n <= 100000; ++n) {
    sections += "[1]\n";
  }
  CHECK(says(refusal_of(sections), "100000 sections"));
}

TEST_CASE("an EDS: compact storage expands to at most 50000 sub-objects") {
  std::string objects;
  constexpr unsigned fitting = 50000 / 254;
  for (unsigned n = 0; n <= fitting; ++n) {
    objects += "[2" + std::to_string(100 + n) +
               "]\nParameterName=x\nObjectType=8\nDataType=5\nAccessType=ro\nCompactSubObj=254\n";
  }
  Findings findings;
  const eds::Document document(Source("device.eds", objects), findings);
  const Description description = eds::read(document, findings);
  const std::vector<Object>& read = description.devices.front().objects;
  REQUIRE(read.size() == fitting + 1);
  CHECK(read[fitting - 1].subs.size() == 255);
  CHECK(read[fitting].subs.empty());
  CHECK(findings.count(eds::rules::compact_limit) == 1);
}

TEST_CASE("an EDS: one known section is enough") {
  CHECK(refusal_of("[deviceinfo]").empty());
  CHECK(refusal_of("[1000]\n").empty());
  CHECK(refusal_of("[1a00SUB1]\n").empty());
}
