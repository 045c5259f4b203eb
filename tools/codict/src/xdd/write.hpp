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

/// Returns the text in the order of the schema. An entry with a parameter has both data types: the type element of the
/// parameter (CiA 311) and, as attribute of the object, the more precise type of CiA 301. Parts that the model does not
/// interpret (OpaquePart) are written where a description of CiA 311 had them; those of other formats are omitted:
/// comments and modules of an EDS, elements of private dialects. The output depends on nothing but the device and the
/// edition.
std::string write(const Device& device, Edition edition);

}  // namespace lexican::codict::xdd
