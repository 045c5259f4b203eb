// SPDX-License-Identifier: Apache-2.0
/// \file recognise.hpp
/// Whether a file is an XML description of a CANopen device at all. Its ending says nothing: others use the same.
#pragma once

#include <string>

#include "text/source.hpp"
#include "xdd/document.hpp"

namespace lexican::codict::xdd {

/// What the root element shows.
enum class Dialect : unsigned char {
  none,            ///< no description of a device
  container,       ///< ISO15745ProfileContainer, of any namespace, and the parts of one
  maxon,           ///< ProfileContainer of maxon and eltra: parameters with an index
  device_profile,  ///< DeviceProfile: objects with elements for attributes
  project,         ///< CanOpenProject_1_1, .nxdd and .nxdc: several containers
  canopennode,     ///< _project.xml of CANopenNode before its version 2
};

Dialect dialect_of(pugi::xml_node root);

/// Empty if the bytes may be such a description; else what they are instead, as far as that shows before they are read.
std::string refusal(const Source& source);
/// The same for what its elements show.
std::string refusal(const Document& document);

}  // namespace lexican::codict::xdd
