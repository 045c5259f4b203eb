// SPDX-License-Identifier: Apache-2.0
#include "text/source.hpp"

#include <algorithm>
#include <utility>

namespace lexican::codict {

Source::Source(std::string name, std::string bytes) : name_(std::move(name)), bytes_(std::move(bytes)) {
  const char line_end = bytes_.find('\n') == std::string::npos ? '\r' : '\n';
  for (std::size_t end = bytes_.find(line_end); end != std::string::npos; end = bytes_.find(line_end, end + 1)) {
    starts_.push_back(static_cast<std::uint32_t>(end + 1));
  }
}

Span Source::line(std::uint32_t number) const {
  Span span{starts_[number - 1], number < lines() ? starts_[number] : size()};
  if (span.end > span.begin && bytes_[span.end - 1] == '\n') {
    --span.end;
  }
  while (span.end > span.begin && bytes_[span.end - 1] == '\r') {
    --span.end;
  }
  return span;
}

Position Source::position(std::uint32_t offset) const {
  const auto after = std::upper_bound(starts_.begin(), starts_.end(), offset);
  const auto line = static_cast<std::uint32_t>(after - starts_.begin());
  return {line, offset - starts_[line - 1] + 1};
}

std::string nul_fault(const Source& source) {
  const std::size_t offset = source.bytes().find('\0');
  if (offset == std::string_view::npos) {
    return {};
  }
  const Position at = source.position(static_cast<std::uint32_t>(offset));
  return "NUL byte at " + std::to_string(at.line) + ":" + std::to_string(at.column) + " (offset " +
         std::to_string(offset) + "): remove it if this is a text file";
}

}  // namespace lexican::codict
