// SPDX-License-Identifier: Apache-2.0
#include "text/similar.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace lexican::codict {

namespace {

// Returns the Levenshtein distance: the least number of letters that are changed, inserted or deleted.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t m = 0; m < a.size(); ++m) {
    std::size_t diagonal = row[0];
    row[0] = m + 1;
    for (std::size_t n = 0; n < b.size(); ++n) {
      const std::size_t replaced = diagonal + (a[m] == b[n] ? 0 : 1);
      diagonal = row[n + 1];
      row[n + 1] = std::min({replaced, row[n] + 1, row[n + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::vector<std::string_view> similar(std::string_view word, const std::vector<std::string_view>& words) {
  constexpr std::size_t longest = 64;  // limits the time; longer words are similar to none
  std::vector<std::string_view> nearest;
  if (word.size() > longest) {
    return nearest;
  }
  std::size_t least = 2 + word.size() / 8;
  for (const std::string_view each : words) {
    const std::size_t far = distance(word, each);
    if (far < least) {
      least = far;
      nearest.clear();
    }
    if (far <= least) {
      nearest.push_back(each);
    }
  }
  return nearest;
}

}  // namespace lexican::codict
