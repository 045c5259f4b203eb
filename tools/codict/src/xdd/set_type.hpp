// SPDX-License-Identifier: Apache-2.0
/// \file set_type.hpp
/// Another data type for an object whose parameter says which one it has.
#pragma once

#include <string>
#include <string_view>

#include "model/device.hpp"
#include "text/edit.hpp"
#include "xdd/document.hpp"

namespace lexican::codict::xdd {

/// Whether a parameter names the type, and not the object alone.
bool has_parameter_type(const Entry& entry);

/// The element of the parameter, and the attribute of the object where one is there, or is needed to tell types apart.
/// type: a name of CiA 301 or CiA 311, or hexadecimal digits. False leaves why not.
bool set_type(const Document& document, const Entry& entry, std::string_view type, Edits& edits, std::string& why);

}  // namespace lexican::codict::xdd
