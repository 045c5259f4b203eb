// SPDX-License-Identifier: Apache-2.0
#include "describe/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lexican::describe {
namespace {

constexpr unsigned dot_columns = 2;  // of a character
constexpr unsigned dot_rows = 4;

/// Bits of the dots of U+2800 ff., by row and column.
constexpr unsigned dots[dot_rows][dot_columns] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};

/// Returns the character of the Basic Multilingual Plane from U+0800 in UTF-8.
std::string utf8(unsigned code) {
  return {static_cast<char>(0xE0U | code >> 12), static_cast<char>(0x80U | (code >> 6 & 0x3FU)),
          static_cast<char>(0x80U | (code & 0x3FU))};
}

/// Returns the cell of a value among a number of cells; values at and beyond the borders are in the outer cells.
unsigned cell_of(double value, double low, double high, unsigned cells) {
  // Halves: the difference of two numbers may be beyond the range of a number.
  const double part = high > low ? (value / 2 - low / 2) / (high / 2 - low / 2) : 0.5;
  return static_cast<unsigned>(std::clamp(part * cells, 0.0, static_cast<double>(cells - 1)));
}

class Dots {
 public:
  Dots(unsigned columns, unsigned rows) : columns_(columns), cells_(std::size_t{columns} * rows) {}

  unsigned columns() const { return columns_ * dot_columns; }
  unsigned rows() const { return static_cast<unsigned>(cells_.size() / columns_) * dot_rows; }
  /// Sets the dots of a column between two rows, of which 0 is the lowest.
  void set(unsigned column, unsigned one, unsigned other) {
    for (unsigned row = std::min(one, other); row <= std::max(one, other); ++row) {
      const unsigned from_top = rows() - 1 - row;
      cells_[std::size_t{from_top / dot_rows} * columns_ + column / dot_columns] |=
          dots[from_top % dot_rows][column % dot_columns];
    }
  }
  std::vector<std::string> lines() const {
    std::vector<std::string> lines;
    for (std::size_t n = 0; n < cells_.size(); ++n) {
      if (n % columns_ == 0) {
        lines.emplace_back();
      }
      lines.back() += utf8(0x2800U + cells_[n]);
    }
    return lines;
  }

 private:
  unsigned columns_;
  std::vector<unsigned> cells_;
};

/// Returns a text as SVG needs it. Control characters, which XML does not allow, become question marks.
std::string xml_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      default: result += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
    }
  }
  return result;
}

/// Returns the distance of the lines of a grid: 1, 2 or 5 times a power of ten, for at most six lines.
double step_of(double low, double high) {
  const double least = high / 6 - low / 6;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least) {
      return factor * power;
    }
  }
  return 10 * power;
}

/// Returns the values of the lines of a grid.
std::vector<double> grid_of(double low, double high) {
  std::vector<double> values;
  const double step = step_of(low, high);
  constexpr std::size_t most = 12;  // a range that is not finite has no end
  for (double n = std::ceil(low / step); n * step <= high && values.size() < most; ++n) {
    values.push_back(n * step);
  }
  return values;
}

constexpr int width = 960;  // of the image, px
constexpr int diagram = 220;
constexpr int left = 90;
constexpr int right = 20;
constexpr int top = 40;
constexpr int gap = 50;

