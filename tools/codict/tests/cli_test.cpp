// SPDX-License-Identifier: Apache-2.0
// The program codict: standard output, standard error output and exit status.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "directory.hpp"
#include "program.hpp"
#include "reading.hpp"

namespace {

using Json = nlohmann::json;
using test::bytes_of;
using test::copy_to;
using test::Directory;
using test::has;
using test::Ran;
using test::run;

}  // namespace

TEST_CASE("codict: without a command or with an unknown one the usage is printed") {
  CHECK(run("").status == 2);
  CHECK(run("chek octal.eds").status == 2);
  CHECK(run("check").status == 2);
  CHECK(run("check --nonsense octal.eds").status == 2);
  const Ran wrong = run("nonsense");
  CHECK(wrong.out.empty());
  CHECK(wrong.err == "codict: unknown command nonsense; codict --help lists all\n");
  CHECK(run("chek octal.eds").err == "codict: unknown command chek; did you mean check?\n");
  CHECK(has(run("--nonsense").err, "--help"));
  CHECK(has(run("check --nonsense octal.eds").err, "--nonsense"));
}

TEST_CASE("codict: an unknown value of an option is refused with a list of the accepted ones") {
  const Ran wrong = run("check octal.eds --level loud");
  CHECK(wrong.status == 2);
  CHECK(wrong.err == "codict: --level: loud not in {note,warning,error}; codict check --help shows the options\n");
  CHECK(run("check octal.eds --level 2").status == 2);
}

TEST_CASE("codict: the help has no control characters and lists all formats") {
  CHECK(has(run("--help").out, "XPD"));
  for (const char* command : {"check", "completion", "convert", "diff", "doc", "explain", "fmt", "gen", "get", "info",
                              "list", "man", "merge", "new", "pdo", "set", "size"}) {
    CAPTURE(command);
    const Ran ran = run(command + std::string(" --help"));
    CHECK(ran.status == 0);
    CHECK(std::none_of(ran.out.begin(), ran.out.end(), [](char c) { return c >= 0 && c < ' ' && c != '\n'; }));
  }
}

namespace {

// Returns the words that bash offers as completion.
std::string completed(const std::string& words) {
  return test::run_shell("bash -c 'source /dev/stdin; COMP_WORDS=(" + words +
                         "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _codict; echo \"${COMPREPLY[*]}\"' <<END\n$('" +
                         std::string(LEXICAN_CODICT_PROGRAM) + "' completion)\nEND")
      .out;
}

// Runs codict with the library that prints system calls. environment: further variables.
Ran run_with_file_calls(const Directory& directory, const std::string& arguments, const std::string& environment = "") {
  return test::run_shell("cd '" + directory / "" + "' && " + environment +
                         " ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD='" LEXICAN_CODICT_FILE_CALLS
                         "' '" LEXICAN_CODICT_PROGRAM "' " +
                         arguments);
}

}  // namespace

TEST_CASE("codict completion: bash completes commands and their options") {
  CHECK(completed("codict che") == "check\n");
  CHECK(completed("codict check --er") == "--error-format\n");
  CHECK(completed("codict --ver") == "--version\n");
  CHECK(completed("codict check dri") == "\n");  // bash completes files itself
  CHECK(completed("codict pdo --lev") == "\n");
  CHECK(run("completion").err.empty());
}

TEST_CASE("codict: a file is synchronised before it is renamed, and the directory before codict ends") {
  if (test::run_shell("ldd '" LEXICAN_CODICT_PROGRAM "'").status != 0) {
    return;  // LD_PRELOAD has no effect on a static program
  }
  const Directory directory;
  test::copy_to(directory, "drive.eds");
  const Ran written = run_with_file_calls(directory, "convert drive.eds -o copy.eds");
  CHECK(written.status == 0);
  CHECK(written.err == "fsync file\nrename\nfsync directory\n");
  CHECK(test::bytes_of(directory / "copy.eds") == test::bytes_of(directory / "drive.eds"));
}

