// SPDX-License-Identifier: Apache-2.0
#include "simulate/sources.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "simulate/arguments.hpp"

namespace lexican::simulate {
namespace {

constexpr double longest_seconds = 1e9;

/// Opens a file to read, without waiting for the writer of a FIFO.
int open_source(const std::string& path, struct stat& state, std::string& why) {
  const int fd = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0 || fstat(fd, &state) != 0) {
    why = path + ": " + std::strerror(errno);
  } else if (S_ISDIR(state.st_mode)) {
    why = path + " is a directory";
  } else {
    return fd;
  }
  if (fd >= 0) {
    close(fd);
  }
  return -1;
}

std::optional<std::string> read_small_file(const std::string& path, std::string& why) {
  struct stat state {};
  const int fd = open_source(path, state, why);
  if (fd < 0) {
    return std::nullopt;
  }
  std::string text;
  char buffer[65536];
  ssize_t size = 1;
  while (S_ISREG(state.st_mode) && text.size() <= most_csv_bytes && (size = read(fd, buffer, sizeof buffer)) > 0) {
    text.append(buffer, static_cast<std::size_t>(size));
  }
  close(fd);
  if (!S_ISREG(state.st_mode) || size < 0 || text.size() > most_csv_bytes) {
    why = !S_ISREG(state.st_mode) ? path + " is no file; use play for a FIFO"
          : size < 0              ? path + " cannot be read"
                                  : path + " has more than 8 MiB; divide it";
    return std::nullopt;
  }
  return text;
}

/// Splits a row of a CSV. Quotation marks are around a field, and doubled in it.
std::vector<std::string> fields_of(const std::string& row, char separator) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  for (std::size_t n = 0; n < row.size(); ++n) {
    if (row[n] == '"' && is_quoted && row[n + 1] == '"') {  // the text ends with zero
      fields.back() += row[++n];
    } else if (row[n] == '"') {
      is_quoted = !is_quoted;
    } else if (row[n] == separator && !is_quoted) {
      fields.emplace_back();
    } else {
      fields.back() += row[n];
    }
  }
  return fields;
}

/// Returns the position of a column; 0: there is none.
std::size_t column_of(const std::vector<std::string>& titles, const std::string& column) {
  const auto found = std::find(titles.begin() + 1, titles.end(), column);
  if (found != titles.end()) {
    return static_cast<std::size_t>(found - titles.begin());
  }
  for (std::size_t n = 1; n < titles.size(); ++n) {
    if (column == std::to_string(n + 1) || (column.empty() && n == 1)) {
      return n;
    }
  }
  return 0;
}

std::optional<Micros> seconds_in(const std::string& text) {
  std::string_view rest;
  const std::optional<double> number = real_in(text, rest);
  const bool is_time = number && rest.empty() && *number >= 0 && *number < longest_seconds;
  return is_time ? std::optional(static_cast<Micros>(std::llround(*number * 1e6))) : std::nullopt;
}

bool is_number(ValueType type) { return type.kind != ValueType::Kind::text && type.kind != ValueType::Kind::bytes; }

/// Adds the value of a row.
/// \retval text  the fault of the row
std::string add_row(std::vector<std::string> fields, std::size_t column, bool has_commas, ValueType type,
                    std::vector<TimedValue>& values) {
  if (fields.size() <= column) {
    return fmt::format("has no column {}", column + 1);
  }
  if (has_commas) {
    std::replace(fields[0].begin(), fields[0].end(), ',', '.');
  }
  if (has_commas && is_number(type)) {
    std::replace(fields[column].begin(), fields[column].end(), ',', '.');
  }
  const std::optional<Micros> time = seconds_in(fields[0]);
  if (!time || (!values.empty() && *time < values.back().time)) {
    return '\'' + fields[0] + (time ? "' is less than the time before" : "' is no time in s");
  }
  if (fields[column].empty()) {
    return {};
  }
  values.push_back({*time, fields[column]});
  return encode_rounded(type, fields[column]).fault;
}

std::string text_of(const nlohmann::ordered_json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

PlayedLine parse_line(const std::string& text) {
  PlayedLine line;
  const auto json = nlohmann::ordered_json::parse(text, nullptr, false);
  if (!json.is_object()) {
    line.fault = "is no JSON object, such as {\"6064\": 1000}";
    return line;
  }
  for (const auto& item : json.items()) {
    const nlohmann::ordered_json& value = item.value();
    if (value.is_structured() || value.is_null()) {
      line.fault = "'" + item.key() + "' is no number, text, true or false";
      return line;
    }
    if (item.key() == "time") {
      line.time = seconds_in(text_of(value));
      line.fault = !line.time ? "\"time\" is no time in s" : line.fault;
    } else if (item.key() == "node") {
      const bool is_node = value.is_number_unsigned() && value <= 127;
      line.node = is_node ? value.get<unsigned>() : 0;
      line.fault = !is_node ? "\"node\" is no node-ID" : line.fault;
    } else if (item.key() == "command") {
      line.command = text_of(value);
    } else {
      line.values.emplace_back(item.key(), text_of(value));
    }
  }
  return line;
}

}  // namespace

