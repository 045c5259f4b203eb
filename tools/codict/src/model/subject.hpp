// SPDX-License-Identifier: Apache-2.0
/// \file subject.hpp
/// Names of objects in messages: "2000h 'Ratio'", "2000h:01 'Gain'".
#pragma once

#include <cstdint>
#include <string>

#include "model/device.hpp"
#include "text/finding.hpp"

namespace lexican::codict {

/// Returns index and name of an object.
std::string subject_of(const Object& object);

/// Returns index, sub-index and name of an entry. The name is missing if the device does not describe it.
std::string subject_of(const Device& device, std::uint16_t index, std::uint8_t sub_index);

/// Returns a value as it is written, shortened.
std::string text_of(const Value& value);

/// Returns the name of a data type, "UNSIGNED8", or its index, "0099h", if CiA 301 does not define it.
std::string type_text(std::uint16_t code);

/// Sets the subject of each finding that is located in the text of an object, a sub-object or a parameter.
void name_subjects(const Device& device, Findings& findings);

}  // namespace lexican::codict
