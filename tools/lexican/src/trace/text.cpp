// SPDX-License-Identifier: Apache-2.0
#include "trace/text.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace lexican {

std::string text(const char* format, ...) {
  char buffer[256];
  va_list arguments;
  va_start(arguments, format);
  const int length = std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  const auto wanted = static_cast<std::size_t>(std::max(length, 0));
  return std::string(buffer, std::min(wanted, sizeof buffer - 1));
}

std::string hex_bytes(const std::uint8_t* bytes, std::size_t size) {
  std::string result;
  for (std::size_t i = 0; i < size; ++i) {
    result += text(i == 0 ? "%02X" : " %02X", bytes[i]);
  }
  return result;
}

bool is_readable(const std::uint8_t* bytes, std::size_t size) {
  return std::all_of(bytes, bytes + size, [](std::uint8_t byte) { return byte >= 0x20 && byte < 0x7F; });
}

std::string quoted(const std::uint8_t* bytes, std::size_t size) { return '"' + std::string(bytes, bytes + size) + '"'; }

}  // namespace lexican
