// SPDX-License-Identifier: Apache-2.0
// codict check with output for programs, suppressed rules and a baseline; codict explain.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "directory.hpp"
#include "program.hpp"
#include "reading.hpp"

namespace {

using Json = nlohmann::json;
using test::Directory;
using test::Ran;

// Disables rules about missing objects and sections, as the fixtures are parts of devices.
const std::string quiet = " --disable od-mandatory --disable od-error-control --disable eds-section-missing ";

Ran check(const std::string& arguments) { return test::run_codict(test::fixture(""), "check" + quiet + arguments); }

// Runs codict check at level note on a file with this text.
Ran check_text(const char* name, const std::string& text, const std::string& options = "") {
  const Directory directory;
  test::write_bytes(directory / name, text);
  return test::run_codict(directory / "", "check --level note" + quiet + options + " '" + name + "'");
}

std::string variable(const char* index, const char* lines) {
  return std::string("[") + index + "]\nParameterName=x\nObjectType=7\nDataType=5\nAccessType=rw\n" + lines + "\n";
}

const std::string unlisted = " --disable eds-list-unlisted ";

}  // namespace

TEST_CASE("codict check --error-format github: workflow commands are printed with escaped special characters") {
  CHECK(check("--error-format github octal.eds").out ==
        "::warning file=octal.eds,line=30,col=14,title=od-value-octal::2000h 'Ten': '012' is octal, read as 10"
        "%0Afix: write it without the leading 0, or with 0x\n"
        "::error file=octal.eds,line=37,col=16,title=od-value-octal-digit::2001h 'No number': '018' begins with 0, "
        "but is not an octal number%0Afix: remove the leading 0, or write 0x\n");
  const Ran odd = check_text("a,b%:c.eds", variable("2000", "Own=1\nOther=2"), unlisted + "--error-format github");
  CHECK(odd.out ==
        "::notice file=a%2Cb%25%3Ac.eds,line=6,col=1,title=eds-key-unknown::2000h 'x': key 'Own' is unknown to CiA 306"
        "%0Afix: check the spelling%0Aand 1 more\n");
}

TEST_CASE("codict check --error-format sarif: one run over all files has the rules with findings") {
  const Ran ran = check("--level note --error-format sarif octal.eds bit_pattern.eds");
  CHECK(ran.status == 1);
  CHECK(ran.err.empty());
  const Json sarif = Json::parse(ran.out);
  CHECK(sarif.at("version") == "2.1.0");
  REQUIRE(sarif.at("runs").size() == 1);
  const Json& run = sarif.at("runs").at(0);
  const Json& rules = run.at("tool").at("driver").at("rules");
  CHECK(run.at("invocations").at(0).at("executionSuccessful") == true);
  CHECK(rules.size() == 3);
  const Json& results = run.at("results");
  CHECK(results.size() == 5);  // equal findings are not folded
  const Json& first = results.at(0);
  CHECK(first.at("ruleId") == "od-value-octal");
  CHECK(rules.at(first.at("ruleIndex").get<std::size_t>()).at("id") == "od-value-octal");
  CHECK(first.at("level") == "warning");
  const Json& location = first.at("locations").at(0).at("physicalLocation");
  CHECK(location.at("artifactLocation").at("uri") == "octal.eds");
  CHECK(location.at("region") == Json{{"startLine", 30}, {"startColumn", 14}, {"endLine", 30}, {"endColumn", 17}});
  for (const Json& rule : rules) {
    CHECK(rule.at("help").at("text").get<std::string>().find(rule.at("id").get<std::string>()) != std::string::npos);
    CHECK_FALSE(rule.at("shortDescription").at("text").get<std::string>().empty());
    const std::string link = "tools/codict/docs/rules.md#" + rule.at("id").get<std::string>();
    CHECK(rule.at("help").at("text").get<std::string>().find(link) != std::string::npos);
    CHECK(rule.at("help").at("markdown").get<std::string>().find("\nRemedy: ") != std::string::npos);
  }
}

