// SPDX-License-Identifier: Apache-2.0
/// \file picture.hpp
/// Pictures of a network as SVG elements of class "network".
#pragma once

#include <string>

#include "network/links.hpp"
#include "network/network.hpp"

namespace lexican::codict::network {

/// Draws the nodes on their bus, with node-ID, name and number of PDOs; a master has a thicker frame.
std::string bus_picture(const Network& network, const Links& links);

/// Draws TPDOs on the left, RPDOs on the right, and a line for each link. Returns an empty text if there are no PDOs.
std::string link_picture(const Network& network, const Links& links);

}  // namespace lexican::codict::network
