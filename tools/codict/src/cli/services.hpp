// SPDX-License-Identifier: Apache-2.0
/// \file services.hpp
/// Output of findings for services that show them beside the source.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command.hpp"
#include "text/finding.hpp"

namespace lexican::codict::cli {

/// Returns workflow commands of GitHub, a line for each finding.
std::string to_github(const Source& source, const std::vector<FoldedFindings>& findings);

/// SARIF 2.1.0 document with one run for all files.
class Sarif {
 public:
  void add(const Input& input, const std::vector<Finding>& findings);
  /// Returns the document. is_complete: all files could be read.
  Json document(bool is_complete) const;

 private:
  std::size_t number_of(const Rule& rule);

  Json rules_ = Json::array();
  Json results_ = Json::array();
  std::map<const Rule*, std::size_t> numbers_;
};

}  // namespace lexican::codict::cli
