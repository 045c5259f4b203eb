// SPDX-License-Identifier: Apache-2.0
#include "text/encoding.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace lexican::codict {

namespace {

using CodePage = std::array<std::uint16_t, 128>;  // code points of the bytes 80h…FFh

// Bytes that CP1252 does not define are decoded as the control character with the same number.
constexpr CodePage cp1252 = {{
    0x20AC, 0x0081, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160, 0x2039, 0x0152,
    0x008D, 0x017D, 0x008F, 0x0090, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014, 0x02DC, 0x2122,
    0x0161, 0x203A, 0x0153, 0x009D, 0x017E, 0x0178, 0x00A0, 0x00A1, 0x00A2, 0x00A3, 0x00A4, 0x00A5, 0x00A6,
    0x00A7, 0x00A8, 0x00A9, 0x00AA, 0x00AB, 0x00AC, 0x00AD, 0x00AE, 0x00AF, 0x00B0, 0x00B1, 0x00B2, 0x00B3,
    0x00B4, 0x00B5, 0x00B6, 0x00B7, 0x00B8, 0x00B9, 0x00BA, 0x00BB, 0x00BC, 0x00BD, 0x00BE, 0x00BF, 0x00C0,
    0x00C1, 0x00C2, 0x00C3, 0x00C4, 0x00C5, 0x00C6, 0x00C7, 0x00C8, 0x00C9, 0x00CA, 0x00CB, 0x00CC, 0x00CD,
    0x00CE, 0x00CF, 0x00D0, 0x00D1, 0x00D2, 0x00D3, 0x00D4, 0x00D5, 0x00D6, 0x00D7, 0x00D8, 0x00D9, 0x00DA,
    0x00DB, 0x00DC, 0x00DD, 0x00DE, 0x00DF, 0x00E0, 0x00E1, 0x00E2, 0x00E3, 0x00E4, 0x00E5, 0x00E6, 0x00E7,
    0x00E8, 0x00E9, 0x00EA, 0x00EB, 0x00EC, 0x00ED, 0x00EE, 0x00EF, 0x00F0, 0x00F1, 0x00F2, 0x00F3, 0x00F4,
    0x00F5, 0x00F6, 0x00F7, 0x00F8, 0x00F9, 0x00FA, 0x00FB, 0x00FC, 0x00FD, 0x00FE, 0x00FF,
}};

// CP437 has the same letters at the same bytes, with few exceptions.
constexpr CodePage cp850 = {{
    0x00C7, 0x00FC, 0x00E9, 0x00E2, 0x00E4, 0x00E0, 0x00E5, 0x00E7, 0x00EA, 0x00EB, 0x00E8, 0x00EF, 0x00EE,
    0x00EC, 0x00C4, 0x00C5, 0x00C9, 0x00E6, 0x00C6, 0x00F4, 0x00F6, 0x00F2, 0x00FB, 0x00F9, 0x00FF, 0x00D6,
    0x00DC, 0x00F8, 0x00A3, 0x00D8, 0x00D7, 0x0192, 0x00E1, 0x00ED, 0x00F3, 0x00FA, 0x00F1, 0x00D1, 0x00AA,
    0x00BA, 0x00BF, 0x00AE, 0x00AC, 0x00BD, 0x00BC, 0x00A1, 0x00AB, 0x00BB, 0x2591, 0x2592, 0x2593, 0x2502,
    0x2524, 0x00C1, 0x00C2, 0x00C0, 0x00A9, 0x2563, 0x2551, 0x2557, 0x255D, 0x00A2, 0x00A5, 0x2510, 0x2514,
    0x2534, 0x252C, 0x251C, 0x2500, 0x253C, 0x00E3, 0x00C3, 0x255A, 0x2554, 0x2569, 0x2566, 0x2560, 0x2550,
    0x256C, 0x00A4, 0x00F0, 0x00D0, 0x00CA, 0x00CB, 0x00C8, 0x0131, 0x00CD, 0x00CE, 0x00CF, 0x2518, 0x250C,
    0x2588, 0x2584, 0x00A6, 0x00CC, 0x2580, 0x00D3, 0x00DF, 0x00D4, 0x00D2, 0x00F5, 0x00D5, 0x00B5, 0x00FE,
    0x00DE, 0x00DA, 0x00DB, 0x00D9, 0x00FD, 0x00DD, 0x00AF, 0x00B4, 0x00AD, 0x00B1, 0x2017, 0x00BE, 0x00B6,
    0x00A7, 0x00F7, 0x00B8, 0x00B0, 0x00A8, 0x00B7, 0x00B9, 0x00B3, 0x00B2, 0x25A0, 0x00A0,
}};

const CodePage* page_of(Encoding encoding) {
  switch (encoding) {
    case Encoding::cp1252: return &cp1252;
    case Encoding::cp850: return &cp850;
    default: return nullptr;
  }
}

std::uint8_t byte_of(char c) { return static_cast<std::uint8_t>(c); }

void append(std::string& utf8, std::uint32_t point) {
  const auto tail = [point](unsigned shift) { return static_cast<char>(0x80U | ((point >> shift) & 0x3FU)); };
  if (point < 0x80) {
    utf8 += static_cast<char>(point);
  } else if (point < 0x800) {
    utf8 += static_cast<char>(0xC0U | (point >> 6));
    utf8 += tail(0);
  } else {
    utf8 += static_cast<char>(0xE0U | (point >> 12));
    utf8 += tail(6);
    utf8 += tail(0);
  }
}

// Returns the size in bytes of the valid UTF-8 sequence at the beginning, or 0 if there is none.
std::size_t sequence(std::string_view bytes) {
  const std::uint8_t first = byte_of(bytes[0]);
  if (first < 0x80) {
    return 1;
  }
  const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || bytes.size() < size) {
    return 0;
  }
  const bool has_tail = std::all_of(bytes.begin() + 1, bytes.begin() + static_cast<std::ptrdiff_t>(size),
                                    [](char c) { return (byte_of(c) & 0xC0U) == 0x80; });
  const std::uint8_t second = byte_of(bytes[1]);
  const bool is_too_long = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool is_no_letter = (first == 0xED && second >= 0xA0) || (first == 0xF4 && second >= 0x90);
  return has_tail && !is_too_long && !is_no_letter ? size : 0;
}

