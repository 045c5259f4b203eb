// SPDX-License-Identifier: Apache-2.0
/// \file report.hpp
/// The speed table in Markdown, on its page, and what is expected of it.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "row.hpp"

namespace speed {

std::string table_of(const std::vector<Row>& rows);

/// The page (a text) with this table between its two markers. Throws std::runtime_error if it has none.
std::string with_table(const std::string& page, const std::string& table);

/// A line "ok …" or "not ok …" for each row with a budget, and for the page, in the Test Anything Protocol.
/// Returns whether all are ok.
bool print_verdicts(std::ostream& out, const std::vector<Row>& rows, const std::string& page);

}  // namespace speed
