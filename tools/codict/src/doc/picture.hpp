// SPDX-License-Identifier: Apache-2.0
/// \file picture.hpp
/// Pictures of PDO mappings for the HTML page.
#pragma once

#include <string>
#include <string_view>

#include "doc/contents.hpp"

namespace lexican::codict::doc {

/// Escapes a text for HTML and XML, for use between tags and in attributes.
std::string escaped_html(std::string_view text);

/// Draws the mapping of a PDO as SVG: a row for each byte, bit 7 on the left, with a box for each part of an object.
/// Boxes have the class "part" and the object's number as data-object.
std::string picture_of(const PdoItem& pdo);

}  // namespace lexican::codict::doc