TEST_CASE("codict check --error-format sarif: columns are characters, paths are URIs, unreadable files are reported") {
  const Ran ran = check_text("\xC3\xA4 b.eds", "[FileInfo]\n\xC3\xA4\xC3\xB6=1\n", "--error-format sarif");
  REQUIRE_FALSE(ran.out.empty());
  const Json run = Json::parse(ran.out).at("runs").at(0);
  const Json location = run.at("results").back().at("locations").at(0).at("physicalLocation");
  CHECK(location.at("artifactLocation").at("uri") == "%C3%A4%20b.eds");
  CHECK(location.at("region").at("endColumn") == 3);
  const Ran missing = check("--error-format sarif missing.eds");
  CHECK(missing.status == 2);
  CHECK(Json::parse(missing.out).at("runs").at(0).at("invocations").at(0).at("executionSuccessful") == false);
}

TEST_CASE("codict check: --json is another output format") {
  CHECK(check("--error-format json octal.eds").out == check("--json octal.eds").out);
  CHECK(check("--error-format gcc octal.eds").out == check("octal.eds").out);
  CHECK(check("--json --error-format gcc octal.eds").status == 2);
  CHECK(check("--error-format xml octal.eds").status == 2);
}

TEST_CASE("codict check --werror: warnings are errors") {
  const Ran ran = check("--level error --werror octal.eds");
  CHECK(ran.out.find("octal.eds:30:14: error: 2000h 'Ten': '012' is octal, read as 10 [od-value-octal]") !=
        std::string::npos);
  CHECK(ran.err == "codict: 2 errors\n");
  CHECK(check("--level error --werror bit_pattern.eds").status == 0);  // notes do not become errors
}

TEST_CASE("codict check --disable: every rule is accepted; for an unknown one similar rules are suggested") {
  CHECK(check("--disable gen-limits --disable suppression-unused bit_pattern.eds").status == 0);
  const Ran wrong = check("--disable od-value-octl octal.eds");
  CHECK(wrong.status == 2);
  CHECK(wrong.err == "codict: unknown rule od-value-octl; did you mean od-value-octal?\n");
  CHECK(check("--disable weather octal.eds").err == "codict: unknown rule weather; codict explain lists all\n");
}

TEST_CASE("codict check --profile: a device profile is checked on request") {
  const std::string text =
      "[1000]\nParameterName=x\nObjectType=7\nDataType=7\nAccessType=ro\nDefaultValue=0x192\n" + variable("6040", "");
  const auto profile_findings = [&text](const char* options) {
    return test::has(check_text("a.eds", text, unlisted + options).out, "[profile-");
  };
  CHECK_FALSE(profile_findings(""));
  CHECK(profile_findings("--profile auto"));
  CHECK(profile_findings("--profile 402"));
  CHECK_FALSE(profile_findings("--profile 401"));
  CHECK(check_text("a.eds", text, unlisted + "--profile 403").status == 2);
  const std::string suppressed = "; codict: ignore profile-type profile-object-missing\n" + text;
  for (const char* options : {"", "--profile auto"}) {
    const Ran ran = check_text("a.eds", suppressed, unlisted + options);
    CHECK_FALSE(test::has(ran.out, "[profile-"));
    CHECK_FALSE(test::has(ran.out, "suppression-unused"));
  }
}

TEST_CASE("codict check: a comment suppresses rules in the key below it") {
  const std::string octal = "DefaultValue=012";
  const auto found = [](const std::string& lines) {
    return check_text("a.eds", variable("2000", lines.c_str()), unlisted).out;
  };
  CHECK(found(octal).find("[od-value-octal]") != std::string::npos);
  CHECK(found("; codict: ignore od-value-octal\n" + octal) == "");
  CHECK(found(";codict: ignore od-limit-order, od-value-octal -- as the drawing has it\n\n" + octal + "\nLowLimit=9\n" +
              "HighLimit=1") ==
        "a.eds:6:17: note: 2000h 'x': comment suppresses nothing [suppression-unused]\n"
        "    ;codict: ignore od-limit-order, od-value-octal -- as the drawing has it\n"
        "                    ^~~~~~~~~~~~~~\n    fix: remove it\n"
        "a.eds:9:10: warning: 2000h 'x': LowLimit 9 is above HighLimit 1 [od-limit-order]\n    LowLimit=9\n            "
        " ^\n"
        "    fix: exchange or correct the limits\n");
  CHECK(found("; codict: ignore od-value-octal\nLowLimit=010\n" + octal).find("a.eds:8:14: ") == 0);
  CHECK(found("; codict: ignores od-value-octal\n" + octal).find("[od-value-octal]") != std::string::npos);
  CHECK(found("; codict: ignore od-value-octal --\n" + octal) == "");
}

