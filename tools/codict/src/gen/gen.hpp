// SPDX-License-Identifier: Apache-2.0
/// \file gen.hpp
/// From a device to the source of its dictionary: sorted table, variables, storage groups, limits, and what the
/// compiler is to prove about them. The same device and options give the same bytes, always.
#pragma once

#include <string>
#include <vector>

#include "gen/plan.hpp"
#include "gen/stores.hpp"
#include "gen/write.hpp"

namespace lexican::codict::gen {

struct File {
  std::string name;  ///< without directory
  std::string bytes;
};

struct Output {
  std::vector<File> files;
  std::vector<Cost> costs;
  std::vector<StoredGroup> groups;  ///< the storage groups
  std::vector<External> externals;  ///< what the application has to define
  std::string verify;               ///< source of the program that starts a node with the dictionary
  std::string stubs;                ///< source that defines the externals; empty if there are none
  Device device;                    ///< as it is made: for an EDS or XDD that matches it
};

/// A C identifier from the name of a file: "Clock (2).eds" gives "clock_2"; "device" if nothing is left.
std::string default_name(std::string_view path);

/// Files are empty if there were errors, which findings name.
Output generate(const Device& device, const Options& options, Findings& findings);

}  // namespace lexican::codict::gen
