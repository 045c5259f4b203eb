// SPDX-License-Identifier: Apache-2.0
/// \file source.hpp
/// The bytes of a file, and positions in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lexican::codict {

/// Bytes [begin, end) of a source. An empty span is a position between two bytes.
struct Span {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  constexpr std::uint32_t size() const { return end - begin; }
  constexpr bool is_empty() const { return begin == end; }
  constexpr bool operator==(const Span& other) const { return begin == other.begin && end == other.end; }
};

/// A position as editors and compilers count it: line and column from 1, columns in bytes.
struct Position {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
};

/// A file that has been read. Lines end with LF or CR LF, or with CR if there is no LF.
class Source {
 public:
  /// Limit of the size in bytes. Larger inputs are not device descriptions; offsets fit in 32 bits.
  static constexpr std::size_t size_limit = std::size_t{64} * 1024 * 1024;

  Source() = default;
  Source(std::string name, std::string bytes);  ///< bytes: at most size_limit

  const std::string& name() const { return name_; }
  std::string_view bytes() const { return bytes_; }
  std::string_view slice(Span span) const { return bytes().substr(span.begin, span.size()); }
  std::uint32_t size() const { return static_cast<std::uint32_t>(bytes_.size()); }

  std::uint32_t lines() const { return static_cast<std::uint32_t>(starts_.size()); }
  Span line(std::uint32_t number) const;  ///< number: 1…lines(); returns the line without its line end
  Position position(std::uint32_t offset) const;

 private:
  std::string name_;
  std::string bytes_;
  std::vector<std::uint32_t> starts_{0};  // offsets of the first bytes of the lines
};

/// Returns a message with the place of the first NUL byte; empty if there is none.
std::string nul_fault(const Source& source);

}  // namespace lexican::codict
