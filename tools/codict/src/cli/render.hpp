// SPDX-License-Identifier: Apache-2.0
/// \file render.hpp
/// Output of findings as text and as JSON.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "text/encoding.hpp"
#include "text/finding.hpp"
#include "text/source.hpp"

namespace lexican::codict::cli {

/// Returns true if the standard output is a terminal and NO_COLOR is not set. [no-color.org]
bool wants_colour();

/// Returns each finding as "file:line:column: severity: text [rule]", its line with a caret, and the remedy. Similar
/// findings are folded.
std::string render(const Source& source, Encoding encoding, const std::vector<FoldedFindings>& findings,
                   bool has_colour);

/// Prints the selected findings on the standard error output.
void show_findings(const Input& input, const Findings& findings, const std::function<bool(const Finding&)>& is_wanted);
void show_findings(const Input& input, const Findings& findings, Severity least);

Json to_json(const Source& source, const std::vector<FoldedFindings>& findings);

/// Returns "1 error, 2 warnings"; empty if all numbers are 0.
std::string summary(std::size_t errors, std::size_t warnings, std::size_t notes);

}  // namespace lexican::codict::cli
