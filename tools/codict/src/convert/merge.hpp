// SPDX-License-Identifier: Apache-2.0
/// \file merge.hpp
/// Merges overlays into an EDS or DCF: their values replace existing values, or are added.
#pragma once

#include <string>
#include <vector>

#include "eds/document.hpp"

namespace lexican::codict::convert {

/// Value that an overlay has replaced.
struct ReplacedValue {
  std::string section;
  std::string key;
  std::string before;
  std::string after;

  /// Returns true if the key defines the object, so that the overlay contradicts the base; false if it is a value.
  bool is_definition() const;
};

/// Returns in bytes the base with all sections and keys of the overlay; all other bytes are unchanged. Adds new objects
/// to the lists and corrects all counts. Returns false if the encoding of base lacks a character.
bool merge(const eds::Document& base, const eds::Document& overlay, std::string& bytes,
           std::vector<ReplacedValue>& replaced);

}  // namespace lexican::codict::convert
