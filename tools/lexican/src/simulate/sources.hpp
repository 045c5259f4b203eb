// SPDX-License-Identifier: Apache-2.0
/// \file sources.hpp
/// Sources of the values of simulated devices: tables over time (CSV), and JSON lines.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/values.hpp"
#include "host/host.hpp"

namespace lexican::simulate {

/// Converts text to bytes like encode(), and rounds a real number for an integer.
Encoded encode_rounded(ValueType type, const std::string& text);

/// Value of an object from a time on.
struct TimedValue {
  Micros time;
  std::string text;
};

constexpr std::size_t most_csv_bytes = 8U << 20;

/// Reads a column of a CSV, which encode_rounded() can convert. \a column: title or number; empty: the second one
/// \retval empty  \a why says why
std::vector<TimedValue> read_csv(const std::string& path, const std::string& column, ValueType type, std::string& why);

/// A line that sets values or executes a command.
struct PlayedLine {
  std::string place;  ///< file and number of the line
  std::optional<Micros> time;
  std::optional<unsigned> node;
  std::string command;
  std::vector<std::pair<std::string, std::string>> values;  ///< object, and text
  std::string fault;                                        ///< the line has no effect
};

/// JSON lines of a file, a FIFO or a pipe. Context: one thread. It does not wait for the writer.
class Playback {
 public:
  static constexpr std::size_t longest_line = 65536;

  /// \a begin: time to which those of the lines are added
  Playback(std::string path, Micros begin) : path_(std::move(path)), begin_(begin) {}
  ~Playback();
  Playback(const Playback&) = delete;
  Playback& operator=(const Playback&) = delete;

  /// \retval false  \a why says why
  bool open(std::string& why);
  /// Returns the next line whose time has come.
  std::optional<PlayedLine> next(Micros now);
  /// Returns true after the last line. A FIFO does not end.
  bool has_ended() const { return has_ended_; }
  /// Returns the time at which next() has to be called again after it has returned nothing.
  Micros due(Micros now) const;

 private:
  std::optional<std::string> read_line(std::string& fault);
  bool read_bytes();

  std::string path_;
  Micros begin_;
  int fd_ = -1;
  bool is_fifo_ = false;
  bool has_ended_ = false;
  bool is_skipping_ = false;  ///< the rest of a line that is too long
  unsigned number_ = 0;       ///< of the last line
  std::string text_;
  std::optional<PlayedLine> waiting_;
};

}  // namespace lexican::simulate
