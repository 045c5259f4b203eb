// SPDX-License-Identifier: Apache-2.0
/// \file encoding.hpp
/// Detection and conversion of encodings. The model holds UTF-8; sources keep their original bytes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lexican::codict {

enum class Encoding : unsigned char { ascii, utf8, cp1252, cp850, utf16 };

std::string_view name_of(Encoding encoding);

/// Returns UTF-16 if the bytes begin with its byte order mark, ASCII or UTF-8 if the bytes are valid in it, else a
/// guess from the bytes of European letters: CP850 has letters at 80h…9Fh, where CP1252 has mostly signs.
Encoding guess_encoding(std::string_view bytes);

/// Returns the size in bytes of the UTF-8 byte order mark at the beginning, or 0.
std::size_t mark_size(std::string_view bytes);

/// Replacement character U+FFFD, written for bytes or characters that cannot be represented.
constexpr std::string_view replacement = "\xEF\xBF\xBD";

bool is_ascii(std::string_view bytes);

/// Converts bytes to valid UTF-8. Bytes that are invalid in the encoding become U+FFFD.
std::string to_utf8(std::string_view bytes, Encoding encoding);

/// Returns a UTF-8 text of at most `characters` characters (at least 1): the last one is an ellipsis if the text is
/// longer.
std::string shortened_to(std::string_view text, std::size_t characters);

/// Converts UTF-8 text to an encoding. Returns false if the encoding lacks one of its characters.
bool from_utf8(std::string_view utf8, Encoding encoding, std::string& bytes);

}  // namespace lexican::codict
