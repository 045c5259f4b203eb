// SPDX-License-Identifier: Apache-2.0
/// \file tour.hpp
/// lexican-demo-master tour: shows the functions of a demo clock elsewhere on the bus.
#pragma once

#include <ostream>

#include "host/host.hpp"
#include "tour/view.hpp"

namespace lexican::demo {

/// Starts a separate node on the bus and runs the tour with the clock whose node-ID is \a node. Prints to \a out.
/// Returns the exit code.
int run_clock_tour(std::uint8_t node, Host& host, View::Style style, std::ostream& out);

}  // namespace lexican::demo
