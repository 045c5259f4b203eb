// SPDX-License-Identifier: Apache-2.0
/// \file report.hpp
/// The speed table in Markdown, its page, and the check of its budgets.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "row.hpp"

namespace speed {

std::string table_of(const std::vector<Row>& rows);

/// Returns the text of the page with \a table between its two markers. Throws std::runtime_error if it has no markers.
std::string with_table(const std::string& page, const std::string& table);

/// Prints a line "ok …" or "not ok …" for each row with a budget and for the page, in the Test Anything Protocol.
/// Returns true if all are ok.
bool print_verdicts(std::ostream& out, const std::vector<Row>& rows, const std::string& page);

}  // namespace speed
