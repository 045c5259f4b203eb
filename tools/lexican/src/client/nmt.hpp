// SPDX-License-Identifier: Apache-2.0
/// \file nmt.hpp
/// Sends an NMT command for a command line. [301:7.2.8.2.1]
#pragma once

#include <ostream>

#include "client/arguments.hpp"
#include "host/host.hpp"

namespace lexican {

/// Starts a separate node on the bus and sends the command. Prints faults to \a err. Returns the exit code.
int carry_out(const NmtRequest& request, Host& host, std::ostream& err);

}  // namespace lexican
