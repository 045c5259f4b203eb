// SPDX-License-Identifier: Apache-2.0
// Conversion between all formats: every difference has to be announced as a loss.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "convert/losses.hpp"
#include "convert/write.hpp"
#include "diff/diff.hpp"
#include "eds/read.hpp"
#include "files.hpp"
#include "json/read.hpp"
#include "json/write.hpp"
#include "program.hpp"
#include "reading.hpp"
#include "xdd/read.hpp"

using namespace lexican::codict;
using convert::Loss;
using convert::Target;

namespace {

struct Way {
  const char* name;  // name of the written file: its extension distinguishes an XDC from an XDD
  Target target;
  xdd::Edition edition;
};

constexpr std::array<Way, 7> ways = {{{"a.eds", Target::eds, xdd::Edition::v11},
                                      {"a.dcf", Target::dcf, xdd::Edition::v11},
                                      {"10.xdd", Target::xdd, xdd::Edition::v10},
                                      {"11.xdd", Target::xdd, xdd::Edition::v11},
                                      {"10.xdc", Target::xdc, xdd::Edition::v10},
                                      {"11.xdc", Target::xdc, xdd::Edition::v11},
                                      {"a.json", Target::json, xdd::Edition::v11}}};

Description description_of(const std::string& text, const std::string& name) {
  Findings findings;
  const Source source(name, text);
  const std::size_t first = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (first != std::string::npos && text[first] == '<') {
    xdd::Document document(source, findings);
    return xdd::read(document, findings);
  }
  if (json::is_json(source)) {
    return json::read(json::Document(source), findings);
  }
  return eds::read(eds::Document(source, findings), findings);
}

std::string written(const Description& description, const Way& way) {
  return way.target == Target::json ? json::write(description)
                                    : convert::write(description.devices.front(), way.target, way.edition, "");
}

// Beginnings of the names of differences, and the loss that announces each.
constexpr std::array<std::pair<std::string_view, std::string_view>, 59> announcements = {{
    {"value", "configured values"},
    {"denotation", "denotations"},
    {"node-ID", "commissioning"},
    {"node name", "commissioning"},
    {"bit rate", "commissioning"},
    {"network number", "commissioning"},
    {"network name", "commissioning"},
    {"manager", "commissioning"},
    {"serial number", "commissioning"},
    {"serial number", "serial numbers"},
    {"label", "labels"},
    {"description", "descriptions"},
    {"unit", "units"},
    {"multiplier", "multipliers"},
    {"offset", "offsets"},
    {"allowed value", "allowed values"},
    {"name of allowed value", "allowed values"},
    {"allowed value", "data types"},
    {"name of allowed value", "data types"},
    {"range", "ranges"},
    {"step", "steps"},
    {"property ", "properties"},
    {"disabled", "properties"},
    {"count label", "properties"},
    {"SRDO access", "properties"},
    {"shortest capacity", "properties"},
    {"capacity", "properties"},
    {"extension", "properties"},
    {"TPDO on change", "properties"},
    {"upload file", "files of domains"},
    {"download file", "files of domains"},
    {"module", "modules"},
    {"object", "modules"},
    {"automatic bit rate", "bit rates"},
    {"self-starting", "features"},
    {"SDO requests", "features"},
    {"flying master", "features"},
    {"SDO manager", "features"},
    {"configuration manager", "features"},
    {"vendor text", "texts of the identity"},
    {"product text", "texts of the identity"},
    {"product family", "texts of the identity"},
    {"EDS it was made of", "name of the former EDS"},
    {"description", "texts of the file"},
    {"version of the format", "texts of the file"},
    {"file revision", "texts of the file"},
    {"revision number", "texts of the file"},
    {"dynamic channel", "numbers of dynamic channels"},
    {"access", "unknown access types"},
    {"PDO mapping", "directions of PDOs"},
    {"PDO mapping", "PDO mappings of unknown data types"},
    {"access", "PDO mappings of unknown data types"},
    {"default", "line ends in texts"},
    {"value", "line ends in texts"},
    {"name", "line ends in texts"},
    {"default", "sub-indexes 0 without a default value"},
    {"time of creation", "seconds of times"},
    {"time of change", "seconds of times"},
    {"access", "access types"},
}};

// Compares places. Those of losses begin with the object, followed by a detail; losses of the device have no object.
bool is_at(const std::string& loss, const std::string& place) {
  return loss.empty() || place.empty() || loss == place || loss.substr(0, place.size() + 1) == place + " ";
}

bool is_announced(const diff::Difference& difference, const std::vector<Loss>& losses) {
  const std::string place = diff::to_string(difference.place);
  return std::any_of(announcements.begin(), announcements.end(), [&](const auto& announcement) {
    const auto& [what, name] = announcement;
    return difference.what.substr(0, what.size()) == what &&
           std::any_of(losses.begin(), losses.end(), [&, wanted = name](const Loss& loss) {
             const bool is_whole = wanted == "data types" || wanted == "modules";
             return loss.what == wanted &&
                    (is_whole || std::any_of(loss.places.begin(), loss.places.end(),
                                             [&](const std::string& each) { return is_at(each, place); }));
           });
  });
}

// Returns the differences that convert does not announce, one per line.
std::string silent_losses(const Description& description, const Way& way) {
  const Description after = description_of(written(description, way), way.name);
  const std::vector<Loss> losses = convert::losses(description, way.target);
  std::string text;
  for (const diff::Difference& difference : diff::compare(description.devices.front(), after.devices.front())) {
    if (!is_announced(difference, losses)) {
      text += std::string(way.name) + ": " + diff::to_string(difference.place) + " " + difference.what + ": " +
              difference.before + " -> " + difference.after + "\n";
    }
  }
  return text;
}

// Returns the lines of [DeviceComissioning], separated by blanks.
std::string commissioning_of(const std::string& dcf) {
  const std::size_t begin = dcf.find("[DeviceComissioning]");
  std::string lines = dcf.substr(begin, dcf.find('[', begin + 1) - begin);
  lines.erase(std::remove(lines.begin(), lines.end(), '\r'), lines.end());
  lines = lines.substr(lines.find('\n') + 1);
  lines.erase(lines.find_last_not_of('\n') + 1);
  std::replace(lines.begin(), lines.end(), '\n', ' ');
  return lines;
}

std::string losses_of(const Description& description, Target target) {
  std::string text;
  for (const Loss& loss : convert::losses(description, target)) {
    text += std::string(loss.what) + ": ";
    for (const std::string& place : loss.places) {
      text += (&place == &loss.places.front() ? "" : ", ") + place;
    }
    text += "\n";
  }
  return text;
}

void check_all_ways(const Description& description) {
  for (const Way& way : ways) {
    CHECK(silent_losses(description, way) == "");
  }
}

// Checks all formats, and another format of each of what has been written; which one depends on the turn.
void check_all_ways_twice(const Description& description, std::size_t turn) {
  check_all_ways(description);
  for (const Way& way : ways) {
    CAPTURE(std::string(way.name));
    CHECK(silent_losses(description_of(written(description, way), way.name), ways[++turn % ways.size()]) == "");
  }
}

}  // namespace