Encoded encode_rounded(ValueType type, const std::string& text) {
  constexpr double most = 9e18;
  const bool is_integer = type.kind == ValueType::Kind::integer || type.kind == ValueType::Kind::unsigned_integer;
  std::string_view rest;
  const std::optional<double> real = is_integer ? real_in(text, rest) : std::nullopt;
  const bool is_rounded =
      real && rest.empty() && std::abs(*real) < most && text.find_first_of(".eE") != std::string::npos;
  return encode(type, is_rounded ? std::to_string(std::llround(*real)) : text);
}

std::vector<TimedValue> read_csv(const std::string& path, const std::string& column, ValueType type, std::string& why) {
  const std::optional<std::string> text = read_small_file(path, why);
  if (!text) {
    return {};
  }
  std::vector<TimedValue> values;
  std::size_t position = 0;  // of the column
  char separator = ',';
  unsigned number = 0;
  for (std::size_t begin = 0; begin < text->size();) {
    const std::size_t end = std::min(text->find('\n', begin), text->size());
    std::string row = text->substr(begin, end - begin);
    row.erase(row.find_last_not_of('\r') + 1);
    begin = end + 1;
    ++number;
    if (number == 1) {
      separator = row.find(';') != std::string::npos ? ';' : ',';
      position = column_of(fields_of(row, separator), column);
      if (position == 0) {
        why = path + (column.empty() ? ": the first line has no titles of two columns" : " has no column " + column);
        return {};
      }
      continue;
    }
    const std::string fault =
        row.empty() ? "" : add_row(fields_of(row, separator), position, separator == ';', type, values);
    if (!fault.empty()) {
      why = fmt::format("{}, line {}: {}", path, number, fault);
      return {};
    }
  }
  why = values.empty() ? path + " has no values" : "";
  return values;
}

Playback::~Playback() {
  if (fd_ >= 0) {
    close(fd_);
  }
}

bool Playback::open(std::string& why) {
  struct stat state {};
  fd_ = open_source(path_, state, why);
  is_fifo_ = fd_ >= 0 && S_ISFIFO(state.st_mode);
  return fd_ >= 0;
}

std::optional<PlayedLine> Playback::next(Micros now) {
  while (!waiting_) {
    std::string fault;
    const std::optional<std::string> text = read_line(fault);
    if (!text && fault.empty()) {
      return std::nullopt;
    }
    if (text && text->find_first_not_of(" \t\r") == std::string::npos) {
      continue;
    }
    waiting_ = text ? parse_line(*text) : PlayedLine{{}, {}, {}, {}, {}, fault};
    waiting_->place = fmt::format("{}, line {}", path_, number_);
  }
  const bool is_due = !waiting_->fault.empty() || begin_ + waiting_->time.value_or(0) <= now;
  return is_due ? std::exchange(waiting_, std::nullopt) : std::nullopt;
}

Micros Playback::due(Micros now) const {
  constexpr Micros interval = 10 * millisecond;
  return waiting_ ? begin_ + waiting_->time.value_or(0) : now + interval;
}

/// Returns the next complete line. Nothing and a fault: it is too long, and is skipped.
std::optional<std::string> Playback::read_line(std::string& fault) {
  for (;;) {
    const std::size_t end = text_.find('\n');
    const bool is_too_long = std::min(end, text_.size()) > longest_line && !is_skipping_;
    std::string line = text_.substr(0, end);
    if (end != std::string::npos || is_too_long || is_skipping_) {
      text_.erase(0, end == std::string::npos ? end : end + 1);
    }
    if (is_too_long) {
      ++number_;
      is_skipping_ = end == std::string::npos;
      fault = "is longer than 64 KiB";
      return std::nullopt;
    }
    if (end != std::string::npos && !std::exchange(is_skipping_, false)) {
      ++number_;
      return line;
    }
    if (end == std::string::npos && !read_bytes()) {
      return std::nullopt;
    }
  }
}

/// Reads what is there. The end of the file, or of a writer of the FIFO, also ends a line.
bool Playback::read_bytes() {
  char buffer[4096];
  const ssize_t size = read(fd_, buffer, sizeof buffer);
  if (size > 0) {
    text_.append(buffer, static_cast<std::size_t>(size));
    return true;
  }
  const bool is_at_end = size == 0 || (errno != EAGAIN && errno != EINTR);
  if (is_at_end && (!text_.empty() || is_skipping_)) {
    text_ += '\n';
    return true;
  }
  has_ended_ = is_at_end && !(is_fifo_ && size == 0);
  return false;
}

}  // namespace lexican::simulate
