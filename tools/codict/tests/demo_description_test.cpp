// SPDX-License-Identifier: Apache-2.0
// Description of the demo's clock, and the committed files that are generated from it.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "directory.hpp"
#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using test::Ran;
using test::run_shell;

const std::string root = LEXICAN_SOURCE_DIR;

/// Runs demo/generate with the codict of this build in a copy of its input and output files.
struct Copy {
  Copy() {
    fs::create_directories(directory / "demo/clock/generated");
    fs::copy(root + "/demo/generate", directory / "demo/generate");
    fs::copy(root + "/demo/clock/clock.xdd", directory / "demo/clock/clock.xdd");
    fs::copy(root + "/demo/clock/generated", directory / "demo/clock/generated");
  }
  Ran generate(const char* option = "") const {
    return run_shell("LEXICAN_CODICT='" LEXICAN_CODICT_PROGRAM "' '" + directory / "demo/generate" + "' " + option);
  }
  std::string file(const std::string& name) const { return directory / "demo/clock/generated/" + name; }

  test::Directory directory;
};

const char* const made[] = {"clock_od.h", "clock_od.cpp", "clock.eds"};

}  // namespace

TEST_CASE("demo: the description of the clock has no findings and no notes; its EDS has no warnings") {
  CHECK(run_shell("'" LEXICAN_CODICT_PROGRAM "' check --level note '" + root + "/demo/clock/clock.xdd'").status == 0);
  CHECK(run_shell("'" LEXICAN_CODICT_PROGRAM "' check '" + root + "/demo/clock/generated/clock.eds'").status == 0);
}

TEST_CASE("demo: the committed dictionary and EDS of the clock are generated from its description") {
  const Copy copy;
  CHECK(copy.generate("--check").status == 0);
  for (const char* name : made) {
    CAPTURE(name);
    const std::string bytes = bytes_of(copy.file(name));
    std::ofstream(copy.file(name), std::ios::app) << "\n";
    const Ran checked = copy.generate("--check");
    CHECK(checked.status == 1);
    CHECK(test::has(checked.err, std::string(name) + " is out of date"));
    CHECK(copy.generate().status == 0);
    CHECK(bytes_of(copy.file(name)) == bytes);
    fs::remove(copy.file(name));
    CHECK(copy.generate("--check").status == 1);
    CHECK(copy.generate().status == 0);
  }
  CHECK(copy.generate("--check").status == 0);
}

TEST_CASE("demo: another description gives another dictionary and another EDS") {
  const Copy copy;
  const std::string path = copy.directory / "demo/clock/clock.xdd";
  std::string text = bytes_of(path);
  const std::string name = "value=\"Lexican demo clock\"";
  REQUIRE(text.find(name) != std::string::npos);
  std::ofstream(path) << text.replace(text.find(name), name.size(), "value=\"Another clock\"");
  CHECK(copy.generate("--check").status == 1);
  CHECK(copy.generate().status == 0);
  CHECK(bytes_of(copy.file("clock_od.cpp")).find("\"Another clock\"") != std::string::npos);
  CHECK(bytes_of(copy.file("clock.eds")).find("DefaultValue=Another clock") != std::string::npos);
}
