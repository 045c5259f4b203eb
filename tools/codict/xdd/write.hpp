// SPDX-License-Identifier: Apache-2.0
/// \file write.hpp
/// A device as a new XML description.
#pragma once

#include <string>

#include "model/device.hpp"

namespace lexican::codict::xdd {

enum class Edition : unsigned char {
  v10,  ///< CiA 311 1.0: all elements in the namespace
  v11,  ///< CiA 311 1.1: those that the schema declares globally in the namespace, the others in none
};

/// In the order of the schema, with both the type element of CiA 311 and the data type of CiA 301, which says more. What
/// was kept of another XML description is written where it was; nothing else than the device decides a byte. What CiA
/// 311 has no place for is left out: comments, modules and unknown keys of an EDS.
std::string write(const Device& device, Edition edition);

}  // namespace lexican::codict::xdd
