// SPDX-License-Identifier: Apache-2.0
/// \file tour.hpp
/// What the demo shows: steps that a master takes with the clock, each with what is expected of it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "linux_node/master.hpp"
#include "linux_node/view.hpp"

namespace demo {

struct TourResult {
  unsigned steps = 0;               // taken to their end
  std::size_t of = 0;               // steps that there are
  std::vector<std::string> shown;   // what those that went as expected have shown
  std::vector<std::string> failed;  // titles of the others
  Micros duration = 0;
  bool interrupted = false;
};

/// Takes all steps, one after the other, whatever the result of those before. A clock without node-ID gets it from the
/// master.
TourResult take_tour(Clock& clock, Master& master, View& view);

/// The last words: what was shown, and what the node has counted.
void summarise(const TourResult& result, const CO_NODE_COUNTERS& counters, View& view);
void show_counters(const CO_NODE_COUNTERS& counters, View& view);

}  // namespace demo
