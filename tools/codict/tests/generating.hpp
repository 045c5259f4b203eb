// SPDX-License-Identifier: Apache-2.0
/// \file generating.hpp
/// Dictionaries generated from descriptions in memory, and sections of such descriptions.
#pragma once

#include <string>

#include "gen/gen.hpp"

namespace test {

struct Generated {
  lexican::codict::gen::Output output;
  std::string found;  ///< "line:column rule" of each finding except notes, one per line
  std::string notes;  ///< "line:column rule" of each note, one per line
  std::string texts;  ///< "rule: text" and the remedy of each finding, one per line

  const std::string& header() const { return output.files.at(0).bytes; }
  const std::string& source() const { return output.files.at(1).bytes; }
  bool has(const std::string& text) const {
    return !output.files.empty() &&
           (header().find(text) != std::string::npos || source().find(text) != std::string::npos);
  }
  bool says(const std::string& text) const { return texts.find(text) != std::string::npos; }
};

/// Generates the dictionary of an EDS; its name is "small" if the options give none.
Generated generate(std::string eds, lexican::codict::gen::Options options = {});

/// Returns the bytes of a fixture.
std::string fixture_text(const std::string& name);

/// Returns the section of a VAR, which ends with \a rest.
std::string variable(const char* index, int type, const char* access, const char* rest = "");

/// Returns the section of a sub-object, named as its section.
std::string sub(const char* section, int type, const char* access, const char* value);

/// Returns the section of a RECORD, without its sub-objects.
std::string record(const char* index);

}  // namespace test
