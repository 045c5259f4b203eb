// SPDX-License-Identifier: Apache-2.0
/// \file similar.hpp
/// Which word may be meant by one that is none.
#pragma once

#include <string_view>
#include <vector>

namespace lexican::codict {

/// Those of the words that are nearest, if they are near; in their order.
std::vector<std::string_view> similar(std::string_view word, const std::vector<std::string_view>& words);

}  // namespace lexican::codict
