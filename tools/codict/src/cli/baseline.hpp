// SPDX-License-Identifier: Apache-2.0
/// \file baseline.hpp
/// Baseline of known findings, so that only new ones are reported. A finding is identified by its rule and text and by
/// the content of its line or element, so that it stays known when lines move.
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
  /// Reads a baseline from a file. On failure, why is the reason in one line.
  static std::optional<Baseline> read(const std::string& path, std::string& why);

  void add(const Input& input, const Finding& finding);
  /// Returns true if the baseline contains the finding, and removes one occurrence of it.
  bool remove_match(const Input& input, const Finding& finding);
  /// Returns the number of a file's findings that remove_match() has not removed, for the rules that is_asked selects.
  std::size_t left(const Input& input, const std::function<bool(const std::string&)>& is_asked) const;

  Json to_json() const;

 private:
  using Key = std::tuple<std::string, std::string, std::string, std::string>;  // file, rule, place, text
  static Key key_of(const Input& input, const Finding& finding);
  bool read_file_entries(const std::string& file, const json::Node& entries);

  std::map<Key, std::size_t> counts_;
};

}  // namespace lexican::codict::cli
