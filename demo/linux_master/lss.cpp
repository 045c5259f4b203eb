// SPDX-License-Identifier: Apache-2.0
#include "linux_master/lss.hpp"

#include "client/lss_master.hpp"
#include "client/sdo_client.hpp"
#include "host/exit.hpp"
#include "host/loop.hpp"
#include "host/node.hpp"
#include "trace/text.hpp"

namespace demo {

#if USE_LSS_MASTER

namespace {

constexpr Micros last_frames = 100 * millisecond;  // for these to find their way to the bus
constexpr std::uint8_t no_sdo = 1;                 // server of an SDO client that is not used
constexpr std::uint8_t waiting = CO_LSSM_WAITING;

std::string shown(const LssAddress& address) {
  return text("0x%08X 0x%08X 0x%08X 0x%08X", address[0], address[1], address[2], address[3]);
}

/// A slave that was found stays in the state configuration, where no fastscan finds it again.
bool scan(LssMaster& master, std::ostream& out) {
  while (master.run(COLssmFastscan, nullptr, std::uint8_t{0})) {
    out << shown(master.address()) << std::endl;
  }
  return master.nobody_found();
}

bool select(LssMaster& master, const LssRequest& request, std::ostream& out) {
  if (request.address) {
    return master.run(COLssmSwitchSelective, request.address->data());
  }
  const bool found = master.run(COLssmFastscan, nullptr, std::uint8_t{0});
  if (found) {
    out << shown(master.address()) << std::endl;
  }
  return found;
}

bool inquire(LssMaster& master, std::ostream& out) {
  constexpr const char* parts[] = {"vendor-ID      ", "product code   ", "revision number", "serial number  "};
  for (std::uint8_t part = 0; part < CO_LSSM_PARTS; ++part) {
    if (!master.run(COLssmInquire, part)) {
      return false;
    }
    out << parts[part] << text(" 0x%08X", master.value()) << std::endl;
  }
  if (!master.run(COLssmInquireNodeId)) {
    return false;
  }
  out << "node-ID         " << (master.value() == no_node_id ? "none" : std::to_string(master.value())) << std::endl;
  return true;
}

bool act(LssMaster& master, const LssRequest& request, std::ostream& out) {
  switch (request.action) {
    case LssAction::set_id: return master.run(COLssmConfigureNodeId, static_cast<std::uint8_t>(request.value));
    case LssAction::set_bit_rate: return master.run(COLssmConfigureBitTiming, request.value);
    case LssAction::store: return true;
    case LssAction::inquire: return inquire(master, out);
    default: return false;
  }
}

bool work(LssMaster& master, const LssRequest& request, std::ostream& out) {
  if (!master.run(COLssmSwitchGlobal, waiting)) {
    return false;
  }
  if (request.action == LssAction::scan) {
    return scan(master, out);
  }
  return select(master, request, out) && act(master, request, out) && (!request.store || master.run(COLssmStore));
}

}  // namespace

int carry_out(const LssRequest& request, Host& host, std::ostream& out, std::ostream& err) {
  ClientDictionary dictionary(no_sdo);
  Node node({request.own_id, host.master_can(), host.master_timer(), dictionary.table()});
  Loop loop(host, {&node});
  LssMaster master(node, loop, {request.timeout, request.listen});
  CONodeStart(&node.stack());
  const bool done = work(master, request, out);
  const bool cancelled = !done && master.cancelled() && !host.bus_lost();
  if (!done) {
    const std::string bus_fault = host.bus_fault();
    err << "LSS: " << master.fault() << (bus_fault.empty() ? "" : '\n' + bus_fault) << std::endl;
  }
  master.run(COLssmSwitchGlobal, waiting);
  loop.flush(last_frames);
  return done ? exit_ok : (cancelled ? exit_interrupted : exit_failed);
}

#else

int carry_out(const LssRequest&, Host&, std::ostream&, std::ostream& err) {
  err << "this build of the stack has no LSS master" << std::endl;
  return exit_usage;
}

#endif

}  // namespace demo
