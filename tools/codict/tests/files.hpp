// SPDX-License-Identifier: Apache-2.0
/// \file files.hpp
/// Descriptions in directories: our fixtures, and those from the field, which are not ours to publish.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace test {

/// The directory that LEXICAN_CORPUS names; null without one.
const char* corpus();
/// For cases that need it.
doctest::skip skipped_without_corpus();

using Endings = std::vector<std::string>;
const Endings& eds_endings();
const Endings& xml_endings();
const Endings& all_endings();  ///< of both

/// Sorted. In the corpus, those that describe no CANopen device are foreign.
std::vector<std::string> files_in(const std::string& directory, const Endings& endings, bool are_foreign = false);

}  // namespace test
