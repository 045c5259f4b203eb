// SPDX-License-Identifier: Apache-2.0
// Findings name the object that they concern, and similar findings are folded.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "catalogue/rules.hpp"
#include "check/check.hpp"
#include "eds/read.hpp"
#include "json/read.hpp"
#include "model/subject.hpp"
#include "program.hpp"
#include "reading.hpp"
#include "xdd/read.hpp"

using namespace lexican::codict;

namespace {

template <typename Document, typename Read>
std::string message(const std::string& name, const std::string& text, const std::string& rule, Read read) {
  Findings findings;
  Document document(Source(name, text), findings);
  const Description description = read(document, findings);
  check::check_all(description.devices.front(), findings);
  name_subjects(description.devices.front(), findings);
  for (const Finding& finding : findings.all()) {
    if (finding.rule->id == rule) {
      return message_of(finding);
    }
  }
  return "not found";
}

std::string in_eds(const std::string& text, const std::string& rule) {
  return message<eds::Document>("a.eds", text, rule, eds::read);
}
std::string in_xdd(const std::string& objects, const std::string& parameters, const std::string& rule) {
  return message<xdd::Document>(
      "a.xdd",
      "<ISO15745ProfileContainer xmlns=\"http://www.canopen.org/xml/1.0\"><ISO15745Profile><ProfileBody>"
      "<ApplicationProcess><parameterList>" +
          parameters + "</parameterList></ApplicationProcess></ProfileBody></ISO15745Profile><ISO15745Profile>" +
          "<ProfileBody><ApplicationLayers><CANopenObjectList>" + objects +
          "</CANopenObjectList></ApplicationLayers></ProfileBody></ISO15745Profile></ISO15745ProfileContainer>",
      rule, xdd::read);
}

const std::string octal = "ParameterName=Ratio\nObjectType=7\nDataType=5\nAccessType=rw\nDefaultValue=012\n";

Finding finding_of(const std::string& text, Span span) {
  Finding finding;
  finding.rule = catalogue::all_rules().front();
  finding.span = span;
  finding.text = text;
  return finding;
}

}  // namespace

TEST_CASE("subject: a finding in a section of an EDS has the object") {
  CHECK(in_eds("[2000]\n" + octal, "od-value-octal").find("2000h 'Ratio': ") == 0);
  CHECK(in_eds("[2000]\nParameterName=All\nObjectType=9\n[2000sub1]\n" + octal, "od-value-octal")
            .find("2000h:01 'Ratio': ") == 0);
}

TEST_CASE("subject: a value of compact storage has its sub-object") {
  CHECK(in_eds("[2000]\nParameterName=Gain\nObjectType=8\nDataType=5\nAccessType=rw\nCompactSubObj=3\n"
               "[2000Value]\nNrOfEntries=1\n2=012\n",
               "od-value-octal")
            .find("2000h:02 'Gain2': ") == 0);
}

TEST_CASE("subject: a finding in another section has none") {
  CHECK(in_eds("[2000]\n" + octal + "[FileInfo]\nFileDate=1\nCreationDate=2020\n", "eds-file-date").find("2000h") ==
        std::string::npos);
}

TEST_CASE("subject: findings of an XDD have object, sub-object or parameter") {
  CHECK(in_xdd("<CANopenObject index=\"2000\" name=\"Ratio\" objectType=\"7\" dataType=\"05\" accessType=\"rw\" "
               "defaultValue=\"012\"/>",
               "", "od-value-octal")
            .find("2000h 'Ratio': ") == 0);
  CHECK(in_xdd("<CANopenObject index=\"2000\" name=\"All\" objectType=\"9\" subNumber=\"1\"><CANopenSubObject "
               "subIndex=\"01\" name=\"Ratio\" objectType=\"7\" dataType=\"05\" accessType=\"rw\" "
               "defaultValue=\"012\"/></CANopenObject>",
               "", "od-value-octal")
            .find("2000h:01 'Ratio': ") == 0);
  CHECK(in_xdd("<CANopenObject index=\"2000\" name=\"Ratio\" objectType=\"7\" uniqueIDRef=\"P\"/>",
               "<parameter uniqueID=\"P\" access=\"readWrite\"><USINT/><defaultValue value=\"012\"/></parameter>",
               "od-value-octal")
            .find("2000h 'Ratio': ") == 0);
  CHECK(in_xdd("", "<parameter uniqueID=\"P\" access=\"readWrite\"><USINT/><defaultValue value=\"012\"/></parameter>",
               "od-value-octal")
            .find("parameter 'P': ") == 0);
}

