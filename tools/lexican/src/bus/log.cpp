// SPDX-License-Identifier: Apache-2.0
#include "bus/log.hpp"

#include <algorithm>

#include "bus/log_formats.hpp"

namespace lexican::host_bus {
namespace {

bool begins_with(std::string_view text, std::string_view begin) { return text.substr(0, begin.size()) == begin; }

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

/// Reads bytes up to the first one that is neither blank nor the end of a line, and three more.
std::string first_bytes(std::istream& stream) {
  constexpr std::size_t most_blanks = 4096;
  std::string bytes;
  std::size_t blanks = 0;
  while (bytes.size() < blanks + 4 && blanks < most_blanks) {
    const int byte = stream.rdbuf()->sbumpc();
    if (byte == std::istream::traits_type::eof()) {
      break;
    }
    bytes += static_cast<char>(byte);
    // The blocks of pcapng begin with a line feed.
    blanks += blanks + 1 == bytes.size() && (byte == ' ' || byte == '\t' || byte == '\r') ? 1U : 0U;
  }
  return bytes;
}

using Reader = std::unique_ptr<LogReader> (*)(LogInput);

Reader reader_of(std::string_view bytes) {
  if (begins_with(bytes, "\x0A\x0D\x0D\x0A")) {
    return read_pcapng;
  }
  for (const std::string_view magic :
       {"\xA1\xB2\xC3\xD4", "\xD4\xC3\xB2\xA1", "\xA1\xB2\x3C\x4D", "\x4D\x3C\xB2\xA1"}) {
    if (begins_with(bytes, magic)) {
      return read_pcap;
    }
  }
  bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  if (begins_with(bytes, "(") || begins_with(bytes, "DROP")) {
    return read_candump;
  }
  for (const std::string_view word : {"date", "Date", "base", "Base", "//"}) {
    if (begins_with(bytes, word)) {
      return read_asc;
    }
  }
  return nullptr;
}

}  // namespace

std::size_t LogInput::read(std::uint8_t* bytes, std::size_t size) {
  std::size_t number = 0;
  while (number < size && used_ < begin_.size()) {
    bytes[number++] = static_cast<std::uint8_t>(begin_[used_++]);
  }
  const std::streamsize more =
      stream_.rdbuf()->sgetn(reinterpret_cast<char*>(bytes + number), static_cast<std::streamsize>(size - number));
  return number + static_cast<std::size_t>(std::max<std::streamsize>(more, 0));
}

bool LogInput::read_line(std::string& line, bool& is_whole) {
  line.clear();
  is_whole = true;
  int byte = get();
  if (byte < 0) {
    return false;
  }
  for (; byte >= 0 && byte != '\n'; byte = get()) {
    if (line.size() < LogReader::longest_line) {
      line += static_cast<char>(byte);
    } else {
      is_whole = false;
    }
  }
  if (!line.empty() && line.back() == '\r') {
    line.pop_back();
  }
  return true;
}

bool parse_seconds(std::string_view text, Micros& time) {
  const std::size_t point = std::min(text.find('.'), text.size());
  std::uint64_t seconds = 0;
  if (!parse_number(text.substr(0, point), seconds) || seconds > most_seconds) {
    return false;
  }
  time = seconds * 1'000'000;
  if (point == text.size()) {
    return true;
  }
  std::string_view decimals = text.substr(point + 1);
  std::uint64_t fraction = 0;
  if (decimals.size() > 9 || !parse_number(decimals, fraction)) {
    return false;
  }
  std::size_t digits = decimals.size();
  for (; digits < 6; ++digits) {
    fraction *= 10;
  }
  for (; digits > 6; --digits) {
    fraction /= 10;
  }
  time += fraction;
  return true;
}

void split(std::string_view line, std::size_t most, std::vector<std::string_view>& words) {
  words.clear();
  while (words.size() < most) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos) {
      return;
    }
    line.remove_prefix(begin);
    const std::size_t size = std::min(line.find_first_of(" \t"), line.size());
    words.push_back(line.substr(0, size));
    line.remove_prefix(size);
  }
}

std::uint16_t LogReader::channel_of(std::string_view name) {
  const auto found = std::find(channels_.begin(), channels_.end(), name);
  if (found == channels_.end() && channels_.size() < most_channels) {
    channels_.emplace_back(name);
    return static_cast<std::uint16_t>(channels_.size() - 1);
  }
  const auto position = static_cast<std::size_t>(found - channels_.begin());
  return static_cast<std::uint16_t>(std::min(position, most_channels - 1));
}

std::unique_ptr<LogReader> read_log(std::istream& stream, std::string& why) {
  std::string bytes = first_bytes(stream);
  const Reader reader = reader_of(bytes);
  if (reader == nullptr) {
    why = bytes.empty() ? "the file is empty"
                        : "unknown format; candump logs (candump -l), pcapng, pcap and ASC files can be read";
    return nullptr;
  }
  return reader({stream, std::move(bytes)});
}

std::unique_ptr<LogWriter> write_log(std::ostream& stream, std::string_view name, std::string_view channel) {
  return ends_with(name, ".pcapng") ? write_pcapng(stream, channel) : write_candump(stream, channel);
}

}  // namespace lexican::host_bus
