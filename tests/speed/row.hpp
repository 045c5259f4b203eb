// SPDX-License-Identifier: Apache-2.0
/// \file row.hpp
/// The rows of the speed table.
#pragma once

#include <string>
#include <vector>

#include "transfer.hpp"

namespace speed {

struct Row {
  std::string hardware;  ///< in words
  std::string transfer;  ///< in words
  std::size_t number;    ///< of transfers, one after the other; 1: their time is told, else their rate
  double micros;         ///< that all of them took
  double ideal_micros;   ///< that they would take with the frames of the standard back to back
  double load;           ///< of the bus meanwhile: 1 = always busy
  double known_micros;   ///< the limit of all of them, known from elsewhere; 0: none is
  double budget;         ///< least part of the limits to be reached; 0: only reported
  std::string peers;     ///< what others publish

  double of_limit() const { return ideal_micros / micros; }
  double of_known_limit() const { return known_micros / micros; }
};

/// Measures all of them.
std::vector<Row> measure_rows();

}  // namespace speed
