// SPDX-License-Identifier: Apache-2.0
/// \file master.hpp
/// Generates the device of the NMT master that a plan describes. [CiA 302-2, CiA 302-3]
#pragma once

#include <cstdint>
#include <vector>

#include "network/network.hpp"
#include "network/plan.hpp"

namespace lexican::codict::network {

/// Returns the master of a network whose slaves are already configured. consumer_times: heartbeat consumer time for
/// each slave, in ms; 0: it has no heartbeat.
Node generated_master(const Plan& plan, const Network& network, const std::vector<std::uint64_t>& consumer_times,
                      Findings& findings);

}  // namespace lexican::codict::network
