// SPDX-License-Identifier: Apache-2.0
/// \file set_type.hpp
/// Change of the data type of an object whose type is given by its parameter.
#pragma once

#include <string>
#include <string_view>

#include "model/device.hpp"
#include "text/edit.hpp"
#include "xdd/document.hpp"

namespace lexican::codict::xdd {

/// Returns whether the parameter of an object gives its type.
bool has_parameter_type(const Entry& entry);

/// Changes the element of the parameter, and the object's attribute if it exists or is necessary to distinguish types.
/// type: a name of CiA 301 or CiA 311, or hexadecimal digits. On failure, returns false and sets `why` to the reason.
bool set_type(const Document& document, const Entry& entry, std::string_view type, Edits& edits, std::string& why);

}  // namespace lexican::codict::xdd