TEST_CASE("codict check: a comment suppresses rules in the section below it, or in the whole file") {
  const std::string bad = "DefaultValue=012\nHighLimit=0100";
  const std::string ignore = "; codict: ignore od-value-octal\n";
  const auto lines_found = [](const std::string& text) {
    const std::string out = check_text("a.eds", text, unlisted + "--all").out;
    return std::count(out.begin(), out.end(), '[');
  };
  const std::string one = variable("2000", bad.c_str());
  const std::string two = variable("2001", bad.c_str());
  CHECK(lines_found(one + two) == 4);
  CHECK(lines_found(one + ignore + two) == 2);
  CHECK(lines_found(ignore + "\n" + one + two) == 0);
  CHECK(lines_found("; A device\n" + ignore + one + two) == 0);
}

TEST_CASE("codict check: a comment suppresses rules in the element behind it, or in the whole document") {
  const auto document = [](const char* first, const char* second) {
    return std::string("<?xml version=\"1.0\"?>\n") + first +
           "<ISO15745ProfileContainer xmlns=\"http://www.canopen.org/xml/1.1\"><ISO15745Profile><ProfileBody>"
           "<ApplicationLayers><CANopenObjectList>\n<!-- <![CDATA[ -->" +
           second +
           "<CANopenObject index=\"2000\" name=\"x\" objectType=\"8\" subNumber=\"2\">"
           "<CANopenSubObject subIndex=\"00\" name=\"n\" dataType=\"05\" accessType=\"RO\" defaultValue=\"1\"/>"
           "<CANopenSubObject subIndex=\"01\" name=\"n\" dataType=\"05\" accessType=\"RO\"/></CANopenObject>\n"
           "<CANopenObject index=\"2001\" name=\"x\" objectType=\"7\" dataType=\"05\" accessType=\"RO\"/>\n"
           "</CANopenObjectList></ApplicationLayers></ProfileBody></ISO15745Profile></ISO15745ProfileContainer>";
  };
  const auto count = [&document](const char* first, const char* second) {
    const Ran ran = check_text("a.xdd", document(first, second), "--all --disable xdd-object-type-missing");
    const std::string word = "[xdd-access-case]";
    std::size_t number = 0;
    for (std::size_t at = ran.out.find(word); at != std::string::npos; at = ran.out.find(word, at + 1)) {
      ++number;
    }
    return number;
  };
  CHECK(count("", "") == 3);
  CHECK(count("", "<!-- codict: ignore xdd-access-case --><!-- more --><?pi?>\n") == 1);
  CHECK(count("", "<![CDATA[<!-- codict: ignore xdd-access-case -->]]>") == 3);
  CHECK(count("<!-- codict: ignore\n xdd-access-case\n-->\n", "") == 0);
}

TEST_CASE("codict check: each of many comments has its effect; those without an effect are reported") {
  std::string text = "; codict: ignore eds-key-unknown\n[FileInfo]\n";
  for (int n = 0; n < 12000; ++n) {
    text += "; codict: ignore eds-key-length\nOwn" + std::to_string(n) + "=1\n";
  }
  text += "; codict: ignore eds-file-version\nEDSVersion=x\n";
  const Ran ran = check_text("a.eds", text);
  CHECK(test::has(ran.out, "    and 11999 more\n"));
  CHECK_FALSE(test::has(ran.out, "eds-key-unknown]"));
  CHECK_FALSE(test::has(ran.out, "eds-file-version]"));
}

