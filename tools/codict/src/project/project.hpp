// SPDX-License-Identifier: Apache-2.0
/// \file project.hpp
/// Files of a new project beside the description and its dictionary.
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
  std::string name;         ///< of the project; an identifier
  std::string dictionary;   ///< first part of all names of the dictionary; an identifier
  std::string description;  ///< name of the file
  bool is_cpp = false;
  std::uint8_t node_id = 1;
  std::uint16_t tpdo = 0;         ///< number of the TPDO that the program triggers, 0: none
  std::uint32_t tpdo_cob_id = 0;  ///< its COB-ID
  bool has_storage = false;       ///< the dictionary has storage groups
  bool has_application = false;   ///< application.c defines what the dictionary leaves to the application
  std::vector<std::pair<std::string, unsigned>> settings;  ///< of co_cfg.h that the dictionary needs
};

/// CMakeLists.txt, main.c or main.cpp, README.md.
std::vector<File> files(const Options& options);

}  // namespace lexican::codict::project
