// SPDX-License-Identifier: Apache-2.0
/// \file tour.hpp
/// lexican-demo-master tour: shows what a demo clock can do that runs elsewhere on the bus.
#pragma once

#include <ostream>

#include "host/host.hpp"
#include "tour/view.hpp"

namespace demo {

/// Goes on the bus as a node, and takes the tour with the clock \a node. All that is seen goes to \a out. Returns the
/// exit code.
int take_tour_with(std::uint8_t node, Host& host, View::Style style, std::ostream& out);

}  // namespace demo
