// SPDX-License-Identifier: Apache-2.0
/// \file reading.hpp
/// Description that the reader under test has read, and its findings.
#pragma once

#include <cstdint>
#include <string>

#include "eds/document.hpp"
#include "model/device.hpp"
#include "text/finding.hpp"

namespace test {

/// Returns the path of a fixture.
std::string fixture(const std::string& name);

struct Reading {
  /// Reads a fixture and runs all checks.
  explicit Reading(const std::string& name);

  lexican::codict::Findings findings;
  lexican::codict::eds::Document document;
  lexican::codict::Description description;
  lexican::codict::Device& device;

  /// Returns "line:column rule" of each finding, one per line.
  std::string found() const;

  /// Returns an object or sub-object, which must exist.
  const lexican::codict::Entry& at(std::uint16_t index, std::uint8_t sub_index = 0) const;
  const lexican::codict::Value& value(std::uint16_t index, std::uint8_t sub_index = 0) const;
};

/// Returns "10", "-1", "$NODEID+384", "none", "malformed" and so on; texts are in quotes.
std::string meaning(const lexican::codict::Value& value);

/// Returns true if a message describes a fault, has no full stop, is not too long, and has a remedy.
bool is_well_said(const lexican::codict::Finding& finding);

}  // namespace test
