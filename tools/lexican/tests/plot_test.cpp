// SPDX-License-Identifier: Apache-2.0
#include "describe/plot.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace {

using namespace lexican::describe;
using Lines = std::vector<std::string>;

TEST_CASE("plot: a curve in Braille characters holds each value until the next") {
  // 4 x 8 dots. Rows from the bottom: value 0 is row 0, value 8 row 7.
  CHECK(braille({{0, 0}, {2, 8}, {3, 8}}, {0, 4, 0, 8}, 2, 2) == Lines{"⠀⡏", "⣀⡇"});
  CHECK(braille({}, {0, 4, 0, 8}, 2, 1) == Lines{"⠀⠀"});
  CHECK(braille({{0, 1}}, {}, 0, 1) == Lines{""});
}

TEST_CASE("plot: points outside of the range, and values that are no numbers") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  CHECK(braille({{-5, 8}, {2, 8}, {3, none}, {9, 0}}, {0, 4, 0, 8}, 2, 1) == Lines{"⠉⠁"});
  CHECK(braille({{0, 1e308}, {4, -1e308}}, {0, 4, 0, 8}, 2, 1) == Lines{"⠉⢹"});
}

TEST_CASE("plot: the range of equal values is not empty") {
  const Range range = range_of({{1, 5}, {3, 5}});
  CHECK(range.from == 1);
  CHECK(range.to == 3);
  CHECK(range.low < 5);
  CHECK(range.high > 5);
}

TEST_CASE("plot: a range that is wider than a number, and values that are infinite") {
  const double most = std::numeric_limits<double>::max();
  const std::vector<Point> points = {{0, -most}, {1, std::numeric_limits<double>::infinity()}, {2, most}};
  const Range range = range_of(points);
  CHECK(range.low == -most);
  CHECK(range.high == most);
  CHECK(braille(points, range, 1, 1) == Lines{"⣸"});
  const std::string svg = to_svg("node 5", {{"speed", points}});
  CHECK(svg.find("M90.00 260.00H940.00V40.00") != std::string::npos);
  CHECK(svg.find("nan") == std::string::npos);
  CHECK(svg.find("inf") == std::string::npos);
}

TEST_CASE("plot: an SVG has a diagram for each curve") {
  const std::string svg = to_svg("node 5", {{"speed <rpm>\x1b", {{0, 0}, {1, 10}}}, {"none", {}}});
  CHECK(svg.find("<title>node 5</title>") != std::string::npos);
  CHECK(svg.find("speed &lt;rpm&gt;?") != std::string::npos);
  CHECK(svg.find("M90.00 260.00H940.00V40.00") != std::string::npos);
  CHECK(svg.find("none: no value") != std::string::npos);
}

}  // namespace
