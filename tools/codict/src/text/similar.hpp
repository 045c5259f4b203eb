// SPDX-License-Identifier: Apache-2.0
/// \file similar.hpp
/// Suggestions for misspelled words.
#pragma once

#include <string_view>
#include <vector>

namespace lexican::codict {

/// Returns the nearest words, if they are near enough to be meant, in the order of `words`.
std::vector<std::string_view> similar(std::string_view word, const std::vector<std::string_view>& words);

}  // namespace lexican::codict
