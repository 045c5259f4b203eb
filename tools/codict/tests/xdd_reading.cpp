// SPDX-License-Identifier: Apache-2.0
#include "xdd_reading.hpp"

#include <optional>
#include <stdexcept>
#include <utility>

#include "reading.hpp"
#include "text/file.hpp"
#include "xdd/read.hpp"
#include "xdd/recognise.hpp"

namespace test {

using namespace lexican::codict;

std::string bytes_of_fixture(const std::string& name) {
  std::string why;
  const std::optional<Source> source = read_file(fixture("xdd/" + name), why);
  if (!source) {
    throw std::runtime_error(why);
  }
  return std::string(source->bytes());
}

XmlReading::XmlReading(std::string bytes, const std::string& name)
    : document(Source(name, std::move(bytes)), findings),
      description(xdd::read(document, findings)),
      device(description.devices.front()) {}

std::string XmlReading::found() const {
  std::string text;
  for (const Finding& finding : findings.all()) {
    const Position position = document.source().position(finding.span.begin);
    text += std::to_string(position.line) + " " + std::string(finding.rule->id) + "\n";
  }
  return text;
}

bool XmlReading::has(const char* rule) const {
  return found().find(" " + std::string(rule) + "\n") != std::string::npos;
}

const Entry& XmlReading::at(std::uint16_t index, std::uint8_t sub_index) const {
  const Object* const object = device.find(index);
  const Entry* const entry =
      sub_index == 0 && object != nullptr && object->subs.empty() ? object : device.find(index, sub_index);
  if (entry == nullptr) {
    throw std::runtime_error("no object " + std::to_string(index) + " sub-index " + std::to_string(sub_index));
  }
  return *entry;
}

XmlReading fixture_xml(const std::string& name) { return XmlReading(bytes_of_fixture(name), name); }

std::string xdd_with(const std::string& objects, const std::string& parameters, const std::string& management) {
  const std::string process = parameters.empty() ? ""
                                                 : "<ApplicationProcess><parameterList>\n" + parameters +
                                                       "\n</parameterList></ApplicationProcess>";
  return "<ISO15745ProfileContainer xmlns=\"http://www.canopen.org/xml/1.0\"><ISO15745Profile><ProfileBody>"
         "<DeviceIdentity/>" +
         process +
         "</ProfileBody></ISO15745Profile><ISO15745Profile><ProfileBody><ApplicationLayers><CANopenObjectList>\n" +
         objects + "\n</CANopenObjectList></ApplicationLayers>" + management +
         "</ProfileBody></ISO15745Profile></ISO15745ProfileContainer>";
}

std::string xml_refusal(const std::string& bytes) {
  const Source source("device.xdd", bytes);
  std::string why = xdd::refusal(source);
  if (why.empty()) {
    Findings findings;
    why = xdd::refusal(xdd::Document(source, findings));
  }
  return why;
}

}  // namespace test
