// SPDX-License-Identifier: Apache-2.0
/// \file xdd_reading.hpp
/// XML description that the reader under test has read, and its findings.
#pragma once

#include <cstdint>
#include <string>

#include "model/device.hpp"
#include "text/finding.hpp"
#include "xdd/document.hpp"

namespace test {

std::string bytes_of_fixture(const std::string& name);  ///< name: path below fixtures/xdd

struct XmlReading {
  explicit XmlReading(std::string bytes, const std::string& name = "device.xdd");

  lexican::codict::Findings findings;
  lexican::codict::xdd::Document document;
  lexican::codict::Description description;
  lexican::codict::Device& device;

  /// Returns "line rule" of each finding, one per line.
  std::string found() const;
  bool has(const char* rule) const;

  const lexican::codict::Entry& at(std::uint16_t index, std::uint8_t sub_index = 0) const;  ///< the object must exist
  std::string raw(lexican::codict::Span span) const { return std::string(document.raw(span)); }
};

XmlReading fixture_xml(const std::string& name);

/// Returns a description of CiA 311 1.0 with these parameters and objects, each on a separate line.
std::string xdd_with(const std::string& objects, const std::string& parameters = {},
                     const std::string& management = {});

/// Returns the message with which the reader refuses a description, empty if it accepts it.
std::string xml_refusal(const std::string& bytes);

}  // namespace test
