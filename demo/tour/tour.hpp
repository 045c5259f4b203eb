// SPDX-License-Identifier: Apache-2.0
/// \file tour.hpp
/// Steps of the tour that a master executes with the clock, each with its expected result.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tour/master.hpp"
#include "tour/view.hpp"

namespace lexican::demo {

struct TourResult {
  unsigned steps = 0;               // completed steps
  std::size_t total = 0;            // number of all steps
  std::vector<std::string> shown;   // results of the successful steps
  std::vector<std::string> failed;  // titles of the failed steps
  Micros duration = 0;
  bool interrupted = false;
};

/// Runs all steps, even after failed ones. The master configures a clock without node-ID.
TourResult run_tour(Device& device, Master& master, View& view);

/// Prints the summary: results, and counters of a node. \a label: text before the counters.
void print_summary(const TourResult& result, const CO_NODE_COUNTERS& counters, View& view, const char* label = "node");
void print_counters(const CO_NODE_COUNTERS& counters, View& view, const char* label = "node");

}  // namespace lexican::demo
