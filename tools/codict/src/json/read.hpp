// SPDX-License-Identifier: Apache-2.0
/// \file read.hpp
/// Reader of JSON of the schema codict-device-1, written by codict, by other programs or by hand.
///
/// A field may be given by its value, its text, or both: "access": "rw", {"value": "rw"}, {"text": "rw"}. A missing one
/// is derived from the other. A contradiction is an error, and the text is used.
#pragma once

#include <string>
#include <vector>

#include "json/document.hpp"
#include "model/device.hpp"
#include "text/finding.hpp"

namespace lexican::codict::json {

/// Returns whether the bytes begin like JSON, and not like another description.
bool is_json(const Source& source);

/// Returns an empty text: no bytes are refused, because only the parsed document shows whether it is a description.
inline std::string refusal(const Source& /*source*/) { return {}; }
/// Returns an empty text if the document is a description; else a message that says what it is.
std::string refusal(const Document& document);

/// Reads a document. Members of a wrong type are reported and ignored.
Description read(const Document& document, Findings& findings);

namespace rules {
extern const Rule type;
extern const Rule range;
extern const Rule word;
extern const Rule unknown;
extern const Rule duplicate;
extern const Rule missing;
extern const Rule contradiction;
}  // namespace rules

/// Returns the rules of this file.
const std::vector<const Rule*>& all_rules();

}  // namespace lexican::codict::json