TEST_CASE("codict check: a comment for the whole file and one for a section both have an effect") {
  const Ran ran = check_text("a.eds", "; codict: ignore eds-key-unknown\n" +
                                          variable("2000", "; codict: ignore eds-key-unknown\nOwn=1\nOther=2"));
  CHECK_FALSE(test::has(ran.out, "eds-key-unknown]"));
  CHECK_FALSE(test::has(ran.out, "suppression-unused"));
}

TEST_CASE("codict check: a suppression without an effect or of an unknown rule is a finding") {
  const std::string text =
      "[FileInfo]\n; codict: ignore od-limitt\n" + variable("2000", "") + "; codict: ignore od-limit gen-limits\n";
  CHECK(check_text("a.eds", text, unlisted).out ==
        "a.eds:2:18: warning: rule 'od-limitt' does not exist [suppression-unknown]\n    ; codict: ignore od-limitt\n"
        "                     ^~~~~~~~~\n    fix: did you mean od-limit?\n"
        "a.eds:9:18: note: 2000h 'x': comment at the end of the file suppresses nothing [suppression-unused]\n"
        "    ; codict: ignore od-limit gen-limits\n                     ^~~~~~~~\n    fix: remove it\n");
  const Ran last = check_text("a.xdd",
                              "<ISO15745ProfileContainer xmlns=\"http://www.canopen.org/xml/1.1\">"
                              "<ISO15745Profile/><!-- codict: ignore od-limit --></ISO15745ProfileContainer>");
  CHECK(last.out.find("comment at the end of the file suppresses nothing") != std::string::npos);
  CHECK(check_text("a.xdd", "<ISO15745ProfileContainer><!-- codict: ignore od-limit").status == 1);
}

TEST_CASE("codict check: very many comments for one place have the effect of one") {
  std::string comments;
  for (int n = 0; n < 60000; ++n) {
    comments += n % 3 == 0 ? "; codict: ignore eds-key-unknown x\n" : "; codict: ignore eds-key-unknown\n";
  }
  const Ran eds = check_text("a.eds", variable("2000", (comments + "Own=1").c_str()), unlisted);
  CHECK_FALSE(test::has(eds.out, "eds-key-unknown]"));
  CHECK_FALSE(test::has(eds.out, "suppression-unused"));
  CHECK(test::has(eds.out, " does not exist [suppression-unknown]"));
  std::string elements;
  for (int n = 0; n < 60000; ++n) {
    elements += "<!-- codict: ignore xdd-unknown -->";
  }
  const Ran xml = check_text("a.xdd", "<ISO15745ProfileContainer xmlns=\"http://www.canopen.org/xml/1.1\">" + elements +
                                          "<own/></ISO15745ProfileContainer>");
  CHECK_FALSE(test::has(xml.out, "[xdd-unknown]"));
  CHECK_FALSE(test::has(xml.out, "suppression-unused"));
}

TEST_CASE("codict gen: comments suppress its warnings and never its errors") {
  const Directory directory;
  const auto told = [&directory](const char* comment, const char* lines) {
    test::write_bytes(directory / "a.eds", "; codict: ignore od-mandatory\n[FileInfo]\n" +
                                               variable("2000", (std::string(comment) + lines).c_str()));
    return test::run_codict(directory / "", "gen --notes a.eds -o out").err;
  };
  const char* const outside = "DefaultValue=1\nLowLimit=2\n";
  CHECK(told("", outside).find("[gen-limits-default]") != std::string::npos);
  CHECK(told("; codict: ignore gen-limits-default od-limit odd\n", outside) == "");
  CHECK(told("; codict: ignore gen-limits\n", outside).find("[suppression-unused]") != std::string::npos);
  CHECK(told("; codict: ignore gen-value\n", "DefaultValue=300").find("[gen-value]") != std::string::npos);
}