TEST_CASE("codict: a file whose directory cannot be synchronised is written, with a warning unless unsupported") {
  if (test::run_shell("ldd '" LEXICAN_CODICT_PROGRAM "'").status != 0) {
    return;
  }
  for (const int error : {EIO, EINVAL, ENOTSUP}) {
    CAPTURE(error);
    const Directory directory;
    test::copy_to(directory, "drive.eds");
    const Ran written = run_with_file_calls(directory, "convert drive.eds -o copy.eds",
                                            "DIRECTORY_FSYNC_ERROR=" + std::to_string(error));
    CHECK(written.status == 0);
    CHECK(has(written.err,
              "codict: copy.eds: the file is written, but a power failure now may undo it: its directory "
              "cannot be synchronised (Input/output error)\n") == (error == EIO));
    CHECK(has(written.err, "codict:") == (error == EIO));
    CHECK(test::bytes_of(directory / "copy.eds") == test::bytes_of(directory / "drive.eds"));
  }
}

TEST_CASE("codict completion zsh: the script has all commands, options and words, and zsh accepts it") {
  const Ran script = run("completion zsh");
  CHECK(script.out.substr(0, script.out.find('\n')) == "#compdef codict");
  CHECK(has(script.out, "    'check:Say what is wrong or odd in descriptions'\n"));
  CHECK(has(script.out,
            "'*--level[Lowest severity that is reported\\: note, warning, error]:ENUM:(note warning error)'"));
  CHECK(has(script.out, "'*-o[Directory of NAME_od.h and NAME_od.c or .cpp]:TEXT:_files'"));
  if (test::run_shell("command -v zsh").status == 0) {
    CHECK(test::run_shell("'" LEXICAN_CODICT_PROGRAM "' completion zsh | zsh -n /dev/stdin").status == 0);
  }
}

TEST_CASE("codict completion fish: the script has all commands, options and words, and fish completes with it") {
  const Ran script = run("completion fish");
  CHECK(has(script.out,
            "complete -c codict -n __fish_use_subcommand -f -a check -d 'Say what is wrong or odd in descriptions'\n"));
  CHECK(has(script.out,
            "complete -c codict -n '__fish_seen_subcommand_from check' -l level -x -a 'note warning error' -d "));
  CHECK(run("completion powershell").status == 2);
  if (test::run_shell("command -v fish").status == 0) {
    const Ran completed = test::run_shell("'" LEXICAN_CODICT_PROGRAM
                                          "' completion fish | fish --no-config -c "
                                          "'source -; complete -C \"codict check --error-f\"'");
    CHECK(has(completed.out, "--error-format"));
    CHECK(completed.err.empty());
  }
}

TEST_CASE("codict man: the manual page has all commands and options and no roff warnings") {
  const Ran page = run("man");
  CHECK(page.status == 0);
  for (const char* words :
       {".TH CODICT 1 ", ".SS \"codict get file target [field]\"", "\\fB\\-\\-error\\-format\\fR", ".SH EXIT STATUS"}) {
    CHECK(has(page.out, words));
  }
  if (test::run_shell("command -v groff").status == 0) {
    const Directory directory;
    test::write_bytes(directory / "codict.1", page.out);
    CHECK(test::run_shell("groff -man -ww -z -Tutf8 '" + directory / "codict.1" + "'").err.empty());
    const std::string shown = test::run_shell("groff -man -Tascii -P-cbu '" + directory / "codict.1" + "'").out;
    CHECK(has(shown, "--string-capacity UINT\n"));
    CHECK(has(shown, "--strict-loss\n"));
  }
}

TEST_CASE("codict: help and version are written to standard output with status 0") {
  const Ran help = run("--help");
  CHECK(help.status == 0);
  CHECK(help.err.empty());
  for (const char* word : {"info", "list", "get", "set", "check", "Exit status"}) {
    CHECK(help.out.find(word) != std::string::npos);
  }
  CHECK(run("check --help").out.find("--level") != std::string::npos);
  CHECK(run("--version").out.substr(0, 7) == "codict ");
}

