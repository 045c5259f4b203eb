// SPDX-License-Identifier: Apache-2.0
/// \file request.hpp
/// Transfers one object by SDO for a command line, and reports how it ended.
#pragma once

#include <ostream>
#include <string>

#include "client/arguments.hpp"
#include "client/progress.hpp"
#include "client/sdo_client.hpp"
#include "host/host.hpp"

namespace demo {

struct Outcome {
  Transfer transfer;
  std::string bus_fault;  // what is wrong with the bus; empty: nothing so far
  bool interrupted;
};

/// Goes on the bus as a node, and transfers the object. The progress is shown on \a err.
Outcome carry_out(const Request& request, Host& host, Progress::Form form, std::ostream& err);

/// Writes the value that was read to \a out (or the bytes to the file), and nothing else there; what went wrong to \a
/// err. Returns the exit code.
int report(const Request& request, const Outcome& outcome, std::ostream& out, std::ostream& err);

}  // namespace demo
