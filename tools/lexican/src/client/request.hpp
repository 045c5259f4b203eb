// SPDX-License-Identifier: Apache-2.0
/// \file request.hpp
/// Transfers one object by SDO for a command line, and prints the result.
#pragma once

#include <ostream>
#include <string>

#include "client/arguments.hpp"
#include "client/progress.hpp"
#include "client/sdo_client.hpp"
#include "host/host.hpp"

namespace lexican {

struct Outcome {
  Transfer transfer;
  std::string bus_fault;  // fault of the bus; empty: none
  bool interrupted;
};

/// Starts a node with the node-ID own_id of the request and transfers the object with its SDO client. Prints the
/// progress to \a err.
Outcome carry_out(const Request& request, Host& host, Progress::Form form, std::ostream& err);

/// Prints the value to \a out, or writes the bytes to the file; prints faults to \a err. Returns the exit code.
int report(const Request& request, const Outcome& outcome, std::ostream& out, std::ostream& err);

}  // namespace lexican
