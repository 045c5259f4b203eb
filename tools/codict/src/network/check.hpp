// SPDX-License-Identifier: Apache-2.0
/// \file check.hpp
/// Checks between the nodes of a network.
#pragma once

#include "network/links.hpp"
#include "network/network.hpp"

namespace lexican::codict::network {

/// Runs all checks below, and check_nodes().
void check_all(const Network& network, const Links& links, NetworkFindings& findings);

/// Reports COB-IDs that two services transmit. [301: 7.3.5]
void check_cob_ids(const Network& network, NetworkFindings& findings);

/// Reports TPDOs without consumer, RPDOs without producer, different lengths, and deadlines that are too short.
void check_links(const Network& network, const Links& links, NetworkFindings& findings);

/// Checks heartbeat consumers against producers, and node guarding against life guarding. [301: 7.2.8.3]
void check_error_control(const Network& network, NetworkFindings& findings);

/// Checks SYNC producers and consumers, counters and synchronous PDOs. [301: 7.2.5]
void check_sync(const Network& network, const Links& links, NetworkFindings& findings);

/// Returns the node that produces SYNC: the first one with bit 30 of 1005h; -1 if there is none.
int sync_producer(const Network& network);

}  // namespace lexican::codict::network
