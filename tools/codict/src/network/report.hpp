// SPDX-License-Identifier: Apache-2.0
/// \file report.hpp
/// A network as files: descriptions for its nodes and a page for people.
#pragma once

#include <string>
#include <vector>

#include "network/links.hpp"
#include "network/network.hpp"
#include "network/traffic.hpp"

namespace lexican::codict::network {

struct File {
  std::string name;  ///< without directory
  std::string bytes;
};

/// Of each node NAME.dcf and, unless it is a master, NAME.bin, the concise DCF. Reports values that NAME.bin cannot
/// have.
std::vector<File> configuration_files(const Network& network, NetworkFindings& findings);

/// One HTML page that needs nothing else: nodes on their bus, PDO links, bus load, response times and findings.
std::string html_report(const Network& network, const Links& links, const Traffic& traffic,
                        const NetworkFindings& findings);

/// "3.500 ms"; empty for 0.
std::string time_text(Nanoseconds time);

}  // namespace lexican::codict::network