TEST_CASE("codict: a file that cannot be read is reported in one line with status 2") {
  for (const char* command : {"check", "info", "list"}) {
    const Ran missing = run(std::string(command) + " missing.eds");
    CHECK(missing.status == 2);
    CHECK(missing.out.empty());
    CHECK(missing.err == "codict: missing.eds: No such file or directory\n");
  }
  const Ran foreign = run("check .gitattributes");
  CHECK(foreign.status == 2);
  CHECK(foreign.err ==
        "codict: .gitattributes: no section [FileInfo], [DeviceInfo] or of an object: this is no EDS or DCF\n");
}

namespace {

// Disables rules about missing objects, as most fixtures are parts of devices.
Ran check(const std::string& arguments) {
  return run("check --disable od-mandatory --disable od-error-control " + arguments);
}

}  // namespace

TEST_CASE("codict check: a finding has file, line with a caret, rule and remedy") {
  const Ran ran = check("octal.eds");
  CHECK(ran.status == 1);
  CHECK(ran.out == R"(octal.eds:30:14: warning: 2000h 'Ten': '012' is octal, read as 10 [od-value-octal]
    DefaultValue=012
                 ^~~
    fix: write it without the leading 0, or with 0x
octal.eds:37:16: error: 2001h 'No number': '018' begins with 0, but is not an octal number [od-value-octal-digit]
    DefaultValue=018
                   ^
    fix: remove the leading 0, or write 0x
)");
  CHECK(ran.err == "codict: 1 error, 1 warning\n");
}

TEST_CASE("codict check: equal findings are folded unless all are requested") {
  const Ran folded = check("--level note storage_location.eds bit_pattern.eds");
  CHECK(folded.out.find("bit_pattern.eds:32:14: note: ") != std::string::npos);
  CHECK(folded.out.find("    and 2 more\n") != std::string::npos);
  CHECK(folded.err == "codict: 5 notes\n");
  const Ran all = check("--level note --all bit_pattern.eds");
  CHECK(all.out.find("bit_pattern.eds:46:14: note: ") != std::string::npos);
  CHECK(all.out.find("more") == std::string::npos);
}

TEST_CASE("codict check: only findings of the requested level are shown and counted") {
  CHECK(check("bit_pattern.eds").status == 0);
  CHECK(check("bit_pattern.eds").out.empty());
  CHECK(check("bit_pattern.eds").err.empty());
  CHECK(check("--level note bit_pattern.eds").status == 1);
  CHECK(check("--level error list_twice.eds").status == 0);
  CHECK(check("--level error octal.eds").err == "codict: 1 error\n");
  CHECK(check("--level loud octal.eds").status == 2);
}

TEST_CASE("codict check: a rule can be disabled by its name") {
  CHECK(check("--disable od-value-octal --disable od-value-octal-digit octal.eds").status == 0);
  const Ran unknown = check("--disable od-value-hexal octal.eds");
  CHECK(unknown.status == 2);
  CHECK(unknown.err == "codict: unknown rule od-value-hexal; did you mean od-value-octal?\n");
}

TEST_CASE("codict check: the status is that of the worst file") {
  CHECK(check("semicolon.eds dos_lines.eds").status == 0);
  CHECK(check("semicolon.eds octal.eds").status == 1);
  const Ran ran = check("missing.eds octal.eds");
  CHECK(ran.status == 2);
  CHECK(ran.out.find("octal.eds:30:14") != std::string::npos);
}

TEST_CASE("codict check: carets are below characters of any encoding in lines of any length") {
  const Ran dos = check("--level note cp850.eds");
  CHECK(dos.out.find(u8"    ParameterName=Größe für Öl\n                    ^~\n") != std::string::npos);
  const Ran longest = check("--level note long_line.eds");
  const std::size_t line = longest.out.find("\n    x");
  REQUIRE(line != std::string::npos);
  CHECK(longest.out.find('\n', line + 1) - line < 170);
  CHECK(check("control_character.eds").out.find("    ParameterName=Be?ll\n                    ^\n") !=
        std::string::npos);
}

