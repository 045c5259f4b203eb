// SPDX-License-Identifier: Apache-2.0
/// \file lss.hpp
/// Finds and configures nodes by their LSS address, for a command line. [305]
#pragma once

#include <functional>
#include <ostream>
#include <vector>

#include "client/arguments.hpp"
#include "client/lss_master.hpp"
#include "client/sdo_client.hpp"
#include "host/host.hpp"

namespace lexican {

/// Starts a separate node on the bus and executes the request; all slaves are then in the state waiting. Prints found
/// slaves and inquired values to \a out, faults to \a err. Returns the exit code.
int carry_out(const LssRequest& request, Host& host, std::ostream& out, std::ostream& err);

#if USE_LSS_MASTER

/// A separate node on the bus as LSS master. All slaves are in the state waiting at the begin and at the end. If a
/// function returns false, fault() says why.
class LssSession {
 public:
  /// \a host must outlive it.
  LssSession(Host& host, LssMaster::Times times);
  ~LssSession();
  LssSession(const LssSession&) = delete;
  LssSession& operator=(const LssSession&) = delete;

  /// Finds the slaves without node-ID by fastscan, and calls \a found for each.
  bool find_unconfigured(const std::function<void(const LssAddress&)>& found);
  /// Switches a slave to the state configuration: the only one that answers to its address.
  bool select(const LssAddress& address);
  /// Configures the node-ID of the selected slave. If several slaves answer, none keeps it.
  bool set_node_id(std::uint8_t id);
  /// Configures the bit rate of the selected slave, in bit/s; activate() switches to it.
  bool set_bit_rate(std::uint32_t bit_rate);
  /// Lets the selected slave store node-ID and bit rate.
  bool store();
  /// Inquires the node-ID of the selected slave. \a id: 255 if it has none.
  bool inquire_node_id(std::uint8_t& id);
  /// Switches all slaves to the state waiting. A slave that has received a node-ID boots with it.
  bool release();
  /// Activates the bit rates of these slaves together, after \a delay ms. No node sends frames for \a delay ms before
  /// and after.
  bool activate(const std::vector<LssAddress>& slaves, std::uint16_t delay);

  std::string fault() const { return master_.fault(); }
  bool is_cancelled() const { return master_.cancelled(); }
  /// Returns true if the selected slave has not answered the last request.
  bool is_silent() const { return master_.timed_out(); }

 private:
  ClientDictionary dictionary_;
  Node node_;
  Loop loop_;
  LssMaster master_;
};

/// Returns "00000100:00000402:00010000:000001A2".
std::string address_name(const LssAddress& address);

#endif

}  // namespace lexican
