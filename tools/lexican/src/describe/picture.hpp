// SPDX-License-Identifier: Apache-2.0
/// \file picture.hpp
/// An HTML page that shows a trace, the values of PDOs, or the curve of a recorder. It is one file, which loads
/// nothing.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "describe/monitor.hpp"

namespace lexican::describe {

/// A cause of a fault, with the frames that show it. Times are in seconds since the first frame.
struct Cause {
  std::string title;
  std::string text;
  std::string check;      ///< what to look at; can be empty
  std::string fix;        ///< what to change; can be empty
  std::uint8_t node = 0;  ///< 0: none
  double since = 0;
  double until = 0;
  std::vector<double> times;
};

/// Names and numbers at the top of the page.
struct PictureHead {
  std::string source;  ///< name of the file or the bus
  Micros begin = 0;    ///< time of the first frame since 1970; 0: unknown
  Micros duration = 0;
  std::uint64_t frames = 0;
  std::uint64_t errors = 0;
  std::uint64_t lost = 0;
  std::uint32_t bit_rate = 0;  ///< 0: unknown
  bool is_recorder = false;    ///< a curve alone, whose times are those of the device
};

/// A curve of a number over time.
struct PictureSeries {
  std::string name;
  std::string about;      ///< PDO or object
  std::string unit;       ///< can be empty
  std::string colour;     ///< RRGGBB; empty: the page chooses
  std::uint8_t node = 0;  ///< 0: none
  std::vector<Micros> times;
  std::vector<double> values;
};

/// Collects what the page shows. The memory in use is bounded. Times are in µs since the first frame.
class Picture {
 public:
  static constexpr std::size_t most_lines = 100'000;
  static constexpr std::size_t most_values = 1'000'000;
  static constexpr std::size_t most_series = 1000;
  static constexpr std::size_t most_bins = 2048;  ///< of the curve of the bus load

  /// Adds a frame to the curve of the bus load.
  void count(Micros time, const CO_IF_FRM& frame);
  /// Adds a line of the trace. \a text: as it is shown.
  void add_line(Micros time, const Event& event, const std::string& text);
  /// Adds the values of a PDO.
  void add_values(Micros time, const PdoContent& content);
  /// Adds a whole curve.
  void add_series(PictureSeries series);
  /// Adds a line with a name across all curves.
  void add_mark(Micros time, std::string name) { marks_.emplace_back(time, std::move(name)); }

  std::size_t lines() const { return lines_.size(); }
  std::size_t values() const { return values_; }
  std::uint64_t omitted_lines() const { return omitted_lines_; }
  std::uint64_t omitted_values() const { return omitted_values_; }

  /// Returns the page.
  std::string page(const PictureHead& head, const std::vector<Cause>& causes) const;

 private:
  struct Line {
    Micros time;
    std::uint32_t text;  ///< position in texts_
    Service service;
    std::uint8_t node;
    bool is_fault;
  };
  struct Bin {
    std::uint64_t bits = 0;
    std::uint32_t frames = 0;
    std::uint32_t errors = 0;
  };
  using SeriesKey = std::tuple<std::uint8_t, bool, std::uint16_t, std::uint16_t, std::uint8_t>;

  std::string data(const PictureHead& head, const std::vector<Cause>& causes) const;
  void write_lines(std::string& json) const;
  void write_series(std::string& json) const;
  void write_load(std::string& json) const;

  std::vector<Line> lines_;
  std::unordered_map<std::string, std::uint32_t> texts_;
  std::map<SeriesKey, std::size_t> series_of_;
  std::vector<PictureSeries> series_;
  std::vector<std::pair<Micros, std::string>> marks_;
  std::vector<Bin> bins_;
  Micros bin_ = 1000;  ///< duration of a bin
  std::size_t values_ = 0;
  std::uint64_t omitted_lines_ = 0;
  std::uint64_t omitted_values_ = 0;
};

}  // namespace lexican::describe
