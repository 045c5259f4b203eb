// SPDX-License-Identifier: Apache-2.0
/// \file file.hpp
/// Files as a whole: read at once, written at once or not at all.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "text/source.hpp"

namespace lexican::codict {

/// path "-" is the standard input. Without a result, why says what is wrong, in one line.
std::optional<Source> read_file(const std::string& path, std::string& why);

enum class Written { no, unchanged, yes };

/// path "-" is the standard output. A file that has these bytes already is left alone, with its time; else a new file
/// takes its place when it is complete and on the medium (fsync of file and directory). On Written::no, why says what
/// is wrong.
Written write_file(const std::string& path, std::string_view bytes, std::string& why);

}  // namespace lexican::codict
