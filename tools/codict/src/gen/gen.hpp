// SPDX-License-Identifier: Apache-2.0
/// \file gen.hpp
/// Generates the source of a device's object dictionary: sorted table, variables, storage groups, limits, and
/// compile-time checks. The output depends on nothing but the device and the options.
#pragma once

#include <string>
#include <vector>

#include "gen/plan.hpp"
#include "gen/stores.hpp"
#include "gen/write.hpp"

namespace lexican::codict::gen {

struct File {
  std::string name;  ///< file name without directory
  std::string bytes;
};

struct Output {
  std::vector<File> files;
  std::vector<Cost> costs;
  std::vector<StoredGroup> groups;  ///< the storage groups
  std::vector<External> externals;  ///< symbols that the application has to define
  std::string verify;               ///< source of the program that starts a node with the dictionary
  std::string stubs;                ///< source that defines the externals; empty if there are no externals
  Device device;                    ///< the device as generated, for an EDS or XDD that matches the dictionary
};

/// Returns the names of the header and of the source.
std::string header_name(const Options& options);
std::string source_name(const Options& options);

/// Returns a C identifier from the name of a file: "clock_2" from "Clock (2).eds"; "device" if no character can be
/// used.
std::string default_name(std::string_view path);

/// Generates the files of a dictionary. There are none if the generator finds an error.
Output generate(const Device& device, const Options& options, Findings& findings);
/// Generates the files of a plan without errors; Output::device is not set. They need several times the memory of the
/// plan: the functions of write.hpp generate one at a time.
Output generate(const Plan& plan, const Options& options);

}  // namespace lexican::codict::gen