TEST_CASE("codict check --baseline: known findings are not reported, also at another line") {
  const Directory directory;
  const auto run = [&directory](const std::string& arguments) {
    return test::run_codict(directory / "", "check" + quiet + unlisted + arguments);
  };
  const std::string known = variable("2000", "DefaultValue=012") + variable("2001", "DefaultValue=012");
  test::write_bytes(directory / "a.eds", known);
  test::write_bytes(directory / "b.eds", known);
  const Ran written = run("--write-baseline base.json a.eds");
  CHECK(written.status == 0);
  CHECK(written.out.empty());
  CHECK(run("--baseline base.json a.eds").status == 0);
  CHECK(run("--baseline base.json b.eds").status == 1);  // baselines are per file
  const std::string fresh = "DefaultValue= 012\nLowLimit=010";
  test::write_bytes(directory / "a.eds", "; moved\n\n" + variable("2001", fresh.c_str()));
  const Ran moved = run("--all --baseline base.json a.eds");
  CHECK(moved.status == 1);
  CHECK(moved.out.find("a.eds:9:10: warning: ") != std::string::npos);
  CHECK(moved.err == "codict: a.eds: findings of the baseline that no longer occur: 2\ncodict: 2 warnings\n");
  CHECK(run("--baseline base.json --disable od-value-octal a.eds").err.empty());
}

TEST_CASE("codict check --baseline: equal findings are counted; XML findings are compared by element") {
  const Directory directory;
  const auto run = [&directory](const std::string& arguments) {
    return test::run_codict(directory / "", "check --level note" + quiet + arguments);
  };
  const auto document = [&directory](const std::string& objects) {
    test::write_bytes(directory / "a.xdd",
                      "<ISO15745ProfileContainer xmlns=\"http://www.canopen.org/xml/1.1\"><ISO15745Profile>"
                      "<ProfileBody><ApplicationLayers><CANopenObjectList>" +
                          objects +
                          "</CANopenObjectList></ApplicationLayers></ProfileBody></ISO15745Profile>"
                          "</ISO15745ProfileContainer>");
  };
  const std::string one =
      "<CANopenObject index=\"2000\" name=\"x\" objectType=\"7\" dataType=\"05\" accessType=\"RO\"/>";
  const std::string two =
      "<CANopenObject index=\"2001\" name=\"x\" objectType=\"7\" dataType=\"05\" accessType=\"RO\"/>";
  document(one);
  CHECK(run("--write-baseline base.json a.xdd").status == 0);
  document("\n" + one);
  CHECK(run("--baseline base.json a.xdd").status == 0);
  document(one + two);
  CHECK(run("--baseline base.json a.xdd").status == 1);
  document(two);
  CHECK(run("--baseline base.json a.xdd").status == 1);
  const auto with_sub = [](const std::string& index) {
    return "<CANopenObject index=\"" + index + "\" name=\"x\" objectType=\"9\" subNumber=\"1\"><CANopenSubObject " +
           "subIndex=\"00\" name=\"n\" objectType=\"7\" dataType=\"05\" accessType=\"RO\" defaultValue=\"0\"/>" +
           "</CANopenObject>";
  };
  document(with_sub("2000"));
  CHECK(run("--write-baseline base.json a.xdd").status == 0);
  document(with_sub("2000") + with_sub("2001"));
  const Ran twice = run("--baseline base.json a.xdd");
  CHECK(twice.status == 1);
  CHECK(twice.err == "codict: 1 note\n");
}

TEST_CASE("codict check --baseline: a file that is not a baseline is refused") {
  const Directory directory;
  test::write_bytes(directory / "a.eds", variable("2000", ""));
  const auto refused = [&directory](const std::string& text) {
    test::write_bytes(directory / "base.json", text);
    return test::run_codict(directory / "", "check --baseline base.json a.eds");
  };
  for (const char* const text :
       {"", "text", "[]", "{}", R"({"schema": "codict-check-1", "files": {}})", R"({"schema": "codict-baseline-1"})",
        R"({"schema": "codict-baseline-1", "files": []})", R"({"schema": "codict-baseline-1", "files": {"a": {}}})",
        R"({"schema": "codict-baseline-1", "files": {"a": [1]}})",
        R"({"schema": "codict-baseline-1", "files": {"a": [{"rule": "x", "count": -1}]}})",
        R"({"schema": "codict-baseline-1", "files": {"a": [{"rule": 5, "count": 1}]}})"}) {
    CAPTURE(text);
    const Ran ran = refused(text);
    CHECK(ran.status == 2);
    CHECK(ran.err == "codict: base.json: no baseline of codict check\n");
  }
  CHECK(refused(R"({"schema": "codict-baseline-1", "files": {}})").status == 1);
  CHECK(test::run_codict(directory / "", "check --baseline missing.json a.eds").err ==
        "codict: missing.json: No such file or directory\n");
  CHECK(test::run_codict(directory / "", "check --baseline base.json --write-baseline new.json a.eds").status == 2);
}

