// SPDX-License-Identifier: Apache-2.0
/// \file library.hpp
/// A directory with descriptions of devices, which are found by the identity of a device (1018h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "describe/description.hpp"

namespace lexican::describe {

/// Identity object of a device. [301:7.5.2.23]
struct Identity {
  std::uint32_t vendor = 0;
  std::uint32_t product = 0;
  std::uint32_t revision = 0;
};

/// Returns the user's directory: $XDG_CONFIG_HOME/lexican/eds, else ~/.config/lexican/eds; empty: there is no home.
std::string user_library();

/// Returns the descriptions of a directory (EDS, DCF, XDD, XDC) in the order of their names.
std::vector<std::string> description_files(const std::string& directory, std::error_code& error);

struct Known {
  std::string file;
  Description description;
};

/// Returns the description of \a directory with this vendor-ID and product code; if there are several, one with this
/// revision number, else the first one. Files that cannot be read are ignored.
std::optional<Known> find_description(const std::string& directory, const Identity& identity);

/// Stores an EDS that a device has supplied, in a file that is named by the identity, and creates the directory.
/// \retval nothing  it cannot be read, is of another device, or cannot be stored; \a why says so
std::optional<Known> store_description(const std::string& directory, const Identity& identity, std::string bytes,
                                       std::string& why);

}  // namespace lexican::describe
