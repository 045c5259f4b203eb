// SPDX-License-Identifier: Apache-2.0
/// \file recognise.hpp
/// Recognition of XML descriptions by their contents. The file name extension is ambiguous: other formats use it, too.
#pragma once

#include <string>

#include "text/source.hpp"
#include "xdd/document.hpp"

namespace lexican::codict::xdd {

/// Kind of a description, by its root element.
enum class Dialect : unsigned char {
  none,            ///< not a description of a device
  container,       ///< ISO15745ProfileContainer of any namespace, or a part of one
  maxon,           ///< ProfileContainer of maxon and eltra: parameters with an index
  device_profile,  ///< DeviceProfile: objects with elements instead of attributes
  project,         ///< CanOpenProject_1_1, .nxdd and .nxdc: several containers
  canopennode,     ///< _project.xml of CANopenNode before its version 2
};

Dialect dialect_of(pugi::xml_node root);

/// Returns an empty text if the bytes may be such a description; else a message that says what they are.
std::string refusal(const Source& source);
/// Returns an empty text if the elements are those of such a description; else a message that says what the file is.
std::string refusal(const Document& document);

}  // namespace lexican::codict::xdd
