// SPDX-License-Identifier: Apache-2.0
/// \file project.hpp
/// Files of a new project, except for the description and the dictionary.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lexican::codict::project {

struct File {
  std::string name;  ///< path below the directory of the project
  std::string bytes;
};

struct Options {
  std::string name;         ///< name of the project; an identifier
  std::string dictionary;   ///< prefix of all names of the dictionary; an identifier
  std::string description;  ///< file name of the description
  bool is_cpp = false;
  std::uint8_t node_id = 1;
  std::uint16_t tpdo = 0;         ///< number of the TPDO that the program triggers, 0: none
  std::uint32_t tpdo_cob_id = 0;  ///< its COB-ID
  bool has_storage = false;       ///< the dictionary has storage groups
  bool is_forced = false;         ///< the description has errors: the build passes --force, and does not verify
  bool has_application = false;   ///< application.c defines symbols that the dictionary declares extern
  std::vector<std::pair<std::string, unsigned>> settings;  ///< minimum settings of co_cfg.h
};

/// Returns CMakeLists.txt, main.c or main.cpp, and README.md.
std::vector<File> files(const Options& options);

}  // namespace lexican::codict::project
