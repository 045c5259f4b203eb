// SPDX-License-Identifier: Apache-2.0
#include "co_can_virtual.h"

#include "virtual_bus.hpp"

namespace {

co::VirtualBus* of(CO_VIRTUAL_BUS* bus) { return reinterpret_cast<co::VirtualBus*>(bus); }
co::VirtualBus::Port* of(CO_VIRTUAL_PORT* port) { return reinterpret_cast<co::VirtualBus::Port*>(port); }

}  // namespace

extern "C" {

CO_VIRTUAL_BUS* COVirtualBusNew(void) { return reinterpret_cast<CO_VIRTUAL_BUS*>(new co::VirtualBus); }

void COVirtualBusFree(CO_VIRTUAL_BUS* bus) { delete of(bus); }

CO_VIRTUAL_PORT* COVirtualBusAttach(CO_VIRTUAL_BUS* bus, const char* name) {
  co::VirtualBus::Options options;
  options.name = name;
  return reinterpret_cast<CO_VIRTUAL_PORT*>(&of(bus)->attach(options));
}

void COVirtualBusTrace(CO_VIRTUAL_BUS* bus, CO_VIRTUAL_TRACE trace, void* user) {
  if (trace == nullptr) {
    of(bus)->set_trace({});
    return;
  }
  of(bus)->set_trace([trace, user](const co::VirtualBus::Traffic& traffic) {
    trace(user, &traffic.frame, traffic.sender == nullptr ? "" : traffic.sender->name().c_str());
  });
}

void COVirtualPortEnable(CO_VIRTUAL_PORT* port, uint32_t baud) { of(port)->enable(baud); }

int16_t COVirtualPortSend(CO_VIRTUAL_PORT* port, const CO_IF_FRM* frame) { return of(port)->send(*frame); }

int16_t COVirtualPortRead(CO_VIRTUAL_PORT* port, CO_IF_FRM* frame) { return COVirtualBusDriver.Read(port, frame); }

}  // extern "C"
