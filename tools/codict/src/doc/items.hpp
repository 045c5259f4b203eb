// SPDX-License-Identifier: Apache-2.0
/// \file items.hpp
/// Texts for objects and their values.
#pragma once

#include <cstdint>
#include <string>

#include "doc/contents.hpp"

namespace lexican::codict::doc {

/// Returns "2000h".
std::string number_of(std::uint16_t index);
/// Returns "2000h:1F".
std::string number_of(std::uint16_t index, std::uint8_t sub_index);
std::string anchor_of(std::uint16_t index);
std::string anchor_of(std::uint16_t index, std::uint8_t sub_index);

ObjectItem item_of(const Device& device, const Object& object, const Options& options);

/// Returns the label in the language of the options, else the name.
std::string name_in(const Entry& entry, const Options& options);

}  // namespace lexican::codict::doc
