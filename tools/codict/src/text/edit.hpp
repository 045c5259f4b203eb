// SPDX-License-Identifier: Apache-2.0
/// \file edit.hpp
/// Edits of a source text: splices that preserve all other bytes.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/source.hpp"

namespace lexican::codict {

/// A replacement of the bytes of a span by a text. With an empty span it is an insertion.
struct Splice {
  Span span;
  std::string text;
};

class Edits {
 public:
  bool is_empty() const { return splices_.empty(); }
  void replace(Span span, std::string text) { splices_.push_back({span, std::move(text)}); }
  /// Inserts text at an offset, after earlier insertions at that offset.
  void insert(std::uint32_t offset, std::string text) { replace({offset, offset}, std::move(text)); }

  /// Returns the bytes with all edits applied. The spans must not overlap.
  std::string applied_to(std::string_view bytes) const;

 private:
  std::vector<Splice> splices_;
};

}  // namespace lexican::codict
