// SPDX-License-Identifier: Apache-2.0
// Each rule has a section in docs/rules.md, whose examples do what it says.
//
// An example contains only the essential lines; the test inserts it into a device (fixtures/rules). Sections of an EDS
// replace those of the same name, and the lists of objects are generated. Elements of an XML description are inserted
// into their parents. An example marked as "whole" is not changed.
#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "catalogue/pages.hpp"
#include "catalogue/rules.hpp"
#include "catalogue/suppress.hpp"
#include "check/check.hpp"
#include "check/profile.hpp"
#include "eds/read.hpp"
#include "eds/suppressions.hpp"
#include "gen/gen.hpp"
#include "network/check.hpp"
#include "network/concise.hpp"
#include "network/links.hpp"
#include "network/network.hpp"
#include "network/plan.hpp"
#include "network/traffic.hpp"
#include "program.hpp"
#include "reading.hpp"
#include "xdd/read.hpp"
#include "xdd/suppressions.hpp"

using namespace lexican::codict;

namespace {

struct Example {
  std::string form;  // "eds", "dcf", "xml", each also with " whole"; "yaml": a plan of a network
  std::string text;

  bool is_xml() const { return form.substr(0, 3) == "xml"; }
  bool is_plan() const { return form == "yaml"; }
  bool is_whole() const { return form.find(" whole") != std::string::npos; }
};

struct Page {
  std::string text;
  std::vector<Example> examples;

  bool says(const std::string& words) const { return text.find(words) != std::string::npos; }
};

Page page_of(const Rule& rule) {
  Page page{catalogue::section_of(rule), {}};
  for (std::size_t at = page.text.find("```"); at != std::string::npos; at = page.text.find("```", at)) {
    const std::size_t line = page.text.find('\n', at) + 1;
    const std::size_t end = page.text.find("```", line);
    page.examples.push_back({page.text.substr(at + 3, line - at - 4), page.text.substr(line, end - line)});
    at = end + 3;
  }
  return page;
}

// Returns the rules named in "The wrong example also breaks: `a`, `b`".
std::set<std::string> others_of(const Page& page) {
  std::set<std::string> others;
  const std::size_t begin = page.text.find("\nThe wrong example also breaks: ");
  const std::string line =
      begin == std::string::npos ? "" : page.text.substr(begin, page.text.find('\n', begin + 1) - begin);
  for (std::size_t at = line.find('`'); at != std::string::npos; at = line.find('`', at + 1)) {
    const std::size_t end = line.find('`', at + 1);
    others.insert(line.substr(at + 1, end - at - 1));
    at = end;
  }
  return others;
}

// Device for examples of EDS and DCF ----------------------------------------------------------------------------------

struct Part {
  std::string name;  // name of the section; empty for the text in front of the first one
  std::string text;
};

std::vector<Part> parts_of(const std::string& text) {
  std::vector<Part> parts;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::size_t first = text.find_first_not_of(" \t", at);
    if (parts.empty() || text[first] == '[') {
      const std::size_t close = text.find(']', first);
      parts.push_back({text[first] == '[' ? text.substr(first + 1, close - first - 1) : "", ""});
    }
    parts.back().text += text.substr(at, end - at);
    at = end;
  }
  return parts;
}

bool has_part(const std::vector<Part>& parts, const std::string& name) {
  return std::any_of(parts.begin(), parts.end(), [&name](const Part& part) { return part.name == name; });
}

std::string list_of_objects(const char* name, ListKind kind, const std::vector<Part>& parts) {
  std::set<std::string> indexes;
  for (const Part& part : parts) {
    if (part.name.size() == 4 && part.name.find_first_not_of("0123456789ABCDEF") == std::string::npos &&
        part.name >= "1000" && list_of(static_cast<std::uint16_t>(std::stoul(part.name, nullptr, 16))) == kind) {
      indexes.insert(part.name);
    }
  }
  std::string text = std::string("[") + name + "]\nSupportedObjects=" + std::to_string(indexes.size()) + "\n";
  unsigned number = 0;
  for (const std::string& index : indexes) {
    text += std::to_string(++number) + "=0x" + index + "\n";
  }
  return text;
}

