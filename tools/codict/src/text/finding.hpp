// SPDX-License-Identifier: Apache-2.0
/// \file finding.hpp
/// Findings: the faults and remarks about an input. Readers accept nearly every input and report its faults here.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/source.hpp"

namespace lexican::codict {

enum class Severity : unsigned char { note, warning, error };

std::string_view name_of(Severity severity);

/// A kind of finding. Its id never changes: users search for it, suppress it, and read the page that explains it.
struct Rule {
  std::string_view id;
  Severity severity = Severity::warning;
  std::string_view about;  ///< the fault in one phrase, or how the reader handles it
};

struct Finding {
  const Rule* rule = nullptr;
  Span span;
  std::string text;                       ///< the fault with its values, in lower case without a full stop
  std::string hint;                       ///< what to do; may be empty
  Severity severity = Severity::warning;  ///< severity of the rule, unless a caller has raised it
  std::string subject;                    ///< the object that contains the place: "2000h 'Ratio'"; may be empty
};

/// Returns a text of the input for a message, cut after 40 bytes.
std::string shortened(std::string_view text);

/// Returns the shortened text in quotes.
std::string in_quotes(std::string_view text);

/// Returns subject and text.
std::string message_of(const Finding& finding);

/// The findings of one source, in the order in which they were made until they are sorted.
class Findings {
 public:
  /// Limit of the errors that are stored, and of the other findings: without it, findings could need many times the
  /// memory of the source. Further ones are only counted by rule. Errors have their own limit, so that notes displace
  /// none.
  static constexpr std::size_t most = 100000;

  void add(const Rule& rule, Span span, std::string text, std::string hint = {});
  /// Number of the findings that are not kept, by rule.
  const std::map<const Rule*, std::size_t>& dropped() const { return dropped_; }

  /// The findings that are kept.
  const std::vector<Finding>& all() const { return all_; }
  /// Numbers of all findings, also of those that are not kept.
  std::size_t count(const Rule& rule) const;
  std::size_t count(Severity severity) const;
  template <typename Predicate>
  void remove_if(Predicate is_unwanted) {
    all_.erase(std::remove_if(all_.begin(), all_.end(), is_unwanted), all_.end());
  }
  template <typename Call>
  void for_each(Call call) {
    std::for_each(all_.begin(), all_.end(), call);
  }
  void sort();  ///< sorts by span; findings with equal spans keep their order

 private:
  std::vector<Finding> all_;
  std::map<const Rule*, std::size_t> dropped_;
  std::size_t errors_ = 0;  ///< errors that were added to all_
  std::size_t others_ = 0;  ///< other findings that were added to all_
};

/// Findings of one rule whose texts differ in numbers and quoted names only: the first, and how many follow. Findings
/// without a place are folded if their texts are equal, because the place does not show the difference.
struct FoldedFindings {
  const Finding* first = nullptr;
  std::size_t more = 0;
  std::string kind;  ///< the common text: "#" replaces each number and each quoted name
};

/// Folds findings that are alike. The result is in the order of the first finding of each kind.
std::vector<FoldedFindings> fold(const std::vector<Finding>& findings);

}  // namespace lexican::codict
