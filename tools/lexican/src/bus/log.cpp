// SPDX-License-Identifier: Apache-2.0
#include "bus/log.hpp"

#include <algorithm>
#include <array>

#include "bus/log_formats.hpp"

namespace lexican::host_bus {
namespace {

bool begins_with(std::string_view text, std::string_view begin) { return text.substr(0, begin.size()) == begin; }

constexpr std::string_view pcapng_magic = "\x0A\x0D\x0D\x0A";
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Reads the first four bytes; of a text the first four behind a byte order mark, spaces and empty lines.
std::string first_bytes(std::istream& stream) {
  constexpr std::size_t max_blanks = 4096;
  std::string bytes;
  for (std::size_t blanks = 0; bytes.size() < 4 && blanks < max_blanks;) {
    const int byte = stream.get();
    if (byte == std::istream::traits_type::eof()) {
      break;
    }
    bytes += static_cast<char>(byte);
    if (bytes != pcapng_magic.substr(0, bytes.size())) {
      const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
      const std::size_t number =
          begins_with(bytes, byte_order_mark) ? byte_order_mark.size() : std::min(begin, bytes.size());
      bytes.erase(0, number);
      blanks += number;
    }
  }
  return bytes;
}

/// Returns advice for files that are not read.
const char* advice_for(std::string_view bytes) {
  if (begins_with(bytes, "LOGG")) {
    return "a BLF file of Vector; convert it to ASC, or with can_logconvert of python-can";
  }
  if (begins_with(bytes, "\x1F\x8B")) {
    return "a compressed file; decompress it with gunzip";
  }
  if (begins_with(bytes, ";$FI") || begins_with(bytes, ";")) {
    return "a trace file of PEAK (TRC); convert it with can_logconvert of python-can";
  }
  return "unknown format; candump logs (candump -l), pcapng, pcap and ASC files can be read";
}

using Reader = std::unique_ptr<LogReader> (*)(LogInput);

Reader reader_of(std::string_view bytes) {
  if (bytes == pcapng_magic) {
    return read_pcapng;
  }
  for (const std::string_view magic :
       {"\xA1\xB2\xC3\xD4", "\xD4\xC3\xB2\xA1", "\xA1\xB2\x3C\x4D", "\x4D\x3C\xB2\xA1"}) {
    if (begins_with(bytes, magic)) {
      return read_pcap;
    }
  }
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
  stream_.read(reinterpret_cast<char*>(bytes + number), static_cast<std::streamsize>(size - number));
  return number + static_cast<std::size_t>(stream_.gcount());
}

bool LogInput::read_line(std::string& line, bool& is_whole) {
  line.clear();
  is_whole = true;
  int byte = get();
  if (byte < 0) {
    return false;
  }
  for (; byte >= 0 && byte != '\n'; byte = get()) {
    if (line.size() < LogReader::max_line) {
      line += static_cast<char>(byte);
    } else {
      is_whole = false;
    }
  }
  is_whole = is_whole && byte == '\n';
  if (!line.empty() && line.back() == '\r') {
    line.pop_back();
  }
  return true;
}

std::string number_text(std::uint64_t number, std::size_t digits, int base) {
  std::array<char, 20> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number, base);
  const auto size = static_cast<std::size_t>(end - text.data());
  std::string result(digits - std::min(size, digits), '0');
  result.append(text.data(), size);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'a' ? char(c - 'a' + 'A') : c; });
  return result;
}

bool parse_seconds(std::string_view text, Micros& time) {
  const std::size_t point = std::min(text.find('.'), text.size());
  std::uint64_t seconds = 0;
  if (!parse_number(text.substr(0, point), seconds)) {
    return false;
  }
  time = std::min(seconds, max_time / 1'000'000) * 1'000'000;
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
  time = std::min(time + fraction, max_time);
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

std::string channel_name(std::string_view name) {
  constexpr std::size_t max_length = 64;
  std::string result(name.substr(0, std::min(name.find('\0'), max_length)));
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c <= ' ' || c >= '\x7F'; }, '_');
  return result.empty() ? "can" : result;
}

std::uint16_t LogReader::channel_of(std::string_view recorded) {
  const std::string name = channel_name(recorded);
  const auto found = std::find(channels_.begin(), channels_.end(), name);
  if (found == channels_.end() && channels_.size() < max_channels) {
    channels_.push_back(name);
    return static_cast<std::uint16_t>(channels_.size() - 1);
  }
  const auto position = static_cast<std::size_t>(found - channels_.begin());
  return static_cast<std::uint16_t>(std::min(position, max_channels - 1));
}

std::unique_ptr<LogReader> read_log(std::istream& stream, std::string& why) {
  if (!stream) {
    why = "the file cannot be opened";
    return nullptr;
  }
  std::string bytes = first_bytes(stream);
  const Reader reader = reader_of(bytes);
  if (reader == nullptr) {
    why = stream.bad() ? "the file cannot be read" : bytes.empty() ? "the file is empty" : advice_for(bytes);
    return nullptr;
  }
  return reader({stream, std::move(bytes)});
}

std::unique_ptr<LogWriter> write_log(std::ostream& stream, std::string_view name, std::string_view channel) {
  const std::size_t point = std::min(name.rfind('.'), name.size());
  std::string kind(name.substr(point));
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  for (const char* const other : {".pcap", ".asc", ".blf", ".trc", ".gz"}) {
    if (kind == other) {
      return nullptr;
    }
  }
  return kind == ".pcapng" ? write_pcapng(stream, channel) : write_candump(stream, channel);
}

}  // namespace lexican::host_bus
