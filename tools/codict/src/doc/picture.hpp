// SPDX-License-Identifier: Apache-2.0
/// \file picture.hpp
#pragma once

#include <string>
#include <string_view>

#include "doc/contents.hpp"

namespace lexican::codict::doc {

/// Text as HTML and XML have it, between tags and in attributes.
std::string escaped_html(std::string_view text);

/// What lies where in a PDO, as SVG: a box for each part of each byte's row, bit 7 on the left. Boxes have the class
/// "part"; those of one object have its number as data-object.
std::string picture_of(const PdoItem& pdo);

}  // namespace lexican::codict::doc
