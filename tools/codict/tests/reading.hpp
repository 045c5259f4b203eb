// SPDX-License-Identifier: Apache-2.0
/// \file reading.hpp
/// A file that the reader under test has read, and what it says.
#pragma once

#include <cstdint>
#include <string>

#include "eds/document.hpp"
#include "model/device.hpp"
#include "text/finding.hpp"

namespace test {

/// The path of a fixture.
std::string fixture(const std::string& name);

struct Reading {
  /// A fixture; all checks have been made.
  explicit Reading(const std::string& name);

  lexican::codict::Findings findings;
  lexican::codict::eds::Document document;
  lexican::codict::Description description;
  lexican::codict::Device& device;

  /// "line:column rule" of each finding, a line for each.
  std::string found() const;

  /// The object, or sub-object, which must be there.
  const lexican::codict::Entry& at(std::uint16_t index, std::uint8_t sub_index = 0) const;
  const lexican::codict::Value& value(std::uint16_t index, std::uint8_t sub_index = 0) const;
};

/// "10", "-1", "$NODEID+384", "none", "malformed" and so on, with quotes around texts.
std::string meaning(const lexican::codict::Value& value);

/// Whether a message is a fault in lower case without a full stop, fits a terminal, and has a remedy.
bool is_well_said(const lexican::codict::Finding& finding);

}  // namespace test
