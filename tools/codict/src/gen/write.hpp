// SPDX-License-Identifier: Apache-2.0
/// \file write.hpp
/// The text of the files that are generated, and what they cost.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gen/plan.hpp"

namespace lexican::codict::gen {

std::string write_header(const Plan& plan, const Options& options);
std::string write_source(const Plan& plan, const Options& options);

/// A part of the dictionary, in bytes on a CPU whose addresses have 32 bits.
struct Cost {
  std::string part;  ///< "RAM", "PERSIST_COMM", "table", …
  std::size_t items = 0;
  std::uint64_t ram = 0;
  std::uint64_t flash = 0;
};

std::vector<Cost> costs_of(const Plan& plan);

/// A symbol that the application has to define.
struct External {
  std::string name;         ///< "clock_2002_0"
  std::string declaration;  ///< "extern CO_OBJ_DOM clock_2002_0;"
  std::string about;        ///< "2002h sub 0: Firmware, DOMAIN wo"
};

std::vector<External> externals_of(const Plan& plan, const Options& options);

/// The source of a file, C and C++ alike, which defines these symbols.
std::string write_stubs(const Plan& plan, const Options& options);

/// Directives that name each setting of co_cfg.h that is too small for the plan, with its value.
std::string write_requirements(const Plan& plan);

/// The source of a program, C and C++ alike, that starts a node with the dictionary and prints what the stack says.
std::string write_verify(const Plan& plan, const Options& options);

/// \name Names that header and source share
/// \{
std::string macro_of(const Item& item, const Options& options);     ///< "CLOCK_2100_1"
std::string external_of(const Item& item, const Options& options);  ///< "clock_2200_0"
std::string struct_of(const Group& group, const Options& options);  ///< "clock_persist_comm"
std::string generated_comment(const Options& options);              ///< first lines of every file
bool needs_para(const Plan& plan);
/// \}

}  // namespace lexican::codict::gen