// `more`: fixture with further sections of the device; may be empty.
std::string in_eds_device(const std::string& example, const std::string& more) {
  const std::vector<Part> own = parts_of(example);
  std::vector<Part> parts;
  const std::string further = more.empty() ? "" : "\n" + test::bytes_of(test::fixture(more));
  for (const Part& part : parts_of(test::bytes_of(test::fixture("rules/device.eds")) + further)) {
    if (!has_part(own, part.name)) {
      parts.push_back(part);
    }
  }
  const bool has_head = !own.empty() && own.front().name.empty();
  parts.insert(parts.end(), own.begin() + (has_head ? 1 : 0), own.end());
  std::string text = has_head ? own.front().text : "";
  for (const auto& [name, kind] :
       {std::pair("MandatoryObjects", ListKind::mandatory), std::pair("OptionalObjects", ListKind::optional),
        std::pair("ManufacturerObjects", ListKind::manufacturer)}) {
    text += has_part(own, name) ? "" : list_of_objects(name, kind, parts);
  }
  for (const Part& part : parts) {
    text += part.text;
  }
  return text;
}

// Device for examples of XML ------------------------------------------------------------------------------------------

const char* place_of(const std::string& element) {
  static const std::map<std::string, const char*> places = {
      {"CANopenObject", "objects"},
      {"parameter", "parameters"},
      {"array", "types"},
      {"struct", "types"},
      {"enum", "types"},
      {"dummyUsage", "layers"},
      {"PhysicalLayer", "transport"},
      {"CANopenGeneralFeatures", "management"},
      {"deviceCommissioning", "management"},
  };
  return places.at(element);
}

// Inserts the elements of an example into a device, each with the comments in front of it.
std::string in_xml_device(const std::string& example) {
  std::string text = test::bytes_of(test::fixture("rules/device.xdd"));
  pugi::xml_document tree;
  REQUIRE(tree.load_buffer(example.data(), example.size(), pugi::parse_fragment));
  std::size_t begin = 0;
  for (pugi::xml_node node = tree.first_child(); node; node = node.next_sibling()) {
    const pugi::xml_node next = node.next_sibling();
    const std::size_t next_tag = next ? static_cast<std::size_t>(next.offset_debug()) - 1 : example.size();
    const std::size_t comment = example.substr(0, next_tag).rfind("<!--");
    const std::size_t end = next && comment != std::string::npos && comment > begin ? comment : next_tag;
    const std::string mark = std::string("<!--") + place_of(node.name()) + "-->";
    text.insert(text.find(mark), example.substr(begin, end - begin));
    begin = end;
  }
  return text;
}

// Findings of an example ----------------------------------------------------------------------------------------------

template <typename Document, typename Read, typename Suppressions>
Findings judge(const Rule& rule, Source source, Read read, Suppressions suppressions) {
  Findings findings;
  Document document(std::move(source), findings);
  const Description description = read(document, findings);
  const bool is_generator = catalogue::is_of_generator(rule);
  if (is_generator) {
    findings = {};
    gen::Options options;
    options.name = "device";
    gen::generate(description.devices.front(), options, findings);
  } else {
    check::check_all(description.devices.front(), findings);
    check::check_profile(description.devices.front(), check::profile_of(description.devices.front()), findings);
  }
  catalogue::suppress(document.source(), suppressions(document),
                      is_generator ? catalogue::Origin::generator : catalogue::Origin::checks, findings);
  return findings;
}