TEST_CASE("codict check: JSON is printed for programs") {
  const Ran ran = check("--json --level note bit_pattern.eds semicolon.eds");
  CHECK(ran.status == 1);
  const Json json = Json::parse(ran.out);
  CHECK(json.at("schema") == "codict-check-1");
  CHECK(json.at("files").size() == 2);
  CHECK(json.at("files").at(1).at("findings").empty());
  const Json& finding = json.at("files").at(0).at("findings").at(0);
  CHECK(finding.at("rule") == "od-value-bit-pattern");
  CHECK(finding.at("severity") == "note");
  CHECK(finding.at("line") == 32);
  CHECK(finding.at("column") == 14);
  CHECK(finding.at("end_column") == 24);
  CHECK(finding.at("count") == 3);
}

TEST_CASE("codict: - reads the standard input") {
  const Ran ran = check("- <octal.eds");
  CHECK(ran.status == 1);
  CHECK(ran.out.substr(0, 14) == "<stdin>:30:14:");
}

TEST_CASE("codict check: a complete device has no findings; missing parts are findings") {
  const Ran whole = run("check --level note drive.eds");
  CHECK(whole.status == 0);
  CHECK(whole.out.empty());
  const Ran part = run("check semicolon.eds");
  CHECK(part.status == 1);
  CHECK(
      part.out.find("semicolon.eds:1:1: error: mandatory object 1018h 'Identity object' is missing [od-mandatory]\n") !=
      std::string::npos);
}

TEST_CASE("codict diff: a device has no differences to itself") {
  const Ran ran = run("diff drive.eds drive.eds");
  CHECK(ran.status == 0);
  CHECK(ran.out.empty());
  CHECK(ran.err.empty());
}

TEST_CASE("codict diff: differences are sorted by kind, with place and both values") {
  const Directory directory;
  const std::string other = copy_to(directory, "drive.eds");
  REQUIRE(run("set --force " + other + " 2000 access=ro name=Velocity").status == 0);
  const Ran ran = run("diff drive.eds " + other);
  CHECK(ran.status == 1);
  CHECK(ran.out ==
        "breaking      2000h     access: rww -> ro\n"
        "text          2000h     name: Wanted speed -> Velocity\n");
  CHECK(ran.err == "codict: 2 differences: 1 breaking, 1 text\n");
  CHECK(run("diff --only text drive.eds " + other).out == "text          2000h     name: Wanted speed -> Velocity\n");
  CHECK(run("diff --only file drive.eds " + other).status == 0);
  CHECK(run("diff --only nonsense drive.eds " + other).status == 2);
  CHECK(run("diff drive.eds missing.eds").status == 2);
}

TEST_CASE("codict diff: a release that breaks networks needs a new major revision number") {
  const Directory directory;
  const std::string other = copy_to(directory, "drive.eds");
  REQUIRE(run("set --force " + other + " 2000 access=ro").status == 0);
  const Ran refused = run("diff --release drive.eds " + other);
  CHECK(refused.status == 1);
  CHECK(refused.err.find("major revision number") != std::string::npos);
  REQUIRE(run("set " + other + " 1018:3 default=0x00020000").status == 0);
  CHECK(run("diff --release drive.eds " + other).status == 0);
}

TEST_CASE("codict diff: JSON contains the lines of both files") {
  const Directory directory;
  const std::string other = copy_to(directory, "drive.eds");
  REQUIRE(run("set --force " + other + " 2000 access=ro").status == 0);
  const Json json = Json::parse(run("diff --json drive.eds " + other).out);
  CHECK(json.at("schema") == "codict-diff-1");
  CHECK(json.at("is_announced") == false);
  const Json& difference = json.at("differences").at(0);
  CHECK(difference.at("kind") == "breaking");
  CHECK(difference.at("index") == 0x2000);
  CHECK(difference.at("before").at("text") == "rww");
  CHECK(difference.at("before").at("line") == difference.at("after").at("line"));
}

TEST_CASE("codict doc: the format is selected by the suffix of the output") {
  const Directory directory;
  CHECK(run("doc drive.eds -o " + directory / "drive.md").status == 0);
  CHECK(bytes_of(directory / "drive.md").find("# Drive 7") == 0);
  CHECK(run("doc drive.eds -o " + directory / "drive.html").status == 0);
  CHECK(bytes_of(directory / "drive.html").find("<!DOCTYPE html>") == 0);
  CHECK(run("doc drive.eds --to md --node-id 127 -o -").out.find("COB-IDs of node 127") != std::string::npos);
  CHECK(run("doc drive.eds -o -").status == 2);
  CHECK(run("doc drive.eds -o " + directory / "drive.pdf").status == 2);
  CHECK(run("doc drive.eds --to md --node-id 128 -o -").status == 2);
  CHECK(run("doc missing.eds --to md -o -").status == 2);
}

