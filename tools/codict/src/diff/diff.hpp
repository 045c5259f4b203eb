// SPDX-License-Identifier: Apache-2.0
/// \file diff.hpp
/// What is different between two descriptions of a device, and what that means for those who use it. It is the models
/// that are compared: 0x10 is 16, and the order of a file tells nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/device.hpp"

namespace lexican::codict::diff {

enum class Kind : unsigned char {
  breaking,       ///< a network that was made for the one may fail with the other
  compatible,     ///< what worked goes on to work
  configuration,  ///< what one device of the kind is told: its node-ID, its values
  text,           ///< names, descriptions
  file,           ///< dates, authors, versions of the file
};

std::string_view name_of(Kind kind);

/// Where in a device: of an object, of a sub-object, or of neither.
struct Place {
  std::uint16_t index = 0;  ///< 0: the device as a whole
  std::uint8_t sub_index = 0;
  bool has_sub_index = false;
  std::string module;  ///< of a bus coupler; empty for the device itself
};

/// "2000h:1F", "2000h", "module 3, 2000h"; empty for the device as a whole.
std::string to_string(const Place& place);

struct Difference {
  Kind kind = Kind::compatible;
  Place place;
  std::string what;  ///< "access", "PDO mapping", "object"
  std::string before;
  std::string after;
  Span before_span;  ///< in the one source …
  Span after_span;   ///< … and in the other; empty at 0 if nothing is there
};

/// By kind of place: the device, then objects in their order, each with its sub-objects.
std::vector<Difference> compare(const Device& before, const Device& after);

std::size_t count(const std::vector<Difference>& differences, Kind kind);

/// May the second one be delivered with the revision number that it has? Whatever breaks a network raises the major
/// revision number, which is the upper half of 1018h, sub-index 3. [301: 7.5.2.18]
bool is_announced(const Device& before, const Device& after, const std::vector<Difference>& differences);

}  // namespace lexican::codict::diff
