// SPDX-License-Identifier: Apache-2.0
/// \file lss.hpp
/// Finds and configures nodes by their LSS address, for a command line. [305]
#pragma once

#include <ostream>

#include "client/arguments.hpp"
#include "host/host.hpp"

namespace lexican {

/// Starts a separate node on the bus and executes the request; all slaves are then in the state waiting. Prints found
/// slaves and inquired values to \a out, faults to \a err. Returns the exit code.
int carry_out(const LssRequest& request, Host& host, std::ostream& out, std::ostream& err);

}  // namespace lexican
