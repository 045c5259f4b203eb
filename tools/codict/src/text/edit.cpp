// SPDX-License-Identifier: Apache-2.0
#include "text/edit.hpp"

#include <algorithm>

namespace lexican::codict {

std::string Edits::applied_to(std::string_view bytes) const {
  std::vector<const Splice*> ordered;
  for (const Splice& splice : splices_) {
    ordered.push_back(&splice);
  }
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const Splice* a, const Splice* b) { return a->span.begin < b->span.begin; });
  std::string result;
  std::size_t copied = 0;
  for (const Splice* splice : ordered) {
    result += bytes.substr(copied, splice->span.begin - copied);
    result += splice->text;
    copied = splice->span.end;
  }
  result += bytes.substr(copied);
  return result;
}

}  // namespace lexican::codict
