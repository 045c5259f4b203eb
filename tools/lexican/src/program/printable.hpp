// SPDX-License-Identifier: Apache-2.0
/// \file printable.hpp
/// Texts for a terminal.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lexican::program {

/// Returns the number of bytes of the character of UTF-8 that a text begins with; 0: it is none. The text is not empty.
std::size_t length_of_character(std::string_view text);

/// Returns the text with question marks in place of control characters (C0 but line ends, DEL, C1, changes of the
/// direction of writing), and of bytes that are not UTF-8.
std::string printable(std::string_view text);

/// Returns the begin of a text, at most 512 bytes, printable in one line: question marks in place of line ends, too.
std::string one_line(std::string_view text);

/// Returns the name of an NMT state as error control shows it; 0 is the boot-up message.
std::string state_text(std::uint8_t state);

/// Returns whether a text contains another one; capitals do not matter.
bool contains_ignoring_case(std::string_view text, std::string_view part);

}  // namespace lexican::program
