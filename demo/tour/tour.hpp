// SPDX-License-Identifier: Apache-2.0
/// \file tour.hpp
/// What the demo shows: steps that a master takes with the clock, each with what is expected of it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tour/master.hpp"
#include "tour/view.hpp"

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
TourResult take_tour(Device& device, Master& master, View& view);

/// The last words: what was shown, and what a node has counted. \a whose: the label before its counters.
void summarise(const TourResult& result, const CO_NODE_COUNTERS& counters, View& view, const char* whose = "node");
void show_counters(const CO_NODE_COUNTERS& counters, View& view, const char* whose = "node");

}  // namespace demo
