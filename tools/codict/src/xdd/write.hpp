// SPDX-License-Identifier: Apache-2.0
/// \file write.hpp
/// Writer of a device as a new XML description.
#pragma once

#include <string>

#include "model/device.hpp"

namespace lexican::codict::xdd {

enum class Edition : unsigned char {
  v10,  ///< CiA 311 1.0: all elements are in the namespace
  v11,  ///< CiA 311 1.1: elements that the schema declares globally are in the namespace, others in none
};

/// Returns the text in the order of the schema, with the type element of CiA 311 and the more precise data type of CiA
/// 301. Kept parts of a description of CiA 311 are written at their places. Private parts of other formats are omitted:
/// comments and modules of an EDS, elements of private dialects. The output depends on nothing but the device and the
/// edition.
std::string write(const Device& device, Edition edition);

}  // namespace lexican::codict::xdd
