// SPDX-License-Identifier: Apache-2.0
/// \file text.hpp
/// Text for people: printf formats into std::string, and bytes as hex digits.
#pragma once

#include <cstdint>
#include <string>

namespace demo {

/// As printf, into a string.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

/// \a size bytes as two hex digits each, with spaces between them.
std::string hex_bytes(const std::uint8_t* bytes, std::size_t size);

/// Whether all bytes are characters of a readable text (ASCII); true if there are none.
bool is_readable(const std::uint8_t* bytes, std::size_t size);

/// The bytes as characters, between quotation marks.
std::string quoted(const std::uint8_t* bytes, std::size_t size);

}  // namespace demo
