// SPDX-License-Identifier: Apache-2.0
/// \file row.hpp
/// The rows of the speed table.
#pragma once

#include <string>
#include <vector>

#include "transfer.hpp"

namespace speed {

struct Row {
  std::string hardware;  ///< description of bus and nodes
  std::string transfer;  ///< description of the transfer
  std::size_t number;    ///< number of consecutive transfers; 1: the table has their duration, else their rate
  double micros;         ///< measured duration of all transfers
  double ideal_micros;   ///< duration of all transfers with the frames of the standard back to back
  double load;           ///< share of the time in which the bus is busy: 0…1
  double known_micros;   ///< published limit for all transfers; 0: none
  double budget;         ///< least share of the limits that must be reached; 0: the row is only reported
  std::string peers;     ///< published results of other stacks

  double of_limit() const { return ideal_micros / micros; }
  double of_known_limit() const { return known_micros / micros; }
};

/// Measures all rows.
std::vector<Row> measure_rows();

}  // namespace speed
