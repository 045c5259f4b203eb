// SPDX-License-Identifier: Apache-2.0
/// \file report.hpp
/// Output files of a network: descriptions of its nodes and an HTML report.
#pragma once

#include <string>
#include <vector>

#include "network/links.hpp"
#include "network/network.hpp"
#include "network/traffic.hpp"

namespace lexican::codict::network {

struct File {
  std::string name;  ///< file name without directory
  std::string bytes;
};

/// Returns NAME.dcf for each node and, for slaves, the concise DCF NAME.bin. Reports values that NAME.bin cannot
/// contain.
std::vector<File> configuration_files(const Network& network, NetworkFindings& findings);

/// Returns one self-contained HTML page: nodes on their bus, PDO links, bus load, response times and findings.
std::string html_report(const Network& network, const Links& links, const Traffic& traffic,
                        const NetworkFindings& findings);

/// Returns "3.500 ms"; empty for 0.
std::string time_text(Nanoseconds time);

}  // namespace lexican::codict::network
