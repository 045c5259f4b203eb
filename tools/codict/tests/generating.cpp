// SPDX-License-Identifier: Apache-2.0
#include "generating.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <utility>

#include "eds/document.hpp"
#include "eds/read.hpp"
#include "reading.hpp"

using namespace lexican::codict;

namespace test {

Generated generate(std::string eds, gen::Options options) {
  Findings reading;
  const eds::Document document(Source("device.eds", std::move(eds)), reading);
  const Description description = eds::read(document, reading);
  options.name = options.name.empty() ? "small" : options.name;
  options.source = "small.eds";
  Findings findings;
  Generated result;
  result.output = gen::generate(description.devices.front(), options, findings);
  findings.sort();
  for (const Finding& finding : findings.all()) {
    const Position position = document.source().position(finding.span.begin);
    std::string& list = finding.rule->severity == Severity::note ? result.notes : result.found;
    list += fmt::format("{}:{} {}\n", position.line, position.column, finding.rule->id);
    result.texts += fmt::format("{}: {} {}\n", finding.rule->id, finding.text, finding.hint);
  }
  return result;
}

std::string fixture_text(const std::string& name) {
  std::ifstream file(fixture(name), std::ios::binary);
  REQUIRE(file);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string variable(const char* index, int type, const char* access, const char* rest) {
  return fmt::format("[{}]\nParameterName=Value {}\nObjectType=7\nDataType={}\nAccessType={}\n{}\n", index, index, type,
                     access, rest);
}

std::string sub(const char* section, int type, const char* access, const char* value) {
  return fmt::format(
      "[{}]\nParameterName={}\nObjectType=7\nDataType={}\nAccessType={}\nPDOMapping=0\nDefaultValue={}\n", section,
      section, type, access, value);
}

std::string record(const char* index) { return fmt::format("[{}]\nParameterName=Record\nObjectType=9\n", index); }

}  // namespace test
