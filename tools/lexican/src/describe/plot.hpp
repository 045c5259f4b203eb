// SPDX-License-Identifier: Apache-2.0
/// \file plot.hpp
/// Curves of values over time: with Braille characters in a terminal, and as SVG.
#pragma once

#include <string>
#include <vector>

namespace lexican::describe {

struct Point {
  double time = 0;  ///< s
  double value = 0;
};

/// A value between two points is that of the first one, as a device sends it.
struct Range {
  double from = 0;  ///< s
  double to = 0;
  double low = 0;  ///< value at the lower border
  double high = 0;
};

/// Returns the range of all points; an empty one without points, and a wider one if all values are equal.
Range range_of(const std::vector<Point>& points);

/// Draws a curve with Braille characters, of which each has 2 x 4 dots. Points must be in the order of their times;
/// those outside of the range are not drawn.
/// \retval lines  as many as \a rows, from the top, each of \a columns characters in UTF-8
std::vector<std::string> braille(const std::vector<Point>& points, const Range& range, unsigned columns, unsigned rows);

struct Curve {
  std::string name;
  std::vector<Point> points;
};

/// Returns an SVG image with a diagram for each curve, one below the other, over the same time.
std::string to_svg(const std::string& title, const std::vector<Curve>& curves);

}  // namespace lexican::describe
