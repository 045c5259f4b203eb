// SPDX-License-Identifier: Apache-2.0
/// \file items.hpp
/// Objects and their values in words.
#pragma once

#include <cstdint>
#include <string>

#include "doc/contents.hpp"

namespace lexican::codict::doc {

/// "2000h"
std::string number_of(std::uint16_t index);
/// "2000h:1F"
std::string number_of(std::uint16_t index, std::uint8_t sub_index);
std::string anchor_of(std::uint16_t index);
std::string anchor_of(std::uint16_t index, std::uint8_t sub_index);

ObjectItem item_of(const Device& device, const Object& object, const Options& options);

/// Its label in the language, or else its name.
std::string name_in(const Entry& entry, const Options& options);

}  // namespace lexican::codict::doc
