// SPDX-License-Identifier: Apache-2.0
// The command codict gen: options, files and exit status.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "directory.hpp"
#include "program.hpp"
#include "reading.hpp"

namespace {

using test::bytes_of;
using test::Ran;

Ran run(const test::Directory& directory, const std::string& arguments) {
  return test::run_codict(directory / "", "gen " + arguments);
}

const std::string small = "'" + test::fixture("gen/small.eds") + "'";

}  // namespace

TEST_CASE("codict gen: unchanged files keep their time; --check returns whether they would change") {
  const test::Directory directory;
  CHECK(run(directory, small + " -o new --check").status == 1);
  CHECK(run(directory, small + " -o new").status == 0);
  const std::string header = directory / "new/small_od.h";
  CHECK(bytes_of(header) == bytes_of(test::fixture("gen/small_od.h.txt")));
  const auto long_ago = std::filesystem::last_write_time(header) - std::chrono::hours(1);
  std::filesystem::last_write_time(header, long_ago);
  CHECK(run(directory, small + " -o new").status == 0);
  CHECK(std::filesystem::last_write_time(header) == long_ago);
  CHECK(run(directory, small + " -o new --check").err.empty());
  std::ofstream(header, std::ios::app) << "\n";
  const Ran checked = run(directory, small + " -o new --check");
  CHECK(checked.status == 1);
  CHECK(checked.err == "codict: new/small_od.h is out of date\n");
}

TEST_CASE("codict gen: an error is shown with file, line, column and rule and nothing is written") {
  const test::Directory directory;
  std::ofstream(directory / "bad.eds") << "[2000]\nParameterName=Bad\nDataType=5\nAccessType=rw\nDefaultValue=256\n";
  const Ran ran = run(directory, "bad.eds -o new");
  CHECK(ran.status == 1);
  CHECK(ran.err.find("bad.eds:5:14: error: 2000h 'Bad': '256' does not fit UNSIGNED8 [gen-value]\n") !=
        std::string::npos);
  CHECK_FALSE(std::filesystem::exists(directory / "new"));
}

TEST_CASE("codict gen: from a description with errors nothing is generated without --force") {
  const test::Directory directory;
  std::string eds = bytes_of(test::fixture("gen/small.eds"));
  eds.replace(eds.find("DefaultValue=100"), 16, "DefaultValue=501");
  test::write_bytes(directory / "bad.eds", eds);
  const Ran ran = run(directory, "bad.eds -o new");
  CHECK(ran.status == 1);
  CHECK(ran.err.find("[od-limit]\n") != std::string::npos);
  CHECK(ran.err.find("codict: errors, no file was written; --force") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(directory / "new"));
  CHECK(run(directory, "bad.eds -o new --check").status == 1);
  const Ran forced = run(directory, "bad.eds -o new --force");
  CHECK(forced.status == 0);
  CHECK(forced.err.find("[od-limit]\n") != std::string::npos);
  CHECK(std::filesystem::exists(directory / "new/bad_od.h"));
  // Comments in the description suppress rules as in codict check.
  eds.insert(eds.find("DefaultValue=501"), "; codict: ignore od-limit\n");
  test::write_bytes(directory / "bad.eds", eds);
  CHECK(run(directory, "bad.eds -o known").status == 0);
}

TEST_CASE("codict: XML with a syntax error is reported by every command, and gen generates nothing") {
  const test::Directory directory;
  CHECK(run(directory, small + " -o new --xdd whole.xdd").status == 0);
  std::string xdd = bytes_of(directory / "whole.xdd");
  xdd.replace(xdd.find("</CANopenObject>"), 16, "</CANopenObjec>");
  test::write_bytes(directory / "broken.xdd", xdd);
  const Ran made = run(directory, "broken.xdd -o made");
  CHECK(made.status == 1);
  CHECK(made.err.find("[xdd-syntax]\n") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(directory / "made"));
  for (const char* command : {"list broken.xdd", "info broken.xdd", "size broken.xdd", "get broken.xdd 1000",
                              "convert broken.xdd -o broken.eds", "diff whole.xdd broken.xdd"}) {
    CAPTURE(command);
    const std::string said = test::run_codict(directory / "", command).err;
    CHECK(said.find("[xdd-syntax]\n") != std::string::npos);
    CHECK(said.find("[xdd-syntax]\n") == said.rfind("[xdd-syntax]\n"));
  }
}

