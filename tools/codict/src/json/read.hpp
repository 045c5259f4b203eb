// SPDX-License-Identifier: Apache-2.0
/// \file read.hpp
/// JSON of the schema codict-device-1, as our writer, other programs and people write it.
///
/// A value may be given as it is meant, as text, or both: "access": "rw", {"value": "rw"}, {"text": "rw"}. What is
/// missing is made of the other; where both say something, the value holds.
#pragma once

#include <string>
#include <vector>

#include "json/document.hpp"
#include "model/device.hpp"
#include "text/finding.hpp"

namespace lexican::codict::json {

/// Whether the bytes begin as JSON does, and no other description.
bool is_json(const Source& source);

/// All that it may be shows when it has been read.
inline std::string refusal(const Source& /*source*/) { return {}; }
/// Empty if the document may be a description; else what it is instead.
std::string refusal(const Document& document);

/// Members of a wrong type are findings, and left out.
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

/// All rules of this room.
const std::vector<const Rule*>& all_rules();

}  // namespace lexican::codict::json
