// SPDX-License-Identifier: Apache-2.0
/// \file recorder.hpp
/// Declarations that the parts of a comparison share.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diff/diff.hpp"

namespace lexican::codict::diff {

/// Appends the differences of one place to a list.
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

  /// Compares texts literally.
  void text(Kind kind, std::string_view what, const Text& old_text, const Text& new_text) const {
    if (old_text.text != new_text.text) {
      add(kind, what, old_text, new_text);
    }
  }

  /// Compares fields by their values. A field that is not given is shown as empty text.
  template <typename T>
  void field(Kind kind, std::string_view what, const Field<T>& old_field, const Field<T>& new_field) const {
    if (old_field.value != new_field.value) {
      add(kind, what, old_field, new_field);
    }
  }

  /// Compares numbers or flags that describe a capability: a decrease is breaking.
  template <typename T>
  void ability(std::string_view what, const Field<T>& old_field, const Field<T>& new_field) const {
    field(new_field.value < old_field.value ? Kind::breaking : Kind::compatible, what, old_field, new_field);
  }
};

/// Compares everything but the objects: identity, features, file information.
void compare_headers(const Recorder& recorder);

/// Compares an object without its sub-objects, or a sub-object.
void compare_entries(const Entry& before, const Entry& after, const Recorder& recorder);

}  // namespace lexican::codict::diff