TEST_CASE("codict gen: --eds and --xdd write descriptions of the generated dictionary, which --check compares") {
  const test::Directory directory;
  const std::string descriptions = " -o new --eds device.eds --xdd device.xdd ";
  CHECK(run(directory, small + descriptions + "--check").err.find("device.eds is missing") != std::string::npos);
  const auto json = nlohmann::json::parse(run(directory, small + descriptions + "--json").out);
  CHECK(json["files"] == nlohmann::json{"new/small_od.h", "new/small_od.c", "device.eds", "device.xdd"});
  CHECK(run(directory, small + descriptions + "--check").status == 0);
  // The written EDS and XDD give the same dictionary.
  CHECK(run(directory, "device.eds -o of_eds --name small").status == 0);
  CHECK(run(directory, "device.xdd -o of_xdd --name small").status == 0);
  const std::string source = bytes_of(directory / "new/small_od.c");
  CHECK(source.size() > 1000);
  for (const char* file : {"of_eds/small_od.c", "of_xdd/small_od.c"}) {
    const std::string again = bytes_of(directory / file);
    CHECK(again.substr(again.find('\n')) == source.substr(source.find('\n')));  // the first line differs
  }
  CHECK(bytes_of(directory / "device.eds").find("FileName=device.eds\r\n") != std::string::npos);
}

TEST_CASE("codict gen: the report has the cost of each part, as text and as JSON") {
  const test::Directory directory;
  const Ran text = run(directory, small + " -o new --report");
  CHECK(text.out.find("\nDRIVE ") != std::string::npos);
  CHECK(text.out.find("\nextern CO_OBJ_DOM small_2002_0;  // 2002h sub 0: Firmware, DOMAIN wo\n") != std::string::npos);
  const auto json = nlohmann::json::parse(run(directory, small + " -o new --json").out);
  CHECK(json["schema"] == "codict-gen-1");
  CHECK(json["files"] == nlohmann::json{"new/small_od.h", "new/small_od.c"});
  CHECK(json["parts"][1]["part"] == "DRIVE");
  CHECK(json["parts"][1]["entries"] == 2);
}

TEST_CASE("codict gen: the output lists storage groups with sub-indices, and application-defined symbols") {
  const test::Directory directory;
  const Ran ran = run(directory, small + " -o new");
  CHECK(ran.status == 0);
  CHECK(
      ran.out ==
      "storage group DRIVE: 2 entries, 40 bytes; stored by 1010h sub 1 (Save all parameters), restored by no sub-index "
      "of 1011h\n"
      "to be defined by the application (--stubs FILE writes stubs):\n"
      "extern CO_OBJ_DOM small_2002_0;  // 2002h sub 0: Firmware, DOMAIN wo\n");
  CHECK(run(directory, small + " -o new --check").out.empty());
  const auto json = nlohmann::json::parse(run(directory, small + " -o new --json").out);
  CHECK(json["groups"][0]["name"] == "DRIVE");
  CHECK(json["groups"][0]["store_sub"] == 1);
  CHECK(json["external"] == nlohmann::json{"extern CO_OBJ_DOM small_2002_0;"});
}

TEST_CASE("codict gen: --stubs writes files once and never overwrites them") {
  const test::Directory directory;
  CHECK(run(directory, small + " -o new --stubs stubs.c").err.empty());
  CHECK(test::has(bytes_of(directory / "stubs.c"), "CO_OBJ_DOM small_2002_0 = {"));
  test::write_bytes(directory / "stubs.c", "CO_OBJ_DOM small_2002_0 = {0, 9, mine};\n");
  CHECK(run(directory, small + " -o new --stubs stubs.c").err.empty());
  CHECK(bytes_of(directory / "stubs.c") == "CO_OBJ_DOM small_2002_0 = {0, 9, mine};\n");
  test::write_bytes(directory / "stubs.c", "\n");
  const Ran missing = run(directory, small + " -o new --stubs stubs.c");
  CHECK(missing.status == 0);
  CHECK(missing.err ==
        "codict: stubs.c: the file exists and is not changed; it does not define small_2002_0 (2002h sub 0: Firmware, "
        "DOMAIN wo)\n");
  CHECK(bytes_of(directory / "stubs.c") == "\n");
}

TEST_CASE("codict gen: --store gives a storage group its sub-index of 1010h") {
  const test::Directory directory;
  CHECK(run(directory, small + " -o new --store DRIVE=1").status == 0);
  const Ran none = run(directory, small + " -o new --store DRIVE=none");
  CHECK(none.status == 0);
  CHECK_FALSE(test::has(none.out, "storage group"));
  const Ran wrong = run(directory, small + " -o new --store DRIVE=5");
  CHECK(wrong.status == 1);
  CHECK(test::has(wrong.err, "--store DRIVE=5: sub-index 5 of 1010h is missing or has another group"));
  for (const char* store : {"DRIVE", "DRIVE=", "=1", "DRIVE=0", "DRIVE=80", "DRIVE=x", "DRIVE=1x"}) {
    CAPTURE(store);
    const Ran ran = run(directory, small + " -o new --store " + store);
    CHECK(ran.status == 2);
    CHECK(test::has(ran.err, "the form is GROUP=SUB"));
  }
  CHECK(test::run_codict(directory / "", "size " + small + " --store DRIVE=none").status == 0);
}

