// SPDX-License-Identifier: Apache-2.0
/// \file finding.hpp
/// What is off in an input: readers accept nearly everything, and say so here.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/source.hpp"

namespace lexican::codict {

enum class Severity : unsigned char { note, warning, error };

std::string_view name_of(Severity severity);

/// A kind of finding. Its id is for ever: people grep for it, suppress it and read the page that explains it.
struct Rule {
  std::string_view id;
  Severity severity = Severity::warning;
  std::string_view about;  ///< one sentence: what holds, or what is done where it does not hold
};

struct Finding {
  const Rule* rule = nullptr;
  Span span;
  std::string text;                       ///< the same for equal findings: what differs is shown by the place
  std::string hint;                       ///< what to do; may be empty
  Severity severity = Severity::warning;  ///< that of the rule, unless somebody takes it for worse
};

/// The findings of one source, in the order in which they were made until they are sorted.
class Findings {
 public:
  /// More of them help nobody, and would need many times the memory of the source: they are counted only.
  static constexpr std::size_t most = 100000;

  void add(const Rule& rule, Span span, std::string text, std::string hint = {}) {
    if (all_.size() == most) {
      ++dropped_;
    } else {
      all_.push_back({&rule, span, std::move(text), std::move(hint), rule.severity});
    }
  }
  std::size_t dropped() const { return dropped_; }

  const std::vector<Finding>& all() const { return all_; }
  std::size_t count(const Rule& rule) const;
  std::size_t count(Severity severity) const;
  template <typename Predicate>
  void remove_if(Predicate is_unwanted) {
    all_.erase(std::remove_if(all_.begin(), all_.end(), is_unwanted), all_.end());
  }
  void sort();  ///< by place; those of one place keep their order

 private:
  std::vector<Finding> all_;
  std::size_t dropped_ = 0;
};

/// Findings of one rule with one text: the first, and how many follow.
struct Folded {
  const Finding* first = nullptr;
  std::size_t more = 0;
};

/// In the order of the first ones.
std::vector<Folded> fold(const std::vector<Finding>& findings);

}  // namespace lexican::codict
