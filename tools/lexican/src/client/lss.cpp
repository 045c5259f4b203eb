// SPDX-License-Identifier: Apache-2.0
#include "client/lss.hpp"

#include <algorithm>
#include <vector>

#include "client/lss_master.hpp"
#include "host/exit.hpp"
#include "host/loop.hpp"
#include "host/node.hpp"
#include "trace/text.hpp"

namespace lexican {

#if USE_LSS_MASTER

namespace {

constexpr std::uint8_t own_id = 127;  // of a master without a node-ID of the command line
constexpr std::uint8_t waiting = CO_LSSM_WAITING;

/// How the program names a node, as the remedy for one that disturbs a fastscan.
constexpr const char* by_option = "; disconnect it, or name the node to configure by --address";
constexpr const char* by_name = "; disconnect it, or name the node to configure by VENDOR:PRODUCT:REVISION:SERIAL";

std::string address_text(const LssAddress& address) {
  return text("0x%08X 0x%08X 0x%08X 0x%08X", address[0], address[1], address[2], address[3]);
}

/// Prints the address in the format of --address.
void print_address(std::ostream& out, const LssAddress& address) {
  out << "vendor-ID, product code, revision, serial number: " << address_text(address) << std::endl;
}

/// Returns true if the node in the state configuration has this address; otherwise master.fault() has the reason.
bool has_identity(LssMaster& master, const LssAddress& address) {
  for (std::uint8_t part = 0; part < CO_LSSM_PARTS; ++part) {
    if (!master.inquire(COLssmInquire, part) || !master.is_alone()) {
      return false;
    }
    if (master.value() != address[part]) {
      return master.fail("the node at " + address_text(address) +
                         text(" reports another number: 0x%08X", master.value()));
    }
  }
  return true;
}

/// Finds a node without node-ID and switches it to the state configuration.
bool find_node(LssMaster& master, const std::string& remedy) {
  if (!master.run(COLssmFastscan, nullptr, std::uint8_t{0})) {
    return false;
  }
  if (master.address() == LssAddress{}) {
    return master.fail(
        "fastscan has found the address 0 0 0 0, which no node has: a node answers every request of a fastscan" +
        remedy);
  }
  return master.answers() <= 1 || master.is_alone();  // otherwise the fastscan has already waited for answers
}

/// Selects the node alone by its address. Returns true if it answers and has this address.
bool verify_address(LssMaster& master, const LssAddress& address) {
  if (!master.run(COLssmSwitchGlobal, waiting)) {
    return false;
  }
  if (!master.run_alone(COLssmSwitchSelective, address.data())) {
    return master.timed_out() ? master.fail(address_text(address) + " was found, but does not answer to its address")
                              : false;
  }
  return has_identity(master, address);
}

/// Switches all these nodes to the state configuration, in which they do not answer a fastscan.
bool select_all(LssMaster& master, const std::vector<LssAddress>& addresses) {
  return std::all_of(addresses.begin(), addresses.end(),
                     [&](const LssAddress& address) { return master.run(COLssmSwitchSelective, address.data()); });
}

/// Finds the next node, not one of \a found. Scans again if the node did not answer at the end: an answer was late.
bool find_next_node(LssMaster& master, const std::vector<LssAddress>& found, const std::string& remedy) {
  return find_node(master, remedy) || (master.timed_out() && master.run(COLssmSwitchGlobal, waiting) &&
                                       select_all(master, found) && find_node(master, remedy));
}

bool scan_nodes(LssMaster& master, const std::string& remedy, const std::function<void(const LssAddress&)>& report) {
  std::vector<LssAddress> found;
  while (find_next_node(master, found, remedy)) {
    const LssAddress address = master.address();
    if (std::find(found.begin(), found.end(), address) != found.end()) {
      return master.fail("fastscan has found " + address_text(address) +
                         " again: this node answers although it is selected or has a node-ID" + remedy);
    }
    if (!verify_address(master, address)) {
      return false;
    }
    report(address);
    if (!select_all(master, found)) {
      return false;
    }
    found.push_back(address);
  }
  return master.no_node_found();
}

bool select_node(LssMaster& master, const LssRequest& request, std::ostream& out) {
  if (request.address) {
    return master.run_alone(COLssmSwitchSelective, request.address->data()) && has_identity(master, *request.address);
  }
  if (!find_node(master, by_option)) {
    return false;
  }
  const LssAddress address = master.address();
  if (!has_identity(master, address)) {
    return false;
  }
  print_address(out, address);
  return true;
}

/// Configures the node-ID. If several nodes have answered, it is removed again from all: they must not share one.
bool set_node_id(LssMaster& master, std::uint8_t id) {
  if (!master.run(COLssmConfigureNodeId, id)) {
    return false;
  }
  if (master.is_alone()) {
    return true;
  }
  const std::string fault = master.fault();
  master.run(COLssmConfigureNodeId, no_node_id);
  return master.fail(fault);
}

bool inquire(LssMaster& master, std::ostream& out) {
  constexpr const char* parts[] = {"vendor-ID      ", "product code   ", "revision number", "serial number  "};
  for (std::uint8_t part = 0; part < CO_LSSM_PARTS; ++part) {
    if (!master.inquire(COLssmInquire, part)) {
      return false;
    }
    out << parts[part] << text(" 0x%08X", master.value()) << std::endl;
  }
  if (!master.inquire(COLssmInquireNodeId)) {
    return false;
  }
  out << "node-ID         " << (master.value() == no_node_id ? "none" : std::to_string(master.value())) << std::endl;
  return true;
}

bool run_action(LssMaster& master, const LssRequest& request, std::ostream& out) {
  switch (request.action) {
    case LssAction::set_id: return set_node_id(master, static_cast<std::uint8_t>(request.value));
    case LssAction::set_bit_rate: return master.run(COLssmConfigureBitTiming, request.value);
    case LssAction::store: return true;
    case LssAction::inquire: return inquire(master, out);
    default: return false;
  }
}

bool run_request(LssMaster& master, const LssRequest& request, std::ostream& out) {
  if (!master.run(COLssmSwitchGlobal, waiting)) {
    return false;
  }
  if (request.action == LssAction::scan) {
    return scan_nodes(master, by_option, [&](const LssAddress& address) { print_address(out, address); });
  }
  return select_node(master, request, out) && run_action(master, request, out) &&
         (!request.store || master.run(COLssmStore));
}

}  // namespace

int carry_out(const LssRequest& request, Host& host, std::ostream& out, std::ostream& err) {
  ClientDictionary dictionary(no_sdo);
  Node node({request.own_id, host.master_can(), host.master_timer(), dictionary.table()});
  Loop loop(host, {&node});
  LssMaster master(node, loop, {request.timeout, request.listen});
  CONodeStart(&node.stack());
  const bool done = run_request(master, request, out);
  const bool cancelled = !done && master.cancelled() && !host.bus_lost();
  if (!done) {
    const std::string bus_fault = host.bus_fault();
    err << "LSS: " << master.fault() << (bus_fault.empty() ? "" : '\n' + bus_fault) << std::endl;
  }
  master.run(COLssmSwitchGlobal, waiting);
  loop.flush(flush_time);
  return done ? exit_ok : (cancelled ? exit_interrupted : exit_failed);
}

LssSession::LssSession(Host& host, LssMaster::Times times)
    : dictionary_(no_sdo),
      node_({own_id, host.master_can(), host.master_timer(), dictionary_.table()}),
      loop_(host, {&node_}),
      master_(node_, loop_, times) {
  CONodeStart(&node_.stack());
  release();
}

LssSession::~LssSession() {
  release();
  loop_.flush(flush_time);
}

bool LssSession::find_unconfigured(const std::function<void(const LssAddress&)>& found) {
  return scan_nodes(master_, by_name, found);
}

bool LssSession::select(const LssAddress& address) { return release() && verify_address(master_, address); }

bool LssSession::set_node_id(std::uint8_t id) { return lexican::set_node_id(master_, id); }

bool LssSession::set_bit_rate(std::uint32_t bit_rate) { return master_.run(COLssmConfigureBitTiming, bit_rate); }

bool LssSession::store() { return master_.run(COLssmStore); }

bool LssSession::inquire_node_id(std::uint8_t& id) {
  const bool done = master_.inquire(COLssmInquireNodeId);
  id = static_cast<std::uint8_t>(master_.value());
  return done;
}

bool LssSession::release() { return master_.run(COLssmSwitchGlobal, waiting); }

bool LssSession::activate(const std::vector<LssAddress>& slaves, std::uint16_t delay) {
  return release() && select_all(master_, slaves) && master_.run(COLssmActivateBitTiming, delay, std::uint32_t{0});
}

std::string address_name(const LssAddress& address) {
  return text("%08X:%08X:%08X:%08X", address[0], address[1], address[2], address[3]);
}

#else

int carry_out(const LssRequest&, Host&, std::ostream&, std::ostream& err) {
  err << "this build of the stack has no LSS master" << std::endl;
  return exit_usage;
}

#endif

}  // namespace lexican
