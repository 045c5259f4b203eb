// SPDX-License-Identifier: Apache-2.0
/// \file stores.hpp
/// Sub-indexes of 1010h and 1011h for the storage groups of a plan.
#pragma once

#include "gen/plan.hpp"

namespace lexican::codict::gen {

/// Merges all storage groups into one if 1010h has sub-index 1 only, which stores all parameters.
void join_groups(Plan& plan, Findings& findings);

/// Assigns the sub-indexes, after the layout of the groups is known: by option, by the names of the sub-objects, then
/// by the purposes that CiA 301 gives to sub-indexes 2, 3 and above.
void plan_stores(Plan& plan, const Options& options, Findings& findings);

/// Storage group with its sub-indexes.
struct StoredGroup {
  std::string name;
  std::uint8_t store_sub = 0;    ///< sub-index of 1010h; 0: none
  std::string store_name;        ///< name of the sub-object of 1010h
  std::uint8_t restore_sub = 0;  ///< sub-index of 1011h; 0: none
  std::string restore_name;
  std::size_t entries = 0;
  std::uint32_t bytes = 0;
};

std::vector<StoredGroup> stored_groups(const Plan& plan);

}  // namespace lexican::codict::gen
