// SPDX-License-Identifier: Apache-2.0
/// \file letters.hpp
/// Texts of descriptions as people see them. All are UTF-8.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lexican::codict::cli {

/// Whether a byte is behind the first one of its letter.
constexpr bool continues_letter(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80; }

std::size_t letters(std::string_view text);

/// One line with nothing that a terminal would obey: control characters are question marks, but for those of `kept`.
std::string visible(std::string_view text, std::string_view kept = {});

}  // namespace lexican::codict::cli
