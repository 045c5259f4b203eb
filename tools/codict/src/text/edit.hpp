// SPDX-License-Identifier: Apache-2.0
/// \file edit.hpp
/// Changes of a text that leave every other byte where it is.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/source.hpp"

namespace lexican::codict {

/// The bytes of a span, which may be empty, become text.
struct Splice {
  Span span;
  std::string text;
};

class Edits {
 public:
  bool is_empty() const { return splices_.empty(); }
  void replace(Span span, std::string text) { splices_.push_back({span, std::move(text)}); }
  /// Behind what was inserted at the same place before.
  void insert(std::uint32_t offset, std::string text) { replace({offset, offset}, std::move(text)); }

  /// The spans must not overlap.
  std::string applied_to(std::string_view bytes) const;

 private:
  std::vector<Splice> splices_;
};

}  // namespace lexican::codict
