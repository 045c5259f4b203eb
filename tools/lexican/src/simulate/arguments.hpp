// SPDX-License-Identifier: Apache-2.0
/// \file arguments.hpp
/// The words of a command of a simulation, and the numbers and times among them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/host.hpp"

namespace lexican::simulate {

/// Splits a line at spaces. Quotation marks join words.
std::vector<std::string> words_of(const std::string& line);
/// Parses a real number that is the whole text, or all but a unit.
std::optional<double> real_in(std::string_view text, std::string_view& unit);
/// Parses 3s, 500ms, 2min.
std::optional<Micros> time_in(std::string_view text);
/// Parses 5%.
std::optional<double> part_in(std::string_view text);
/// Parses 4310, 0x4310, 4310h.
std::optional<std::uint32_t> hex_in(std::string_view text);

}  // namespace lexican::simulate
