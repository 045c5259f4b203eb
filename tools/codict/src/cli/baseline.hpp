// SPDX-License-Identifier: Apache-2.0
/// \file baseline.hpp
/// Findings that are known already, so that only new ones are told. Lines may move: a finding is known by its rule and
/// text, and by the line or element in which it is.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "cli/command.hpp"
#include "json/document.hpp"
#include "text/finding.hpp"

namespace lexican::codict::cli {

class Baseline {
 public:
  /// Without a result, why is one line.
  static std::optional<Baseline> read(const std::string& path, std::string& why);

  void add(const Input& input, const Finding& finding);
  /// Whether the finding is known: each of those that are equal once.
  bool take(const Input& input, const Finding& finding);
  /// Those of a file that have not been taken; is_asked: of which rules.
  std::size_t left(const Input& input, const std::function<bool(const std::string&)>& is_asked) const;

  Json to_json() const;

 private:
  using Key = std::tuple<std::string, std::string, std::string, std::string>;  // file, rule, place, text
  static Key key_of(const Input& input, const Finding& finding);
  bool read_file_entries(const std::string& file, const json::Node& entries);

  std::map<Key, std::size_t> counts_;
};

}  // namespace lexican::codict::cli
