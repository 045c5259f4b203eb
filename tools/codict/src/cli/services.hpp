// SPDX-License-Identifier: Apache-2.0
/// \file services.hpp
/// Findings for services that show them beside the source.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command.hpp"
#include "text/finding.hpp"

namespace lexican::codict::cli {

/// Workflow commands of GitHub: a line for each.
std::string to_github(const Source& source, const std::vector<Folded>& findings);

/// One run of SARIF 2.1.0 over all files.
class Sarif {
 public:
  void add(const Input& input, const std::vector<Finding>& findings);
  /// is_complete: every file could be read.
  Json document(bool is_complete) const;

 private:
  std::size_t number_of(const Rule& rule);

  Json rules_ = Json::array();
  Json results_ = Json::array();
  std::map<const Rule*, std::size_t> numbers_;
};

}  // namespace lexican::codict::cli