TEST_CASE("codict convert: the same format gives the same bytes") {
  CHECK(run("convert dos_lines.eds --to eds -o -").out == bytes_of(test::fixture("dos_lines.eds")));
  CHECK(run("convert cp850.eds --to eds -o -").out == bytes_of(test::fixture("cp850.eds")));
  CHECK(run("convert commissioning.dcf --to dcf -o -").out == bytes_of(test::fixture("commissioning.dcf")));
}

TEST_CASE("codict convert: an EDS converted to a DCF describes the same device") {
  const Directory directory;
  CHECK(run("convert drive.eds -o " + directory / "drive.dcf").status == 0);
  CHECK(bytes_of(directory / "drive.dcf").find("[DeviceComissioning]\r\n") != std::string::npos);
  CHECK(run("diff drive.eds " + directory / "drive.dcf").out ==
        "file                    file name: drive.eds -> drive.dcf\n");
  CHECK(run("convert drive.eds -o -").status == 2);
  CHECK(run("convert drive.eds -o " + directory / "drive.txt").status == 2);
  CHECK(run("convert missing.eds --to dcf -o -").status == 2);
}

TEST_CASE("codict convert: an EDS converted to an XDD and back describes the same device") {
  const Directory directory;
  for (const char* const name : {"drive.xdd", "drive.xdc"}) {
    CHECK(run("convert drive.eds -o " + directory / name).status == 0);
    CHECK(run("convert " + directory / name + " -o " + directory / "drive.eds").status == 0);
    const Ran ran = run("diff drive.eds " + directory / "drive.eds");
    CHECK(ran.status == 0);
    CHECK(ran.out.empty());
  }
  CHECK(run("convert drive.eds --to xdd10 -o -").out.find("http://www.canopen.org/xml/1.0") != std::string::npos);
  CHECK(run("convert drive.eds --to xdd -o -").out.find("http://www.canopen.org/xml/1.1") != std::string::npos);
}

TEST_CASE("codict convert: values that the other format cannot express are reported or prevent the output") {
  const Directory directory;
  const Ran told = run("convert xdd/device10.xdd -o " + directory / "valve.eds");
  CHECK(told.status == 0);
  CHECK(told.err ==
        "codict: xdd/device10.xdd: not in the output: 1 configured values (2000h), 2 denotations (2000h, 2003h), 1 "
        "commissioning, 2 labels (2000h de, 2002h:1 en), 1 descriptions (1000h en), 2 units (2000h, 2002h:2), 1 bit "
        "rates (auto-baudRate), 1 default bit rates, 2 features (selfStartingDevice, flyingMaster), 4 texts of the "
        "identity "
        "(vendorText, deviceFamily, productFamily, …), 2 numbers of dynamic channels, 2 allowed values (2000h 0, 2000h "
        "1), 1 steps (2000h), 1 substitute values (2000h), 5 properties (2000h Own, 2000h CO_disabled, 2000h "
        "CO_countLabel, …), 1 groups (G_1), 4 data types (Errors, Identity, Modes, …), 2 templates (TPL_RO, TPL_01), 1 "
        "parameters without an object (P_NOBODY), 1 order codes (V1-B), 2 versions (1.2, B), 1 comments\n");
  const Ran all = run("convert --all xdd/device10.xdd -o " + directory / "valve.eds");
  CHECK(has(all.err,
            "5 properties (2000h Own, 2000h CO_disabled, 2000h CO_countLabel, 2000h CO_accessSRDO, 2001h "
            "CO_stringLengthMin)"));
  CHECK(std::filesystem::exists(directory / "valve.eds"));
  CHECK(run("convert --strict-loss xdd/device10.xdd -o " + directory / "strict.eds").status == 1);
  CHECK_FALSE(std::filesystem::exists(directory / "strict.eds"));
  // Empty attributes and elements are no losses.
  const Ran rate = run("convert --strict-loss xdd/empty_values.xdd -o " + directory / "strict.eds");
  CHECK(rate.status == 0);
  CHECK(rate.err == "codict: xdd/empty_values.xdd: not in the output: 1 default bit rates\n");
  CHECK(std::filesystem::exists(directory / "strict.eds"));
  CHECK(run("convert xdd/device10.xdd --to xdc -o -").out == bytes_of(test::fixture("xdd/device10.xdd")));
}

