// SPDX-License-Identifier: Apache-2.0
// From one format into another and back.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "diff/diff.hpp"
#include "eds/read.hpp"
#include "eds/write.hpp"
#include "program.hpp"
#include "reading.hpp"
#include "xdd/write.hpp"
#include "xdd_reading.hpp"

using namespace lexican::codict;

namespace {

Device eds_of(const std::string& text, const std::string& name) {
  Findings findings;
  const eds::Document document(Source(name, text), findings);
  return eds::read(document, findings).devices.front();
}

std::vector<std::string> files_in(const std::string& directory) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    const std::string extension = entry.path().extension();
    if (entry.is_regular_file() && (extension == ".eds" || extension == ".dcf") &&
        !test::has(entry.path(), "/_not-canopen/")) {
      found.push_back(entry.path());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

// CiA 311 has no words for them, which convert tells; without an access, a parameter is ro.
bool is_told(const diff::Difference& difference) {
  constexpr std::array<std::string_view, 8> told = {"serial number", "upload file", "download file", "module",
                                                    "unit",          "multiplier",  "description",   "object link"};
  return difference.kind == diff::Kind::file || (difference.what == "access" && difference.before.empty()) ||
         std::find(told.begin(), told.end(), difference.what) != told.end();
}

std::string differences(const Device& before, const Device& after) {
  std::string text;
  for (const diff::Difference& difference : diff::compare(before, after)) {
    if (!is_told(difference)) {
      text += diff::to_string(difference.place) + " " + difference.what + ": " + difference.before + " -> " +
              difference.after + "\n";
    }
  }
  return text;
}

void check_round_trip(const std::string& path) {
  CAPTURE(path);
  const Device device = eds_of(test::bytes_of(path), path);
  for (const xdd::Edition edition : {xdd::Edition::v10, xdd::Edition::v11}) {
    const test::XmlReading xdd(xdd::write(device, edition));
    CHECK(differences(device, xdd.device) == "");
    eds::WriteOptions options;
    options.as_dcf = true;
    CHECK(differences(device, eds_of(eds::write(xdd.device, options), path)) == "");
  }
}

}  // namespace

TEST_CASE("round trip: each fixture of an EDS is the same device as an XDD, and as the EDS of that") {
  for (const std::string& path : files_in(test::fixture(""))) {
    if (!test::has(path, "control_character")) {  // which XML cannot have
      check_round_trip(path);
    }
  }
}

TEST_CASE("round trip: each EDS of the corpus is the same device as an XDD, and as the EDS of that" *
          doctest::skip(std::getenv("LEXICAN_CORPUS") == nullptr)) {
  for (const std::string& path : files_in(std::getenv("LEXICAN_CORPUS"))) {
    check_round_trip(path);
  }
}
