// SPDX-License-Identifier: Apache-2.0
/// \file files.hpp
/// Descriptions in directories: the fixtures, and descriptions of real devices, which cannot be published.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace test {

/// Returns the directory in the environment variable LEXICAN_CORPUS, null if it is not set.
const char* corpus();
/// Suite of the test cases that need the corpus; tests/run prints it if they are skipped.
inline constexpr const char* needs_corpus = "needs LEXICAN_CORPUS, a directory of device descriptions";
/// Skips test cases that need the corpus if there is none.
doctest::skip skipped_without_corpus();

using Endings = std::vector<std::string>;
const Endings& eds_endings();
const Endings& xml_endings();
const Endings& all_endings();  ///< those of eds_endings() and xml_endings()

/// Returns the paths of a directory in sorted order. are_foreign: those files of the corpus that describe no CANopen
/// device.
std::vector<std::string> files_in(const std::string& directory, const Endings& endings, bool are_foreign = false);

}  // namespace test