TEST_CASE("codict convert: the output has its own file name; lost comments of XML are reported") {
  const Directory directory;
  const Ran ran = run("convert xdd/enumeration.xdd -o " + directory / "other.eds");
  CHECK(has(ran.err, "1 comments"));
  CHECK(run("get " + directory / "other.eds" + " FileInfo FileName").out == "other.eds\n");
  CHECK(run("convert " + directory / "other.eds" + " -o " + directory / "third.xdd").status == 0);
  CHECK(has(bytes_of(directory / "third.xdd"), "fileName=\"third.xdd\""));
  CHECK(has(run("convert xdd/enumeration.xdd --to eds -o -").out, "FileName=enumeration.xdd\r\n"));
}

TEST_CASE("codict convert: an EDS without granularity has none after a conversion to XDD and back") {
  const Directory directory;
  CHECK(run("convert semicolon.eds -o " + directory / "device.xdd").status == 0);
  CHECK(run("convert " + directory / "device.xdd" + " -o " + directory / "device.eds").status == 0);
  CHECK_FALSE(has(bytes_of(directory / "device.eds"), "Granularity"));
}

TEST_CASE("codict: an XDD is shown and changed like an EDS") {
  CHECK(run("info xdd/device10.xdd").out.find("Format           XDC 1.0\n") != std::string::npos);
  CHECK(run("get xdd/device10.xdd 2000 access").out == "readWriteOutput\n");
  CHECK(run("get xdd/device10.xdd 2000").out.find("name=Mode\n") == 0);
  CHECK(run("get xdd/device10.xdd 2009").status == 2);
  CHECK(run("get xdd/device10.xdd 2000 flags").status == 2);
  const Directory directory;
  const std::string other = directory / "valve.xdd";
  std::filesystem::copy_file(test::fixture("xdd/device10.xdd"), other);
  CHECK(run("set " + other + " 2000 default=1").status == 0);
  std::string wanted = bytes_of(test::fixture("xdd/device10.xdd"));
  wanted.replace(wanted.find("<defaultValue value=\"0\" offset"), 23, "<defaultValue value=\"1\"");
  CHECK(bytes_of(other) == wanted);
  CHECK(run("set " + other + " 2000 default=2").status == 1);
  CHECK(run("set " + other + " 2000 colour=1").status == 2);
  CHECK(bytes_of(other) == wanted);
  const std::string found = run("check xdd/device10.xdd").out;
  CHECK(found.find("xdd/device10.xdd:138:11: error: 1800h") != std::string::npos);
  CHECK(found.find("TPDO 1 has no mapping parameter [pdo-pair]\n") != std::string::npos);
  CHECK(run("doc xdd/device10.xdd --to md -o -").out.find("## <a id=\"g-1\"></a>Working\n") != std::string::npos);
}

TEST_CASE("codict: XML that is not a device description is refused with one message") {
  const Directory directory;
  std::ofstream(directory / "other.xml") << "<?xml version=\"1.0\"?>\n<html/>\n";
  const Ran ran = run("check " + directory / "other.xml");
  CHECK(ran.status == 2);
  CHECK(ran.out.empty());
  CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
}