TEST_CASE("codict gen: --verify reports missing programs before anything is written") {
  const test::Directory directory;
  const std::pair<const char*, const char*> cases[] = {
      {"", "--verify needs the sources of the stack; give their directory, --stack DIR"},
      {"--stack .", ".: no sources of Lexican"},
      {"--stack '" LEXICAN_SOURCE_DIR "' --preset huge", "--preset huge: no such file"},
      {"--stack '" LEXICAN_SOURCE_DIR "' --preset ../presets/slave", "no such file"},
      {"--stack '" LEXICAN_SOURCE_DIR "' -D '=5'", "-D =5: not of the form NAME=VALUE"},
      {"--stack '" LEXICAN_SOURCE_DIR "' -D 'A B=5'", "-D A B=5: not of the form NAME=VALUE"},
  };
  for (const auto& row : cases) {
    const auto& [arguments, text] = row;
    CAPTURE(row.first);
    const Ran ran = run(directory, small + " -o new --verify " + arguments);
    CHECK(ran.status == 2);
    CHECK_MESSAGE(test::has(ran.err, text), ran.err);
    CHECK_FALSE(std::filesystem::exists(directory / "new"));
  }
  CHECK(run(directory, small + " -o new --verify-source new/verify.c").status == 0);
  CHECK(test::has(bytes_of(directory / "new/verify.c"), "{SMALL_2000_0, \"Speed\"},"));
}

TEST_CASE("codict gen: wrong usage ends with status 2") {
  const test::Directory directory;
  CHECK(run(directory, small).status == 2);
  CHECK(run(directory, small + " -o new --name Large").status == 2);
  CHECK(run(directory, small + " -o new --language basic").status == 2);
  CHECK(run(directory, small + " -o new --eds device.xdd").status == 2);
  CHECK(run(directory, small + " -o new --xdd device.eds").status == 2);
  CHECK(run(directory, "none.eds -o new").status == 2);
  test::write_bytes(directory / "out", "a file");
  CHECK(run(directory, small + " -o out/new").status == 2);  // "out" is a file
}

TEST_CASE("codict gen: --embed-eds generates the EDS that --eds writes") {
  const test::Directory directory;
  CHECK(run(directory, small + " -o new --eds shipped.eds --embed-eds plain").status == 0);
  const std::string eds = bytes_of(directory / "shipped.eds");
  CHECK(eds.find("FileName=shipped.eds\r\n") != std::string::npos);
  CHECK(eds.find("[1021]\r\n") != std::string::npos);
  CHECK(bytes_of(directory / "new/small_od.c")
            .find("static const uint8_t bytes_1021_0[" + std::to_string(eds.size()) + "]") != std::string::npos);
  CHECK(run(directory, small + " -o new --eds shipped.eds --embed-eds plain --check").status == 0);
  CHECK(run(directory, small + " -o new --embed-eds zlib --check").status == 1);
  CHECK(run(directory, small + " -o new --embed-eds gzip").status == 2);
}

TEST_CASE("codict gen: an object of --error-bits that cannot show them is named") {
  const test::Directory directory;
  std::ofstream(directory / "bits.eds") << "[2100]\nParameterName=Bits\nObjectType=7\nDataType=10\nAccessType=ro\n"
                                           "[2101]\nParameterName=Other\nObjectType=7\nDataType=10\nAccessType=rw\n";
  CHECK(run(directory, "bits.eds -o new --force --error-bits 2100").status == 0);
  CHECK(run(directory, "bits.eds -o new --force --error-bits 0x2100:0").status == 0);
  const Ran writable = run(directory, "bits.eds -o new --force --error-bits 2101");
  CHECK(writable.status == 1);
  CHECK(writable.err.find("--error-bits 2101h sub 0: no OCTET_STRING that the network can only read\n") !=
        std::string::npos);
  const Ran malformed = run(directory, "bits.eds -o new --force --error-bits bits");
  CHECK(malformed.status == 2);
  CHECK(malformed.err.find("--error-bits bits: the form is INDEX or INDEX:SUB, hexadecimal\n") != std::string::npos);
}
