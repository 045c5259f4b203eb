// SPDX-License-Identifier: Apache-2.0
#include "host/named_bus.hpp"

#include "bus/open.hpp"

namespace lexican::demo {
namespace {

constexpr const char* default_hub = "hub:demo";

/// \retval null  \a why says why
std::unique_ptr<host_bus::Bus> open_end(const std::string& name, std::string& why) {
  std::unique_ptr<host_bus::Bus> bus = host_bus::open_bus(name, {}, why);
  if (bus != nullptr && !bus->fault().empty()) {  // an interface that is down
    why = bus->fault();
    return nullptr;
  }
  return bus;
}

NamedBus open_default(Ends ends, const Interruption& interruption) {
  NamedBus interface = open_bus(default_interface, ends, interruption);
  if (interface.host != nullptr) {
    return interface;
  }
  NamedBus hub = open_bus(default_hub, ends, interruption);
  hub.about += "; " + interface.about;
  return hub;
}

}  // namespace

NamedBus open_bus(const std::string& name, Ends ends, const Interruption& interruption) {
  if (name.empty()) {
    return open_default(ends, interruption);
  }
  NamedBus bus;
  if (ends == Ends::both && name.compare(0, 5, "slcan") == 0) {
    bus.about = name + ": only one node can use it; for two, use a CAN interface or a hub";
    return bus;
  }
  bus.device = open_end(name, bus.about);
  bus.master = ends == Ends::both && bus.device != nullptr ? open_end(name, bus.about) : nullptr;
  if (bus.device == nullptr || (ends == Ends::both && bus.master == nullptr)) {
    return bus;
  }
  const std::string note = bus.device->note();
  bus.about = name + (note.empty() ? "" : ", " + note);
  bus.name_for_others = note.empty() ? name : "slcan:" + note.substr(note.rfind(' ') + 1);
  const auto role = ends == Ends::master ? BusHost::Role::master : BusHost::Role::device;
  host_bus::Bus& master = bus.master == nullptr ? *bus.device : *bus.master;
  bus.host = std::make_unique<BusHost>(*bus.device, master, interruption, role);
  return bus;
}

}  // namespace lexican::demo
