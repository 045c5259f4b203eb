// SPDX-License-Identifier: Apache-2.0
/// \file encoding.hpp
/// What bytes above 7Fh mean. The model is UTF-8; sources keep their bytes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lexican::codict {

enum class Encoding : unsigned char { ascii, utf8, cp1252, cp850, utf16 };

std::string_view name_of(Encoding encoding);

/// UTF-8 if it can be, with or without a mark at the beginning. Else a guess from the letters of European languages:
/// below A0h, where CP1252 has signs, the code pages of DOS have them.
Encoding guess_encoding(std::string_view bytes);

/// Bytes of a mark for UTF-8 at the beginning.
std::size_t mark_size(std::string_view bytes);

/// What stands for what is no character of a text: U+FFFD.
constexpr std::string_view replacement = "\xEF\xBF\xBD";

bool is_ascii(std::string_view bytes);

/// UTF-8 whatever the bytes are: what is no text in the encoding becomes U+FFFD.
std::string to_utf8(std::string_view bytes, Encoding encoding);

/// The bytes of UTF-8 text in an encoding; false if it has no letter for one of them.
bool from_utf8(std::string_view utf8, Encoding encoding, std::string& bytes);

}  // namespace lexican::codict
