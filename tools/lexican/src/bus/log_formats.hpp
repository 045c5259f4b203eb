// SPDX-License-Identifier: Apache-2.0
/// \file log_formats.hpp
/// The formats of log.hpp, and functions that they share.
#pragma once

#include <charconv>
#include <istream>
#include <ostream>
#include <utility>

#include "bus/log.hpp"

namespace lexican::host_bus {

constexpr std::uint32_t max_extended_id = 0x1FFFFFFF;
constexpr std::uint32_t max_base_id = 0x7FF;

/// A stream whose first bytes have been read to recognise the format.
class LogInput {
 public:
  LogInput(std::istream& stream, std::string begin) : stream_(stream), begin_(std::move(begin)) {}

  /// \retval -1  the end of the stream
  int get() {
    if (used_ < begin_.size()) {
      return static_cast<unsigned char>(begin_[used_++]);
    }
    const int byte = stream_.get();
    return byte == std::istream::traits_type::eof() ? -1 : byte;
  }
  /// Returns true if the file could not be read to its end.
  bool is_broken() const { return stream_.bad(); }
  /// Returns the number of bytes read; less than \a size: the stream has ended.
  std::size_t read(std::uint8_t* bytes, std::size_t size);
  /// Reads a line without its end. \a is_whole: false if it is longer than LogReader::max_line, and therefore cut, or
  /// if the file ends within it. \retval false  the stream has ended
  bool read_line(std::string& line, bool& is_whole);

 private:
  std::istream& stream_;
  std::string begin_;
  std::size_t used_ = 0;
};

std::unique_ptr<LogReader> read_candump(LogInput input);
std::unique_ptr<LogReader> read_asc(LogInput input);
std::unique_ptr<LogReader> read_pcap(LogInput input);    ///< the classic format
std::unique_ptr<LogReader> read_pcapng(LogInput input);  ///< the blocks
std::unique_ptr<LogWriter> write_candump(std::ostream& stream, std::string_view channel);
std::unique_ptr<LogWriter> write_pcapng(std::ostream& stream, std::string_view channel);

/// Parses a whole text as a number without sign or prefix.
/// \retval false  it is not such a number, or too large
template <typename T>
bool parse_number(std::string_view text, T& number, int base = 10) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  return error == std::errc{} && end == text.data() + text.size();
}

/// Returns a number with at least \a digits digits; upper-case letters where \a base is 16.
std::string number_text(std::uint64_t number, std::size_t digits, int base = 16);

/// Parses a time in seconds with up to nine decimals.
/// \retval false  it is not such a number
bool parse_seconds(std::string_view text, Micros& time);

/// Returns a name without spaces, control characters and bytes beyond ASCII, cut at 64 bytes; "can" for an empty one.
std::string channel_name(std::string_view name);

/// Splits a line at spaces and tabs into at most \a most words. \a words: reused memory.
void split(std::string_view line, std::size_t most, std::vector<std::string_view>& words);

}  // namespace lexican::host_bus