std::string svg_diagram(const Curve& curve, const Range& time, int y) {
  Range range = range_of(curve.points);
  range.from = time.from;
  range.to = time.to;
  const auto x_of = [&](double t) {
    return left + (t - range.from) / (range.to - range.from) * (width - left - right);
  };
  const auto y_of = [&](double v) {
    return y + diagram - (v / 2 - range.low / 2) / (range.high / 2 - range.low / 2) * diagram;
  };
  std::string text =
      fmt::format("<text x='{}' y='{}' font-weight='bold'>{}</text>\n", left, y - 8, xml_text(curve.name));
  for (const double value : grid_of(range.low, range.high)) {
    text +=
        fmt::format("<path d='M{} {:.1f}H{}' stroke='#ccc'/><text x='{}' y='{:.1f}' text-anchor='end'>{:.6g}</text>\n",
                    left, y_of(value), width - right, left - 6, y_of(value) + 4, value);
  }
  for (const double value : grid_of(range.from, range.to)) {
    text += fmt::format(
        "<path d='M{:.1f} {}V{}' stroke='#ccc'/><text x='{:.1f}' y='{}' text-anchor='middle'>{:.6g} s</text>\n",
        x_of(value), y, y + diagram, x_of(value), y + diagram + 16, value);
  }
  std::string path;
  for (const Point& point : curve.points) {
    if (!std::isfinite(point.value)) {
      continue;
    }
    path += path.empty() ? fmt::format("M{:.2f} {:.2f}", x_of(point.time), y_of(point.value))
                         : fmt::format("H{:.2f}V{:.2f}", x_of(point.time), y_of(point.value));
  }
  return text + fmt::format("<path d='{}' fill='none' stroke='#0060c0' stroke-width='1.5'/>\n", path);
}

}  // namespace

Range range_of(const std::vector<Point>& points) {
  if (points.empty()) {
    return {};
  }
  Range range{points.front().time, points.back().time, 0, 0};
  bool has_value = false;
  for (const Point& point : points) {
    if (std::isfinite(point.value)) {
      range.low = has_value ? std::min(range.low, point.value) : point.value;
      range.high = has_value ? std::max(range.high, point.value) : point.value;
      has_value = true;
    }
  }
  if (range.low == range.high) {
    const double margin = std::max(1.0, std::abs(range.low) / 10);
    range.low -= margin;
    range.high += margin;
  }
  range.to = range.to > range.from ? range.to : range.from + 1;
  return range;
}

std::vector<std::string> braille(const std::vector<Point>& points, const Range& range, unsigned columns,
                                 unsigned rows) {
  if (columns == 0 || rows == 0) {
    return std::vector<std::string>(rows);
  }
  Dots picture(columns, rows);
  bool has_last = false;
  unsigned last_column = 0;
  unsigned last_row = 0;
  for (const Point& point : points) {
    if (!std::isfinite(point.value) || point.time > range.to) {
      continue;
    }
    const unsigned row = cell_of(point.value, range.low, range.high, picture.rows());
    if (point.time < range.from) {  // its value is that of the left border
      has_last = true;
      last_column = 0;
      last_row = row;
      continue;
    }
    const unsigned column = cell_of(point.time, range.from, range.to, picture.columns());
    for (unsigned n = last_column; has_last && n < column; ++n) {
      picture.set(n, last_row, last_row);
    }
    picture.set(column, has_last ? last_row : row, row);
    has_last = true;
    last_column = column;
    last_row = row;
  }
  return picture.lines();
}

std::string to_svg(const std::string& title, const std::vector<Curve>& curves) {
  Range time;
  bool is_first = true;
  for (const Curve& curve : curves) {
    if (!curve.points.empty()) {
      const Range range = range_of(curve.points);
      time.from = is_first ? range.from : std::min(time.from, range.from);
      time.to = is_first ? range.to : std::max(time.to, range.to);
      is_first = false;
    }
  }
  const int height = top + static_cast<int>(curves.size()) * (diagram + gap) + 10;
  std::string text = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
      "font-family='sans-serif' font-size='12'>\n<title>{2}</title>\n<rect width='100%' height='100%' fill='#fff'/>\n",
      width, height, xml_text(title));
  int y = top;
  for (const Curve& curve : curves) {
    text += curve.points.empty()
                ? fmt::format("<text x='{}' y='{}'>{}: no value</text>\n", left, y - 8, xml_text(curve.name))
                : svg_diagram(curve, time, y);
    y += diagram + gap;
  }
  return text + "</svg>\n";
}

}  // namespace lexican::describe
