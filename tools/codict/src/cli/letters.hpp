// SPDX-License-Identifier: Apache-2.0
/// \file letters.hpp
/// Texts of descriptions for the terminal. All are UTF-8.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lexican::codict::cli {

/// Returns true for a continuation byte of UTF-8.
constexpr bool continues_letter(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80; }

/// Returns the number of characters.
std::size_t letters(std::string_view text);

/// Returns the text in one line, with question marks for control characters, except for those in `kept`.
std::string visible(std::string_view text, std::string_view kept = {});

}  // namespace lexican::codict::cli