TEST_CASE("convert: losses in another format are reported for each fixture and each format") {
  std::size_t turn = 0;
  for (const std::string& path : test::files_in(test::fixture(""), test::all_endings())) {
    if (!test::has(path, "control_character")) {  // XML cannot contain control characters
      CAPTURE(path);
      check_all_ways_twice(description_of(test::bytes_of(path), path), ++turn);
    }
  }
}

TEST_CASE("convert: losses in another format are reported for each description of the corpus" *
          doctest::test_suite(test::needs_corpus) * test::skipped_without_corpus()) {
  for (const std::string& path : test::files_in(test::corpus(), test::all_endings())) {
    CAPTURE(path);
    check_all_ways(description_of(test::bytes_of(path), path));
  }
}

TEST_CASE("convert: values of a DCF are kept through all formats") {
  for (const std::string name : {"automatic_rate.dcf", "blank_commissioning.dcf", "empty_commissioning.dcf"}) {
    CAPTURE(name);
    const std::string dcf = written(description_of(test::bytes_of(test::fixture(name)), name), ways[1]);
    for (const Way& way : {ways[4], ways[5], ways[6]}) {
      CAPTURE(std::string(way.name));
      const std::string between = written(description_of(dcf, "a.dcf"), way);
      const std::string after = commissioning_of(written(description_of(between, way.name), ways[1]));
      if (name == "automatic_rate.dcf") {
        CHECK(test::has(after, "NodeID=5 NodeName=Inlet Baudrate=0"));
      } else if (way.target != Target::json) {
        CHECK(after == "");
      }
    }
  }
  CHECK(commissioning_of(written(description_of("[FileInfo]\n", "a.eds"), ways[1])) == "");
}

TEST_CASE("convert: an XDD keeps an empty and an invalid default bit rate") {
  for (const std::string rate : {"", "fast", "125 Kbps", "auto-baudRate"}) {
    const std::string xdd =
        "<ISO15745ProfileContainer xmlns=\"http://www.canopen.org/xml/1.0\"><ISO15745Profile>"
        "<ProfileBody><DeviceIdentity/><TransportLayers><PhysicalLayer><baudRate defaultValue=\"" +
        rate + "\"/></PhysicalLayer></TransportLayers></ProfileBody></ISO15745Profile></ISO15745ProfileContainer>";
    CHECK(test::has(written(description_of(xdd, "a.xdd"), ways[3]), "<baudRate defaultValue=\"" + rate + "\""));
  }
}

TEST_CASE("convert: vendor-ID and product code of an .nxdd are kept") {
  const std::string path = test::fixture("xdd/identity.nxdd");
  const Description project = description_of(test::bytes_of(path), path);
  CHECK(project.devices.front().format == Format::nxdd);
  for (const Way& way : ways) {
    CAPTURE(std::string(way.name));
    const Description after = description_of(written(project, way), way.name);
    CHECK(after.devices.front().identity.vendor_number.value == 0x12);
    CHECK(after.devices.front().identity.product_number.value == 0x34);
  }
}

TEST_CASE("convert: limits of compact storage are kept; ranges and steps that an EDS cannot express are reported") {
  const Description compact = description_of(test::bytes_of(test::fixture("compact_limits.eds")), "a.eds");
  for (const Way& way : ways) {
    CAPTURE(std::string(way.name));
    const Description after = description_of(written(compact, way), way.name);
    CHECK(after.devices.front().find(0x2000)->low_limit->text == "1");
    CHECK(after.devices.front().find(0x2000)->high_limit->text == "9");
    CHECK(after.devices.front().find(0x2001)->low_limit->text == "1");
  }
  const Description ranges = description_of(test::bytes_of(test::fixture("xdd/ranges.xdd")), "ranges.xdd");
  CHECK(losses_of(ranges, Target::eds) == "ranges: 2000h 1..5, 2000h 10..20\nsteps: 2000h, 2001h\n");
  CHECK(losses_of(ranges, Target::xdd) == "");
}