TEST_CASE("codict explain: prints one rule or all rules") {
  const auto explain = [](const std::string& arguments) {
    return test::run_codict(test::fixture(""), "explain " + arguments);
  };
  const std::string one = explain("od-limit").out;
  CHECK(one.find("### od-limit\n\nerror: ") == 0);
  CHECK(one.find("\nWrong:\n\n```eds\n[2000]\n") != std::string::npos);
  const std::string link = "\ntools/codict/docs/rules.md#od-limit\n";
  CHECK(one.substr(one.size() - link.size()) == link);
  const std::string all = explain("--all").out;
  CHECK(all == test::bytes_of(LEXICAN_SOURCE_DIR "/tools/codict/docs/rules.md"));
  CHECK(all.find(one.substr(0, one.size() - link.size())) != std::string::npos);
  CHECK(explain("").out.find("\nod-limit                   error    ") != std::string::npos);
  CHECK(explain("od-limt").err == "codict: unknown rule od-limt; did you mean od-limit?\n");
  CHECK(explain("od-limt").status == 2);
  const Json json = Json::parse(explain("--json gen-access").out);
  CHECK(json.at("schema") == "codict-explain-1");
  CHECK(json.at("rules").at(0).at("severity") == "error");
  CHECK(Json::parse(explain("--json").out).at("rules").size() > 140);
}

TEST_CASE("codict check: only on a terminal the end of a check without findings is said") {
  const std::string command =
      std::string("'") + LEXICAN_CODICT_PROGRAM + "' check '" LEXICAN_SOURCE_DIR "/demo/clock/generated/clock.eds'";
  const Ran piped = test::run_shell(command);
  CHECK(piped.status == 0);
  CHECK(piped.out + piped.err == "");
  const Ran shown = test::run_shell("script --quiet --return --command \"" + command + "\" /dev/null </dev/null");
  CHECK(shown.status == 0);
  CHECK(shown.out == "codict: no findings\r\n");
}

TEST_CASE("codict check: findings beyond the limit are counted, hide no error and keep the exit status") {
  const Directory directory;
  std::string text = "[2000]\nParameterName=x\nObjectType=7\n";
  for (int n = 0; n < 100100; ++n) {
    text += "Own" + std::to_string(n) + "=1\n";
  }
  test::write_bytes(directory / "many.eds", text);
  const auto check_many = [&directory](const std::string& options) {
    return test::run_codict(directory / "", "check" + quiet + unlisted + options + " many.eds");
  };
  const Ran notes = check_many("--level note --disable eds-key-missing");
  CHECK(notes.status == 1);
  CHECK(test::has(notes.err, "many.eds: more than 100000 findings: 103 notes are counted, but not shown"));
  CHECK(test::has(notes.err, "codict: 100100 notes\n"));
  CHECK(check_many("--level note --disable eds-key-missing --disable eds-key-unknown").status == 0);
  const Ran all = check_many("--level note --json");
  CHECK(all.status == 1);
  CHECK(test::has(all.out, "\"eds-key-missing\""));
  const Json json = Json::parse(all.out);
  CHECK(json.at("files").at(0).at("not_shown") == Json{{"eds-key-unknown", 103}});  // the other 3 are disabled
}

TEST_CASE("codict check: errors beyond the limit are counted") {
  const Directory directory;
  std::string text;
  for (int n = 0; n < 100007; ++n) {
    text += "nonsense\n";
  }
  test::write_bytes(directory / "many.eds", text + "[FileInfo]\n");
  const Ran ran = test::run_codict(directory / "", "check --level error many.eds");
  CHECK(ran.status == 1);
  CHECK(test::has(ran.err, "errors are counted, but not shown"));
  CHECK(test::has(ran.err, "codict: 10001"));  // the faulty lines, and missing objects
}
