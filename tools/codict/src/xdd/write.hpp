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

/// In the order of the schema, with both the type element of CiA 311 and the data type of CiA 301, which says more.
/// What was kept of another description of CiA 311 is written where it was; what other formats say in ways of their own
/// is left out: comments and modules of an EDS, elements of private dialects. Nothing but the device decides a byte.
std::string write(const Device& device, Edition edition);

}  // namespace lexican::codict::xdd