TEST_CASE("subject: findings of JSON have the object") {
  const std::string text =
      R"({"schema": "codict-device-1", "devices": [{"format": "eds", "objects": [{"index": 8192, "name": "Ratio",
          "object_code": "var", "data_type": 5, "access": "rw", "default_value": {"text": "012"}}]}]})";
  Findings findings;
  const json::Document document(Source("a.json", text));
  const Description description = json::read(document, findings);
  name_subjects(description.devices.front(), findings);
  REQUIRE(findings.all().size() == 1);
  CHECK(message_of(findings.all().front()).find("2000h 'Ratio': ") == 0);
}

TEST_CASE("subject: long names are truncated between characters; missing ones are omitted") {
  CHECK(in_quotes(std::string(40, 'n')) == "'" + std::string(40, 'n') + "'");
  CHECK(in_quotes(std::string(41, 'n')) == "'" + std::string(40, 'n') + "...'");
  CHECK(in_quotes(std::string(39, 'n') + "\xC3\xA4n") == "'" + std::string(39, 'n') + "...'");
  Device device;
  CHECK(subject_of(device, 0x2000, 0) == "2000h");
  CHECK(subject_of(device, 0x2000, 3) == "2000h:03");
  device.objects.emplace_back().index = 0x2000;
  CHECK(subject_of(device, 0x2000, 0) == "2000h");
  CHECK(subject_of(device.objects.front()) == "2000h");
}

TEST_CASE("messages about the fixtures are short, state a fault and have a remedy") {
  std::string wrong;
  for (const auto& file : std::filesystem::directory_iterator(test::fixture(""))) {
    const std::string name = file.path().filename();
    if (file.path().extension() != ".eds" && file.path().extension() != ".dcf") {
      continue;
    }
    const test::Reading reading(name);
    for (const Finding& finding : reading.findings.all()) {
      wrong += test::is_well_said(finding) ? "" : name + ": " + message_of(finding) + " [" + finding.hint + "]\n";
    }
  }
  for (const auto& file : std::filesystem::directory_iterator(test::fixture("xdd"))) {
    Findings findings;
    xdd::Document document(Source(file.path().filename(), test::bytes_of(file.path())), findings);
    const Description description = xdd::read(document, findings);
    for (const Finding& finding : findings.all()) {
      wrong += test::is_well_said(finding) ? "" : message_of(finding) + " [" + finding.hint + "]\n";
    }
  }
  CHECK(wrong == "");
}

TEST_CASE("fold: findings that differ only in numbers and quoted names are folded") {
  const std::vector<Finding> alike = {finding_of("'a' is 5, not 2000h", {1, 2}),
                                      finding_of("'b' is 66, not 2001h", {3, 4}),
                                      finding_of("'b' was 66, not 2001h", {5, 6})};
  const std::vector<FoldedFindings> folded = fold(alike);
  REQUIRE(folded.size() == 2);
  CHECK(folded.front().first == &alike.front());
  CHECK(folded.front().more == 1);
  CHECK(fold({finding_of("1000h is missing", {}), finding_of("1001h is missing", {})}).size() == 2);
  CHECK(fold({finding_of("unpaired ' 5", {1, 2}), finding_of("unpaired ' 6", {1, 2})}).size() == 1);
}
