// SPDX-License-Identifier: Apache-2.0
/// \file file.hpp
/// Reading and writing of whole files; a write either completes or leaves the old file unchanged.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "text/source.hpp"

namespace lexican::codict {

/// Reads a file; path "-" is the standard input. On failure, returns nothing and sets `why` to one line with the
/// reason.
std::optional<Source> read_file(const std::string& path, std::string& why);

enum class Written { no, unchanged, yes };

/// Writes a file; path "-" is the standard output. A file that already has these bytes is not written, and keeps its
/// modification time. Else a new file replaces it, after it is complete and on the medium (fsync of file and
/// directory). On Written::no, `why` is set to one line with the reason. On Written::yes, `why` is a warning if the
/// directory could not be synchronised, else empty.
Written write_file(const std::string& path, std::string_view bytes, std::string& why);

}  // namespace lexican::codict
