// SPDX-License-Identifier: Apache-2.0
/// \file recorder_csv.hpp
/// Reads the CSV of a recorder (docs/recorder.md): lines "time;value" with the time in ms, and comments that describe
/// the curve.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace lexican::describe {

struct RecorderPoint {
  std::uint64_t time = 0;  ///< ms; does not wrap
  std::int64_t value = 0;
};

struct RecorderCurve {
  std::string name = "value";
  std::string object;  ///< can be empty
  std::string colour;  ///< RRGGBB; empty: not given
  bool has_trigger = false;
  std::uint64_t trigger = 0;  ///< ms, on the time axis of the points
  std::vector<RecorderPoint> points;
};

/// Returns whether a file that begins with a character can be the CSV of a recorder, and no log.
bool begins_recorder_csv(char first);

/// Reads a curve.
/// \retval false  it is malformed or has no points; \a why says so behind "FILE:", with the number of the line if there
/// is one
bool read_recorder_csv(std::istream& input, RecorderCurve& curve, std::string& why);

}  // namespace lexican::describe
