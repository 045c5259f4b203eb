// SPDX-License-Identifier: Apache-2.0
/// \file render.hpp
/// Findings for people and for programs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "text/encoding.hpp"
#include "text/finding.hpp"
#include "text/source.hpp"

namespace lexican::codict::cli {

/// Whether the standard output is a terminal whose user has not refused colours. [no-color.org]
bool wants_colour();

/// file:line:column: severity: text [rule], the line with a caret, and what to do; equal ones folded.
std::string render(const Source& source, Encoding encoding, const std::vector<Folded>& findings, bool has_colour);

/// What a command has found on its way, on the standard error output.
void show_findings(const Input& input, const Findings& findings, const std::function<bool(const Finding&)>& is_wanted);
void show_findings(const Input& input, const Findings& findings, Severity least);

Json to_json(const Source& source, const std::vector<Folded>& findings);

/// "1 error, 2 warnings"; empty if there is nothing to count.
std::string summary(std::size_t errors, std::size_t warnings, std::size_t notes);

}  // namespace lexican::codict::cli
