// SPDX-License-Identifier: Apache-2.0
/// \file lss.hpp
/// Finds and configures nodes by their LSS address, for a command line. [305]
#pragma once

#include <functional>
#include <ostream>

#include "client/arguments.hpp"
#include "client/lss_master.hpp"
#include "host/host.hpp"

namespace lexican {

/// Starts a separate node on the bus and executes the request; all slaves are then in the state waiting. Prints found
/// slaves and inquired values to \a out, faults to \a err. Returns the exit code.
int carry_out(const LssRequest& request, Host& host, std::ostream& out, std::ostream& err);

#if USE_LSS_MASTER

/// Finds the nodes without node-ID by fastscan, and calls \a found for each; all slaves are then in the state waiting.
/// \retval false  \a fault says why the search has ended early
bool find_unconfigured(Host& host, LssMaster::Times times, const std::function<void(const LssAddress&)>& found,
                       std::string& fault);

#endif

}  // namespace lexican
