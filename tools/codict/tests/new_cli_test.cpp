// SPDX-License-Identifier: Apache-2.0
// The command codict new. tests/programs/package/run.sh builds and runs a project.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "program.hpp"
#include "reading.hpp"

using test::Directory;
using test::has;
using test::Ran;

namespace {

Ran run_in(const Directory& directory, const std::string& arguments) {
  return test::run_codict(directory / "", arguments);
}

bool exists(const Directory& directory, const std::string& path) {
  return std::filesystem::exists(directory / path.c_str());
}

}  // namespace

TEST_CASE("codict new --profile: the description passes all checks without notes and is in normal form") {
  for (const std::string profile : {"301", "401", "402"}) {
    CAPTURE(profile);
    const Directory directory;
    const Ran made = run_in(directory, "new pump --profile " + profile);
    CHECK(made.status == 0);
    CHECK(made.err.empty());
    for (const char* const file :
         {"CMakeLists.txt", "main.c", "README.md", "pump.eds", "generated/pump_od.h", "generated/pump_od.c"}) {
      CAPTURE(file);
      CHECK(exists(directory, std::string("pump/") + file));
      CHECK(has(made.out, std::string("pump/") + file + "\n"));
    }
    const Ran checked = run_in(directory, "check --level note --profile auto pump/pump.eds");
    CHECK(checked.out.empty());
    CHECK(checked.status == 0);
    CHECK(run_in(directory, "fmt --check pump/pump.eds").status == 0);
    CHECK(run_in(directory, "gen pump/pump.eds -o pump/generated --check").status == 0);
    CHECK(has(test::bytes_of(directory / "pump/main.c"), "COTPdoTrigPdo(Node.TPdo, 0)"));
    CHECK_FALSE(has(test::bytes_of(directory / "pump/main.c"), "@"));
    CHECK_FALSE(has(test::bytes_of(directory / "pump/CMakeLists.txt"), "@"));
    CHECK_FALSE(has(test::bytes_of(directory / "pump/README.md"), "@"));
  }
}

TEST_CASE("codict new --profile 401: a new value of the inputs transmits the TPDO") {
  const Directory directory;
  CHECK(run_in(directory, "new pump --profile 401").status == 0);
  CHECK(has(test::bytes_of(directory / "pump/pump.eds"), "PDOMapping=1\n;TPDODetectCos=1\n"));
  CHECK(has(test::bytes_of(directory / "pump/generated/pump_od.c"), "PUMP_6000_1 | CO_OBJ___APR_,"));
}

TEST_CASE("codict new --from: the description is copied; names are those of the file") {
  const Directory directory;
  const std::string source = test::copy_to(directory, "drive.eds");
  const Ran made = run_in(directory, "new 'My pump' --from drive.eds --language c++");
  CHECK(made.status == 0);
  CHECK(test::bytes_of(directory / "My pump/drive.eds") == test::bytes_of(source));
  CHECK(has(test::bytes_of(directory / "My pump/CMakeLists.txt"), "project(my_pump LANGUAGES C CXX)"));
  CHECK(has(test::bytes_of(directory / "My pump/main.cpp"), "#include \"drive_od.h\""));
  CHECK(run_in(directory, "gen 'My pump/drive.eds' -o 'My pump/generated' --language c++ --check").status == 0);
}

TEST_CASE("codict new: names with blanks and special characters and a directory with a final slash are accepted") {
  const Directory directory;
  const std::string source = test::copy_to(directory, "drive.eds");
  std::filesystem::rename(source, directory / "a $drive.eds");
  CHECK(run_in(directory, "new pump/ --from 'a $drive.eds'").status == 0);
  const std::string lists = test::bytes_of(directory / "pump/CMakeLists.txt");
  CHECK(has(lists, "project(pump LANGUAGES"));
  CHECK(has(lists, "DESCRIPTION \"a \\$drive.eds\" NAME a_drive "));
}

TEST_CASE("codict new: existing files are reported and nothing is written") {
  const Directory directory;
  test::write_bytes(directory / "README.md", "mine");
  const Ran refused = run_in(directory, "new . --profile 301");
  CHECK(refused.status == 2);
  CHECK(has(refused.err, "README.md exists; no file was written"));
  CHECK(test::bytes_of(directory / "README.md") == "mine");
  CHECK_FALSE(exists(directory, "CMakeLists.txt"));
  CHECK_FALSE(exists(directory, "generated"));
  std::filesystem::create_symlink("nowhere", directory / "main.c");
  std::filesystem::remove(directory / "README.md");
  CHECK(run_in(directory, "new . --profile 301").status == 2);
  CHECK_FALSE(exists(directory, "nowhere"));
}

TEST_CASE("codict new: wrong usage and descriptions with errors write nothing") {
  const Directory directory;
  test::copy_to(directory, "number_word.eds");
  CHECK(has(run_in(directory, "new pump").err, "--from FILE or --profile 301, 401 or 402"));
  CHECK(run_in(directory, "new pump --profile 403").status == 2);
  CHECK(run_in(directory, "new pump --profile 301 --from number_word.eds").status == 2);
  CHECK(run_in(directory, "new pump --from missing.eds").status == 2);
  CHECK(run_in(directory, "new pump --from - </dev/null").status == 2);
  CHECK(run_in(directory, "new pump --from number_word.eds").status == 1);
  CHECK_FALSE(exists(directory, "pump"));
}

TEST_CASE("codict new --force: the project builds with a description with errors") {
  const Directory directory;
  test::copy_to(directory, "limits.eds");
  const Ran made = run_in(directory, "new pump --from limits.eds --force");
  CHECK(made.status == 0);
  CHECK(has(made.err, "error: mandatory object 1001h 'Error register' is missing [od-mandatory]"));
  CHECK(has(test::bytes_of(directory / "pump/CMakeLists.txt"),
            "generated\n    # The description has errors. Remove these options when they are corrected.\n"
            "    VERIFY OFF OPTIONS --force)\n"));
  CHECK(has(test::bytes_of(directory / "pump/README.md"),
            "codict gen \"limits.eds\" -o generated --name limits --force`"));
  CHECK(run_in(directory, "new correct --profile 301 --force").status == 0);
  CHECK_FALSE(has(test::bytes_of(directory / "correct/CMakeLists.txt"), "--force"));
}

TEST_CASE("codict new: a description of another format is accepted; application-defined symbols get a file") {
  const Directory directory;
  CHECK(run_in(directory, "new first --profile 401").status == 0);
  CHECK(run_in(directory, "convert first/first.eds -o io.xdd").status == 0);
  CHECK(run_in(directory, "new io --from io.xdd").status == 0);
  CHECK(exists(directory, "io/io.xdd"));
  CHECK_FALSE(exists(directory, "io/application.c"));
  std::string text = test::bytes_of(directory / "first/first.eds");
  const std::string domain =
      "[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\n[2000]\nParameterName=Firmware\nObjectType=0x2\n"
      "DataType=0x000F\nAccessType=rw\n";
  const std::size_t at = text.find("[ManufacturerObjects]");
  REQUIRE(at != std::string::npos);
  text.replace(at, std::string::npos, domain);
  test::write_bytes(directory / "domain.eds", text);
  const Ran made = run_in(directory, "new domain --from domain.eds");
  CAPTURE(made.err);
  CHECK(made.status == 0);
  CHECK(exists(directory, "domain/application.c"));
  CHECK(has(test::bytes_of(directory / "domain/CMakeLists.txt"), "OBJECT application.c)"));
}
