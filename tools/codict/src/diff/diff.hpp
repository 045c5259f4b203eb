// SPDX-License-Identifier: Apache-2.0
/// \file diff.hpp
/// Differences between two descriptions of a device, and their consequences for users. The models are compared:
/// spelling and order of the files have no influence.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/device.hpp"

namespace lexican::codict::diff {

enum class Kind : unsigned char {
  breaking,       ///< a network that was configured for the first device may fail with the second
  compatible,     ///< networks continue to work
  configuration,  ///< settings of a single device: node-ID, configured values
  text,           ///< names and descriptions
  file,           ///< dates, authors and version of the file
};

std::string_view name_of(Kind kind);

/// Object, sub-object, or the device as a whole.
struct Place {
  std::uint16_t index = 0;  ///< 0: the device as a whole
  std::uint8_t sub_index = 0;
  bool has_sub_index = false;
  std::string module;  ///< number of the bus coupler's module; empty for the device itself
};

/// Returns "2000h:1F", "2000h" or "module 3, 2000h"; empty for the device as a whole.
std::string to_string(const Place& place);

struct Difference {
  Kind kind = Kind::compatible;
  Place place;
  std::string what;  ///< "access", "PDO mapping", "object"
  std::string before;
  std::string after;
  Span before_span;  ///< place in the first source; empty at offset 0 if the text is not in it
  Span after_span;   ///< place in the second source; empty at offset 0 if the text is not in it
};

/// Returns the differences: first those of the device, then of each object, followed by those of its sub-objects.
std::vector<Difference> compare(const Device& before, const Device& after);

std::size_t count(const std::vector<Difference>& differences, Kind kind);

/// Returns false if a difference is breaking and the major revision number has not been increased, which is the upper
/// half of 1018h sub-index 3. [301: 7.5.2.18]
bool is_announced(const Device& before, const Device& after, const std::vector<Difference>& differences);

}  // namespace lexican::codict::diff