bool is_utf8(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t size = sequence(bytes);
    if (size == 0) {
      return false;
    }
    bytes.remove_prefix(size);
  }
  return true;
}

std::string repaired_utf8(std::string_view bytes) {
  std::string result;
  while (!bytes.empty()) {
    const std::size_t size = sequence(bytes);
    if (size == 0) {
      append(result, 0xFFFD);
    } else {
      result += bytes.substr(0, size);
    }
    bytes.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return result;
}

std::uint32_t point_of(std::string_view sequence) {
  if (sequence.size() == 1) {
    return byte_of(sequence[0]);
  }
  std::uint32_t point = byte_of(sequence[0]) & (0x7FU >> sequence.size());
  for (const char c : sequence.substr(1)) {
    point = (point << 6) | (byte_of(c) & 0x3FU);
  }
  return point;
}

}  // namespace

std::string_view name_of(Encoding encoding) {
  switch (encoding) {
    case Encoding::ascii: return "ASCII";
    case Encoding::utf8: return "UTF-8";
    case Encoding::cp1252: return "CP1252";
    case Encoding::cp850: return "CP850";
    case Encoding::utf16: break;
  }
  return "UTF-16";
}

std::size_t mark_size(std::string_view bytes) { return bytes.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0; }

bool is_ascii(std::string_view bytes) {
  std::uint64_t all = 0;
  while (bytes.size() >= sizeof(all)) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, bytes.data(), sizeof(eight));
    all |= eight;
    bytes.remove_prefix(sizeof(eight));
  }
  for (const char c : bytes) {
    all |= byte_of(c);
  }
  return (all & 0x8080808080808080U) == 0;
}

Encoding guess_encoding(std::string_view bytes) {
  const std::string_view mark = bytes.substr(0, 2);
  if (mark == "\xFF\xFE" || mark == "\xFE\xFF") {
    return Encoding::utf16;
  }
  if (is_ascii(bytes)) {
    return Encoding::ascii;
  }
  if (is_utf8(bytes)) {
    return Encoding::utf8;
  }
  // Bytes of frequent letters: ä ö ü Ä Ö Ü é à ç è ß in CP850; in CP1252 the same, and the signs ° µ ² ³.
  constexpr std::string_view dos = "\x84\x94\x81\x8E\x99\x9A\x82\x85\x87\x8A\xE1";
  constexpr std::string_view windows = "\xE4\xF6\xFC\xC4\xD6\xDC\xDF\xE9\xE8\xE7\xE0\xB0\xB5\xB2\xB3";
  const auto of = [](std::string_view letters) {
    return [letters](char c) { return letters.find(c) != std::string_view::npos; };
  };
  const auto for_dos = std::count_if(bytes.begin(), bytes.end(), of(dos));
  const auto for_windows = std::count_if(bytes.begin(), bytes.end(), of(windows));
  return for_dos > for_windows ? Encoding::cp850 : Encoding::cp1252;
}

std::string to_utf8(std::string_view bytes, Encoding encoding) {
  if (is_ascii(bytes)) {
    return std::string(bytes);
  }
  const CodePage* page = page_of(encoding);
  if (page == nullptr) {
    return repaired_utf8(bytes);
  }
  std::string result;
  for (const char c : bytes) {
    append(result, byte_of(c) < 0x80 ? byte_of(c) : (*page)[byte_of(c) - 0x80U]);
  }
  return result;
}

bool from_utf8(std::string_view utf8, Encoding encoding, std::string& bytes) {
  bytes.assign(utf8);
  const CodePage* page = page_of(encoding);
  if (is_ascii(utf8) || page == nullptr) {
    return is_ascii(utf8) || (encoding == Encoding::utf8 && is_utf8(utf8));
  }
  bytes.clear();
  while (!utf8.empty()) {
    const std::size_t size = sequence(utf8);
    if (size == 0) {
      return false;
    }
    const std::uint32_t point = point_of(utf8.substr(0, size));
    const auto* const place = std::find(page->begin(), page->end(), point);
    if (point >= 0x80 && place == page->end()) {
      return false;
    }
    bytes += static_cast<char>(point < 0x80 ? point : 0x80U + static_cast<std::uint32_t>(place - page->begin()));
    utf8.remove_prefix(size);
  }
  return true;
}

std::string shortened_to(std::string_view text, std::size_t characters) {
  std::size_t seen = 0;
  std::size_t kept = 0;  // bytes in front of the character that an ellipsis would replace
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool begins_character = (static_cast<unsigned char>(text[at]) & 0xC0U) != 0x80U;
    if (!begins_character) {
      continue;
    }
    kept = seen + 1 == characters ? at : kept;
    if (++seen > characters) {
      return std::string(text.substr(0, kept)) + "…";
    }
  }
  return std::string(text);
}

}  // namespace lexican::codict
