// SPDX-License-Identifier: Apache-2.0
/// \file text.hpp
/// Text output: printf formats into std::string, and bytes as hex digits.
#pragma once

#include <cstdint>
#include <string>

namespace lexican {

/// Formats like printf() and returns a string.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

/// Returns \a size bytes as two hex digits each, separated by spaces.
std::string hex_bytes(const std::uint8_t* bytes, std::size_t size);

/// Returns true if all bytes are printable ASCII characters, or there are none.
bool is_readable(const std::uint8_t* bytes, std::size_t size);

/// Returns the bytes as characters, in quotation marks.
std::string quoted(const std::uint8_t* bytes, std::size_t size);

}  // namespace lexican
