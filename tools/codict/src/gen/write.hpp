// SPDX-License-Identifier: Apache-2.0
/// \file write.hpp
/// Texts and costs of the generated files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gen/plan.hpp"

namespace lexican::codict::gen {

/// Usual length of header or source for an entry of the table.
constexpr std::size_t usual_length = 600;

std::string write_header(const Plan& plan, const Options& options);
std::string write_source(const Plan& plan, const Options& options);

/// Cost of a part of the dictionary, in bytes on a CPU with 32-bit addresses.
struct Cost {
  std::string part;  ///< "RAM", "PERSIST_COMM", "table", …
  std::size_t items = 0;
  std::uint64_t ram = 0;
  std::uint64_t flash = 0;
};

std::vector<Cost> costs_of(const Plan& plan);

/// Symbol that the application has to define.
struct External {
  std::string name;         ///< "clock_2002_0"
  std::string declaration;  ///< "extern CO_OBJ_DOM clock_2002_0;"
  std::string about;        ///< "2002h sub 0: Firmware, DOMAIN wo"
};

std::vector<External> externals_of(const Plan& plan, const Options& options);

/// Returns the source of a file, valid C and C++, that defines the externals.
std::string write_stubs(const Plan& plan, const Options& options);

/// Returns preprocessor directives that report each setting of co_cfg.h that is too small for the plan, with its value.
std::string write_requirements(const Plan& plan);

/// Returns the source of a program, valid C and C++, that starts a node with the dictionary and prints the errors that
/// the stack reports.
std::string write_verify(const Plan& plan, const Options& options);

/// \name Names used in header and source
/// \{
std::string macro_of(const Item& item, const Options& options);     ///< "CLOCK_2100_1"
std::string external_of(const Item& item, const Options& options);  ///< "clock_2200_0"
std::string shared_of(const Item& item, const Options& options);    ///< "clock_1023", also for 1024h
std::string struct_of(const Group& group, const Options& options);  ///< "clock_persist_comm"
std::string generated_comment(const Options& options);              ///< first lines of every file
bool needs_para(const Plan& plan);
/// \}

}  // namespace lexican::codict::gen