TEST_CASE("codict info: prints the identity and features of the device") {
  const Ran ran = run("info file_info.eds");
  CHECK(ran.status == 0);
  CHECK(ran.out == R"(File             file_info.eds
Format           EDS
Encoding         ASCII
Vendor           Example
Vendor number    0x0000001F
Product          Drive
Product number   17
Revision number  0x00010002
Order code       ABC-1
Description      What it is
Bit rates        125 100 1000
Objects          2
Variables        3
Receive PDOs     0
Transmit PDOs    0
SDO servers      0
SDO clients      0
)");
  const Json json = Json::parse(run("info --json compact.dcf").out);
  CHECK(json.at("schema") == "codict-info-1");
  CHECK(json.at("node_id") == "5");
  CHECK(json.at("variables") == 270);
}

TEST_CASE("codict list: prints all objects with their types and values") {
  const Ran ran = run("list sub_zero.eds");
  CHECK(ran.status == 0);
  CHECK(ran.out.substr(0, ran.out.find("2001")) == R"(1000     UNSIGNED32      ro         0x00000000         Device type
2000     RECORD                                        No default
2000:00  UNSIGNED8       ro         -                  Part 0
2000:01  UNSIGNED8       ro         0                  Part 1
2000:07  UNSIGNED8       ro         0                  Part 7
)");
  CHECK(run("list --objects sub_zero.eds").out.find(':') == std::string::npos);
  const Json json = Json::parse(run("list --json compact.dcf").out);
  CHECK(json.at("objects").at(0).at("value") == "0x00000191");
  CHECK(json.at("objects").at(3).at("index") == 0x2000);
  CHECK(json.at("objects").at(3).at("sub_index") == 1);
  CHECK(json.at("objects").at(3).at("pdo_mapping") == "optional");
  CHECK(json.at("objects").at(4).at("name") == "Second gain");
}

TEST_CASE("codict get: prints one value as it is written, or all of an object or section") {
  CHECK(run("get octal.eds 0x2000 default").out == "012\n");
  CHECK(run("get octal.eds 2000:0 DefaultValue").out == "012\n");
  CHECK(run("get sub_zero.eds 2000sub7 name").out == "Part 7\n");
  CHECK(run("get sub_zero.eds 0x2000:0x07 name").out == "Part 7\n");
  CHECK(run("get octal.eds fileinfo EDSVersion").out == "4.0\n");
  CHECK(run("get octal.eds 0x2001").out ==
        "ParameterName=No number\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nDefaultValue=018\n");
  const Json json = Json::parse(run("get --json octal.eds 0x2000 default").out);
  CHECK(json.at("keys").at(0).at("text") == "012");
  CHECK(json.at("keys").at(0).at("line") == 30);
}

namespace {

// Runs codict with a terminal as standard output.
Ran run_at_terminal(const std::string& arguments) {
  return test::run_shell("script -qec \"'" LEXICAN_CODICT_PROGRAM "' " + arguments + "\" /dev/null </dev/null");
}

bool has_escape(const Ran& ran) { return (ran.out + ran.err).find_first_of("\x1B\x07\x9B") != std::string::npos; }

}  // namespace

TEST_CASE("codict: control characters are printed as question marks, except in a value that get writes to a file") {
  const Directory directory;
  const std::string path = directory / "hostile.eds";
  const std::string other = copy_to(directory, "drive.eds");
  std::string text = bytes_of(other);
  text.replace(text.find("ParameterName=Wanted speed"), 26,
               "ParameterName=a\x1B[2Jb\xC2\x9B"
               "1mc\x07");
  text.replace(text.find("VendorName="), 11, "VendorName=a\x1B[2J");
  test::write_bytes(path, text);
  for (const std::string& command : {"list " + path, "info " + path, "pdo " + path, "diff " + other + " " + path,
                                     "get " + path + " Own\x1B", "check --level note " + path}) {
    CAPTURE(command);
    CHECK_FALSE(has_escape(run(command)));
  }
  CHECK(has(run("list " + path).out, " a?[2Jb?1mc?\n"));
  CHECK(run("get " + path + " 2000 name").out ==
        "a\x1B[2Jb\xC2\x9B"
        "1mc\x07\n");
  CHECK(run_at_terminal("get " + path + " 2000 name").out == "a?[2Jb?1mc?\r\n");
  CHECK(has(run_at_terminal("get " + path + " 2000").out, "ParameterName=a?[2Jb?1mc?\r\n"));
}