// Returns the findings of a plan, whose descriptions are fixtures.
Findings judge_plan(const std::string& text) {
  Findings findings;
  const network::Plan plan = network::read_plan(Source("plan.yaml", text), findings);
  if (findings.count(Severity::error) != 0) {
    return findings;
  }
  std::vector<Device> devices;
  for (const network::PlannedSlave& slave : plan.slaves) {
    Findings ignored;
    const std::string bytes = test::bytes_of(test::fixture("network/") + slave.description.value);
    const eds::Document document(Source(slave.description.value, bytes), ignored);
    devices.push_back(eds::read(document, ignored).devices.front());
  }
  const network::Network net = network::planned_network(plan, std::move(devices), findings);
  network::NetworkFindings of_network(net);
  of_network.plan = findings;
  const network::Links links = network::links_of(net);
  network::check_all(net, links, of_network);
  network::traffic_of(net, links, of_network);
  for (std::size_t n = 0; n < net.nodes.size(); ++n) {
    network::downloads_of(net, n, of_network);
  }
  return of_network.plan;
}

Findings judge(const Rule& rule, const Example& example) {
  if (example.is_plan()) {
    return judge_plan(example.text);
  }
  const std::string name = std::string(rule.id) + (example.is_xml() ? ".xdd" : "." + example.form.substr(0, 3));
  if (example.is_xml()) {
    Source source(name, example.is_whole() ? example.text : in_xml_device(example.text));
    return judge<xdd::Document>(rule, std::move(source), xdd::read, xdd::suppressions);
  }
  const bool is_of_srdo = rule.id.find("srdo-") != std::string_view::npos;
  Source source(name,
                example.is_whole() ? example.text : in_eds_device(example.text, is_of_srdo ? "rules/srdo.eds" : ""));
  return judge<eds::Document>(rule, std::move(source), eds::read, eds::suppressions);
}

std::string listed(const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings.all()) {
    text += std::string(finding.rule->id) + ": " + finding.text + "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("rule pages: each rule has a page with a remedy and with two examples or a reason") {
  std::string wrong;
  for (const Rule* rule : catalogue::all_rules()) {
    const Page page = page_of(*rule);
    const bool has_examples = page.examples.size() == 2;
    if (!page.says("\nRemedy: ") || has_examples == page.says("\nNo example: ")) {
      wrong += std::string(rule->id) + "\n";
    }
  }
  CHECK(wrong == "");
}

TEST_CASE("rule pages: each page belongs to a rule") {
  for (const catalogue::Page& page : catalogue::all_pages()) {
    CHECK_MESSAGE(catalogue::find_rule(page.id) != nullptr, page.id);
  }
}

TEST_CASE("rule pages: the wrong example breaks only its rule, except for notes") {
  std::string wrong;
  for (const Rule* rule : catalogue::all_rules()) {
    const Page page = page_of(*rule);
    if (page.examples.empty()) {
      continue;
    }
    const Findings findings = judge(*rule, page.examples.front());
    const std::set<std::string> others = others_of(page);
    const bool is_as_said = std::all_of(findings.all().begin(), findings.all().end(), [&](const Finding& finding) {
      return finding.rule == rule || finding.severity == Severity::note ||
             others.count(std::string(finding.rule->id)) != 0;
    });
    if (findings.count(*rule) == 0 || !is_as_said) {
      wrong += "\n" + std::string(rule->id) + "\n" + listed(findings);
    }
  }
  CHECK(wrong == "");
}

TEST_CASE("rule pages: messages about the wrong example are short, state a fault and have a remedy") {
  std::string wrong;
  for (const Rule* rule : catalogue::all_rules()) {
    const Page page = page_of(*rule);
    const Findings findings = page.examples.empty() ? Findings() : judge(*rule, page.examples.front());
    for (const Finding& finding : findings.all()) {
      wrong += test::is_well_said(finding) ? "" : message_of(finding) + " [" + finding.hint + "]\n";
    }
  }
  CHECK(wrong == "");
}

TEST_CASE("rule pages: the right example has only notes, and none of its rule") {
  std::string wrong;
  for (const Rule* rule : catalogue::all_rules()) {
    const Page page = page_of(*rule);
    if (page.examples.empty()) {
      continue;
    }
    const Findings findings = judge(*rule, page.examples.back());
    if (findings.count(*rule) + findings.count(Severity::warning) + findings.count(Severity::error) != 0) {
      wrong += "\n" + std::string(rule->id) + "\n" + listed(findings);
    }
  }
  CHECK(wrong == "");
}
