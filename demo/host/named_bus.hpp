// SPDX-License-Identifier: Apache-2.0
/// \file named_bus.hpp
/// The bus that the option -i,--bus names, in real time.
#pragma once

#include <memory>
#include <string>

#include "host/bus_host.hpp"

namespace lexican::demo {

constexpr const char* default_interface = "vcan0";
constexpr const char* bus_help = "Bus: can0, hub:NAME, slcan:DEVICE@RATE, slcan-pty, socketcand:HOST:PORT/can0";

/// Ends of the bus that a program uses.
enum class Ends { device, master, both };

struct NamedBus {
  std::unique_ptr<host_bus::Bus> device = {};
  std::unique_ptr<host_bus::Bus> master = {};  // null: device is the only end
  std::unique_ptr<Host> host = {};             // null: the bus could not be opened
  std::string about = {};                      // the bus in words; without host: the fault
  std::string name_for_others = {};            // by which other programs open it
};

/// Opens a bus of tools/lexican/docs/lexican.md. Empty: vcan0 if it is up, else hub:demo. A bus that one program uses
/// alone, such as an slcan adapter, cannot have both ends.
NamedBus open_bus(const std::string& name, Ends ends, const Interruption& interruption);

}  // namespace lexican::demo