TEST_CASE("codict get: a missing object or key is reported") {
  CHECK(run("get octal.eds 0x2005").err == "codict: octal.eds: object 2005 does not exist\n");
  CHECK(run("get octal.eds Weather").err == "codict: octal.eds: neither an object nor a section: Weather\n");
  CHECK(run("get octal.eds 0x2000 high").err == "codict: octal.eds: [2000] has no HighLimit\n");
  CHECK(run("get compact.dcf 0x2000:5 name").err ==
        "codict: compact.dcf: 2000:05 has no section: it is in compact storage\n");
  CHECK(run("get octal.eds 0x2000 high").status == 2);
}

TEST_CASE("codict set: one line changes and all other bytes stay") {
  const Directory directory;
  const std::string path = copy_to(directory, "dos_lines.eds");
  std::string expected = bytes_of(path);
  CHECK(run("set '" + path + "' 0x2000 default=5").status == 0);
  expected.replace(expected.find("DefaultValue=1\r"), 15, "DefaultValue=5\r");
  CHECK(bytes_of(path) == expected);
  CHECK(run("set '" + path + "' 0x2000 high=9 'name=New name'").status == 0);
  expected.replace(expected.find("DefaultValue=5\r\n"), 16, "DefaultValue=5\r\nHighLimit=9\r\n");
  expected.replace(expected.find("ParameterName=One"), 17, "ParameterName=New name");
  CHECK(bytes_of(path) == expected);
}

TEST_CASE("codict set: the output may be another file or the standard output") {
  const Directory directory;
  CHECK(run("set octal.eds 2000 default=3 -o '" + directory / "new.eds" + "'").status == 0);
  CHECK(bytes_of(directory / "new.eds").find("DefaultValue=3\n") != std::string::npos);
  CHECK(run("set - 2000 default=3 -o - <octal.eds").out == bytes_of(directory / "new.eds"));
  CHECK(run("get octal.eds 2000 default").out == "012\n");
}

TEST_CASE("codict set: a value with errors is not written without --force") {
  const Directory directory;
  const std::string path = copy_to(directory, "dos_lines.eds");
  const std::string before = bytes_of(path);
  const Ran ran = run("set '" + path + "' 0x2000 default=256");
  CHECK(ran.status == 1);
  CHECK(ran.out.empty());
  CHECK(ran.err == path + ":29:14: error: 2000h 'One': '256' does not fit UNSIGNED8 (0 to 255) [od-value-range]\n" +
                       "    DefaultValue=256\n                 ^~~\n" +
                       "    fix: correct the value, or use a larger data type\n" +
                       "codict: new errors, no file was written; --force writes it nevertheless\n");
  CHECK(bytes_of(path) == before);
  const Ran pattern = run("set '" + path + "' 0x2000 type=0x0002 default=255");
  CHECK(pattern.status == 1);
  CHECK(has(pattern.err, "'255' does not fit INTEGER8 (-128 to 127)"));
  CHECK(bytes_of(path) == before);
  CHECK(run("set --force '" + path + "' 0x2000 default=256").status == 0);
  CHECK(bytes_of(path) != before);
}

TEST_CASE("codict set: errors that were present before do not prevent the change") {
  const Directory directory;
  const std::string path = copy_to(directory, "octal.eds");
  CHECK(run("set '" + path + "' 0x2000 default=1").status == 0);
  CHECK(run("set '" + path + "' FileInfo ModifiedBy=me").status == 0);
  CHECK(run("get '" + path + "' FileInfo ModifiedBy").out == "me\n");
}

TEST_CASE("codict set: wrong usage is reported and nothing is written") {
  CHECK(run("set octal.eds 0x2000").status == 2);
  CHECK(run("set octal.eds 0x2000 default").err == "codict: octal.eds: not of the form field=value: default\n");
  CHECK(run("set octal.eds 0x2009 default=1").status == 2);
  CHECK(run("set cp850.eds 0x2000 'name=→' -o -").err == "codict: cp850.eds: the file cannot hold this text: name=→\n");
  CHECK(run("set octal.eds 0x2000 default=1 -o no/such/place").err ==
        "codict: no/such/place: No such file or directory\n");
}
