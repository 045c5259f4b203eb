// SPDX-License-Identifier: Apache-2.0
/// \file recorder.hpp
/// What the parts of a comparison share.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diff/diff.hpp"

namespace lexican::codict::diff {

/// Writes down the differences of one place.
struct Recorder {
  std::vector<Difference>& differences;
  const Device& before;
  const Device& after;
  Place place;

  Recorder at(Place other) const {
    other.module = place.module;
    return {differences, before, after, std::move(other)};
  }

  void add(Kind kind, std::string_view what, const Text& old_text, const Text& new_text) const {
    differences.push_back({kind, place, std::string(what), old_text.text, new_text.text, old_text.span, new_text.span});
  }

  /// Texts that mean what they say.
  void text(Kind kind, std::string_view what, const Text& old_text, const Text& new_text) const {
    if (old_text.text != new_text.text) {
      add(kind, what, old_text, new_text);
    }
  }

  /// Fields, by what they mean. What is not given is shown as it is written: not at all.
  template <typename T>
  void field(Kind kind, std::string_view what, const Field<T>& old_field, const Field<T>& new_field) const {
    if (old_field.value != new_field.value) {
      add(kind, what, old_field, new_field);
    }
  }

  /// A number of which more is better, or something that is there or is not.
  template <typename T>
  void ability(std::string_view what, const Field<T>& old_field, const Field<T>& new_field) const {
    field(new_field.value < old_field.value ? Kind::breaking : Kind::compatible, what, old_field, new_field);
  }
};

/// Everything beside the objects: identity, features, the file.
void compare_headers(const Recorder& recorder);

/// An object without its sub-objects, or a sub-object.
void compare_entries(const Entry& before, const Entry& after, const Recorder& recorder);

}  // namespace lexican::codict::diff
