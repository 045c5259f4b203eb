// SPDX-License-Identifier: Apache-2.0
/// \file merge.hpp
/// An EDS with what others say beside it: what they say replaces what it says, or is added to it.
#pragma once

#include <string>
#include <vector>

#include "eds/document.hpp"

namespace lexican::codict::convert {

/// A value that has been replaced by another one.
struct Replaced {
  std::string section;
  std::string key;
  std::string before;
  std::string after;

  /// What an object is, not which value it has: there the overlay contradicts.
  bool is_definition() const;
};

/// The bytes of base with all sections and keys of overlay; all other bytes stay. New objects are put into their lists,
/// and the counts of lists and sub-objects are made right. False if the encoding of base lacks a letter.
bool merge(const eds::Document& base, const eds::Document& overlay, std::string& bytes,
           std::vector<Replaced>& replaced);

}  // namespace lexican::codict::convert
